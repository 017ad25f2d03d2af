import type { Light, Material, Scene } from '@glanz/scene';
import { RenderError } from '../errors';
import { MAX_LIGHT_GROUPS } from '../storage/resources';
import type { LightGroupMode } from '../options';
import { emittedRadiance } from '../materials/materials';
import { parametersOf } from '../materials/parameters';

/** The group of everything that names none. */
const REST = 'rest';

/** The light groups of a scene: names, and which light belongs where. */
export interface LightGroupTable {
  /** One at least. */
  readonly names: readonly string[];
  /** Index of the group of the environment. */
  readonly environment: number;
  light(light: Light): number;
  material(material: Material): number;
}

const shines = (material: Material) => emittedRadiance(parametersOf(material)).some((c) => c > 0);

/**
 * Sorts a scene's lights into groups.
 *
 * @throws {RenderError} `renderer/light-groups` if there are more than the kernels can keep apart.
 */
export function lightGroupTable(scene: Scene, mode: LightGroupMode): LightGroupTable {
  const nameOf = (own: string | undefined, each: string) =>
    mode === 'off' ? REST : (own ?? (mode === 'each' ? each : REST));
  const environmentName = nameOf(scene.environment?.light_group, 'environment');
  const lightName = (light: Light) => nameOf(light.light_group, light.name);
  const materialName = (material: Material) => nameOf(material.light_group, material.name);
  // In the order in which instances first use them.
  const emitters: Material[] = [];
  const seen = new Uint8Array(scene.materials.length);
  for (const { material: index } of scene.instances) {
    if (seen[index]) continue;
    seen[index] = 1;
    const material = scene.materials[index] as Material;
    if (shines(material)) emitters.push(material);
  }
  const names = [
    ...new Set([
      ...(scene.environment ? [environmentName] : []),
      ...scene.lights.map(lightName),
      ...emitters.map(materialName),
    ]),
  ];
  if (names.length === 0) names.push(REST);
  if (names.length > MAX_LIGHT_GROUPS) {
    throw new RenderError(
      'renderer/light-groups',
      `There are ${names.length} light groups; at most ${MAX_LIGHT_GROUPS} can be kept apart.`,
    );
  }
  const index = (name: string) => Math.max(names.indexOf(name), 0);
  return {
    names,
    environment: index(environmentName),
    light: (light) => index(lightName(light)),
    material: (material) => index(materialName(material)),
  };
}
