import type { DracoAttribute, DracoPrimitive } from './draco';

/** Message to a worker: a mesh to decode. */
export interface DracoRequest {
  readonly kind: 'draco';
  readonly id: number;
  readonly bytes: Uint8Array<ArrayBuffer>;
  readonly attributes: readonly DracoAttribute[];
  /** Max bytes of the decoded mesh. */
  readonly maxBytes: number;
}

/** Message from a worker; without a mesh if decoding failed. */
export interface DracoReply {
  readonly kind: 'unpacked';
  readonly id: number;
  readonly primitive?: DracoPrimitive;
}

/** Options for {@link DracoWorkers}. */
export interface DracoWorkersOptions {
  /** Starts a worker whose file calls `serveGltf` of `@glanz/gltf/worker` with the decoder `draco`. */
  readonly createWorker: () => Worker;
  /** Max workers, at least 1. Default: the machine's threads, at most 4. */
  readonly count?: number | undefined;
}

/** A worker and its pending requests. */
interface Slot {
  readonly worker: Worker;
  readonly waiting: Map<number, (primitive: DracoPrimitive | undefined) => void>;
  /** Compressed bytes of its pending requests. */
  load: number;
  failed: boolean;
}

/** Time after which a worker that has not answered counts as failed. */
const TIMEOUT_MS = 30_000;

/**
 * Decodes Draco-compressed meshes in parallel in workers: the option `decoders.dracoWorkers` of `loadGltf`. Workers are
 * started on demand and kept. A failure (a worker that does not start, a broken mesh) is not an error: `decoders.draco`
 * then decodes the mesh on the calling thread and reports what is wrong.
 *
 * A worker file that calls `serveGltf` creates such workers itself; this class is for loads on the calling thread.
 *
 * @example
 * const dracoWorkers = new DracoWorkers({ createWorker: () => new Worker(new URL('./my-gltf-worker.ts',
 * import.meta.url), { type: 'module' }) }); const scene = await loadGltf('board.glb', { decoders: { draco, dracoWorkers
 * } });
 */
export class DracoWorkers {
  readonly #createWorker: () => Worker;
  readonly #count: number;
  readonly #slots: Slot[] = [];
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
   * Decodes a mesh.
   *
   * @param bytes Compressed bytes, as in the file; copied.
   * @param maxBytes Max bytes of the decoded mesh.
   * @returns The mesh, or `undefined` if decoding failed.
   */
  unpack(
    bytes: Uint8Array,
    attributes: readonly DracoAttribute[],
    maxBytes: number,
  ): Promise<DracoPrimitive | undefined> {
    return new Promise((resolve) => {
      const slot = this.#destroyed ? undefined : this.#idlest(bytes.length);
      if (!slot) return resolve(undefined);
      const id = this.#next++;
      const timer = setTimeout(() => this.#fail(slot), TIMEOUT_MS);
      slot.load += bytes.length;
      slot.waiting.set(id, (primitive) => {
        clearTimeout(timer);
        slot.load -= bytes.length;
        slot.waiting.delete(id);
        resolve(primitive);
      });
      const own = bytes.slice();
      slot.worker.postMessage({ kind: 'draco', id, bytes: own, attributes, maxBytes } satisfies DracoRequest, [
        own.buffer,
      ]);
    });
  }

  /** Terminates the workers; pending calls of {@link unpack} return `undefined`. Idempotent. */
  destroy(): void {
    this.#destroyed = true;
    for (const slot of this.#slots.splice(0)) this.#fail(slot);
  }

  /** The least busy worker; a new one if all are busy and the maximum is not reached. */
  #idlest(bytes: number): Slot | undefined {
    const usable = this.#slots.filter(({ failed }) => !failed);
    const min = usable.reduce<Slot | undefined>(
      (best, slot) => (best && best.load <= slot.load ? best : slot),
      undefined,
    );
    // Failed workers count towards the maximum, so that they are not restarted forever.
    if ((min && (min.load === 0 || bytes === 0)) || this.#slots.length >= this.#count) return min;
    let worker: Worker;
    try {
      worker = this.#createWorker();
    } catch {
      return min;
    }
    const slot: Slot = { worker, waiting: new Map(), load: 0, failed: false };
    worker.addEventListener('message', ({ data }: MessageEvent<DracoReply | { readonly kind: string }>) => {
      if (data.kind === 'unpacked') slot.waiting.get((data as DracoReply).id)?.((data as DracoReply).primitive);
    });
    worker.addEventListener('messageerror', () => this.#fail(slot));
    worker.addEventListener('error', (event) => {
      event.preventDefault();
      this.#fail(slot);
    });
    this.#slots.push(slot);
    return slot;
  }

  #fail(slot: Slot): void {
    slot.failed = true;
    slot.worker.terminate();
    for (const answer of slot.waiting.values()) answer(undefined);
  }
}
