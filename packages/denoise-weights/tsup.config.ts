import { glanzPackage } from '../../tsup.base';
import { writeWeights } from './scripts/weights.mjs';
import { WEIGHT_ARCHIVES } from './src/archives';

export default {
  ...glanzPackage({
    index: 'src/index.ts',
    small: 'src/small.ts',
    base: 'src/base.ts',
    large: 'src/large.ts',
    ldr: 'src/ldr.ts',
    node: 'src/node.ts',
  }),
  onSuccess: async () => writeWeights(WEIGHT_ARCHIVES),
};
