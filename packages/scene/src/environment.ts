/** The same radiance from every direction. */
export interface ConstantEnvironment {
  type: 'constant';
  /** Linear Rec.709. */
  radiance: readonly [number, number, number];
  /** Whether the camera sees it directly; default true. Light from it arrives either way. */
  visible?: boolean;
  /** Light group that its light is added to. */
  light_group?: string;
}

/**
 * A latitude-longitude image of the environment. A direction d in the image's frame maps to
 * u = atan2(d.z, d.x)/2π + ½, v = acos(d.y)/π: row 0 is +Y, the image's centre +X, u grows towards +Z. Texel centres
 * at (i+½)/N, bilinear, wrapping in u, clamping in v.
 */
export interface LatLongEnvironment {
  type: 'latlong';
  width: number;
  height: number;
  /** RGB interleaved, stride 3, linear Rec.709 radiance, top row first. Finite and not negative. */
  data: Float32Array<ArrayBuffer>;
  /** Multiplies the radiance; at least 0, default 1. */
  intensity?: number;
  /**
   * Rotates the environment about +Y, radians, counter-clockwise seen from above: L(d) = image(R_y(−rotation) d).
   * Default 0.
   */
  rotation?: number;
  visible?: boolean;
  /** Light group that its light is added to. */
  light_group?: string;
}

/** The light that comes from infinitely far away. */
export type Environment = ConstantEnvironment | LatLongEnvironment;
