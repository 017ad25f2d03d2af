import type { Blas } from '../blas';

const limits = /* @__PURE__ */ new WeakMap<Uint32Array, number>();

/**
 * One more than the largest triangle of a BLAS in which some triangle is in several leaves (it was cut into pieces); 0
 * for others. Computed once.
 */
function repeatsBelow({ triangleIndices }: Blas): number {
  let limit = limits.get(triangleIndices);
  if (limit === undefined) {
    let end = 0;
    for (let i = 0; i < triangleIndices.length; i++) end = Math.max(end, (triangleIndices[i] as number) + 1);
    const seen = new Uint8Array(end);
    limit = 0;
    for (let i = 0; i < triangleIndices.length; i++) {
      const triangle = triangleIndices[i] as number;
      if (seen[triangle]) limit = end;
      seen[triangle] = 1;
    }
    limits.set(triangleIndices, limit);
  }
  return limit;
}

/**
 * Passes each triangle once a query, though it may be in several leaves. Serves any number of queries one after the
 * other and allocates only when a larger mesh comes.
 */
export class VisitedSet {
  #stamps = new Uint32Array(0);
  #stamp = 0;
  #instance = -1;
  #repeats = false;

  /** Starts the next query. */
  start(): void {
    this.#instance = -1;
  }

  /** Whether this triangle comes for the first time. Triangles of one instance must come in a row. */
  first(blas: Blas, triangle: number, instance: number): boolean {
    if (instance !== this.#instance) this.#enter(blas, instance);
    if (!this.#repeats) return true;
    if (this.#stamps[triangle] === this.#stamp) return false;
    this.#stamps[triangle] = this.#stamp;
    return true;
  }

  #enter(blas: Blas, instance: number): void {
    this.#instance = instance;
    const limit = repeatsBelow(blas);
    this.#repeats = limit > 0;
    if (limit > this.#stamps.length) this.#stamps = new Uint32Array(limit);
    if (++this.#stamp < 2 ** 32) return;
    this.#stamp = 1;
    this.#stamps.fill(0);
  }
}
