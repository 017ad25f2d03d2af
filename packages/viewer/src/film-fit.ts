import type { PathTracer } from '@glanz/renderer';

type Size = readonly [number, number];

/** Pixels of a film below which a smaller one is not worth trying. */
const LEAST_PIXELS = 4096;

const aspectOf = ([width, height]: Size) => width / height;

/** Sizes and depths of tracers' films. Where the GPU has no memory for a size, films stay smaller until another one is wanted. */
export class FilmFit {
  /** Depths that tracers have been given. */
  readonly #depths = new WeakMap<PathTracer, number>();
  #mostPixels = Infinity;
  /** The size of the film there is, where no other one can be had. */
  #only: Size | undefined;

  /** The size of a film for an image: the image's own, or the largest of its shape that the GPU may have memory for. */
  sizeFor([width, height]: Size): Size {
    if (this.#only) return this.#only;
    const scale = Math.sqrt(this.#mostPixels / (width * height));
    return scale >= 1 ? [width, height] : [Math.max(1, Math.floor(width * scale)), Math.max(1, Math.floor(height * scale))];
  }

  /** Tries whole sizes again: there is another scene, another device, or another size of the image. */
  forget(): void {
    this.#mostPixels = Infinity;
    this.#only = undefined;
  }

  /** Takes over a tracer as it was made. */
  adopt(tracer: PathTracer, depth: number): void {
    this.#depths.set(tracer, depth);
  }

  /**
   * Gives a tracer a size in pixels and a depth of paths.
   *
   * @returns Whether its film was restarted.
   * @throws {DeviceError} where the GPU refuses the size. The film is what it was, and {@link sizeFor} is smaller then.
   */
  async fit(tracer: PathTracer, size: Size, depth: number): Promise<boolean> {
    const before: Size = [tracer.width, tracer.height];
    const resized = before[0] !== size[0] || before[1] !== size[1];
    if (resized) {
      try {
        await tracer.resize(...size);
      } catch (error) {
        this.#mostPixels = Math.floor((size[0] * size[1]) / 2);
        const alike = Math.abs(aspectOf(size) / aspectOf(before) - 1) < 0.02;
        if (this.#mostPixels <= (alike ? before[0] * before[1] : LEAST_PIXELS)) this.#only = before;
        throw error;
      }
    }
    const deeper = this.#depths.get(tracer) !== depth;
    if (deeper) {
      tracer.setDepth(depth);
      this.#depths.set(tracer, depth);
    }
    return resized || deeper;
  }
}
