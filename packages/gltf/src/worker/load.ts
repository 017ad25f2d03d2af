import type { CompressedFormat, Scene } from '@glanz/scene';
import { GltfError } from '../error';
import type { LoadGltfOptions } from '../load';
import type { GltfInput } from '../source';
import { received, type LoadReply, type LoadRequest, type SentOptions } from './protocol';

export { DracoWorkers, type DracoWorkersOptions } from '../draco-workers';
export { received as receivedScene, type SentScene } from './protocol';

/** What a load in a worker may be told. */
export interface WorkerLoad extends Pick<
  LoadGltfOptions,
  'signal' | 'onProgress' | 'allowEmpty' | 'scene' | 'animation' | 'time' | 'limits' | 'baseUrl'
> {
  /** As for `loadGltf`, known beforehand; for workers whose file has a decoder of KTX2. */
  readonly compressedFormats?: readonly CompressedFormat[] | undefined;
  /**
   * Hands given bytes over instead of copying them: they are empty afterwards, and nothing waits for a copy. Default
   * false.
   */
  readonly transfer?: boolean | undefined;
}

/** How workers are started. */
export interface GltfWorkerOptions {
  /**
   * Starts a worker. Default: the package's own file, which has no decoders of compressed meshes. A file of yours calls
   * `serveGltf` of `@glanz/gltf/worker` with them.
   */
  readonly createWorker?: (() => Worker) | undefined;
}

/** What {@link loadGltfInWorker} may be told. */
export interface WorkerGltfOptions extends WorkerLoad, GltfWorkerOptions {}

/** A worker that has not reported by then will not. */
const START_MS = 15_000;

/** A worker that can take a load once `ready` resolves. */
interface Running {
  readonly worker: Worker;
  /** Rejects with the reason why it cannot start. */
  readonly ready: Promise<void>;
  /** Who hears its messages now. */
  heard: ((reply: LoadReply) => void) | undefined;
  failed: ((why: string) => void) | undefined;
}

function start(createWorker: () => Worker): Running {
  const worker = createWorker();
  let begun = () => undefined as void,
    broken = (_: string) => undefined as void;
  const ready = new Promise<void>((resolve, reject) => {
    begun = resolve;
    broken = (why) => reject(new Error(why));
  });
  // Whoever loads hears of it.
  ready.catch(() => undefined);
  const timer = setTimeout(() => fail('it has not started'), START_MS);
  const running: Running = { worker, ready, heard: undefined, failed: undefined };
  const fail = (why: string) => {
    clearTimeout(timer);
    broken(why);
    running.failed?.(why);
  };
  worker.addEventListener('messageerror', () => fail('its answer could not be read'));
  worker.addEventListener('error', (event) => {
    event.preventDefault();
    fail(
      event.message ||
        'its script could not be loaded (a wrong address, or a content security policy without worker-src)',
    );
  });
  worker.addEventListener('message', ({ data }: MessageEvent<LoadReply>) => {
    if (data.kind !== 'ready') return running.heard?.(data);
    clearTimeout(timer);
    begun();
  });
  return running;
}

/**
 * Loads glTF documents in workers: reading, checking, unpacking and decoding pictures all happen there, and the arrays
 * of a scene are handed over without a copy. The calling thread is never busy for longer than a message takes. The
 * worker is a file of this origin, so no content security policy has to be widened beyond `worker-src 'self'`. A
 * package that comes from another origin needs `worker-src blob:`.
 *
 * One worker stands ready from the beginning and stays so between loads, with its decoders; loads at the same time have
 * one each.
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

  /** Starts the first worker. @throws {DOMException} where an address of `createWorker` may not be used. */
  constructor({ createWorker = startWorker }: GltfWorkerOptions = {}) {
    this.#createWorker = createWorker;
    this.#idle = start(createWorker);
  }

  /**
   * Loads a document, as `loadGltf` does.
   *
   * Bytes that are given stay yours: they are copied into the worker unless `transfer` is set. Addresses and Blobs cost
   * nothing.
   *
   * @throws {GltfError} As `loadGltf`, and `gltf/worker` where a worker cannot be started.
   */
  load(input: GltfInput, options: WorkerLoad = {}): Promise<Scene> {
    const { signal, onProgress, transfer, baseUrl, allowEmpty, scene, animation, time, limits, compressedFormats } =
      options;
    return new Promise((resolve, reject) => {
      signal?.throwIfAborted();
      if (this.#destroyed) throw new GltfError('gltf/worker', 'This GltfWorker has been destroyed: make another.');
      const sent: SentOptions = {
        allowEmpty,
        scene,
        animation,
        time,
        limits,
        compressedFormats,
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
      const settle = (answer: () => void, sound: boolean) => {
        running.heard = running.failed = undefined;
        signal?.removeEventListener('abort', abort);
        this.#busy.delete(running);
        if (sound && !this.#destroyed && !this.#idle) this.#idle = running;
        else running.worker.terminate();
        answer();
      };
      const fail = (why: string) =>
        settle(() => reject(new GltfError('gltf/worker', `The worker that loads glTF failed: ${why}.`)), false);
      // What it does cannot be called off; the next load has another.
      const abort = () => settle(() => reject(signal?.reason as Error), false);
      signal?.addEventListener('abort', abort);
      running.failed = fail;
      running.heard = (reply) => {
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
          if (!running.heard) return;
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
        (error: Error) => running.failed?.(error.message),
      );
    });
  }

  /** Ends the workers; loads that are under way reject with `gltf/worker`. Idempotent. */
  destroy(): void {
    this.#destroyed = true;
    this.#idle?.worker.terminate();
    this.#idle = undefined;
    for (const running of this.#busy) running.failed?.('it was destroyed');
  }
}

/**
 * Loads a glTF document in a worker that is started for it; {@link GltfWorker} keeps one.
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

let elsewhere: string | undefined;

/**
 * Starts the package's own worker file. Browsers refuse one of another origin, a content delivery network say; there a
 * worker of a Blob imports the file, unless the page's content security policy forbids that.
 */
function startWorker(): Worker {
  try {
    // In this form bundlers find the file.
    return new Worker(new URL('./worker.js', import.meta.url), { type: 'module', name: 'glanz-gltf' });
  } catch (error) {
    if ((error as Error).name !== 'SecurityError') throw error;
    const { url } = import.meta;
    elsewhere ??= URL.createObjectURL(
      new Blob([`import ${JSON.stringify(new URL('./worker.js', url).href)};`], { type: 'text/javascript' }),
    );
    return new Worker(elsewhere, { type: 'module', name: 'glanz-gltf' });
  }
}
