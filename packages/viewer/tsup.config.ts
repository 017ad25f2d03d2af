import { glanzPackage } from '../../tsup.base';

export default glanzPackage({
  index: 'src/index.ts',
  controls: 'src/controls.ts',
  orbit: 'src/orbit.ts',
  load: 'src/load.ts',
  engine: 'src/engine.ts',
  denoise: 'src/denoise.ts',
  'fit-camera': 'src/fit-camera.ts',
  'render-image': 'src/render-image.ts',
  record: 'src/record/index.ts',
});
