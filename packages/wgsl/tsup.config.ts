import { glanzPackage } from '../../tsup.base';

export default glanzPackage({
  index: 'src/index.ts',
  compose: 'src/compose.ts',
  module: 'src/module.ts',
  struct: 'src/struct.ts',
  shader: 'src/shader.ts',
  error: 'src/error.ts',
});
