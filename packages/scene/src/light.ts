/** What all lights have in common. */
interface NamedLight {
  name: string;
  /** Light group that its light is kept in; see `PathTracerOptions.lightGroups` of the renderer. */
  light_group?: string;
  /** Linear Rec.709; multiplies the intensity. */
  color: readonly [number, number, number];
}

/** A light without size. World space. Colours are linear Rec.709 and multiply the intensity. */
export interface PointLight extends NamedLight {
  type: 'point';
  /** Radiant intensity, W/sr (glTF: candela, taken 1:1). */
  intensity: number;
  /** Metres. */
  position: readonly [number, number, number];
}

/** A point light with a cone, falling off smoothly between the two angles (glTF KHR_lights_punctual). */
export interface SpotLight extends NamedLight {
  type: 'spot';
  /** Radiant intensity on the axis, W/sr. */
  intensity: number;
  position: readonly [number, number, number];
  /** Unit vector the light shines along. */
  direction: readonly [number, number, number];
  /** Half angle of the full-strength cone, radians. */
  inner_cone_angle: number;
  /** Half angle where it reaches zero, radians, at most π/2, greater than the inner one. */
  outer_cone_angle: number;
}

/**
 * How much a lamp was measured to shine which way: the luminous intensities of a photometric file (IES LM-63, type C),
 * taken 1:1 as W/sr as glTF's candela are. Between the angles it is linear, beyond the last vertical one it is dark.
 */
export interface LightProfile {
  /** Angles from the lamp's axis, radians, rising, 0 to π at most; two at least. */
  readonly vertical: Float32Array;
  /** Angles around it, radians, rising from 0, below 2π; one alone: the same all around. */
  readonly horizontal: Float32Array;
  /** W/sr, for each horizontal angle those of all vertical ones: stride `vertical.length`. */
  readonly intensities: Float32Array;
}

/** A light without size that shines as a measured lamp does. */
export interface ProfileLight extends NamedLight {
  type: 'profile';
  /** Factor of the profile's intensities. */
  intensity: number;
  /** Metres. */
  position: readonly [number, number, number];
  /** Unit vector of the lamp's axis, the way that its vertical angle 0 points: down for a ceiling lamp. */
  direction: readonly [number, number, number];
  /**
   * Where its horizontal angle 0 lies; what of it runs along the direction does not count. They go round
   * counter-clockwise as seen against the direction's way, that is, by tangent × direction. Default: level, that is,
   * across +Y.
   */
  tangent?: readonly [number, number, number];
  profile: LightProfile;
}

/** Parallel light from infinitely far away. */
export interface DirectionalLight extends NamedLight {
  type: 'directional';
  /** Irradiance on a perpendicular surface, W/m² (glTF: lux, taken 1:1). */
  intensity: number;
  /** Unit vector the light travels along. */
  direction: readonly [number, number, number];
}

/**
 * What the lights with a size have in common. They block no light and reflect none: what lies behind them is seen
 * through them.
 */
interface AreaLight extends NamedLight {
  /** Radiance, W/(sr·m²), the same in all directions it shines into. */
  intensity: number;
  /** Its middle, metres. */
  position: readonly [number, number, number];
  /** Whether the camera sees it; mirrors and glass show it in any case. Default true. */
  visible?: boolean;
}

/** A rectangle that shines to one side. */
export interface RectangleLight extends AreaLight {
  type: 'rectangle';
  /** Unit vector out of the side that shines. */
  direction: readonly [number, number, number];
  /**
   * Which way its width lies; what of it runs along the direction does not count. Default: level, that is, across +Y.
   */
  tangent?: readonly [number, number, number];
  /** Metres. */
  width: number;
  height: number;
}

/** A disk that shines to one side. */
export interface DiskLight extends AreaLight {
  type: 'disk';
  /** Unit vector out of the side that shines. */
  direction: readonly [number, number, number];
  /** Metres. */
  radius: number;
}

/** A sphere that shines all around, outwards. */
export interface SphereLight extends AreaLight {
  type: 'sphere';
  /** Metres. */
  radius: number;
}

/** A light other than an emissive mesh or the surroundings. */
export type Light = PointLight | SpotLight | ProfileLight | DirectionalLight | RectangleLight | DiskLight | SphereLight;
