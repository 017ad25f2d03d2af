import type { PathTracer } from '@glanz/renderer';

type Size = readonly [number, number];

/** Pixels of a film below which a smaller one is not tried. */
const MIN_PIXELS = 16;

/**
 * When a refused size is tried again, after the image is done: the first delay and the maximum. Doubled in
 * between.
 */
const [RETRY_MS, MAX_RETRY_MS] = [4_000, 256_000];

export const sameSize = (one: Size, other: Size) => one[0] === other[0] && one[1] === other[1];

/** A size at a render scale, as the tracer rounds it. */
export const scaledSize = (size: Size, scale: number) =>
  size.map((side) => Math.max(1, Math.round(side * scale))) as unknown as Size;

/** Whether one size is the other one scaled, and rounded. */
const isScaled = (one: Size, other: Size) => Math.abs((other[0] * one[1]) / one[0] - other[1]) < 1;

/**
 * Sizes and depths of tracers' films. Where the GPU has no memory for a size, films are smaller until that size fits,
 * or another one is wanted.
 */
export class FilmFit {
  /** Sizes and depths that tracers have been given. */
  readonly #sizes = new WeakMap<PathTracer, Size>();
  readonly #depths = new WeakMap<PathTracer, number>();
  #maxPixels = Infinity;
  /** The size of the film there is, where no other one can be had. */
  #only: Size | undefined;
  #retryMs = RETRY_MS;

  /** Milliseconds after which to {@link grow} a film that had to be smaller. */
  get retryMs(): number {
    return this.#retryMs;
  }

  /** The size of a film for an image: the image's own, or the largest of its shape that the GPU may have memory for. */
  sizeFor([width, height]: Size): Size {
    if (this.#only) return this.#only;
    const scale = Math.sqrt(this.#maxPixels / (width * height));
    return scale >= 1
      ? [width, height]
      : [Math.max(1, Math.floor(width * scale)), Math.max(1, Math.floor(height * scale))];
  }

  /** Tries whole sizes again: there is another scene, or another size of the image. */
  forget(): void {
    this.#maxPixels = Infinity;
    this.#only = undefined;
    this.#retryMs = RETRY_MS;
  }

  /**
   * Tries the whole size of an image whose film had to be smaller: memory may be free by now.
   *
   * @returns Whether the film has that size, and was restarted. Otherwise everything is as before, and the next try is
   * later.
   */
  async grow(tracer: PathTracer, size: Size): Promise<boolean> {
    try {
      await this.#resize(tracer, size);
    } catch {
      this.#retryMs = Math.min(2 * this.#retryMs, MAX_RETRY_MS);
      return false;
    }
    this.forget();
    return true;
  }

  /** Takes over a tracer as it was made. */
  adopt(tracer: PathTracer, depth: number): void {
    this.#sizes.set(tracer, [tracer.width, tracer.height]);
    this.#depths.set(tracer, depth);
  }

  /**
   * Gives a tracer a size in pixels and a depth of paths. A film that has that size is scaled; one that has not, is
   * made as small as the preview, for the size may be another one at the next frame.
   *
   * @param scale Share of the width and height that is rendered.
   * @returns Whether its film was restarted.
   * @throws {DeviceError} where the GPU refuses the size. The film is what it was.
   */
  async fit(tracer: PathTracer, size: Size, depth: number, scale = 1): Promise<boolean> {
    const pixels = scaledSize(size, scale);
    const resized = !sameSize([tracer.width, tracer.height], pixels);
    if (resized) {
      if (sameSize(this.#sizes.get(tracer) ?? [0, 0], size)) tracer.setRenderScale(scale);
      else await this.#resize(tracer, pixels);
    }
    const deeper = this.#depths.get(tracer) !== depth;
    if (deeper) {
      tracer.setDepth(depth);
      this.#depths.set(tracer, depth);
    }
    return resized || deeper;
  }

  async #resize(tracer: PathTracer, size: Size): Promise<void> {
    await tracer.resize(...size);
    this.#sizes.set(tracer, size);
  }

  /** Notes that the GPU has refused a size: {@link sizeFor} is smaller from then on. */
  refuse(tracer: PathTracer, size: Size): void {
    const present: Size = [tracer.width, tracer.height];
    this.#maxPixels = Math.floor((size[0] * size[1]) / 2);
    // The film there is does, where its shape is right and there is nothing between it and what was refused.
    if (this.#maxPixels <= (isScaled(size, present) ? present[0] * present[1] : MIN_PIXELS)) this.#only = present;
  }
}
