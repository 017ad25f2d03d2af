import type { Scene } from '@glanz/scene';
import { GltfError } from '../error';
import type { LoadGltfOptions } from '../load';
import type { GltfInput } from '../source';
import type { LoadReply, LoadRequest, SentOptions } from './protocol';

/** What {@link loadGltfInWorker} may be told. */
export interface WorkerGltfOptions extends Pick<LoadGltfOptions, 'signal' | 'onProgress' | 'allowEmpty' | 'scene' | 'animation' | 'time' | 'limits' | 'baseUrl'> {
  /** Hands given bytes over instead of copying them: they are empty afterwards, and nothing waits for a copy. Default false. */
  readonly transfer?: boolean | undefined;
  /**
   * Starts the worker. Default: the package's own file, which has no decoders of compressed meshes. A file of yours calls
   * `serveGltf` of `@glanz/gltf/worker` with them.
   */
  readonly createWorker?: (() => Worker) | undefined;
}

/** A worker that has not reported by then will not. */
const START_MS = 15_000;

/**
 * Loads a glTF document in a worker: reading, checking, unpacking and decoding pictures all happen there, and the arrays of
 * the scene are handed over without a copy. The calling thread is never busy for longer than a message takes. The worker is a
 * file of this origin (no Blob), so no content security policy has to be widened beyond `worker-src 'self'`.
 *
 * Bytes that are given stay yours: they are copied into the worker unless `transfer` is set. Addresses and Blobs cost nothing.
 *
 * @throws {GltfError} As `loadGltf`, and `gltf/worker` where the worker cannot be started.
 * @example
 * const scene = await loadGltfInWorker('models/button.glb', { signal, onProgress });
 */
export function loadGltfInWorker(input: GltfInput, options: WorkerGltfOptions = {}): Promise<Scene> {
  const { signal, onProgress, createWorker = startWorker, transfer, baseUrl, allowEmpty, scene, animation, time, limits } = options;
  return new Promise((resolve, reject) => {
    signal?.throwIfAborted();
    const sent: SentOptions = { allowEmpty, scene, animation, time, limits, ...(baseUrl === undefined ? {} : { baseUrl: new URL(baseUrl, location.href).href }) };
    const request: LoadRequest = { input: input instanceof URL ? input.href : typeof input === 'string' ? (baseUrl === undefined && URL.canParse(input, location.href) ? new URL(input, location.href).href : input) : input, options: sent };
    const worker = createWorker();
    const settle = (answer: () => void) => {
      clearTimeout(timer);
      worker.terminate();
      signal?.removeEventListener('abort', abort);
      answer();
    };
    const fail = (why: string) => settle(() => reject(new GltfError('gltf/worker', `The worker that loads glTF failed: ${why}.`)));
    const abort = () => settle(() => reject(signal?.reason as Error));
    const timer = setTimeout(() => fail('it has not started'), START_MS);
    signal?.addEventListener('abort', abort);
    worker.addEventListener('messageerror', () => fail('its answer could not be read'));
    worker.addEventListener('error', (event) => {
      event.preventDefault();
      fail(event.message || 'its script could not be loaded (a wrong address, or a content security policy without worker-src)');
    });
    worker.addEventListener('message', ({ data }: MessageEvent<LoadReply>) => {
      clearTimeout(timer);
      if (data.kind === 'ready') worker.postMessage(request, transfer ? [input instanceof Uint8Array ? input.buffer : input].filter((part) => part instanceof ArrayBuffer) : []);
      else if (data.kind === 'progress') onProgress?.(data.progress);
      else if (data.kind === 'scene') settle(() => resolve(data.scene));
      else settle(() => reject(data.code === undefined ? new GltfError('gltf/worker', `A load failed in its worker: ${data.message}`) : new GltfError(data.code, data.message, data.path === undefined ? {} : { location: { path: data.path } })));
    });
  });
}

/** In this form bundlers find the file. */
const startWorker = () => new Worker(new URL('./worker.js', import.meta.url), { type: 'module', name: 'glanz-gltf' });
