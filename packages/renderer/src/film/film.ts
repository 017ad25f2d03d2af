import { TileGrid } from '../schedule/adaptive';
import { GPU_BUFFER_COPY_DST, GPU_BUFFER_COPY_SRC, GPU_BUFFER_STORAGE, type GpuMemory } from '../storage/buffers';
import { TILE } from '../schedule/tile';
import { AOV_BUFFERS, type AovBuffer } from './aovs';

/**
 * The buffers of one image. Per pixel: a vec4f for each light pass (light group) in `film_block` (samples of a chunk
 * not yet complete) and in `film_total` (complete chunks), one pass after another; `film_moment` for the variance;
 * `beauty`; the pixel's number in `film_pixels`; in a film that begins in the middle of a chunk, that chunk's samples in
 * `film_head`, which `film_total` contains too; the AOVs that are requested. `film_noise` and `film_variance` are made
 * when they are first bound.
 */
export class Film {
  /** Pixels that there is memory for. */
  readonly fullWidth: number;
  readonly fullHeight: number;
  /** Sums that are kept apart. */
  readonly lightPasses: number;
  readonly #memory: GpuMemory;
  readonly #buffers = new Map<string, GPUBuffer>();
  /** Bytes for each pixel; `film_noise` has tiles. */
  readonly #perPixel = new WeakMap<GPUBuffer, number>();
  #scale = 1;
  #pixels: Uint32Array<ArrayBuffer> | undefined;
  #whole = false;

  /** @param aovs Buffers of AOVs, see {@link keepAovs}. */
  constructor(memory: GpuMemory, width: number, height: number, lightPasses: number, aovs: readonly AovBuffer[] = []) {
    this.#memory = memory;
    this.fullWidth = width;
    this.fullHeight = height;
    this.lightPasses = lightPasses;
    this.#make('film_block', 16 * lightPasses);
    this.#make('film_total', 16 * lightPasses);
    this.#make('film_moment', 16);
    this.#make('beauty', 16);
    this.#make('film_pixels', 4);
    this.keepAovs(aovs);
    this.setPixels(undefined);
  }

  /** Buffers of AOVs that there are. */
  get aovs(): readonly AovBuffer[] {
    return (Object.keys(AOV_BUFFERS) as AovBuffer[]).filter((name) => this.#buffers.has(name));
  }

  /** Makes the buffers of these AOVs that there are not yet, and frees those of others. */
  keepAovs(aovs: readonly AovBuffer[]): void {
    for (const name of aovs) if (!this.#buffers.has(name)) this.#make(name, AOV_BUFFERS[name]);
    this.release(...this.aovs.filter((name) => !aovs.includes(name)));
  }

  /** Share of the full width and height that is rendered. */
  get scale(): number {
    return this.#scale;
  }

  /** Renders fewer pixels in the same memory, 0 < scale ≤ 1. What was accumulated has to be cleared. */
  set scale(scale: number) {
    this.#scale = scale;
    this.#whole = false;
    this.setPixels(undefined);
  }

  /** Pixels that are rendered. */
  get width(): number {
    return Math.max(1, Math.round(this.fullWidth * this.#scale));
  }

  get height(): number {
    return Math.max(1, Math.round(this.fullHeight * this.#scale));
  }

  /**
   * From now on, place i of a batch is pixel `list[i]`; without a list all of them tile by tile, as in the beginning:
   * rays of one workgroup then go through a square of the image, not through a line of it, and meet the same nodes.
   */
  setPixels(list: Uint32Array<ArrayBuffer> | undefined): void {
    if (!list && this.#whole) return;
    this.#whole = !list;
    this.#pixels = list;
    this.#memory.write(
      this.#buffers.get('film_pixels') as GPUBuffer,
      list ?? new TileGrid(this.width, this.height).allPixels(),
    );
  }

  /** The list that was set with {@link setPixels}. */
  get listed(): Uint32Array<ArrayBuffer> | undefined {
    return this.#pixels;
  }

  get pixels(): number {
    return this.width * this.height;
  }

  /** Mean radiance and coverage, vec4f per pixel, row-major, top row first. */
  get beauty(): GPUBuffer {
    return this.#buffers.get('beauty') as GPUBuffer;
  }

  /** The buffer that a kernel binds under this name, if it is the film's. Only {@link bytes} of it are in use. */
  buffer(name: string): GPUBuffer | undefined {
    // A tile each 64 pixels, and those at the edges.
    if (name === 'film_noise' && !this.#buffers.has(name))
      this.#allocate(name, 16 * Math.ceil(this.fullWidth / TILE) * Math.ceil(this.fullHeight / TILE));
    if (name === 'film_variance' && !this.#buffers.has(name)) this.#make(name, 16);
    return this.#buffers.get(name);
  }

  /** Bytes of a buffer that the rendered pixels take: kernels see no more of it, nor do copies. */
  bytes(buffer: GPUBuffer): number {
    const each = this.#scale === 1 ? undefined : this.#perPixel.get(buffer);
    return each === undefined ? buffer.size : each * this.pixels;
  }

  /** Copies the totals, which are the sums of the first chunk at this time, to `film_head`. */
  copyHead(encoder: GPUCommandEncoder): void {
    const { head } = this;
    encoder.copyBufferToBuffer(this.#buffers.get('film_total') as GPUBuffer, 0, head, 0, this.bytes(head));
  }

  /** `film_head`, made when it is first used. */
  get head(): GPUBuffer {
    return this.#buffers.get('film_head') ?? this.#make('film_head', 16 * this.lightPasses);
  }

  /** Frees buffers that were made when they were first bound; they are made again when they are bound again. */
  release(...names: readonly string[]): void {
    for (const name of names) {
      this.#memory.release(this.#buffers.get(name));
      this.#buffers.delete(name);
    }
  }

  /** Zeroes the sums. */
  clear(encoder: GPUCommandEncoder): void {
    for (const name of ['film_block', 'film_total', 'film_moment', 'beauty', ...this.aovs]) {
      const buffer = this.#buffers.get(name) as GPUBuffer;
      encoder.clearBuffer(buffer, 0, this.bytes(buffer));
    }
  }

  destroy(): void {
    for (const buffer of this.#buffers.values()) this.#memory.release(buffer);
    this.#buffers.clear();
  }

  #make(name: string, bytesPerPixel: number): GPUBuffer {
    const buffer = this.#allocate(name, this.fullWidth * this.fullHeight * bytesPerPixel);
    this.#perPixel.set(buffer, bytesPerPixel);
    return buffer;
  }

  #allocate(name: string, bytes: number): GPUBuffer {
    const label = name.startsWith('film') ? name.replace('_', ' ') : `film ${name.replace('aov_', '')}`;
    const buffer = this.#memory.buffer(label, bytes, GPU_BUFFER_STORAGE | GPU_BUFFER_COPY_SRC | GPU_BUFFER_COPY_DST);
    this.#buffers.set(name, buffer);
    return buffer;
  }
}
