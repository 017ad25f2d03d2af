/** A light without size. World space. Colours are linear Rec.709 and multiply the intensity. */
export interface PointLight {
  type: 'point';
  name: string;
  /** Light group that its light is kept in; see `PathTracerOptions.lightGroups` of the renderer. */
  light_group?: string;
  color: readonly [number, number, number];
  /** Radiant intensity, W/sr (glTF: candela, taken 1:1). */
  intensity: number;
  /** Metres. */
  position: readonly [number, number, number];
}

/** A point light with a cone, falling off smoothly between the two angles (glTF KHR_lights_punctual). */
export interface SpotLight {
  type: 'spot';
  name: string;
  /** Light group that its light is kept in; see `PathTracerOptions.lightGroups` of the renderer. */
  light_group?: string;
  color: readonly [number, number, number];
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

/** Parallel light from infinitely far away. */
export interface DirectionalLight {
  type: 'directional';
  name: string;
  /** Light group that its light is kept in; see `PathTracerOptions.lightGroups` of the renderer. */
  light_group?: string;
  color: readonly [number, number, number];
  /** Irradiance on a perpendicular surface, W/m² (glTF: lux, taken 1:1). */
  intensity: number;
  /** Unit vector the light travels along. */
  direction: readonly [number, number, number];
}

/** A light without area. Those with area are emissive triangles. */
export type Light = PointLight | SpotLight | DirectionalLight;
