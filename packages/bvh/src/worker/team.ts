import type { TriangleMesh } from '../layout';
import { BvhError } from '../error';
import type { Copy } from './copy';

/** Numbers in a worker's report. */
const REPORT = 16;

/**
 * Shared words: workers waiting at the barrier, barriers passed, whether one has given up, whether something is
 * published, how much of the mesh is copied; then the counters, at an even word, as doubles follow them.
 */
const [WAITING, BARRIERS, GAVE_UP, PUBLISHED, COPIED, COUNTERS] = [0, 1, 2, 3, 4, 6];
/** Counters that {@link Team.take} may be asked for. */
const COUNTER_MAX = 4;
const BYTES = 4 * (COUNTERS + COUNTER_MAX);

/** Memory that two workers share while they build one hierarchy together. */
export interface TeamMemory {
  /** Synchronisation: words for the barriers, then the reports. */
  readonly control: SharedArrayBuffer;
  /** Memory for all arrays that both read. */
  readonly arrays: SharedArrayBuffer;
  /** Memory for the nodes, and for those of the upper levels. */
  readonly nodes: SharedArrayBuffer;
  readonly upper: SharedArrayBuffer;
  /** Memory for the mesh, unless it is in shared memory already. */
  readonly mesh: SharedArrayBuffer | undefined;
}

/** Memory of an earlier build is reused where it is at most this many times as large as needed. */
const SLACK = 4;

/** Bytes of the arrays for a number of triangles, and of the nodes. */
const arrayBytes = (triangles: number) => 140 * triangles + (1 << 16);
const nodeBytes = (triangles: number) => 64 * triangles;

/** Shared memory of at least `bytes`: the reusable one, if it is not much too large. */
const room = (bytes: number, reusable?: SharedArrayBuffer) =>
  reusable && reusable.byteLength >= bytes && reusable.byteLength <= SLACK * bytes
    ? reusable
    : new SharedArrayBuffer(bytes);

/**
 * Allocates the shared memory for a mesh, and the mesh as both workers see it. The caller copies the arrays that are
 * not shared yet, which may happen while both workers run: see {@link reportCopied}.
 *
 * @param reusable Memory of an earlier build that both have finished with: new memory costs a fifth of a build. It is
 * not cleared.
 * @throws {RangeError} if there is not enough memory.
 * @throws {TypeError} for detached arrays.
 */
export function teamMemory(
  mesh: TriangleMesh,
  triangles: number,
  reusable?: TeamMemory,
): { readonly memory: TeamMemory; readonly mesh: TriangleMesh; readonly copies: readonly Copy[] } {
  const { positions, indices } = mesh;
  const copied = [positions, indices].reduce(
    (bytes, array) => bytes + (array?.buffer instanceof ArrayBuffer ? array.byteLength : 0),
    0,
  );
  const memory: TeamMemory = {
    control: new SharedArrayBuffer(BYTES + 4 * 8 * REPORT),
    arrays: room(arrayBytes(triangles), reusable?.arrays),
    nodes: room(nodeBytes(triangles), reusable?.nodes),
    upper: room(nodeBytes(triangles), reusable?.upper),
    mesh: copied > 0 ? room(copied, reusable?.mesh) : undefined,
  };
  let offset = 0;
  const copies: Copy[] = [];
  const shared = <T extends Float32Array | Uint32Array | Uint16Array>(array: T): T => {
    if (!(array.buffer instanceof ArrayBuffer) || !memory.mesh) return array;
    const to = new (array.constructor as new (buffer: SharedArrayBuffer, offset: number, length: number) => T)(
      memory.mesh,
      offset,
      array.length,
    );
    // Throws for a detached array, which would look like an empty one.
    copies.push({ from: array.subarray() as T, to });
    offset += array.byteLength;
    return to;
  };
  // Positions first: entries of four bytes must be aligned.
  return { memory, mesh: { positions: shared(positions), indices: indices && shared(indices) }, copies };
}

/** Reports to both workers how many entries of the mesh's arrays are copied, of all copies in order. */
export function reportCopied({ control }: TeamMemory, entries: number): void {
  const words = new Int32Array(control);
  Atomics.store(words, COPIED, entries);
  Atomics.notify(words, COPIED);
}

/** Wakes both workers: what they wait for throws. */
export function release({ control }: TeamMemory): void {
  const words = new Int32Array(control);
  Atomics.store(words, GAVE_UP, 1);
  for (const word of [BARRIERS, PUBLISHED, COPIED]) {
    Atomics.add(words, word, 1);
    Atomics.notify(words, word);
  }
}

/**
 * One of two workers that run the same code on the same memory: both allocate the same blocks in the same order, do
 * their parts, and synchronise where one needs the other's results.
 */
export class Team {
  readonly #control: Int32Array;
  readonly #reports: Float64Array;
  readonly memory: TeamMemory;
  /** Whether the other worker has given up. */
  peerGaveUp = false;
  #taken = 0;
  #barriers = 0;

  /** @param index 0 or 1. */
  constructor(
    readonly index: number,
    memory: TeamMemory,
  ) {
    this.memory = memory;
    this.#control = new Int32Array(memory.control, 0, COUNTERS + COUNTER_MAX);
    this.#reports = new Float64Array(memory.control, BYTES);
  }

  /** Allocates a block. @returns Its offset. */
  #block(bytes: number): number {
    const offset = this.#taken;
    this.#taken += Math.ceil(bytes / 64) * 64;
    return offset;
  }

  uint32(length: number): Uint32Array<ArrayBuffer> {
    // The rest of the code expects arrays over memory that is not shared.
    return new Uint32Array(
      this.memory.arrays,
      this.#block(4 * length),
      length,
    ) as Uint32Array as Uint32Array<ArrayBuffer>;
  }

  int32(length: number): Int32Array<ArrayBuffer> {
    return new Int32Array(this.memory.arrays, this.#block(4 * length), length) as Int32Array as Int32Array<ArrayBuffer>;
  }

  float32(length: number): Float32Array<ArrayBuffer> {
    return new Float32Array(
      this.memory.arrays,
      this.#block(4 * length),
      length,
    ) as Float32Array as Float32Array<ArrayBuffer>;
  }

  /** A barrier: waits for the other worker. @returns Both reports, the first worker's first. */
  meet(report: readonly number[] = []): readonly [Float64Array, Float64Array] {
    // Two sets of reports: a worker reaches the next barrier only after it has read those of the last.
    const first = 2 * (this.#barriers++ & 1);
    this.#reports.set(report, (first + this.index) * REPORT);
    const control = this.#control;
    const meeting = Atomics.load(control, BARRIERS);
    if (Atomics.add(control, WAITING, 1) === 1) {
      Atomics.store(control, WAITING, 0);
      Atomics.add(control, BARRIERS, 1);
      Atomics.notify(control, BARRIERS);
    } else this.#wait(BARRIERS, meeting + 1);
    this.#throwIfGaveUp();
    return [0, 1].map((index) => this.#reports.slice((first + index) * REPORT, (first + index + 1) * REPORT)) as [
      Float64Array,
      Float64Array,
    ];
  }

  /** Signals to the other worker, which may wait for it at any time, that something is ready. */
  publish(): void {
    Atomics.store(this.#control, PUBLISHED, 1);
    Atomics.notify(this.#control, PUBLISHED);
  }

  /** Waits until the other worker has published. */
  published(): void {
    this.#wait(PUBLISHED, 1);
    this.#throwIfGaveUp();
  }

  /** Waits until this many entries of the mesh's arrays are copied. */
  copied(entries: number): void {
    this.#wait(COPIED, entries);
    this.#throwIfGaveUp();
  }

  /** The next number of a counter, 0, 1, 2 …, each given to one worker, so that the faster one does more. */
  take(counter: number): number {
    return Atomics.add(this.#control, COUNTERS + counter, 1);
  }

  /** Makes the other worker's next barrier throw. */
  giveUp(): void {
    release(this.memory);
  }

  /**
   * Waits until a word has reached a value, or the other worker has given up, which may have happened before the
   * call.
   */
  #wait(word: number, min: number): void {
    const control = this.#control;
    for (
      let now = Atomics.load(control, word);
      now < min && Atomics.load(control, GAVE_UP) === 0;
      now = Atomics.load(control, word)
    )
      Atomics.wait(control, word, now);
  }

  #throwIfGaveUp(): void {
    this.peerGaveUp = Atomics.load(this.#control, GAVE_UP) !== 0;
    if (this.peerGaveUp) throw new BvhError('bvh/worker', 'The other worker of a shared build has failed.');
  }
}
