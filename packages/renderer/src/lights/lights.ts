import {
  finish,
  type Instance,
  type Light,
  type LightProfile,
  type Material,
  type Mesh,
  type Scene,
  type Steps,
} from '@glanz/scene';
import { GROUP_SHIFT, LIGHT_NODE_DISTANT, LIGHT_NODE_LEAF, lightStruct, NONE } from '../storage/layout';
import { buildAliasTable, type AliasTable } from './alias-table';
import type { TreeLights } from './light-bounds';
import type { LightGroupTable } from './light-groups';
import { nameLights, type LightIds } from './light-ids';
import { profileGrid, profileRecords, writeProfile, type ProfileGrid } from './light-profile';
import { hasSize, luminance, wordOf, writeLight } from './light-records';
import { LIGHT_TREE_DISTANT, LIGHT_TREE_LEAF, LIGHT_TREE_NODE, lightTreeSteps, type LightTree } from './light-tree';
import { nameTriangles, triangleSteps } from './light-triangles';
import { emittedRadiance } from '../materials/materials';
import { parametersOf } from '../materials/parameters';

/** How the lights are chosen from, see `PathTracerOptions.lightSampling`. */
export type LightSampling = 'tree' | 'power';

/** All lights but the environment, ready for the GPU. */
export interface LightTable {
  /**
   * Light records, behind them the nodes of the tree, then the profiles of lamps; at least one, so that the buffer is
   * never empty.
   */
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
  /** Of a mesh: input triangle → absolute leaf-order triangle. */
  readonly leafTriangles: (mesh: number) => Uint32Array;
}

/** The table of a scene without lights, or before they are known. */
export const noLights = ({ instances }: Scene): LightTable => ({
  records: lightStruct.allocate(),
  count: 0,
  profiles: false,
  tree: false,
  firstArea: 0,
  areaCount: 0,
  firstLight: new Uint32Array(instances.length).fill(NONE),
  power: 0,
});

/** A glowing instance: its triangles' records begin at `base`. */
interface Emitter {
  readonly instance: number;
  readonly base: number;
  readonly triangles: number;
}

/** What follows from the lights before shapes have their places; {@link placingSteps} adds the rest. */
export interface GatheredLights {
  /** As `LightTable.records`, without what names shapes, and without chances. */
  readonly records: ArrayBuffer;
  readonly count: number;
  readonly profiles: boolean;
  readonly tree: LightTree | undefined;
  readonly firstArea: number;
  readonly areaCount: number;
  readonly firstLight: Uint32Array;
  readonly emitters: readonly Emitter[];
  /** Power of each; of directional lights for a scene with a radius of 1. */
  readonly weights: Float64Array;
  readonly directional: readonly number[];
}

/**
 * Collects emissive triangles and the scene's lights: triangles, lights with a size, lights without.
 *
 * @param shows Whether a scene's instance is there to be seen.
 * @param groups Which light group each belongs to.
 * @param sampling Whether a tree is built over them.
 */
export function* lightSteps(
  scene: Scene,
  shows: (instance: number) => boolean,
  groups: LightGroupTable,
  sampling: LightSampling,
): Steps<GatheredLights> {
  const firstLight = new Uint32Array(scene.instances.length).fill(NONE);
  const emitters: Emitter[] = [];
  let count = 0;
  const glows = scene.materials.map((material: Material) => luminance(emittedRadiance(parametersOf(material))) > 0);
  scene.instances.forEach((instance, index) => {
    if (!glows[instance.material] || !shows(index)) return;
    const triangles = (scene.meshes[instance.mesh] as Mesh).indices.length / 3;
    firstLight[index] = count;
    emitters.push({ instance: index, base: count, triangles });
    count += triangles;
  });
  const firstArea = count;
  const areas = scene.lights.filter(hasSize);
  const others = scene.lights.filter((light) => !hasSize(light));
  count += scene.lights.length;
  const weights = new Float64Array(count);
  const bounds: TreeLights = {
    bounds: new Float64Array(6 * count),
    axes: new Float64Array(3 * count),
    spreads: new Float64Array(count),
    reaches: new Float64Array(count),
    energies: new Float64Array(count),
  };
  const profiles = layProfiles(others);
  const lights = lightStruct.allocate(Math.max(count, 1));
  for (const { instance, base } of emitters)
    yield* triangleSteps(lights, weights, bounds, scene, instance, base, groups);
  [...areas, ...others].forEach(
    (light, i) =>
      (weights[firstArea + i] = writeLight(
        lights,
        bounds,
        firstArea + i,
        light,
        1,
        groups.light(light) << GROUP_SHIFT,
        light.type === 'profile' ? profiles.get(light.profile) : undefined,
      )),
  );
  const firstOther = firstArea + areas.length;
  const placesOf = (type: Light['type']) => others.flatMap((light, i) => (light.type === type ? [firstOther + i] : []));
  const directional = placesOf('directional');
  yield;
  const tree = sampling === 'tree' ? yield* treeOf(bounds, weights, new Set(directional)) : undefined;
  const records = withProfiles(tree ? yield* withNodes(lights, count, tree) : lights, profiles, placesOf('profile'));
  return {
    records,
    count,
    profiles: profiles.size > 0,
    tree,
    firstArea,
    areaCount: areas.length,
    firstLight,
    emitters,
    weights,
    directional,
  };
}

/**
 * Builds the table, in place.
 *
 * @param sceneRadius Radius of the scene's bounding sphere, metres, to weigh directional lights.
 * @param ids Keeps the ids it has given for the next table.
 * @returns Undefined where an emitter has no place after all: gather the lights again without it.
 */
export function* placingSteps(
  scene: Scene,
  lights: GatheredLights,
  geometry: LightGeometry,
  sceneRadius: number,
  ids: LightIds,
): Steps<LightTable | undefined> {
  const { records, count, profiles, tree, firstArea, areaCount, firstLight, emitters, weights, directional } = lights;
  if (emitters.some(({ instance }) => geometry.instanceSlots[instance] === NONE)) return undefined;
  for (const i of directional) (weights[i] as number) *= sceneRadius * sceneRadius;
  const table = buildAliasTable(weights);
  if (!table) return noLights(scene);
  yield;
  ids.begin(count);
  for (const { instance, base, triangles } of emitters) {
    nameTriangles(
      records,
      base,
      triangles,
      geometry.instanceSlots[instance] as number,
      geometry.leafTriangles((scene.instances[instance] as Instance).mesh),
      ids.ofTriangles(instance, triangles),
    );
    yield;
  }
  nameLights(records, scene.lights, firstArea, areaCount, ids);
  writeChances(records, table, tree);
  yield;
  return {
    records,
    count,
    profiles,
    tree: tree !== undefined,
    firstArea,
    areaCount,
    firstLight,
    power: sumOf(weights),
  };
}

/** The table in one go. */
export function buildLightTable(
  scene: Scene,
  geometry: LightGeometry,
  sceneRadius: number,
  groups: LightGroupTable,
  sampling: LightSampling,
  ids: LightIds,
): LightTable {
  const lights = finish(lightSteps(scene, (instance) => geometry.instanceSlots[instance] !== NONE, groups, sampling));
  return finish(placingSteps(scene, lights, geometry, sceneRadius, ids)) as LightTable;
}

function sumOf(values: Float64Array): number {
  let sum = 0;
  for (let i = 0; i < values.length; i++) sum += values[i] as number;
  return sum;
}

/** The tree over the lights that shine, if any does. */
function* treeOf(
  bounds: TreeLights,
  weights: Float64Array,
  directional: ReadonlySet<number>,
): Steps<LightTree | undefined> {
  const near: number[] = [];
  const distant: number[] = [];
  for (let i = 0; i < weights.length; i++)
    if ((weights[i] as number) > 0) (directional.has(i) ? distant : near).push(i);
  return near.length + distant.length > 0 ? yield* lightTreeSteps(bounds, near, distant) : undefined;
}

/** Writes how likely each light is without a tree, and the way to it in one. */
function writeChances(
  lights: ArrayBuffer,
  { probability, alias, keep }: AliasTable,
  tree: LightTree | undefined,
): void {
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
  const records = lightStruct.allocate(
    [...profiles.values()].reduce((sum, { grid }) => sum + profileRecords(grid), count),
  );
  new Uint8Array(records).set(new Uint8Array(before));
  for (const { grid, first } of profiles.values()) writeProfile(records, count + first, grid);
  const integers = new Uint32Array(records);
  for (const light of users)
    (integers[(light * lightStruct.size + lightStruct.offsetOf('ids')) / 4] as number) += count;
  return records;
}

/** Nodes that are written between two stops. */
const STEP_NODES = 4096;

/** The light records with the nodes of the tree behind them. */
function* withNodes(lights: ArrayBuffer, count: number, tree: LightTree): Steps<ArrayBuffer> {
  const records = lightStruct.allocate(count + tree.count);
  new Uint8Array(records).set(new Uint8Array(lights));
  for (let first = 0; first < tree.count; first += STEP_NODES) {
    yield;
    writeNodes(records, count, tree, first, Math.min(tree.count, first + STEP_NODES));
  }
  return records;
}

/** Writes nodes behind `count` lights. Word by word: thousands of them, while nothing is compiled yet. */
function writeNodes(
  records: ArrayBuffer,
  count: number,
  { values, kinds, links }: LightTree,
  first: number,
  end: number,
): void {
  const floats = new Float32Array(records);
  const integers = new Uint32Array(records);
  const words = lightStruct.size / 4;
  const at = {
    a: wordOf('a'),
    kind: wordOf('kind'),
    b: wordOf('b'),
    probability: wordOf('probability'),
    c: wordOf('c'),
    other: wordOf('other'),
  };
  const { center, radius, axis, cosSpread, cosReach, energy, stride } = LIGHT_TREE_NODE;
  for (
    let i = first, row = (count + first) * words, from = first * stride;
    i < end;
    i++, row += words, from += stride
  ) {
    const kind = kinds[i] as number;
    for (let k = 0; k < 3; k++) {
      floats[row + at.a + k] = values[from + center + k] as number;
      floats[row + at.b + k] = values[from + axis + k] as number;
    }
    floats[row + at.probability] = values[from + radius] as number;
    floats[row + at.c] = values[from + cosSpread] as number;
    floats[row + at.c + 1] = values[from + cosReach] as number;
    floats[row + at.c + 2] = values[from + energy] as number;
    integers[row + at.kind] =
      (kind & LIGHT_TREE_LEAF ? LIGHT_NODE_LEAF : 0) | (kind & LIGHT_TREE_DISTANT ? LIGHT_NODE_DISTANT : 0);
    integers[row + at.other] = (links[i] as number) + (kind & LIGHT_TREE_LEAF ? 0 : count);
  }
}
