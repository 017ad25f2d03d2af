/** What all lights have in common. */
interface NamedLight {
  name: string;
  /** Light group that its light is added to; see `PathTracerOptions.lightGroups` of the renderer. */
  light_group?: string;
  /** Linear Rec.709; multiplies the intensity. */
  color: readonly [number, number, number];
}

/** A point light. World space. Colours are linear Rec.709 and multiply the intensity. */
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
 * The measured intensity of a luminaire by direction: the luminous intensities of a photometric file (IES LM-63,
 * type C), taken 1:1 as W/sr as glTF's candela are. Interpolated linearly between angles; 0 beyond the last vertical one.
 */
export interface LightProfile {
  /** Angles from the luminaire's axis, radians, rising, from 0 to at most π; at least two. */
  readonly vertical: Float32Array;
  /** Angles around it, radians, rising from 0, below 2π; a single one: symmetric about the axis. */
  readonly horizontal: Float32Array;
  /** W/sr; for each horizontal angle, the values at all vertical angles: stride `vertical.length`. */
  readonly intensities: Float32Array;
}

/** A point light with the measured intensity profile of a luminaire. */
export interface ProfileLight extends NamedLight {
  type: 'profile';
  /** Factor of the profile's intensities. */
  intensity: number;
  /** Metres. */
  position: readonly [number, number, number];
  /** Unit vector of the luminaire's axis, towards vertical angle 0: down for a ceiling luminaire. */
  direction: readonly [number, number, number];
  /**
   * Direction of horizontal angle 0; its component along `direction` is ignored. Angles increase counter-clockwise seen
   * against `direction`, that is, towards tangent × direction. Default: horizontal, perpendicular to +Y.
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
 * What area lights have in common. They neither block nor reflect light: what lies behind them is visible through
 * them.
 */
interface AreaLight extends NamedLight {
  /** Radiance, W/(sr·m²), the same in all directions that it emits to. */
  intensity: number;
  /** Its centre, metres. */
  position: readonly [number, number, number];
  /** Whether the camera sees it; mirrors and glass show it in any case. Default true. */
  visible?: boolean;
}

/** A rectangle that emits from one side. */
export interface RectangleLight extends AreaLight {
  type: 'rectangle';
  /** Unit normal of the side that emits. */
  direction: readonly [number, number, number];
  /**
   * Direction of its width; its component along `direction` is ignored. Default: horizontal, perpendicular to +Y.
   */
  tangent?: readonly [number, number, number];
  /** Metres. */
  width: number;
  height: number;
}

/** A disk that emits from one side. */
export interface DiskLight extends AreaLight {
  type: 'disk';
  /** Unit normal of the side that emits. */
  direction: readonly [number, number, number];
  /** Metres. */
  radius: number;
}

/** A sphere that emits outwards. */
export interface SphereLight extends AreaLight {
  type: 'sphere';
  /** Metres. */
  radius: number;
}

/** A light other than an emissive mesh or the environment. */
export type Light = PointLight | SpotLight | ProfileLight | DirectionalLight | RectangleLight | DiskLight | SphereLight;
