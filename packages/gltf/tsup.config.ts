import { glanzPackage } from '../../tsup.base';

export default glanzPackage({
  index: 'src/index.ts',
  animation: 'src/poser.ts',
  node: 'src/node.ts',
  workers: 'src/worker/load.ts',
  worker: 'src/worker/worker.ts',
});
