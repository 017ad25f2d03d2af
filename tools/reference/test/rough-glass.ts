import { along, convexPlanes, dot, reflectance, unit, type ConvexGlass, type Vector } from './convex-glass';

/** A polyhedron of rough glass, see {@link roughConvexGlass}. */
export interface RoughConvexGlass extends ConvexGlass {
  /** Of the GGX distribution of the facets' microfacets. */
  readonly alpha: number;
}

const cross = (a: Vector, b: Vector): Vector => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];

/** Smith's Λ of GGX for the cosine between a direction and the normal. */
function lambda(alpha: number, cosine: number): number {
  const square = cosine * cosine;
  return (Math.sqrt(1 + (alpha * alpha * (1 - square)) / square) - 1) / 2;
}

/** A microfacet's normal in proportion to the area that `v` sees of it (Heitz 2018), in a frame whose z is the normal. */
function visibleNormal(alpha: number, v: Vector, random: () => number): Vector {
  const view = unit([alpha * v[0], alpha * v[1], v[2]]);
  const length = Math.hypot(view[0], view[1]);
  const t1: Vector = length > 0 ? [-view[1] / length, view[0] / length, 0] : [1, 0, 0];
  const t2 = cross(view, t1);
  const [r, phi] = [Math.sqrt(random()), 2 * Math.PI * random()];
  const x = r * Math.cos(phi);
  const s = (1 + view[2]) / 2;
  const y = (1 - s) * Math.sqrt(1 - x * x) + s * r * Math.sin(phi);
  const z = Math.sqrt(Math.max(0, 1 - x * x - y * y));
  const n = along(along([x * t1[0], x * t1[1], x * t1[2]], y, t2), z, view);
  return unit([alpha * n[0], alpha * n[1], Math.max(1e-12, n[2])]);
}

/**
 * Traces rays from outside through a polyhedron of rough glass in an environment of radiance 1, in double precision:
 * single scattering on GGX microfacets with height-correlated masking, for reflection and transmission (Walter et al.
 * 2007), a random choice by Fresnel's equations at each. Nothing of it is Glanz's.
 *
 * @returns A function that gives the part of a ray's energy that leaves within so many edges, for each number of edges
 * up to `maxEdges`: an estimate, whose mean is right.
 */
export function roughConvexGlass(glass: RoughConvexGlass, maxEdges: number, random: () => number) {
  const { ior, alpha } = glass;
  const { leave, enter, normal } = convexPlanes(glass);

  /**
   * Scatters a ray at a facet.
   * @param n The facet's normal on the side that the ray comes from.
   * @param eta Index of the other side over that of this one.
   */
  const scatter = (direction: Vector, n: Vector, eta: number) => {
    const tangent = unit(cross(Math.abs(n[0]) > 0.5 ? [0, 1, 0] : [1, 0, 0], n));
    const other = cross(n, tangent);
    const v: Vector = [-dot(direction, tangent), -dot(direction, other), -dot(direction, n)];
    const h = visibleNormal(alpha, v, random);
    const cosine = dot(v, h);
    const reflects = random() < reflectance(eta, cosine);
    const refracted = cosine / eta - Math.sqrt(Math.max(0, 1 - (1 - cosine * cosine) / (eta * eta)));
    const l = reflects
      ? along([-v[0], -v[1], -v[2]], 2 * cosine, h)
      : along([-v[0] / eta, -v[1] / eta, -v[2] / eta], refracted, h);
    const from = lambda(alpha, v[2]);
    // What would leave on the wrong side scatters more than once.
    const isKept = reflects ? l[2] > 0 : l[2] < 0;
    const weight = isKept ? (1 + from) / (1 + from + lambda(alpha, l[2])) : 0;
    const to = along(along([l[0] * tangent[0], l[0] * tangent[1], l[0] * tangent[2]], l[1], other), l[2], n);
    return { reflects, weight, direction: unit(to) };
  };

  return (origin: Vector, direction: Vector): Float64Array => {
    const left = new Float64Array(maxEdges + 1);
    const met = enter(origin, direction);
    if (!met) return left.fill(1, 1);
    let [o, from] = [along(origin, met.t, direction), met.facet];
    const first = scatter(direction, normal(from), ior);
    let [d, kept] = [first.direction, first.weight];
    if (first.reflects) return left.fill(kept, 2);
    for (let edges = 3; edges <= maxEdges && kept > 0; edges++) {
      const exit = leave(o, d, from);
      o = along(o, exit.t, d);
      from = exit.facet;
      const n = normal(from);
      const next = scatter(d, [-n[0], -n[1], -n[2]], 1 / ior);
      kept *= next.weight;
      d = next.direction;
      if (!next.reflects) return left.fill(kept, edges);
    }
    return left;
  };
}
