import { GPU_BUFFER_COPY_DST, GPU_BUFFER_COPY_SRC, GPU_BUFFER_STORAGE, type GpuMemory } from '../gpu/buffers';

/** Buffers of the film by the names under which kernels bind them. */
type FilmBuffer = 'film_block' | 'film_total' | 'beauty' | 'feature_albedo' | 'feature_normal' | 'feature_ids';

/** Made when a kernel first binds them: they belong to layers that few ask for. */
const ON_DEMAND: ReadonlySet<string> = new Set<FilmBuffer>(['feature_albedo', 'feature_normal', 'feature_ids']);

/** The buffers of one picture: sums, mean and, once asked for, the first-hit features. */
export class Film {
  readonly width: number;
  readonly height: number;
  readonly #memory: GpuMemory;
  readonly #buffers = new Map<string, GPUBuffer>();

  constructor(memory: GpuMemory, width: number, height: number) {
    this.#memory = memory;
    this.width = width;
    this.height = height;
    for (const name of ['film_block', 'film_total', 'beauty'] as const) this.#make(name);
  }

  get pixels(): number {
    return this.width * this.height;
  }

  /** Mean radiance and coverage, vec4f per pixel, row-major, top row first. */
  get beauty(): GPUBuffer {
    return this.#buffers.get('beauty') as GPUBuffer;
  }

  /** The buffer that a kernel binds under this name, if it is the film's. */
  buffer(name: string): GPUBuffer | undefined {
    return this.#buffers.get(name) ?? (ON_DEMAND.has(name) ? this.#make(name) : undefined);
  }

  /** Zeroes the sums. */
  clear(encoder: GPUCommandEncoder): void {
    for (const [name, buffer] of this.#buffers) if (!ON_DEMAND.has(name)) encoder.clearBuffer(buffer);
  }

  destroy(): void {
    for (const buffer of this.#buffers.values()) this.#memory.release(buffer);
    this.#buffers.clear();
  }

  #make(name: string): GPUBuffer {
    const label = name.startsWith('film') ? name.replace('_', ' ') : `film ${name.replace('feature_', '')}`;
    const buffer = this.#memory.buffer(label, this.pixels * 16, GPU_BUFFER_STORAGE | GPU_BUFFER_COPY_SRC | GPU_BUFFER_COPY_DST);
    this.#buffers.set(name, buffer);
    return buffer;
  }
}
