import type { PathTracer } from '@glanz/renderer';

/** Sizes and depths of tracers' films. */
export class FilmFit {
  /** Depths that tracers have been given. */
  readonly #depths = new WeakMap<PathTracer, number>();

  /** Gives a tracer a size in pixels and a depth of paths. @returns Whether its film was restarted. */
  fit(tracer: PathTracer, [width, height]: readonly [number, number], depth: number): boolean {
    const resized = tracer.width !== width || tracer.height !== height;
    const deeper = this.#depths.get(tracer) !== depth;
    if (resized) tracer.resize(width, height);
    if (deeper) {
      tracer.setDepth(depth);
      this.#depths.set(tracer, depth);
    }
    return resized || deeper;
  }
}
