/** An allocator of arrays. */
export type Memory = Pick<Scratch, 'uint32' | 'float32'>;

/** A block is reused where it is at most this many times as large as requested. */
const SLACK = 4;

/**
 * Working memory that the next build reuses: allocating it costs more than most of the work done with it. Held by a
 * weak reference, so that it is freed when memory is short. Blocks are not cleared.
 */
export class Scratch {
  /** Where set, the objects that a build works with are put here. */
  kept: object[] | undefined;
  readonly #free: ArrayBuffer[];
  readonly #taken: ArrayBuffer[] = [];

  private constructor(free: ArrayBuffer[]) {
    this.#free = free;
  }

  /** Memory released by the last build; hold a reference to it if more builds follow. */
  static left: WeakRef<ArrayBuffer[]> | undefined;

  /** Takes the memory of the last build. */
  static take(): Scratch {
    const free = Scratch.left?.deref() ?? [];
    Scratch.left = undefined;
    return new Scratch(free);
  }

  /** Releases all blocks to the next build; they must not be used afterwards. */
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
