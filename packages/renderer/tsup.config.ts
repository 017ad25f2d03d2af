import { glanzPackage } from '../../tsup.base';

export default glanzPackage({
  index: 'src/index.ts',
  film: 'src/film.ts',
  shutter: 'src/shutter.ts',
  options: 'src/render-options/index.ts',
  node: 'src/node.ts',
});
