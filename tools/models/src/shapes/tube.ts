import { cross, dot, scale, scaleAndAdd, subtract } from 'gl-matrix/esm/vec3.js';
import type { MeshBuilder } from './mesh-builder';

type Vector = readonly [number, number, number];

/** A path to run a tube along. */
export type Curve = (t: number) => Vector;

const unit = (a: Vector): Vector => {
  const length = Math.hypot(...a);
  return [a[0] / length, a[1] / length, a[2] / length];
};

/**
 * A round tube along a curve, with flat ends. The frame is carried along without twisting (double reflection, Wang et
 * al. 2008).
 *
 * @param curve Gives the centre line for t in [0, 1], millimetres.
 * @param steps Sections along the curve.
 * @param segments Corners of a section.
 */
export function tube(builder: MeshBuilder, curve: Curve, radius: number, steps: number, segments: number): void {
  const centres = Array.from({ length: steps + 1 }, (_, i) => curve(i / steps));
  const tangents = centres.map((_, i) =>
    unit(subtract([0, 0, 0], centres[Math.min(i + 1, steps)]!, centres[Math.max(i - 1, 0)]!)),
  );
  const t0 = tangents[0]!;
  let side = unit(cross([0, 0, 0], t0, Math.abs(t0[2]) < 0.9 ? [0, 0, 1] : [1, 0, 0]));
  const sides: Vector[] = [side];
  for (let i = 0; i < steps; i++) {
    const v1 = subtract([0, 0, 0], centres[i + 1]!, centres[i]!);
    const c1 = dot(v1, v1);
    const reflect = (v: Vector, axis: Vector, c: number): Vector =>
      scaleAndAdd([0, 0, 0], v, axis, (-2 / c) * dot(axis, v));
    const sideL = reflect(side, v1, c1);
    const tangentL = reflect(tangents[i]!, v1, c1);
    const v2 = subtract([0, 0, 0], tangents[i + 1]!, tangentL);
    const c2 = dot(v2, v2);
    side = unit(c2 > 1e-20 ? reflect(sideL, v2, c2) : sideL);
    sides.push(side);
  }
  const first = builder.vertexCount;
  const at = (i: number, j: number): { p: Vector; n: Vector } => {
    const u = sides[i]!;
    const v = cross([0, 0, 0], tangents[i]!, u);
    const angle = (j / segments) * 2 * Math.PI;
    const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
    const n = scaleAndAdd([0, 0, 0], scale([0, 0, 0], u, cos), v, sin);
    return { p: scaleAndAdd([0, 0, 0], centres[i]!, n, radius), n };
  };
  for (let i = 0; i <= steps; i++) {
    for (let j = 0; j < segments; j++) {
      const { p, n } = at(i, j);
      builder.vertex(...p, ...n);
    }
  }
  for (let i = 0; i < steps; i++) {
    for (let j = 0; j < segments; j++) {
      const k = (j + 1) % segments;
      builder.quad(
        first + i * segments + j,
        first + i * segments + k,
        first + (i + 1) * segments + k,
        first + (i + 1) * segments + j,
      );
    }
  }
  for (const [i, sign] of [
    [0, -1],
    [steps, 1],
  ] as const) {
    const t = tangents[i]!;
    const n = scale([0, 0, 0], t, sign);
    const rim = builder.vertexCount;
    for (let j = 0; j < segments; j++) builder.vertex(...at(i, j).p, ...n);
    for (let j = 1; j + 1 < segments; j++) {
      if (sign > 0) builder.triangle(rim, rim + j, rim + j + 1);
      else builder.triangle(rim, rim + j + 1, rim + j);
    }
  }
}

/** A quadratic B-spline: smooth, begins and ends at the first and the last point, never leaves their hull; t in [0, 1]. */
export function softSpline(points: readonly Vector[]): Curve {
  const n = points.length - 2;
  return (t) => {
    const s = Math.min(Math.max(t, 0), 1) * n;
    const i = Math.min(Math.floor(s), n - 1);
    const f = s - i;
    const b = points[i + 1]!;
    const [before, after] = [points[i]!, points[i + 2]!];
    const at = (k: 0 | 1 | 2) => {
      const from = i === 0 ? before[k] : (before[k] + b[k]) / 2;
      const to = i === n - 1 ? after[k] : (b[k] + after[k]) / 2;
      return from * (1 - f) ** 2 + 2 * b[k] * f * (1 - f) + to * f * f;
    };
    return [at(0), at(1), at(2)];
  };
}

/** A Catmull-Rom spline through points, centripetal enough for evenly spaced ones; t in [0, 1]. */
export function spline(points: readonly Vector[]): Curve {
  const n = points.length - 1;
  return (t) => {
    const s = Math.min(Math.max(t, 0), 1) * n;
    const i = Math.min(Math.floor(s), n - 1);
    const f = s - i;
    const [b, c] = [points[i]!, points[i + 1]!];
    const a = points[i - 1] ?? [2 * b[0] - c[0], 2 * b[1] - c[1], 2 * b[2] - c[2]];
    const d = points[i + 2] ?? [2 * c[0] - b[0], 2 * c[1] - b[1], 2 * c[2] - b[2]];
    const at = (k: 0 | 1 | 2) =>
      0.5 *
      (2 * b[k] +
        (c[k] - a[k]) * f +
        (2 * a[k] - 5 * b[k] + 4 * c[k] - d[k]) * f * f +
        (3 * b[k] - a[k] - 3 * c[k] + d[k]) * f ** 3);
    return [at(0), at(1), at(2)];
  };
}
