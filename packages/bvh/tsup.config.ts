import { glanzPackage } from '../../tsup.base';

export default glanzPackage({ index: 'src/index.ts', blas: 'src/blas.ts', tlas: 'src/tlas.ts', refit: 'src/refit.ts', statistics: 'src/statistics.ts', queries: 'src/cpu/queries.ts', batch: 'src/cpu/batch.ts', 'all-hits': 'src/cpu/all-hits.ts', distance: 'src/cpu/distance.ts', overlap: 'src/cpu/overlap.ts', serialize: 'src/serialize.ts', cache: 'src/cache.ts', 'indexed-db': 'src/indexed-db.ts', node: 'src/node.ts', wgsl: 'src/wgsl/index.ts', workers: 'src/worker/workers.ts', worker: 'src/worker/worker.ts' });
