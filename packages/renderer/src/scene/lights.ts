import { resolveParameters } from '@glanz/openpbr';
import type { Instance, Light, LightProfile, Material, Mesh, Scene } from '@glanz/scene';
import { GROUP_SHIFT, LIGHT_MIRRORED, LIGHT_NODE_DISTANT, LIGHT_NODE_LEAF, LIGHT_TRIANGLE, LIGHT_TWO_SIDED, lightStruct, NONE } from '../kernels/layout';
import { buildAliasTable } from './alias-table';
import { EmissionEstimate } from './emission';
import type { LightGroupTable } from './light-groups';
import { buildLightTree, type LightTree, type TreeLights } from './light-tree';
import { profileGrid, profileRecords, writeProfile, type ProfileGrid } from './light-profile';
import { hasSize, writeLight } from './light-records';
import { emittedRadiance } from './materials';
import { determinant3, transformPoint } from './matrix';

/** How the lights are chosen from, see `PathTracerOptions.lightSampling`. */
export type LightSampling = 'tree' | 'power';

/** All lights but the environment, ready for the GPU. */
export interface LightTable {
  /** Light records, behind them the nodes of the tree, then the profiles of lamps; at least one, so that the buffer is never empty. */
  readonly records: ArrayBuffer;
  readonly count: number;
  /** Whether some of them shine by a profile. */
  readonly profiles: boolean;
  /** Whether there is a tree; its root follows the last light. */
  readonly tree: boolean;
  /** The lights with a size of their own: where their records begin, and how many there are. */
  readonly firstArea: number;
  readonly areaCount: number;
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
 * Collects emissive triangles and the scene's lights into one table: triangles, lights with a size, lights without.
 *
 * @param sceneRadius Radius of the scene's bounding sphere, metres, to weigh directional lights.
 * @param groups Which light group each belongs to.
 * @param sampling Whether a tree is built over them.
 */
export function buildLightTable(scene: Scene, geometry: LightGeometry, sceneRadius: number, groups: LightGroupTable, sampling: LightSampling): LightTable {
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
  const firstArea = count;
  const areas = scene.lights.filter(hasSize);
  const others = scene.lights.filter((light) => !hasSize(light));
  count += scene.lights.length;
  const weights = new Float64Array(count);
  const bounds: TreeLights = { bounds: new Float64Array(6 * count), axes: new Float64Array(3 * count), spreads: new Float64Array(count), reaches: new Float64Array(count), energies: new Float64Array(count) };
  const profiles = layProfiles(others);
  const lights = lightStruct.allocate(Math.max(count, 1));
  for (const { instance, slot, base } of emitters) writeTriangles(lights, weights, bounds, scene, instance, slot, base, geometry, groups);
  [...areas, ...others].forEach((light, i) => (weights[firstArea + i] = writeLight(lights, bounds, firstArea + i, light, sceneRadius, groups.light(light) << GROUP_SHIFT, light.type === 'profile' ? profiles.get(light.profile) : undefined)));
  const table = buildAliasTable(weights);
  if (!table) return { records: lights, count: 0, profiles: false, tree: false, firstArea: 0, areaCount: 0, firstLight: firstLight.fill(NONE), power: 0 };
  const words = lightStruct.size / 4;
  const floats = new Float32Array(lights);
  const integers = new Uint32Array(lights);
  const [probability, alias, keep] = [lightStruct.offsetOf('probability') / 4, lightStruct.offsetOf('other') / 4, lightStruct.offsetOf('keep') / 4];
  for (let i = 0; i < count; i++) {
    floats[i * words + probability] = table.probability[i] as number;
    integers[i * words + alias] = table.alias[i] as number;
    floats[i * words + keep] = table.keep[i] as number;
  }
  const shining = [...weights.keys()].filter((i) => (weights[i] as number) > 0);
  const isDistant = (i: number) => i >= firstArea + areas.length && others[i - firstArea - areas.length]?.type === 'directional';
  const tree = sampling === 'tree' ? buildLightTree(bounds, shining.filter((i) => !isDistant(i)), shining.filter(isDistant)) : undefined;
  if (tree) tree.trails.forEach((trail, i) => (integers[i * words + alias] = trail));
  const records = withProfiles(tree ? withNodes(lights, count, tree) : lights, profiles, others.flatMap((light, i) => (light.type === 'profile' ? [firstArea + areas.length + i] : [])));
  return { records, count, profiles: profiles.size > 0, tree: tree !== undefined, firstArea, areaCount: areas.length, firstLight, power: weights.reduce((sum, w) => sum + w, 0) };
}

type Profiles = ReadonlyMap<LightProfile, { readonly grid: ProfileGrid; readonly first: number }>;

/** The profiles of lights, one after the other; lights of one kind share theirs. */
function layProfiles(lights: readonly Light[]): Profiles {
  let first = 0;
  const profiles = new Map<LightProfile, { grid: ProfileGrid; first: number }>();
  for (const light of lights) {
    if (light.type !== 'profile' || profiles.has(light.profile)) continue;
    const grid = profileGrid(light.profile);
    profiles.set(light.profile, { grid, first });
    first += profileRecords(grid);
  }
  return profiles;
}

/** The records with the profiles behind them; `users` have counted from the first one's beginning. */
function withProfiles(before: ArrayBuffer, profiles: Profiles, users: readonly number[]): ArrayBuffer {
  if (users.length === 0) return before;
  const count = before.byteLength / lightStruct.size;
  const records = lightStruct.allocate([...profiles.values()].reduce((sum, { grid }) => sum + profileRecords(grid), count));
  new Uint8Array(records).set(new Uint8Array(before));
  for (const { grid, first } of profiles.values()) writeProfile(records, count + first, grid);
  const integers = new Uint32Array(records);
  for (const light of users) (integers[(light * lightStruct.size + lightStruct.offsetOf('ids')) / 4] as number) += count;
  return records;
}

/** The light records with the nodes of the tree behind them. */
function withNodes(lights: ArrayBuffer, count: number, { nodes }: LightTree): ArrayBuffer {
  const records = lightStruct.allocate(count + nodes.length);
  new Uint8Array(records).set(new Uint8Array(lights));
  nodes.forEach(({ center, radius, axis, cosSpread, cosReach, energy, distant, light, child }, i) => {
    lightStruct.write(records, count + i, {
      a: center,
      kind: (light === undefined ? 0 : LIGHT_NODE_LEAF) | (distant ? LIGHT_NODE_DISTANT : 0),
      b: axis,
      probability: radius,
      c: [cosSpread, cosReach, energy],
      other: light ?? count + (child as number),
    });
  });
  return records;
}

function writeTriangles(records: ArrayBuffer, weights: Float64Array, bounds: TreeLights, scene: Scene, index: number, slot: number, base: number, geometry: LightGeometry, groups: LightGroupTable): void {
  const instance = scene.instances[index] as Instance;
  const mesh = scene.meshes[instance.mesh] as Mesh;
  const material = scene.materials[instance.material] as Material;
  const radiance = luminance(emittedRadiance(resolveParameters(material.parameters)));
  const sides = material.double_sided ? 2 : 1;
  const mirrored = determinant3(instance.transform) < 0 ? -1 : 1;
  const kind = LIGHT_TRIANGLE | (material.double_sided ? LIGHT_TWO_SIDED : 0) | (mirrored < 0 ? LIGHT_MIRRORED : 0) | (groups.material(material) << GROUP_SHIFT);
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
    const [ax, ay, az] = [0, 1, 2].map((k) => (p[3 + k] as number) - (p[k] as number)) as [number, number, number];
    const [bx, by, bz] = [0, 1, 2].map((k) => (p[6 + k] as number) - (p[k] as number)) as [number, number, number];
    const normal = [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx] as const;
    const length = Math.hypot(...normal);
    const area = 0.5 * length;
    const texel = estimate && uvs ? estimate.mean([0, 1, 2].flatMap((k) => [uvs[2 * corner(k)] as number, uvs[2 * corner(k) + 1] as number]) as [number, number, number, number, number, number]) : 1;
    const power = Math.PI * area * radiance * sides * texel;
    if (!(Number.isFinite(power) && power > 0)) continue;
    const i = base + triangle;
    weights[i] = power;
    bounds.energies[i] = area * radiance * texel;
    bounds.spreads[i] = sides === 2 ? Math.PI : 0;
    bounds.reaches[i] = Math.PI / 2;
    for (let k = 0; k < 3; k++) {
      bounds.axes[3 * i + k] = (mirrored * (normal[k] as number)) / length;
      bounds.bounds[6 * i + k] = Math.min(p[k] as number, p[3 + k] as number, p[6 + k] as number);
      bounds.bounds[6 * i + 3 + k] = Math.max(p[k] as number, p[3 + k] as number, p[6 + k] as number);
    }
  }
}
