import type { TriangleMesh } from '../../src/index';

type Point = readonly [number, number, number];

const sub = (a: Point, b: Point): Point => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const dot = (a: Point, b: Point) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a: Point, b: Point): Point => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];

/** The corners of each triangle. */
export function cornersOf({ positions: p, indices }: TriangleMesh): [Point, Point, Point][] {
  const count = Math.floor((indices?.length ?? p.length / 3) / 3);
  const point = (v: number): Point => [p[3 * v]!, p[3 * v + 1]!, p[3 * v + 2]!];
  return Array.from(
    { length: count },
    (_, i) => [0, 1, 2].map((c) => point(indices ? indices[3 * i + c]! : 3 * i + c)) as [Point, Point, Point],
  );
}

/**
 * Distance of a point to a triangle: to its plane where the foot lies on the inner side of all edges, else to the
 * nearest edge.
 */
export function distanceTo([a, b, c]: readonly [Point, Point, Point], p: Point): number {
  const n = cross(sub(b, a), sub(c, a));
  const edges: [Point, Point][] = [
    [a, b],
    [b, c],
    [c, a],
  ];
  if (dot(n, n) > 0 && edges.every(([s, e]) => dot(cross(n, sub(e, s)), sub(p, s)) >= 0))
    return Math.abs(dot(n, sub(p, a))) / Math.sqrt(dot(n, n));
  return Math.min(
    ...edges.map(([s, e]) => {
      const d = sub(e, s),
        length = dot(d, d);
      const t = length > 0 ? Math.min(1, Math.max(0, dot(sub(p, s), d) / length)) : 0;
      const q = sub(p, [s[0] + t * d[0], s[1] + t * d[1], s[2] + t * d[2]]);
      return Math.sqrt(dot(q, q));
    }),
  );
}

/**
 * Whether a triangle and the inner sides of planes have a point in common: a linear program in the two barycentrics,
 * whose corners are all tried.
 */
export function meetsPlanes([a, b, c]: readonly [Point, Point, Point], planes: ArrayLike<number>): boolean {
  // Each constraint: k u + l v + m ≥ 0.
  const constraints: Point[] = [
    [1, 0, 0],
    [0, 1, 0],
    [-1, -1, 1],
  ];
  for (let i = 0; i < planes.length; i += 4) {
    const n: Point = [planes[i]!, planes[i + 1]!, planes[i + 2]!];
    const at = dot(n, a) + planes[i + 3]!;
    constraints.push([dot(n, b) + planes[i + 3]! - at, dot(n, c) + planes[i + 3]! - at, at]);
  }
  const size = Math.max(...constraints.map(([k, l, m]) => Math.abs(k) + Math.abs(l) + Math.abs(m)));
  for (let i = 0; i < constraints.length; i++) {
    for (let j = i + 1; j < constraints.length; j++) {
      const [k, l, m] = constraints[i]!,
        [p, q, r] = constraints[j]!;
      const det = k * q - l * p;
      if (det === 0) continue;
      const u = (l * r - m * q) / det,
        v = (m * p - k * r) / det;
      if (constraints.every(([x, y, z]) => x * u + y * v + z >= -1e-12 * size)) return true;
    }
  }
  return false;
}

/** The planes of a box. */
export const boxPlanes = (min: Point, max: Point): number[] =>
  [0, 1, 2].flatMap((k) =>
    [1, -1].flatMap((s) => [...[0, 1, 2].map((i) => (i === k ? s : 0)), s > 0 ? -min[k]! : max[k]!]),
  );
