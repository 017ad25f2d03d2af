import type { MeshBuilder } from './mesh-builder';
import { closedOutline, openOutline, type Corner } from './outline';
import { revolve } from './revolve';
import type { Tessellation } from './tessellation';

/** Fine enough for close-ups of things of some centimetres. */
export const FINE: Tessellation = { deviation: 0.02, angle: 0.16 };

/** A corner of a profile: radius, height and the radius that rounds it off, millimetres. */
export type ProfilePoint = readonly [radius: number, height: number, rounding?: number];

/** The corners of a profile, with roundings made smaller where two of them do not fit on the edge between them. */
function corners(profile: readonly ProfilePoint[], closed: boolean): Corner[] {
  const n = profile.length;
  const radii = profile.map(([, , r = 0], i) => (closed || (i > 0 && i < n - 1) ? r : 0));
  const edge = (i: number) => {
    const [a, b] = [profile[i % n]!, profile[(i + 1) % n]!];
    return [b[0] - a[0], b[1] - a[1]] as const;
  };
  // Length that a rounding takes from its edges, per millimetre of its radius.
  const taken = profile.map((_, i) => {
    const [a, b] = [edge((i + n - 1) % n), edge(i)];
    const turn = Math.atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]);
    return Math.abs(turn) < 3.1 ? Math.tan(Math.abs(turn) / 2) : 0;
  });
  for (let i = 0; i < (closed ? n : n - 1); i++) {
    const j = (i + 1) % n;
    const needed = radii[i]! * taken[i]! + radii[j]! * taken[j]!;
    const share = (0.999 * Math.hypot(...edge(i))) / needed;
    if (share < 1) for (const k of [i, j]) radii[k]! *= share;
  }
  return profile.map(([x, y], i) => ({ x, y, r: radii[i]! }));
}

/**
 * A solid of revolution about z from a profile that begins and ends on the axis, from below to above along the outside.
 */
export function lathe(
  builder: MeshBuilder,
  profile: readonly ProfilePoint[],
  segments = 96,
  tessellation: Tessellation = FINE,
): void {
  revolve(builder, openOutline(corners(profile, false), tessellation), segments, false);
}

/** A ring about z: the profile is a loop off the axis, counter-clockwise. */
export function latheRing(
  builder: MeshBuilder,
  profile: readonly ProfilePoint[],
  segments = 96,
  tessellation: Tessellation = FINE,
): void {
  revolve(builder, closedOutline(corners(profile, true), tessellation), segments, true);
}

/**
 * Points of a smooth curve through control points (Catmull-Rom), as corners of a profile.
 *
 * @param steps Chords between two control points.
 */
export function smoothProfile(points: readonly (readonly [number, number])[], steps = 8): ProfilePoint[] {
  const result: ProfilePoint[] = [];
  const n = points.length - 1;
  for (let i = 0; i < n; i++) {
    const [b, c] = [points[i]!, points[i + 1]!];
    const a = points[i - 1] ?? b;
    const d = points[i + 2] ?? c;
    for (let k = 0; k < steps; k++) {
      const t = k / steps;
      const at = (axis: 0 | 1) =>
        0.5 *
        (2 * b[axis] +
          (c[axis] - a[axis]) * t +
          (2 * a[axis] - 5 * b[axis] + 4 * c[axis] - d[axis]) * t * t +
          (3 * b[axis] - a[axis] - 3 * c[axis] + d[axis]) * t ** 3);
      result.push([Math.max(at(0), 0), at(1)]);
    }
  }
  result.push([points[n]![0], points[n]![1]]);
  return result;
}
