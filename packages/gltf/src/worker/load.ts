import type { CompressedFormat, Scene } from '@glanz/scene';
import { GltfError } from '../error';
import type { LoadGltfOptions } from '../load';
import type { GltfInput } from '../source';
import { received, type LoadReply, type LoadRequest, type SentOptions } from './protocol';

export { DracoWorkers, type DracoWorkersOptions } from '../draco-workers';
export { received as receivedScene, type SentScene } from './protocol';

/** Options for a load in a worker. */
export interface WorkerLoad extends Pick<
  LoadGltfOptions,
  | 'signal'
  | 'onProgress'
  | 'allowEmpty'
  | 'scene'
  | 'animation'
  | 'time'
  | 'imageBudgetMiB'
  | 'limits'
  | 'baseUrl'
  | 'credentials'
> {
  /** As for `loadGltf`, but a list; for worker files that have a KTX2 decoder. */
  readonly compressedFormats?: readonly CompressedFormat[] | undefined;
  /**
   * Transfers the given bytes instead of copying them; the caller's buffer is detached. Default false.
   */
  readonly transfer?: boolean | undefined;
}

/** Options for {@link GltfWorker}. */
export interface GltfWorkerOptions {
  /**
   * Starts a worker. Default: the package's own file, which has no decoders of compressed meshes. To use decoders,
   * start a file that passes them to `serveGltf` of `@glanz/gltf/worker`.
   */
  readonly createWorker?: (() => Worker) | undefined;
}

/** Options for {@link loadGltfInWorker}. */
export interface WorkerGltfOptions extends WorkerLoad, GltfWorkerOptions {}

/** Time within which a worker must report that it has started. */
const START_MS = 15_000;

/** A worker that accepts a load once `ready` resolves. */
interface Running {
  readonly worker: Worker;
  /** Rejects with the reason why it cannot start. */
  readonly ready: Promise<void>;
  /** Receives its messages during a load. */
  onReply: ((reply: LoadReply) => void) | undefined;
  onFailure: ((why: string) => void) | undefined;
}

function start(createWorker: () => Worker): Running {
  const worker = createWorker();
  let begun = () => undefined as void,
    broken = (_: string) => undefined as void;
  const ready = new Promise<void>((resolve, reject) => {
    begun = resolve;
    broken = (why) => reject(new Error(why));
  });
  // load() reports the rejection.
  ready.catch(() => undefined);
  const timer = setTimeout(() => fail('it has not started'), START_MS);
  const running: Running = { worker, ready, onReply: undefined, onFailure: undefined };
  const fail = (why: string) => {
    clearTimeout(timer);
    broken(why);
    running.onFailure?.(why);
  };
  worker.addEventListener('messageerror', () => fail('its answer could not be read'));
  worker.addEventListener('error', (event) => {
    event.preventDefault();
    fail(
      event.message || 'its script could not be loaded (wrong URL, or a content security policy without worker-src)',
    );
  });
  worker.addEventListener('message', ({ data }: MessageEvent<LoadReply>) => {
    if (data.kind !== 'ready') return running.onReply?.(data);
    clearTimeout(timer);
    begun();
  });
  return running;
}

/**
 * Loads glTF documents in workers, which read, check, decompress and decode images; the arrays of the scene are
 * transferred without a copy. The calling thread only handles messages. The worker is a file of the same origin, so a
 * content security policy needs `worker-src 'self'` only; a package from another origin needs `worker-src blob:`.
 *
 * One worker is started at construction and kept between loads, with its decoders; concurrent loads get one each.
 *
 * @example
 * const models = new GltfWorker();              // starts up while the page does
 * const scene = await models.load('models/button.glb', { signal, onProgress });
 */
export class GltfWorker {
  readonly #createWorker: () => Worker;
  #idle: Running | undefined;
  readonly #busy = new Set<Running>();
  #destroyed = false;

  /** Starts the first worker. @throws {DOMException} where an address of `createWorker` is not allowed. */
  constructor({ createWorker = startWorker }: GltfWorkerOptions = {}) {
    this.#createWorker = createWorker;
    this.#idle = start(createWorker);
  }

  /**
   * Loads a document, as `loadGltf` does.
   *
   * Given bytes are copied into the worker unless `transfer` is set. URLs and Blobs are passed without a copy.
   *
   * @throws {GltfError} As `loadGltf`, and `gltf/worker` where a worker cannot be started.
   */
  load(input: GltfInput, options: WorkerLoad = {}): Promise<Scene> {
    const { signal, onProgress, transfer, baseUrl, allowEmpty, scene, animation, time, limits } = options;
    const { imageBudgetMiB, compressedFormats, credentials } = options;
    return new Promise((resolve, reject) => {
      signal?.throwIfAborted();
      if (this.#destroyed) throw new GltfError('gltf/worker', 'This GltfWorker has been destroyed: create another.');
      const sent: SentOptions = {
        allowEmpty,
        scene,
        animation,
        time,
        limits,
        imageBudgetMiB,
        compressedFormats,
        credentials,
        ...(baseUrl === undefined ? {} : { baseUrl: new URL(baseUrl, location.href).href }),
      };
      const request: LoadRequest = {
        input:
          input instanceof URL
            ? input.href
            : typeof input === 'string'
              ? baseUrl === undefined && URL.canParse(input, location.href)
                ? new URL(input, location.href).href
                : input
              : input,
        options: sent,
      };
      const running = this.#idle ?? start(this.#createWorker);
      this.#idle = undefined;
      this.#busy.add(running);
      const settle = (answer: () => void, reusable: boolean) => {
        running.onReply = running.onFailure = undefined;
        signal?.removeEventListener('abort', abort);
        this.#busy.delete(running);
        if (reusable && !this.#destroyed && !this.#idle) this.#idle = running;
        else running.worker.terminate();
        answer();
      };
      const fail = (why: string) =>
        settle(() => reject(new GltfError('gltf/worker', `The worker that loads glTF failed: ${why}.`)), false);
      // A running load cannot be cancelled inside the worker: terminate it; the next load starts another.
      const abort = () => settle(() => reject(signal?.reason as Error), false);
      signal?.addEventListener('abort', abort);
      running.onFailure = fail;
      running.onReply = (reply) => {
        if (reply.kind === 'progress') onProgress?.(reply.progress);
        else if (reply.kind === 'scene') settle(() => resolve(received(reply.scene)), true);
        else if (reply.kind === 'error')
          settle(
            () =>
              reject(
                reply.code === undefined
                  ? new GltfError('gltf/worker', `A load failed in its worker: ${reply.message}`)
                  : new GltfError(
                      reply.code,
                      reply.message,
                      reply.path === undefined ? {} : { location: { path: reply.path } },
                    ),
              ),
            true,
          );
      };
      running.ready.then(
        () => {
          if (!running.onReply) return;
          try {
            running.worker.postMessage(
              request,
              transfer
                ? [input instanceof Uint8Array ? input.buffer : input].filter((part) => part instanceof ArrayBuffer)
                : [],
            );
          } catch (error) {
            fail(error instanceof Error ? error.message : String(error));
          }
        },
        (error: Error) => running.onFailure?.(error.message),
      );
    });
  }

  /** Terminates the workers; pending loads reject with `gltf/worker`. Idempotent. */
  destroy(): void {
    this.#destroyed = true;
    this.#idle?.worker.terminate();
    this.#idle = undefined;
    for (const running of this.#busy) running.onFailure?.('it was destroyed');
  }
}

/**
 * Loads a glTF document in a worker that is started for this load; {@link GltfWorker} keeps its worker.
 *
 * @throws {GltfError} As `loadGltf`, and `gltf/worker` where the worker cannot be started.
 * @example
 * const scene = await loadGltfInWorker('models/button.glb', { signal, onProgress });
 */
export async function loadGltfInWorker(input: GltfInput, options: WorkerGltfOptions = {}): Promise<Scene> {
  options.signal?.throwIfAborted();
  const worker = new GltfWorker(options);
  try {
    return await worker.load(input, options);
  } finally {
    worker.destroy();
  }
}

let blobUrl: string | undefined;

/**
 * Starts the package's own worker file. Browsers reject a file of another origin (a content delivery network); then a
 * Blob worker imports the file, unless the page's content security policy forbids it.
 */
function startWorker(): Worker {
  try {
    // Bundlers recognise this form.
    return new Worker(new URL('./worker.js', import.meta.url), { type: 'module', name: 'glanz-gltf' });
  } catch (error) {
    if ((error as Error).name !== 'SecurityError') throw error;
    const { url } = import.meta;
    blobUrl ??= URL.createObjectURL(
      new Blob([`import ${JSON.stringify(new URL('./worker.js', url).href)};`], { type: 'text/javascript' }),
    );
    return new Worker(blobUrl, { type: 'module', name: 'glanz-gltf' });
  }
}
