import { writeSample } from '../element/scripts/sample.mjs';
import { glanzPackage } from '../../tsup.base';

export default {
  ...glanzPackage({ index: 'src/index.ts', 'create-glanz': 'src/create-glanz.ts' }, { platform: 'node' }),
  // The model that every starter shows until its author has one.
  onSuccess: () => writeSample(process.cwd(), 'dist/push-button.glb'),
};
