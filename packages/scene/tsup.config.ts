import { glanzPackage } from '../../tsup.base';

export default glanzPackage({
  index: 'src/index.ts',
  studio: 'src/studio.ts',
  'texture-budget': 'src/texture-budget.ts',
  pose: 'src/pose/index.ts',
  node: 'src/node.ts',
});
