import { BvhError } from '../error';

/** Numbers of a member's report. */
const REPORT = 16;
const BYTES = 16;

/** What two workers share while they build one hierarchy together. */
export interface TeamMemory {
  /** Who has come to the meeting point, how many meetings there were, whether it is over; then the members' reports. */
  readonly control: SharedArrayBuffer;
  /** Room for all arrays that both look at. */
  readonly arrays: SharedArrayBuffer;
  /** Room for the nodes, and for those of the upper levels. */
  readonly nodes: SharedArrayBuffer;
  readonly upper: SharedArrayBuffer;
}

/** Memory of an earlier build serves the next where it is not larger than this times what that needs. */
const SLACK = 4;

/** Bytes of the arrays for so many triangles, and of the nodes. */
const arrayBytes = (triangles: number) => 128 * triangles + (1 << 16);
const nodeBytes = (triangles: number) => 64 * triangles;

/**
 * What two workers share for so many triangles.
 *
 * @param spare What an earlier build has left, if both have left it: fresh memory costs a fifth of a build. It is not cleared.
 */
export function teamMemory(triangles: number, spare?: TeamMemory): TeamMemory {
  const bytes = arrayBytes(triangles), had = spare?.arrays.byteLength ?? 0;
  const { arrays, nodes, upper } =
    spare && had >= bytes && had <= SLACK * bytes
      ? spare
      : { arrays: new SharedArrayBuffer(bytes), nodes: new SharedArrayBuffer(nodeBytes(triangles)), upper: new SharedArrayBuffer(nodeBytes(triangles)) };
  return { control: new SharedArrayBuffer(BYTES + 2 * 8 * REPORT), arrays, nodes, upper };
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

  /** @param index 0 or 1. */
  constructor(
    readonly index: number,
    memory: TeamMemory,
  ) {
    this.memory = memory;
    this.#control = new Int32Array(memory.control, 0, BYTES / 4);
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
    return new Uint32Array(this.memory.arrays, this.#block(4 * length), length) as Uint32Array as Uint32Array<ArrayBuffer>;
  }

  float32(length: number): Float32Array<ArrayBuffer> {
    return new Float32Array(this.memory.arrays, this.#block(4 * length), length) as Float32Array as Float32Array<ArrayBuffer>;
  }

  /** Waits for the other one, and gives what both have to say, the first one's words first. */
  meet(report: readonly number[] = []): readonly [Float64Array, Float64Array] {
    this.#reports.set(report, this.index * REPORT);
    this.#wait();
    const said = [0, 1].map((index) => this.#reports.slice(index * REPORT, (index + 1) * REPORT)) as [Float64Array, Float64Array];
    // Nobody reports again before both have read.
    this.#wait();
    return said;
  }

  #wait(): void {
    const control = this.#control;
    const meeting = Atomics.load(control, 1);
    if (Atomics.add(control, 0, 1) === 1) {
      Atomics.store(control, 0, 0);
      Atomics.add(control, 1, 1);
      Atomics.notify(control, 1);
    } else while (Atomics.load(control, 1) === meeting) Atomics.wait(control, 1, meeting);
    this.left = Atomics.load(control, 2) !== 0;
    if (this.left) throw new BvhError('bvh/worker', 'The other worker of a build has given up.');
  }

  /** Lets the other one go: its next meeting throws. */
  giveUp(): void {
    Atomics.store(this.#control, 2, 1);
    Atomics.add(this.#control, 1, 1);
    Atomics.notify(this.#control, 1);
  }
}
