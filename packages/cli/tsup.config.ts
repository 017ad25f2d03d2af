import { glanzPackage } from '../../tsup.base';

export default glanzPackage({ index: 'src/index.ts', glanz: 'src/glanz.ts' }, { platform: 'node' });
