import { cross, subtract } from 'gl-matrix/esm/vec3.js';
import type { MeshBuilder } from './mesh-builder';

type Point = readonly [number, number, number];

/** How {@link surface} cuts and joins a parametric surface. */
export interface SurfaceOptions {
  /** Cells along u and v. */
  readonly nu: number;
  readonly nv: number;
  /** Whether u = 1 meets u = 0; likewise v. */
  readonly closeU?: boolean;
  readonly closeV?: boolean;
  /** Turns the triangles around: by default the front is on the side of ∂u × ∂v. */
  readonly flip?: boolean;
}

const EPSILON = 1e-4;

/**
 * A parametric surface over [0, 1]² as a grid, with normals by central differences. Rows that shrink to a point at
 * v = 0 or v = 1 become fans.
 *
 * @param f Gives points, millimetres. Must accept values slightly outside of [0, 1] in directions that are closed.
 */
export function surface(
  builder: MeshBuilder,
  f: (u: number, v: number) => Point,
  { nu, nv, closeU = false, closeV = false, flip = false }: SurfaceOptions,
): void {
  const columns = closeU ? nu : nu + 1;
  const rows = closeV ? nv : nv + 1;
  const sign = flip ? -1 : 1;
  const limited = (x: number, closed: boolean) => (closed ? x : Math.min(Math.max(x, 0), 1));
  const normal = (u: number, v: number, attempt = 0): Point => {
    const along = (du: number, dv: number) =>
      subtract(
        [0, 0, 0],
        f(limited(u + du, closeU), limited(v + dv, closeV)),
        f(limited(u - du, closeU), limited(v - dv, closeV)),
      );
    const n = cross([0, 0, 0], along(EPSILON, 0), along(0, EPSILON));
    const length = Math.hypot(...n);
    // Where a derivative vanishes, as at tips, that of a point nearer to the middle counts.
    if (!(length > 1e-12) && attempt < 20)
      return normal(closeU ? u : u + (0.5 - u) * 0.01, closeV ? v : v + (0.5 - v) * 0.01, attempt + 1);
    return [(sign * n[0]) / length, (sign * n[1]) / length, (sign * n[2]) / length];
  };
  const shrinks = (v: number) => {
    const [a, b, c] = [f(0, v), f(0.31, v), f(0.67, v)];
    return Math.hypot(...subtract([0, 0, 0], a, b)) + Math.hypot(...subtract([0, 0, 0], a, c)) < 1e-6;
  };
  const [pointAt0, pointAt1] = [!closeV && shrinks(0), !closeV && shrinks(1)];
  const first = builder.vertexCount;
  for (let j = 0; j < rows; j++) {
    const v = j / nv;
    const pole = (j === 0 && pointAt0) || (j === nv && pointAt1);
    const tip = pole ? f(0, v) : undefined;
    for (let i = 0; i < columns; i++) {
      const u = i / nu;
      // At a pole the surface has no derivative along u: a step away from it, it has.
      const n = normal(pole ? u + 0.5 / nu : u, pole ? Math.abs(v - 2e-4) : v);
      builder.vertex(...(tip ?? f(u, v)), ...n);
    }
  }
  const at = (i: number, j: number) => first + (j % rows) * columns + (i % columns);
  const triangle = (a: number, b: number, c: number) => (flip ? builder.triangle(a, c, b) : builder.triangle(a, b, c));
  for (let j = 0; j < nv; j++)
    for (let i = 0; i < nu; i++) {
      const [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
      if (!(j === 0 && pointAt0)) triangle(a, b, c);
      if (!(j === nv - 1 && pointAt1)) triangle(a, c, d);
    }
}

const powered = (x: number, e: number) => Math.sign(x) * Math.abs(x) ** e;

/** Options for {@link superellipsoid}. */
export interface SuperellipsoidOptions {
  /** Half extents along x, y and z, millimetres. */
  readonly radii: Point;
  /** Exponents of the outline seen from above and from the side: 1 is round, towards 0 a box. */
  readonly around?: number;
  readonly along?: number;
  readonly segments?: number;
  /** Moves a point of the surface, e.g. for folds. */
  readonly shape?: (p: Point) => Point;
}

/** A superellipsoid around the origin (Barr 1981) with its poles on the z axis: cushions, pebbles, soft boxes. */
export function superellipsoid(
  builder: MeshBuilder,
  { radii, around = 1, along = 1, segments = 64, shape = (p) => p }: SuperellipsoidOptions,
): void {
  surface(
    builder,
    (u, v) => {
      const theta = 2 * Math.PI * u;
      const phi = Math.PI * (v - 0.5);
      const [cp, sp] = [v <= 0 || v >= 1 ? 0 : powered(Math.cos(phi), along), powered(Math.sin(phi), along)];
      return shape([
        radii[0] * cp * powered(Math.cos(theta), around),
        radii[1] * cp * powered(Math.sin(theta), around),
        radii[2] * sp,
      ]);
    },
    { nu: segments, nv: segments / 2, closeU: true },
  );
}

/** A sphere around a point. */
export function sphere(builder: MeshBuilder, centre: Point, radius: number, segments = 48): void {
  superellipsoid(builder, {
    radii: [radius, radius, radius],
    segments,
    shape: ([x, y, z]) => [x + centre[0], y + centre[1], z + centre[2]],
  });
}
