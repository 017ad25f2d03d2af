/** Where arrays come from. */
export type Memory = Pick<Scratch, 'uint32' | 'float32'>;

/** Blocks are found again where they are not larger than this times what is asked for. */
const SLACK = 4;

/**
 * Working memory that is used again by the next build: fresh memory costs more than most of what is done with it. Held
 * weakly, so that it goes when memory is short. What is taken is not cleared.
 */
export class Scratch {
  /** Where set, the objects that a build works with are put here. */
  kept: object[] | undefined;
  readonly #free: ArrayBuffer[];
  readonly #taken: ArrayBuffer[] = [];

  private constructor(free: ArrayBuffer[]) {
    this.#free = free;
  }

  /** What the last build has given back; who knows that more builds come may hold on to it. */
  static left: WeakRef<ArrayBuffer[]> | undefined;

  /** Takes what the last build has given back. */
  static take(): Scratch {
    const free = Scratch.left?.deref() ?? [];
    Scratch.left = undefined;
    return new Scratch(free);
  }

  /** Leaves all blocks to the next build; they must not be used any more. */
  giveBack(): void {
    Scratch.left = new WeakRef(this.#taken);
  }

  /** A block of at least that many bytes. */
  buffer(bytes: number): ArrayBuffer {
    const free = this.#free;
    const at = free.findIndex(({ byteLength }) => byteLength >= bytes && byteLength <= SLACK * bytes);
    const block = at < 0 ? new ArrayBuffer(bytes) : (free.splice(at, 1)[0] as ArrayBuffer);
    this.#taken.push(block);
    return block;
  }

  uint32(length: number): Uint32Array<ArrayBuffer> {
    return new Uint32Array(this.buffer(4 * length), 0, length);
  }

  float32(length: number): Float32Array<ArrayBuffer> {
    return new Float32Array(this.buffer(4 * length), 0, length);
  }
}
