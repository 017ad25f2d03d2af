import type { PathTracer } from '@glanz/renderer';

/** Milliseconds between two looks at the count. */
const EVERY_MS = 1000;

/** Rays a second, from the tracer's own count between two moments of uninterrupted work. */
export class RayMeter {
  #begin: { readonly tracer: PathTracer; readonly rays: number; readonly time: number } | undefined;
  #busy = false;
  #perSecond: number | undefined;

  get perSecond(): number | undefined {
    return this.#perSecond;
  }

  /** The work has been interrupted: what was counted until now does not measure the speed. */
  interrupt(): void {
    this.#begin = undefined;
  }

  /** To be called as samples come. */
  async measure(tracer: PathTracer): Promise<void> {
    const begin = this.#begin;
    if (this.#busy || (begin?.tracer === tracer && performance.now() - begin.time < EVERY_MS)) return;
    this.#busy = true;
    try {
      const rays = await tracer.readRayCount();
      const time = performance.now();
      if (begin?.tracer === tracer && begin === this.#begin)
        this.#perSecond = (1000 * (rays - begin.rays)) / (time - begin.time);
      this.#begin = { tracer, rays, time };
    } catch {
      // The tracer or its device is gone; another one will count.
      this.#begin = undefined;
    } finally {
      this.#busy = false;
    }
  }
}
