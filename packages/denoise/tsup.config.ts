import { glanzPackage } from '../../tsup.base';

export default glanzPackage({
  index: 'src/index.ts',
  cpu: 'src/cpu/index.ts',
  film: 'src/film/index.ts',
  temporal: 'src/temporal/index.ts',
  tune: 'src/tune/index.ts',
});
