/** Three numbers in the world, metres. */
export type Vector = readonly [number, number, number];

/** Position of a camera around a point, +Y up. */
export interface Orbit {
  /** Azimuth around the target, radians: 0 looks from +Z, π/2 from +X. */
  readonly theta: number;
  /** Angle from straight above, radians, in (0, π): π/2 is level with the target. */
  readonly phi: number;
  /** Metres from the target. */
  readonly radius: number;
  /** The point that the camera orbits and looks at, metres. */
  readonly target: Vector;
  /** Magnification of a parallel projection over that of its camera; `undefined` for others. */
  readonly zoom?: number | undefined;
}

/** How far users and calls may move the camera: minimum and maximum of each. What is left out is free. */
export interface OrbitLimits {
  /** Radians. */
  readonly theta?: readonly [number, number];
  /** Radians from straight above. */
  readonly phi?: readonly [number, number];
  /** Metres. */
  readonly radius?: readonly [number, number];
}

/** Three numbers of a matrix in columns, from one that begins at `k`. */
export const column = (m: ArrayLike<number>, k: number): Vector => [
  m[k] as number,
  m[k + 1] as number,
  m[k + 2] as number,
];

/** The vector with a length of 1; one without length stays. */
export function unit([x, y, z]: Vector): Vector {
  const length = Math.hypot(x, y, z) || 1;
  return [x / length, y / length, z / length];
}
