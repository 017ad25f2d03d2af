import { glanzPackage } from '../../tsup.base';

// Under server components a component with effects says where it runs.
export default { ...glanzPackage({ index: 'src/index.ts' }, { external: ['react'] }), banner: { js: "'use client';" } };
