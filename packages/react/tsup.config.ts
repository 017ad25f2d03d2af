import { glanzPackage } from '../../tsup.base';

// A component with effects says that it runs on the client, so that server components may render it.
export default glanzPackage({ index: 'src/index.ts' }, { external: ['react'], client: true });
