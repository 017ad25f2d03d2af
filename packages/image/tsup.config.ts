import { glanzPackage } from '../../tsup.base';

export default glanzPackage({
  index: 'src/index.ts',
  hdr: 'src/hdr.ts',
  png: 'src/png.ts',
  exr: 'src/exr.ts',
  environment: 'src/environment.ts',
  half: 'src/half.ts',
  'gain-map': 'src/gain-map.ts',
});
