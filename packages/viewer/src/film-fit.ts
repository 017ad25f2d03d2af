import type { PathTracer } from '@glanz/renderer';

/** What a tracer has been asked for. */
interface Asked {
  depth: number;
  /** Pixels that its film is about to get. */
  size?: readonly [number, number];
  /** Why it did not get them; thrown once. */
  error?: unknown;
}

/** Sizes and depths of tracers' films. */
export class FilmFit {
  readonly #asked = new WeakMap<PathTracer, Asked>();

  /**
   * Gives a tracer a size in pixels and a depth of paths. The size comes when the GPU has memory for it.
   *
   * @returns Whether its film was restarted, or will be.
   * @throws the error of an earlier size that the GPU refused.
   */
  fit(tracer: PathTracer, [width, height]: readonly [number, number], depth: number): boolean {
    let asked = this.#asked.get(tracer);
    if (!asked) this.#asked.set(tracer, (asked = { depth: NaN }));
    const known = asked;
    const { error } = known;
    if (error !== undefined) {
      delete known.error;
      throw error;
    }
    const [nextWidth, nextHeight] = known.size ?? [tracer.width, tracer.height];
    const resized = nextWidth !== width || nextHeight !== height;
    const deeper = known.depth !== depth;
    if (resized) {
      const size = [width, height] as const;
      known.size = size;
      tracer
        .resize(width, height)
        .catch((cause: unknown) => (known.error = cause))
        .finally(() => {
          if (known.size === size) delete known.size;
        });
    }
    if (deeper) {
      tracer.setDepth(depth);
      known.depth = depth;
    }
    return resized || deeper;
  }
}
