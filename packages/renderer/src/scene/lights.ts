import { resolveParameters } from '@glanz/openpbr';
import type { Instance, Light, Material, Mesh, Scene } from '@glanz/scene';
import { LIGHT_DIRECTIONAL, LIGHT_MIRRORED, LIGHT_POINT, LIGHT_SPOT, LIGHT_TRIANGLE, LIGHT_TWO_SIDED, GROUP_SHIFT, lightStruct, NONE } from '../kernels/layout';
import { buildAliasTable } from './alias-table';
import { EmissionEstimate } from './emission';
import type { LightGroupTable } from './light-groups';
import { emittedRadiance } from './materials';
import { determinant3, transformPoint } from './matrix';

/** All lights but the environment, ready for the GPU. */
export interface LightTable {
  /** Light records; at least one, so that the buffer is never empty. */
  readonly records: ArrayBuffer;
  readonly count: number;
  /** For each instance of the scene: index of the light of its triangle 0, or NONE. */
  readonly firstLight: Uint32Array;
  /** Estimated power of all of them. */
  readonly power: number;
}

/** How the geometry refers to instances and triangles on the GPU. */
export interface LightGeometry {
  /** Scene instance → record in the instance buffer, or NONE for an invisible one. */
  readonly instanceSlots: Uint32Array;
  /** Mesh index → input triangle → absolute leaf-order triangle. */
  readonly leafTriangle: (mesh: number, triangle: number) => number;
}

const luminance = (c: ArrayLike<number>) => 0.2126 * (c[0] as number) + 0.7152 * (c[1] as number) + 0.0722 * (c[2] as number);

/**
 * Collects emissive triangles and lights without size into one table, weighted by power.
 *
 * @param sceneRadius Radius of the scene's bounding sphere, metres, to weigh directional lights.
 * @param groups Which light group each belongs to.
 */
export function buildLightTable(scene: Scene, geometry: LightGeometry, sceneRadius: number, groups: LightGroupTable): LightTable {
  const firstLight = new Uint32Array(scene.instances.length).fill(NONE);
  const emitters: { instance: number; slot: number; base: number }[] = [];
  let count = 0;
  scene.instances.forEach((instance, index) => {
    const slot = geometry.instanceSlots[index] as number;
    const material = scene.materials[instance.material] as Material;
    if (slot === NONE || luminance(emittedRadiance(resolveParameters(material.parameters))) <= 0) return;
    firstLight[index] = count;
    emitters.push({ instance: index, slot, base: count });
    count += (scene.meshes[instance.mesh] as Mesh).indices.length / 3;
  });
  const punctual = count;
  count += scene.lights.length;
  const records = lightStruct.allocate(Math.max(count, 1));
  const weights = new Float64Array(count);
  for (const { instance, slot, base } of emitters) writeTriangles(records, weights, scene, instance, slot, base, geometry, groups);
  scene.lights.forEach((light, i) => (weights[punctual + i] = writeLight(records, punctual + i, light, sceneRadius, groups.light(light) << GROUP_SHIFT)));
  const table = buildAliasTable(weights);
  if (!table) return { records, count: 0, firstLight: firstLight.fill(NONE), power: 0 };
  const words = lightStruct.size / 4;
  const floats = new Float32Array(records);
  const integers = new Uint32Array(records);
  const [probability, alias, keep] = [lightStruct.offsetOf('probability') / 4, lightStruct.offsetOf('other') / 4, lightStruct.offsetOf('keep') / 4];
  for (let i = 0; i < count; i++) {
    floats[i * words + probability] = table.probability[i] as number;
    integers[i * words + alias] = table.alias[i] as number;
    floats[i * words + keep] = table.keep[i] as number;
  }
  return { records, count, firstLight, power: weights.reduce((sum, w) => sum + w, 0) };
}

function writeTriangles(records: ArrayBuffer, weights: Float64Array, scene: Scene, index: number, slot: number, base: number, geometry: LightGeometry, groups: LightGroupTable): void {
  const instance = scene.instances[index] as Instance;
  const mesh = scene.meshes[instance.mesh] as Mesh;
  const material = scene.materials[instance.material] as Material;
  const radiance = luminance(emittedRadiance(resolveParameters(material.parameters)));
  const sides = material.double_sided ? 2 : 1;
  const kind = LIGHT_TRIANGLE | (material.double_sided ? LIGHT_TWO_SIDED : 0) | (determinant3(instance.transform) < 0 ? LIGHT_MIRRORED : 0) | (groups.material(material) << GROUP_SHIFT);
  const binding = material.textures?.emission_color;
  const estimate = binding ? new EmissionEstimate(scene, binding) : undefined;
  const uvs = binding ? mesh.uvs?.[binding.uv ?? 0] : undefined;
  const floats = new Float32Array(records);
  const integers = new Uint32Array(records);
  const words = lightStruct.size / 4;
  const at = { a: lightStruct.offsetOf('a') / 4, b: lightStruct.offsetOf('b') / 4, c: lightStruct.offsetOf('c') / 4, kind: lightStruct.offsetOf('kind') / 4, ids: lightStruct.offsetOf('ids') / 4 };
  const p = new Float64Array(9);
  for (let triangle = 0; triangle < mesh.indices.length / 3; triangle++) {
    const corner = (k: number) => mesh.indices[3 * triangle + k] as number;
    for (let k = 0; k < 3; k++) transformPoint(instance.transform, mesh.positions[3 * corner(k)] as number, mesh.positions[3 * corner(k) + 1] as number, mesh.positions[3 * corner(k) + 2] as number, p, 3 * k);
    const row = (base + triangle) * words;
    for (let k = 0; k < 3; k++) {
      floats[row + at.a + k] = p[k] as number;
      floats[row + at.b + k] = p[3 + k] as number;
      floats[row + at.c + k] = p[6 + k] as number;
    }
    integers[row + at.kind] = kind;
    integers[row + at.ids] = slot;
    integers[row + at.ids + 1] = geometry.leafTriangle(instance.mesh, triangle);
    integers[row + at.ids + 2] = instance.material;
    const e1 = [0, 1, 2].map((k) => (p[3 + k] as number) - (p[k] as number));
    const e2 = [0, 1, 2].map((k) => (p[6 + k] as number) - (p[k] as number));
    const area = 0.5 * Math.hypot((e1[1] as number) * (e2[2] as number) - (e1[2] as number) * (e2[1] as number), (e1[2] as number) * (e2[0] as number) - (e1[0] as number) * (e2[2] as number), (e1[0] as number) * (e2[1] as number) - (e1[1] as number) * (e2[0] as number));
    const texel = estimate && uvs ? estimate.mean([0, 1, 2].flatMap((k) => [uvs[2 * corner(k)] as number, uvs[2 * corner(k) + 1] as number]) as [number, number, number, number, number, number]) : 1;
    const power = Math.PI * area * radiance * sides * texel;
    weights[base + triangle] = Number.isFinite(power) ? power : 0;
  }
}

/** Writes a light without size and returns its weight. */
function writeLight(records: ArrayBuffer, index: number, light: Light, sceneRadius: number, group: number): number {
  const color = light.color.map((c) => c * light.intensity);
  const ids = [NONE, NONE, NONE, NONE];
  const power = luminance(color);
  switch (light.type) {
    case 'directional':
      lightStruct.write(records, index, { kind: LIGHT_DIRECTIONAL | group, b: light.direction, color, ids });
      return power * Math.PI * sceneRadius * sceneRadius;
    case 'point':
      lightStruct.write(records, index, { kind: LIGHT_POINT | group, a: light.position, color, ids });
      return power * 4 * Math.PI;
    case 'spot': {
      const outer = Math.cos(light.outer_cone_angle);
      const scale = 1 / Math.max(1e-3, Math.cos(light.inner_cone_angle) - outer);
      lightStruct.write(records, index, { kind: LIGHT_SPOT | group, a: light.position, b: light.direction, c: [scale, -outer * scale, 0], color, ids });
      return power * 2 * Math.PI * (1 - outer);
    }
  }
}
