import { GlanzError, type Scene } from '@glanz/scene';
import { loadGltf, type LoadGltfOptions } from '../load';
import { buffersOf, sendable, type LoadReply, type LoadRequest } from './protocol';

/** What a worker of your own adds to a load: things that cannot be sent. */
export type WorkerLoadOptions = Pick<LoadGltfOptions, 'decoders' | 'decodeImage' | 'fetch'>;

/**
 * Answers one load request after another, for `loadGltfInWorker`. The module `@glanz/gltf/worker` does so by itself where
 * it is loaded as a worker; call this in a worker file of your own to hand it decoders.
 *
 * @param options Decoders of compressed meshes and pictures.
 * @example
 * // my-gltf-worker.ts
 * serveGltf({ decoders: { meshopt: async () => (await import('meshoptimizer/decoder')).MeshoptDecoder } });
 */
export function serveGltf(options: WorkerLoadOptions = {}): void {
  const scope = globalThis as unknown as { postMessage(message: LoadReply, transfer?: readonly Transferable[]): void; addEventListener(type: 'message', heard: (event: MessageEvent<LoadRequest>) => void): void };
  scope.addEventListener('message', ({ data: { input, options: sent } }) => {
    const answer = (loaded: Scene) => {
      const scene = sendable(loaded);
      scope.postMessage({ kind: 'scene', scene }, buffersOf(scene));
    };
    const fail = (error: unknown) => {
      const { code, location } = error instanceof GlanzError ? error : ({} as Partial<GlanzError>);
      const path = location?.path;
      scope.postMessage({ kind: 'error', message: error instanceof Error ? error.message : String(error), ...(code === undefined ? {} : { code }), ...(path === undefined ? {} : { path }) });
    };
    loadGltf(input, { ...sent, ...options, onProgress: (progress) => scope.postMessage({ kind: 'progress', progress }) }).then(answer).catch(fail);
  });
  scope.postMessage({ kind: 'ready' });
}
