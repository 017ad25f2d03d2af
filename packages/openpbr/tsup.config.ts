import { glanzPackage } from '../../tsup.base';

export default glanzPackage({
  index: 'src/index.ts',
  parameters: 'src/parameters/index.ts',
  wgsl: 'src/wgsl/index.ts',
  lobes: 'src/wgsl/lobes/index.ts',
  film: 'src/wgsl/thin_film/index.ts',
  cpu: 'src/cpu/index.ts',
  tables: 'src/tables/index.ts',
  gltf: 'src/gltf/index.ts',
  materialx: 'src/materialx/index.ts',
  presets: 'src/presets/index.ts',
  versions: 'src/versions/index.ts',
});
