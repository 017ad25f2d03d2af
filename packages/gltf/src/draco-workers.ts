import type { DracoAttribute, DracoPrimitive } from './draco';

/** To a helper: one mesh to unpack. */
export interface DracoRequest {
  readonly kind: 'draco';
  readonly id: number;
  readonly bytes: Uint8Array<ArrayBuffer>;
  readonly attributes: readonly DracoAttribute[];
  /** Bytes that may come out. */
  readonly most: number;
}

/** From a helper; without a mesh where it could not be unpacked. */
export interface DracoReply {
  readonly kind: 'unpacked';
  readonly id: number;
  readonly primitive?: DracoPrimitive;
}

/** How helpers are started. */
export interface DracoWorkersOptions {
  /** Starts a worker whose file calls `serveGltf` of `@glanz/gltf/worker` with the decoder `draco`. */
  readonly createWorker: () => Worker;
  /** Most workers at a time, at least 1. Default: the machine's threads, at most 4. */
  readonly count?: number | undefined;
}

/** A helper and what it has to do. */
interface Helper {
  readonly worker: Worker;
  readonly waiting: Map<number, (primitive: DracoPrimitive | undefined) => void>;
  /** Packed bytes that it has still to unpack. */
  load: number;
  failed: boolean;
}

/** A worker that has unpacked nothing by then will not. */
const PATIENCE_MS = 30_000;

/**
 * Unpacks Draco-compressed meshes side by side in workers: the option `decoders.dracoWorkers` of `loadGltf`. A
 * worker is started when there is something for it to do, and stays. What goes wrong here (a worker that does not
 * start, a broken mesh) is no error: `decoders.draco` then does it, and tells what is wrong.
 *
 * A worker file that calls `serveGltf` has workers of this kind by itself; this class is for loads on the calling
 * thread.
 *
 * @example
 * const dracoWorkers = new DracoWorkers({ createWorker: () => new Worker(new URL('./my-gltf-worker.ts',
 * import.meta.url), { type: 'module' }) }); const scene = await loadGltf('board.glb', { decoders: { draco, dracoWorkers
 * } });
 */
export class DracoWorkers {
  readonly #createWorker: () => Worker;
  readonly #count: number;
  readonly #helpers: Helper[] = [];
  #next = 0;
  #destroyed = false;

  constructor({
    createWorker,
    count = Math.min(4, globalThis.navigator?.hardwareConcurrency ?? 1),
  }: DracoWorkersOptions) {
    this.#createWorker = createWorker;
    this.#count = count;
  }

  /**
   * Unpacks a mesh.
   *
   * @param bytes As they are in the file; copied.
   * @param most Bytes that may come out.
   * @returns The mesh, or `undefined` where this did not work.
   */
  unpack(bytes: Uint8Array, attributes: readonly DracoAttribute[], most: number): Promise<DracoPrimitive | undefined> {
    return new Promise((resolve) => {
      const helper = this.#destroyed ? undefined : this.#leastBusy(bytes.length);
      if (!helper) return resolve(undefined);
      const id = this.#next++;
      const timer = setTimeout(() => this.#fail(helper), PATIENCE_MS);
      helper.load += bytes.length;
      helper.waiting.set(id, (primitive) => {
        clearTimeout(timer);
        helper.load -= bytes.length;
        helper.waiting.delete(id);
        resolve(primitive);
      });
      const own = bytes.slice();
      helper.worker.postMessage({ kind: 'draco', id, bytes: own, attributes, most } satisfies DracoRequest, [
        own.buffer,
      ]);
    });
  }

  /** Ends the workers; what they have not unpacked yet comes as `undefined`. Idempotent. */
  destroy(): void {
    this.#destroyed = true;
    for (const helper of this.#helpers.splice(0)) this.#fail(helper);
  }

  /** The worker that has least to do; a new one if all are busy and there may be more. */
  #leastBusy(bytes: number): Helper | undefined {
    const sound = this.#helpers.filter(({ failed }) => !failed);
    const least = sound.reduce<Helper | undefined>(
      (best, helper) => (best && best.load <= helper.load ? best : helper),
      undefined,
    );
    // One that failed is not started again and again.
    if ((least && (least.load === 0 || bytes === 0)) || this.#helpers.length >= this.#count) return least;
    let worker: Worker;
    try {
      worker = this.#createWorker();
    } catch {
      return least;
    }
    const helper: Helper = { worker, waiting: new Map(), load: 0, failed: false };
    worker.addEventListener('message', ({ data }: MessageEvent<DracoReply | { readonly kind: string }>) => {
      if (data.kind === 'unpacked') helper.waiting.get((data as DracoReply).id)?.((data as DracoReply).primitive);
    });
    worker.addEventListener('messageerror', () => this.#fail(helper));
    worker.addEventListener('error', (event) => {
      event.preventDefault();
      this.#fail(helper);
    });
    this.#helpers.push(helper);
    return helper;
  }

  #fail(helper: Helper): void {
    helper.failed = true;
    helper.worker.terminate();
    for (const answer of helper.waiting.values()) answer(undefined);
  }
}
