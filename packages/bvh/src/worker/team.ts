import type { TriangleMesh } from '../layout';
import { BvhError } from '../error';
import type { Copy } from './copy';

/** Numbers of a member's report. */
const REPORT = 16;

/**
 * Words that are for all to see: who has come to the meeting point, how many meetings there were, whether one has given
 * up, what is published, how much of the mesh is copied; then the counters, an even number of words on, as doubles
 * follow them.
 */
const [COME, MEETINGS, LEFT_ALONE, PUBLISHED, COPIED, COUNTERS] = [0, 1, 2, 3, 4, 6];
/** Counters that {@link Team.take} may be asked for. */
const COUNTER_MAX = 4;
const BYTES = 4 * (COUNTERS + COUNTER_MAX);

/** What two workers share while they build one hierarchy together. */
export interface TeamMemory {
  /** What the members tell each other: words for their meetings, then their reports. */
  readonly control: SharedArrayBuffer;
  /** Room for all arrays that both look at. */
  readonly arrays: SharedArrayBuffer;
  /** Room for the nodes, and for those of the upper levels. */
  readonly nodes: SharedArrayBuffer;
  readonly upper: SharedArrayBuffer;
  /** Room for the mesh, where it does not lie in shared memory already. */
  readonly mesh: SharedArrayBuffer | undefined;
}

/** Memory of an earlier build serves the next where it is not larger than this times what that needs. */
const SLACK = 4;

/** Bytes of the arrays for so many triangles, and of the nodes. */
const arrayBytes = (triangles: number) => 140 * triangles + (1 << 16);
const nodeBytes = (triangles: number) => 64 * triangles;

/** Shared memory of at least so many bytes: that one, if it is not much too large. */
const room = (bytes: number, spare?: SharedArrayBuffer) =>
  spare && spare.byteLength >= bytes && spare.byteLength <= SLACK * bytes ? spare : new SharedArrayBuffer(bytes);

/**
 * What two workers share for a mesh of so many triangles, and the mesh as both see it; the arrays that
 * are not shared are still to be copied, which they may be while both are at it: see {@link tellCopied}.
 *
 * @param spare What an earlier build has left, if both have left it: fresh memory costs a fifth of a build. It is not
 * cleared.
 * @throws {RangeError} where there is not so much memory.
 * @throws {TypeError} for arrays that were given away.
 */
export function teamMemory(
  mesh: TriangleMesh,
  triangles: number,
  spare?: TeamMemory,
): { readonly memory: TeamMemory; readonly mesh: TriangleMesh; readonly copies: readonly Copy[] } {
  const { positions, indices } = mesh;
  const copied = [positions, indices].reduce(
    (bytes, array) => bytes + (array?.buffer instanceof ArrayBuffer ? array.byteLength : 0),
    0,
  );
  const memory: TeamMemory = {
    control: new SharedArrayBuffer(BYTES + 4 * 8 * REPORT),
    arrays: room(arrayBytes(triangles), spare?.arrays),
    nodes: room(nodeBytes(triangles), spare?.nodes),
    upper: room(nodeBytes(triangles), spare?.upper),
    mesh: copied > 0 ? room(copied, spare?.mesh) : undefined,
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
    // Throws where it was given away, for it looks like an empty one then.
    copies.push({ from: array.subarray() as T, to });
    offset += array.byteLength;
    return to;
  };
  // Positions first: what has four bytes each begins at a whole place.
  return { memory, mesh: { positions: shared(positions), indices: indices && shared(indices) }, copies };
}

/** Tells both workers how many entries of the mesh's arrays are copied, those of all copies one after the other. */
export function tellCopied({ control }: TeamMemory, entries: number): void {
  const words = new Int32Array(control);
  Atomics.store(words, COPIED, entries);
  Atomics.notify(words, COPIED);
}

/** Lets both go, whatever they wait for: it throws. */
export function release({ control }: TeamMemory): void {
  const words = new Int32Array(control);
  Atomics.store(words, LEFT_ALONE, 1);
  for (const word of [MEETINGS, PUBLISHED, COPIED]) {
    Atomics.add(words, word, 1);
    Atomics.notify(words, word);
  }
}

/**
 * One of two workers that run the same code on the same memory: both take the same blocks in the same order, do their
 * share, and meet where one needs what the other has done.
 */
export class Team {
  readonly #control: Int32Array;
  readonly #reports: Float64Array;
  readonly memory: TeamMemory;
  /** Whether the other one has given up. */
  left = false;
  #taken = 0;
  #meetings = 0;

  /** @param index 0 or 1. */
  constructor(
    readonly index: number,
    memory: TeamMemory,
  ) {
    this.memory = memory;
    this.#control = new Int32Array(memory.control, 0, COUNTERS + COUNTER_MAX);
    this.#reports = new Float64Array(memory.control, BYTES);
  }

  /** Where the next block of so many bytes begins. */
  #block(bytes: number): number {
    const offset = this.#taken;
    this.#taken += Math.ceil(bytes / 64) * 64;
    return offset;
  }

  uint32(length: number): Uint32Array<ArrayBuffer> {
    // Everywhere but here arrays lie over memory of their own.
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

  /** Waits for the other one, and gives what both have to say, the first one's words first. */
  meet(report: readonly number[] = []): readonly [Float64Array, Float64Array] {
    // Reports of one meeting stay while the next one's are written: only who has read them comes to that.
    const first = 2 * (this.#meetings++ & 1);
    this.#reports.set(report, (first + this.index) * REPORT);
    const control = this.#control;
    const meeting = Atomics.load(control, MEETINGS);
    if (Atomics.add(control, COME, 1) === 1) {
      Atomics.store(control, COME, 0);
      Atomics.add(control, MEETINGS, 1);
      Atomics.notify(control, MEETINGS);
    } else this.#wait(MEETINGS, meeting + 1);
    this.#throwIfLeft();
    return [0, 1].map((index) => this.#reports.slice((first + index) * REPORT, (first + index + 1) * REPORT)) as [
      Float64Array,
      Float64Array,
    ];
  }

  /** Tells the other one, who may ask for it at any time, that something is ready. */
  publish(): void {
    Atomics.store(this.#control, PUBLISHED, 1);
    Atomics.notify(this.#control, PUBLISHED);
  }

  /** Waits until the other one has published. */
  published(): void {
    this.#wait(PUBLISHED, 1);
    this.#throwIfLeft();
  }

  /** Waits until so many entries of the mesh's arrays are copied. */
  copied(entries: number): void {
    this.#wait(COPIED, entries);
    this.#throwIfLeft();
  }

  /** The next number of a counter, each of which one of both gets: 0, 1, 2 … So whoever is faster does more. */
  take(counter: number): number {
    return Atomics.add(this.#control, COUNTERS + counter, 1);
  }

  /** Lets the other one go: its next meeting throws. */
  giveUp(): void {
    release(this.memory);
  }

  /**
   * Waits until a word is at least that, or nobody will change it: the other one may have given up before this one
   * came.
   */
  #wait(word: number, least: number): void {
    const control = this.#control;
    for (
      let now = Atomics.load(control, word);
      now < least && Atomics.load(control, LEFT_ALONE) === 0;
      now = Atomics.load(control, word)
    )
      Atomics.wait(control, word, now);
  }

  #throwIfLeft(): void {
    this.left = Atomics.load(this.#control, LEFT_ALONE) !== 0;
    if (this.left) throw new BvhError('bvh/worker', 'The other worker of a build has given up.');
  }
}
