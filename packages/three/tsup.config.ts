import { glanzPackage } from '../../tsup.base';

export default glanzPackage(
  { index: 'src/index.ts', compat: 'src/compat/index.ts', fiber: 'src/fiber/index.ts' },
  { external: ['three', 'react', '@react-three/fiber'], directives: true },
);
