import { glanzPackage } from '../../tsup.base';

export default glanzPackage({
  index: 'src/index.ts',
  obj: 'src/obj.ts',
  stl: 'src/stl.ts',
  ies: 'src/ies.ts',
  usd: 'src/usd/index.ts',
  node: 'src/node.ts',
});
