/** A convex polyhedron of clear glass in an environment of radiance 1, traced by itself. */
export interface ConvexGlass {
  /** Corners, stride 3, around the origin, and triangles. */
  readonly positions: ArrayLike<number>;
  readonly indices: ArrayLike<number>;
  /** Index of refraction. */
  readonly ior: number;
}

/** A point or direction. */
export type Vector = readonly [number, number, number];
export const dot = (a: Vector, b: Vector): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const along = (a: Vector, t: number, b: Vector): Vector => [a[0] + t * b[0], a[1] + t * b[1], a[2] + t * b[2]];
export const unit = (a: Vector): Vector => {
  const length = Math.hypot(...a);
  return [a[0] / length, a[1] / length, a[2] / length];
};

/** Fresnel's equations, of light that is not polarized, for the relative index and the cosine of incidence; 1 where all is reflected. */
export function reflectance(eta: number, cosine: number): number {
  const square = 1 - (1 - cosine * cosine) / (eta * eta);
  if (square <= 0) return 1;
  const refracted = Math.sqrt(square);
  const s = (cosine - eta * refracted) / (cosine + eta * refracted);
  const p = (refracted - eta * cosine) / (refracted + eta * cosine);
  return (s * s + p * p) / 2;
}

/** Where a ray meets a polyhedron. */
export interface Met {
  readonly t: number;
  readonly facet: number;
}

/** The planes of a convex polyhedron, met in double precision, without any offset of rays. */
export function convexPlanes({ positions, indices }: Omit<ConvexGlass, 'ior'>) {
  const corner = (i: number): Vector => [0, 1, 2].map((k) => positions[3 * indices[i]! + k]!) as unknown as Vector;
  const facets = Array.from({ length: indices.length / 3 }, (_, t) => {
    const [a, b, c] = [corner(3 * t), corner(3 * t + 1), corner(3 * t + 2)];
    const [u, v] = [along(b, -1, a), along(c, -1, a)];
    const n = unit([u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]);
    const out: Vector = dot(n, a) < 0 ? [-n[0], -n[1], -n[2]] : n;
    return { n: out, distance: dot(out, a), middle: unit(along(along(a, 1, b), 1, c)) };
  });
  const radius = Math.max(...Array.from({ length: indices.length }, (_, i) => Math.hypot(...corner(i))));
  // Facets near a point of the sphere around: by cells of latitude and longitude, within 0.2 radians of their middle.
  const cells = new Map<number, readonly number[]>();
  const near = (point: Vector): readonly number[] => {
    const p = unit(point);
    const row = Math.floor((Math.acos(Math.min(Math.max(p[1], -1), 1)) / Math.PI) * 40);
    const column = Math.floor((Math.atan2(p[2], p[0]) / Math.PI) * 40);
    const key = 100 * row + column;
    const found = cells.get(key) ?? facets.flatMap(({ middle }, i) => (dot(middle, p) > Math.cos(0.2) ? [i] : []));
    cells.set(key, found);
    return found;
  };
  /** Where a ray leaves the polyhedron that it is in. */
  const leave = (origin: Vector, direction: Vector, from: number): Met => {
    const b = dot(origin, direction);
    const end = along(origin, Math.sqrt(Math.max(b * b - dot(origin, origin) + radius * radius, 0)) - b, direction);
    let best = { t: Infinity, facet: -1 };
    for (const facet of near(end)) {
      const { n, distance } = facets[facet]!;
      const slope = dot(n, direction);
      if (facet === from || slope <= 0) continue;
      const t = (distance - dot(n, origin)) / slope;
      if (t < best.t) best = { t, facet };
    }
    return best;
  };
  /** Where a ray from outside the sphere around enters it, if it does. */
  const enter = (origin: Vector, direction: Vector): Met | undefined => {
    const b = dot(origin, direction);
    const square = b * b - dot(origin, origin) + radius * radius;
    if (square < 0) return undefined;
    // Most rays enter by a facet near to where they meet the sphere: a point of its plane that is behind no other.
    const close = near(along(origin, -b - Math.sqrt(square), direction));
    let [t, found] = [-Infinity, -1];
    for (const i of close) {
      const { n, distance } = facets[i]!;
      const slope = dot(n, direction);
      const at = (distance - dot(n, origin)) / slope;
      if (slope < 0 && at > t) [t, found] = [at, i];
    }
    const point = along(origin, t, direction);
    if (found >= 0 && close.every((i) => dot(facets[i]!.n, point) < facets[i]!.distance + 1e-12))
      return { t, facet: found };
    let [first, last, facet] = [-Infinity, Infinity, -1];
    facets.forEach(({ n, distance }, i) => {
      const slope = dot(n, direction);
      const t = (distance - dot(n, origin)) / slope;
      if (slope > 0) last = Math.min(last, t);
      else if (t > first) [first, facet] = [t, i];
    });
    return first < last ? { t: first, facet } : undefined;
  };
  return { leave, enter, normal: (facet: number): Vector => facets[facet]!.n };
}

/**
 * Traces rays from outside by splitting: what a facet reflects and what it lets through are both followed. Nothing of
 * it is Glanz's.
 *
 * @returns A function that gives the part of a ray's energy that leaves within so many edges, for each number of edges
 * up to `maxEdges`.
 */
export function convexGlass(glass: ConvexGlass, maxEdges: number) {
  const { ior } = glass;
  const { leave, enter, normal } = convexPlanes(glass);
  return (origin: Vector, direction: Vector): Float64Array => {
    const left = new Float64Array(maxEdges + 1);
    const met = enter(origin, direction);
    if (!met) return left.fill(1, 1);
    let n = normal(met.facet);
    let cosine = -dot(n, direction);
    let kept = 1 - reflectance(ior, cosine);
    left[2] = 1 - kept;
    let d = along(
      [direction[0] / ior, direction[1] / ior, direction[2] / ior],
      cosine / ior - Math.sqrt(1 - (1 - cosine * cosine) / (ior * ior)),
      n,
    );
    let o = along(origin, met.t, direction);
    let from = met.facet;
    for (let edges = 3; edges <= maxEdges; edges++) {
      const exit = leave(o, d, from);
      n = normal(exit.facet);
      o = along(o, exit.t, d);
      cosine = dot(n, d);
      const part = reflectance(1 / ior, cosine);
      left[edges] = kept * (1 - part);
      kept *= part;
      d = along(d, -2 * cosine, n);
      from = exit.facet;
    }
    for (let edges = 2; edges <= maxEdges; edges++) left[edges]! += left[edges - 1]!;
    return left;
  };
}
