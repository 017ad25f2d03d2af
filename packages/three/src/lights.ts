import type { Scene } from '@glanz/scene';
import { positionOf } from './matrix';
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

/** Adds a light of three to the scene. @returns Whether it was one. */
export function readLight(object: ThreeObject, scene: Scene, ambience: Ambience): boolean {
  const light = object as unknown as Loose & ThreeObject;
  if (light['isLight'] !== true) return false;
  const [color, intensity] = [light['color'] as Color, light['intensity'] as number];
  const name = object.name || (light['type'] as string);
  const warn = (message: string) =>
    void scene.warnings.push({ code: 'three/light', message: `Light "${name}": ${message}.` });
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
    scene.lights.push({ type: 'directional', name, color: rgb, intensity, direction: towards() });
  else if (light['isSpotLight'] === true) {
    fading();
    if (light['map']) warn('its map is not supported');
    const outer = Math.min(Math.max(light['angle'] as number, 1e-3), Math.PI / 2);
    const inner = Math.min(outer * (1 - (light['penumbra'] as number)), outer * 0.999);
    scene.lights.push({
      type: 'spot',
      name,
      color: rgb,
      intensity,
      position,
      direction: towards(),
      inner_cone_angle: Math.max(0, inner),
      outer_cone_angle: outer,
    });
  } else if (light['isRectAreaLight'] === true)
    addRectangle(scene, name, object, scaled(color, intensity), light['width'] as number, light['height'] as number);
  else if (light['isPointLight'] === true) {
    fading();
    scene.lights.push({ type: 'point', name, color: rgb, intensity, position });
  } else warn(`${light['type'] as string} is not supported`);
  return true;
}

/** A rectangle that shines along its −Z from one side: geometry, as all light with size is. */
function addRectangle(
  scene: Scene,
  name: string,
  { matrixWorld }: ThreeObject,
  radiance: Rgb,
  width: number,
  height: number,
): void {
  const strength = Math.max(...radiance);
  if (!(strength > 0)) return;
  const [w, h] = [width / 2, height / 2];
  // Counter-clockwise as seen from −Z.
  scene.meshes.push({
    name,
    positions: Float32Array.of(-w, -h, 0, w, -h, 0, w, h, 0, -w, h, 0),
    indices: Uint32Array.of(0, 2, 1, 0, 3, 2),
  });
  scene.materials.push({
    name,
    parameters: {
      base_weight: 0,
      specular_weight: 0,
      emission_luminance: strength,
      emission_color: radiance.map((value) => value / strength) as Rgb,
    },
  });
  scene.instances.push({
    name,
    mesh: scene.meshes.length - 1,
    material: scene.materials.length - 1,
    transform: Float64Array.from(matrixWorld.elements),
  });
}
