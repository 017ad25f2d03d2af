// The file that workers run: nothing happens where it is loaded as anything else.
import { serveGltf } from './serve';

export { buffersOf as transferablesOf, sendable as sendableScene, type SentScene } from './protocol';
export { serveGltf, type WorkerLoadOptions } from './serve';

const { WorkerGlobalScope } = globalThis as unknown as { WorkerGlobalScope?: new () => object };
// A page of one's own may load this module to call serveGltf() with decoders: then its worker is named otherwise.
if (
  WorkerGlobalScope &&
  globalThis instanceof WorkerGlobalScope &&
  (globalThis as { name?: string }).name === 'glanz-gltf'
)
  serveGltf();
