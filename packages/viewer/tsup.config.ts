import { glanzPackage } from '../../tsup.base';

export default glanzPackage({
  index: 'src/index.ts',
  controls: 'src/controls.ts',
  orbit: 'src/orbit.ts',
  load: 'src/load.ts',
});
