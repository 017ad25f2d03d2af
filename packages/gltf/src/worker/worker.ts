// The worker file. Loaded as anything else, it only exports.
import { serveGltf } from './serve';

export { buffersOf as transferablesOf, sendable as sendableScene, type SentScene } from './protocol';
export { serveGltf, type WorkerLoadOptions } from './serve';

const { WorkerGlobalScope } = globalThis as unknown as { WorkerGlobalScope?: new () => object };
// A worker file of the host imports this module to call serveGltf() with decoders; its name differs.
if (
  WorkerGlobalScope &&
  globalThis instanceof WorkerGlobalScope &&
  (globalThis as { name?: string }).name === 'glanz-gltf'
)
  serveGltf();
