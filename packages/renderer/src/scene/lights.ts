import type { Instance, Light, LightProfile, Material, Mesh, Scene } from '@glanz/scene';
import { GROUP_SHIFT, LIGHT_MIRRORED, LIGHT_NODE_DISTANT, LIGHT_NODE_LEAF, LIGHT_TRIANGLE, LIGHT_TWO_SIDED, lightStruct, NONE } from '../kernels/layout';
import { buildAliasTable, type AliasTable } from './alias-table';
import { EmissionEstimate } from './emission';
import type { LightGroupTable } from './light-groups';
import { buildLightTree, LIGHT_TREE_DISTANT, LIGHT_TREE_LEAF, LIGHT_TREE_NODE, type LightTree, type TreeLights } from './light-tree';
import { profileGrid, profileRecords, writeProfile, type ProfileGrid } from './light-profile';
import { hasSize, writeLight } from './light-records';
import { emittedRadiance } from './materials';
import { determinant3, transformPoint } from './matrix';
import { parametersOf } from './parameters';

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

/** The table of a scene without lights, or before they are known. */
export const noLights = ({ instances }: Scene): LightTable => ({ records: lightStruct.allocate(), count: 0, profiles: false, tree: false, firstArea: 0, areaCount: 0, firstLight: new Uint32Array(instances.length).fill(NONE), power: 0 });

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
    if (slot === NONE || luminance(emittedRadiance(parametersOf(material))) <= 0) return;
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
  if (!table) return noLights(scene);
  const isDistant = (i: number) => i >= firstArea + areas.length && others[i - firstArea - areas.length]?.type === 'directional';
  const tree = sampling === 'tree' ? treeOf(bounds, weights, isDistant) : undefined;
  writeChances(lights, table, tree);
  const records = withProfiles(tree ? withNodes(lights, count, tree) : lights, profiles, others.flatMap((light, i) => (light.type === 'profile' ? [firstArea + areas.length + i] : [])));
  return { records, count, profiles: profiles.size > 0, tree: tree !== undefined, firstArea, areaCount: areas.length, firstLight, power: sumOf(weights) };
}

function sumOf(values: Float64Array): number {
  let sum = 0;
  for (let i = 0; i < values.length; i++) sum += values[i] as number;
  return sum;
}

/** The tree over the lights that shine. */
function treeOf(bounds: TreeLights, weights: Float64Array, isDistant: (light: number) => boolean): LightTree {
  const near: number[] = [];
  const distant: number[] = [];
  for (let i = 0; i < weights.length; i++) if ((weights[i] as number) > 0) (isDistant(i) ? distant : near).push(i);
  return buildLightTree(bounds, near, distant);
}

/** Writes how likely each light is without a tree, and the way to it in one. */
function writeChances(lights: ArrayBuffer, { probability, alias, keep }: AliasTable, tree: LightTree | undefined): void {
  const floats = new Float32Array(lights);
  const integers = new Uint32Array(lights);
  const others = tree?.trails ?? alias;
  const words = lightStruct.size / 4;
  const at = { probability: wordOf('probability'), other: wordOf('other'), keep: wordOf('keep') };
  for (let i = 0, row = 0; i < others.length; i++, row += words) {
    floats[row + at.probability] = probability[i] as number;
    integers[row + at.other] = others[i] as number;
    floats[row + at.keep] = keep[i] as number;
  }
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

/** Where a field of a light record lies, in words. */
const wordOf = (field: Parameters<typeof lightStruct.offsetOf>[0]): number => lightStruct.offsetOf(field) / 4;

/** The light records with the nodes of the tree behind them. Written word by word: thousands of them, while nothing is compiled yet. */
function withNodes(lights: ArrayBuffer, count: number, { count: nodes, values, kinds, links }: LightTree): ArrayBuffer {
  const records = lightStruct.allocate(count + nodes);
  new Uint8Array(records).set(new Uint8Array(lights));
  const floats = new Float32Array(records);
  const integers = new Uint32Array(records);
  const words = lightStruct.size / 4;
  const at = { a: wordOf('a'), kind: wordOf('kind'), b: wordOf('b'), probability: wordOf('probability'), c: wordOf('c'), other: wordOf('other') };
  const { center, radius, axis, cosSpread, cosReach, energy, stride } = LIGHT_TREE_NODE;
  for (let i = 0, row = count * words, from = 0; i < nodes; i++, row += words, from += stride) {
    const kind = kinds[i] as number;
    for (let k = 0; k < 3; k++) {
      floats[row + at.a + k] = values[from + center + k] as number;
      floats[row + at.b + k] = values[from + axis + k] as number;
    }
    floats[row + at.probability] = values[from + radius] as number;
    floats[row + at.c] = values[from + cosSpread] as number;
    floats[row + at.c + 1] = values[from + cosReach] as number;
    floats[row + at.c + 2] = values[from + energy] as number;
    integers[row + at.kind] = (kind & LIGHT_TREE_LEAF ? LIGHT_NODE_LEAF : 0) | (kind & LIGHT_TREE_DISTANT ? LIGHT_NODE_DISTANT : 0);
    integers[row + at.other] = (links[i] as number) + (kind & LIGHT_TREE_LEAF ? 0 : count);
  }
  return records;
}

function writeTriangles(records: ArrayBuffer, weights: Float64Array, bounds: TreeLights, scene: Scene, index: number, slot: number, base: number, geometry: LightGeometry, groups: LightGroupTable): void {
  const instance = scene.instances[index] as Instance;
  const mesh = scene.meshes[instance.mesh] as Mesh;
  const material = scene.materials[instance.material] as Material;
  const radiance = luminance(emittedRadiance(parametersOf(material)));
  const sides = material.double_sided ? 2 : 1;
  const mirrored = determinant3(instance.transform) < 0 ? -1 : 1;
  const kind = LIGHT_TRIANGLE | (material.double_sided ? LIGHT_TWO_SIDED : 0) | (mirrored < 0 ? LIGHT_MIRRORED : 0) | (groups.material(material) << GROUP_SHIFT);
  const binding = material.textures?.emission_color;
  const estimate = binding ? new EmissionEstimate(scene, binding) : undefined;
  const uvs = binding ? mesh.uvs?.[binding.uv ?? 0] : undefined;
  const floats = new Float32Array(records);
  const integers = new Uint32Array(records);
  const words = lightStruct.size / 4;
  const at = { a: wordOf('a'), b: wordOf('b'), c: wordOf('c'), kind: wordOf('kind'), ids: wordOf('ids') };
  const p = new Float64Array(9);
  // Whatever kind of list it is, the loop's machine code sees one.
  const transform = Float64Array.from(instance.transform);
  const { positions, indices } = mesh;
  // No functions and no lists within: thousands of triangles, while nothing is compiled yet.
  for (let triangle = 0; triangle < indices.length / 3; triangle++) {
    const row = (base + triangle) * words;
    for (let k = 0; k < 3; k++) {
      const vertex = 3 * (indices[3 * triangle + k] as number);
      transformPoint(transform, positions[vertex] as number, positions[vertex + 1] as number, positions[vertex + 2] as number, p, 3 * k);
    }
    for (let k = 0; k < 3; k++) {
      floats[row + at.a + k] = p[k] as number;
      floats[row + at.b + k] = p[3 + k] as number;
      floats[row + at.c + k] = p[6 + k] as number;
    }
    integers[row + at.kind] = kind;
    integers[row + at.ids] = slot;
    integers[row + at.ids + 1] = geometry.leafTriangle(instance.mesh, triangle);
    integers[row + at.ids + 2] = instance.material;
    const ax = (p[3] as number) - (p[0] as number), ay = (p[4] as number) - (p[1] as number), az = (p[5] as number) - (p[2] as number);
    const bx = (p[6] as number) - (p[0] as number), by = (p[7] as number) - (p[1] as number), bz = (p[8] as number) - (p[2] as number);
    const nx = ay * bz - az * by, ny = az * bx - ax * bz, nz = ax * by - ay * bx;
    const length = Math.hypot(nx, ny, nz);
    const area = 0.5 * length;
    const texel = estimate && uvs ? estimate.mean(cornersOf(uvs, indices, triangle)) : 1;
    const power = Math.PI * area * radiance * sides * texel;
    if (!(Number.isFinite(power) && power > 0)) continue;
    const i = base + triangle;
    weights[i] = power;
    bounds.energies[i] = area * radiance * texel;
    bounds.spreads[i] = sides === 2 ? Math.PI : 0;
    bounds.reaches[i] = Math.PI / 2;
    bounds.axes[3 * i] = (mirrored * nx) / length;
    bounds.axes[3 * i + 1] = (mirrored * ny) / length;
    bounds.axes[3 * i + 2] = (mirrored * nz) / length;
    for (let k = 0; k < 3; k++) {
      bounds.bounds[6 * i + k] = Math.min(p[k] as number, p[3 + k] as number, p[6 + k] as number);
      bounds.bounds[6 * i + 3 + k] = Math.max(p[k] as number, p[3 + k] as number, p[6 + k] as number);
    }
  }
}

/** The texture coordinates of a triangle's corners. */
const cornersOf = (uvs: Float32Array, indices: Uint32Array, triangle: number) =>
  [0, 1, 2].flatMap((k) => {
    const vertex = indices[3 * triangle + k] as number;
    return [uvs[2 * vertex] as number, uvs[2 * vertex + 1] as number];
  }) as [number, number, number, number, number, number];
