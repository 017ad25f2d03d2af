import type { Light, Scene } from '@glanz/scene';
import { axisOf, positionOf } from './matrix';
import type { Color, Loose, ThreeObject } from './types';

type Rgb = [number, number, number];

const scaled = ({ r, g, b }: Color, k: number): Rgb => [r * k, g * k, b * k];

/** Ambient light, as an environment: radiance from above and from below. */
export class Ambience {
  readonly above: Rgb = [0, 0, 0];
  readonly below: Rgb = [0, 0, 0];

  get dark(): boolean {
    return [...this.above, ...this.below].every((value) => value === 0);
  }

  /**
   * Irradiance on surfaces that face up, and on those that face down, as three's ambient and hemisphere lights give it.
   */
  add(sky: Rgb, ground: Rgb): void {
    // A hemisphere of radiance L gives the irradiance π L (1 + cos θ) / 2: three's formula, exactly.
    for (const k of [0, 1, 2] as const) {
      this.above[k] += sky[k] / Math.PI;
      this.below[k] += ground[k] / Math.PI;
    }
  }
}

/** A light of three, and what it has become. */
export interface LightLink {
  readonly object: ThreeObject;
  /** Index in `Scene.lights`. */
  readonly index: number;
}

/**
 * Adds a light of three to the scene.
 *
 * @returns Its place there; `undefined` if it has none: ambient light, what gives no light, and what is no light.
 */
export function readLight(object: ThreeObject, scene: Scene, ambience: Ambience): LightLink | undefined {
  const light = lightOf(object, ambience, (message) =>
    scene.warnings.push({
      code: 'three/light',
      message: `Light "${object.name || String((object as unknown as Loose)['type'])}": ${message}.`,
    }),
  );
  return light && { object, index: scene.lights.push(light) - 1 };
}

/**
 * What a light of three is now.
 *
 * @param ambience Gets ambient light.
 * @param warn Is called with what is not supported.
 */
export function lightOf(
  object: ThreeObject,
  ambience: Ambience,
  warn: (message: string) => void = () => undefined,
): Light | undefined {
  const light = object as unknown as Loose & ThreeObject;
  if (light['isLight'] !== true) return undefined;
  const [color, intensity] = [light['color'] as Color, light['intensity'] as number];
  const name = object.name || (light['type'] as string);
  const m = object.matrixWorld.elements;
  const rgb: Rgb = [color.r, color.g, color.b];
  const position = positionOf(m);
  if (
    light['castShadow'] === false &&
    light['isAmbientLight'] !== true &&
    light['isHemisphereLight'] !== true &&
    light['isRectAreaLight'] !== true &&
    light['isLightProbe'] !== true
  )
    warn('it casts shadows here, as all light does');
  const towards = (): Rgb => {
    const target = light['target'] as ThreeObject | undefined;
    target?.updateMatrixWorld();
    const at = target ? positionOf(target.matrixWorld.elements) : [0, 0, 0];
    const d = [0, 1, 2].map((k) => (at[k] as number) - (position[k] as number));
    const length = Math.hypot(...d);
    return length > 0 ? (d.map((value) => value / length) as Rgb) : [0, -1, 0];
  };
  const fading = () => {
    if ((light['decay'] ?? 2) !== 2)
      warn(`its decay of ${light['decay'] as number} is not supported: light fades with the square of the distance`);
    if (Number(light['distance'] ?? 0) > 0) warn('its distance is not supported: light does not end');
  };
  if (light['isAmbientLight'] === true) ambience.add(scaled(color, intensity), scaled(color, intensity));
  else if (light['isHemisphereLight'] === true)
    ambience.add(scaled(color, intensity), scaled(light['groundColor'] as Color, intensity));
  else if (light['isDirectionalLight'] === true)
    return { type: 'directional', name, color: rgb, intensity, direction: towards() };
  else if (light['isSpotLight'] === true) {
    fading();
    if (light['map']) warn('its map is not supported');
    if (light['iesMap']) warn('its iesMap is not supported: a scene of ours takes measured intensities');
    if (Number(light['radius'] ?? 0) > 0) warn('its radius is not supported: it is a point');
    const outer = Math.min(Math.max(light['angle'] as number, 1e-3), Math.PI / 2);
    const inner = Math.min(outer * (1 - (light['penumbra'] as number)), outer * 0.999);
    return {
      type: 'spot',
      name,
      color: rgb,
      intensity,
      position,
      direction: towards(),
      inner_cone_angle: Math.max(0, inner),
      outer_cone_angle: outer,
    };
  } else if (light['isRectAreaLight'] === true) {
    // three's rectangles emit along their −Z, and have no scale.
    const [x, z] = [axisOf(m, 0), axisOf(m, 2)];
    const [width, height] = [light['width'] as number, light['height'] as number];
    if (!(width > 0 && height > 0)) return undefined;
    const area = { name, color: rgb, intensity, position, direction: z.map((value) => -value) as Rgb };
    if (light['isCircular'] !== true) return { type: 'rectangle', ...area, tangent: x, width, height };
    if (Math.abs(width - height) > 1e-6 * width)
      warn(`its ellipse of ${width} × ${height} is not supported: it is a disk of the same area`);
    return { type: 'disk', ...area, radius: Math.sqrt(width * height) / 2 };
  } else if (light['isPointLight'] === true) {
    fading();
    return { type: 'point', name, color: rgb, intensity, position };
  } else warn(`${light['type'] as string} is not supported`);
  return undefined;
}
