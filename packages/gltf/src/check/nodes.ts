import type { CheckContext } from './context';
import { own, quote, type Raw } from '../json-value';
import type { AccessorFacts } from './data';

const TRANSFORMS = [
  ['matrix', 16],
  ['translation', 3],
  ['rotation', 4],
  ['scale', 3],
] as const;

/**
 * Checks the node tree: references, no cycles, one parent at most, numeric transforms. Returns repaired nodes.
 * @param meshes Checked.
 */
export function checkNodes(
  context: CheckContext,
  facts: readonly (AccessorFacts | undefined)[],
  meshes: readonly Raw[],
): readonly Raw[] {
  const nodes = context.list('nodes');
  const skins = context.list('skins'),
    cameras = context.list('cameras');
  const parents = new Int32Array(nodes.length).fill(-1);
  const checked = nodes.map((node, index) => {
    const path = `/nodes/${index}`;
    context.index(node, 'mesh', path, meshes, 'mesh');
    context.index(node, 'skin', path, skins, 'skin');
    context.indices(node, 'children', path, nodes, 'node').forEach((child, at) => {
      if (parents[child] !== -1)
        context.fail(
          `${path}/children/${at}`,
          `is node ${child}, which already is a child of node ${parents[child]}; a node has one parent`,
        );
      parents[child] = index;
    });
    checkMeshParts(context, node, path, meshes);
    const repaired = repairInstancing(context, repairTransform(context, node, path), path, facts);
    const camera = own(node, 'camera');
    if (camera === undefined || (typeof camera === 'number' && cameras[camera])) return repaired;
    context.warn('gltf/camera', `${path}/camera`, `is ${quote(camera)}, which names no camera; it is left out`);
    const { camera: _, ...rest } = repaired;
    return rest;
  });
  refuseCircles(context, parents);
  checkScenes(context, nodes, parents);
  return checked;
}

/** Warns of a skin or weights that the node's mesh cannot use. */
function checkMeshParts(context: CheckContext, node: Raw, path: string, meshes: readonly Raw[]): void {
  const mesh = own(node, 'mesh');
  const primitives = typeof mesh === 'number' ? ((meshes[mesh] as Raw)['primitives'] as readonly Raw[]) : [];
  for (const [key, code] of [
    ['skin', 'gltf/skin'],
    ['weights', 'gltf/node'],
  ] as const) {
    if (own(node, key) !== undefined && mesh === undefined)
      context.warn(code, `${path}/${key}`, 'is on a node without a mesh and does nothing');
  }
  if (
    own(node, 'skin') !== undefined &&
    primitives.some(({ attributes }) => own(attributes as Raw, 'JOINTS_0') === undefined)
  ) {
    context.warn(
      'gltf/skin',
      `${path}/skin`,
      `poses mesh ${mesh as number}, which has a primitive without JOINTS_0; that one keeps its shape at its node`,
    );
  }
  const weights = own(node, 'weights'),
    targets = targetsOf(primitives);
  if (mesh !== undefined && Array.isArray(weights) && weights.length !== targets) {
    context.warn(
      'gltf/node',
      `${path}/weights`,
      `are ${weights.length}, but mesh ${mesh as number} has ${targets} morph targets`,
    );
  }
}

/** How many morph targets a mesh has, by its first primitive. */
function targetsOf([primitive]: readonly Raw[]): number {
  const targets = primitive && own(primitive, 'targets');
  return Array.isArray(targets) ? targets.length : 0;
}

/** Whether a node (with one parent at most) is part of a cycle: walking up never ends. */
function refuseCircles(context: CheckContext, parents: Int32Array): void {
  // The walk that has seen a node; nodes that an earlier walk has seen lead to a root.
  const walks = new Int32Array(parents.length).fill(-1);
  for (let start = 0; start < parents.length; start++) {
    for (let node = start; node !== -1 && walks[node] !== start; node = parents[node] as number) {
      if (walks[node] !== -1) break;
      walks[node] = start;
      if (parents[node] !== -1 && walks[parents[node] as number] === start)
        context.fail(`/nodes/${node}`, 'lies below itself');
    }
  }
}

function checkScenes(context: CheckContext, nodes: readonly Raw[], parents: Int32Array): void {
  const scenes = context.list('scenes');
  if (own(context.json, 'scenes') === undefined && own(context.json, 'scene') !== undefined)
    context.warn('gltf/scene', '/scene', 'names a scene, but the file has none; all nodes are shown');
  else context.index(context.json, 'scene', '', scenes, 'scene');
  if (own(context.json, 'scenes') !== undefined && scenes.length === 0) context.fail('/scenes', 'is empty');
  scenes.forEach((scene, index) => {
    context.indices(scene, 'nodes', `/scenes/${index}`, nodes, 'node').forEach((root, at) => {
      if (parents[root] !== -1)
        context.fail(
          `/scenes/${index}/nodes/${at}`,
          `is node ${root}, which is a child of node ${parents[root]}; scenes list roots`,
        );
    });
  });
}

function repairTransform(context: CheckContext, node: Raw, path: string): Raw {
  let repaired = node;
  for (const [key, length] of TRANSFORMS) {
    const value = own(node, key);
    if (value === undefined) continue;
    if (!Array.isArray(value) || value.length !== length || !value.every((x) => typeof x === 'number'))
      context.fail(`${path}/${key}`, `is ${quote(value)}, but must be ${length} numbers`);
  }
  if (
    own(node, 'matrix') !== undefined &&
    TRANSFORMS.some(([key]) => key !== 'matrix' && own(node, key) !== undefined)
  ) {
    context.warn(
      'gltf/node',
      `${path}/matrix`,
      'is beside a translation, rotation or scale, but a node has one or the other; the matrix is taken',
    );
  }
  const weights = own(node, 'weights');
  if (weights !== undefined && !(Array.isArray(weights) && weights.every((w) => typeof w === 'number'))) {
    context.warn(
      'gltf/node',
      `${path}/weights`,
      `is ${quote(weights)}, but must be an array of numbers; it is left out`,
    );
    const { weights: _, ...rest } = repaired;
    repaired = rest;
  }
  const rotation = own(node, 'rotation') as readonly number[] | undefined;
  if (rotation) {
    const size = Math.hypot(...rotation);
    if (!(Math.abs(size - 1) < 1e-2)) {
      const usable = size > 1e-12 && size < Infinity;
      context.warn(
        'gltf/node',
        `${path}/rotation`,
        `has the length ${size} instead of 1; it is ${usable ? 'scaled' : 'left out'}`,
      );
      repaired = { ...repaired, rotation: usable ? rotation.map((x) => x / size) : [0, 0, 0, 1] };
    }
  }
  const matrix = own(node, 'matrix') as readonly number[] | undefined;
  if (matrix && !(matrix[3] === 0 && matrix[7] === 0 && matrix[11] === 0 && matrix[15] === 1)) {
    context.warn('gltf/node', `${path}/matrix`, 'is not affine; its last row is taken as 0, 0, 0, 1');
    repaired = { ...repaired, matrix: matrix.map((x, i) => (i % 4 === 3 ? (i === 15 ? 1 : 0) : x)) };
  }
  return repaired;
}

/** Attributes of instances, with their types. */
const PLACES: ReadonlyMap<string, string> = new Map([
  ['TRANSLATION', 'VEC3'],
  ['ROTATION', 'VEC4'],
  ['SCALE', 'VEC3'],
]);

/** A node with valid attributes of EXT_mesh_gpu_instancing: each of its type, all of the same count. */
function repairInstancing(
  context: CheckContext,
  node: Raw,
  path: string,
  facts: readonly (AccessorFacts | undefined)[],
): Raw {
  const name = 'EXT_mesh_gpu_instancing';
  const instancing = context.extension(node, name, path);
  if (!instancing) return node;
  const at = `${path}/extensions/${name}`;
  const attributes = context.object(instancing, 'attributes', at) ?? {};
  const kept: Record<string, unknown> = {};
  let count: number | undefined;
  for (const [semantic, accessor] of Object.entries(attributes)) {
    const place = `${at}/attributes/${semantic}`;
    context.reference(accessor, place, facts, 'accessor');
    const { type, count: entries } = facts[accessor] as AccessorFacts;
    if (count !== undefined && entries !== count)
      context.fail(place, `has ${entries} entries where others have ${count}`);
    count = entries;
    const expected = PLACES.get(semantic) ?? type;
    if (type === expected) kept[semantic] = accessor;
    else context.warn('gltf/node', place, `is a ${quote(type)}, but must be ${expected}; it is left out`);
  }
  const { [name]: _, ...others } = own(node, 'extensions') as Raw;
  if (count !== undefined)
    return { ...node, extensions: { ...others, [name]: { ...instancing, attributes: kept, count } } };
  context.warn('gltf/node', `${at}/attributes`, 'is empty; the node is shown once');
  return { ...node, extensions: others };
}

/** Checks skins: joints that exist, and a matrix for each where there are any. */
export function checkSkins(context: CheckContext, facts: readonly (AccessorFacts | undefined)[]): void {
  const nodes = context.list('nodes');
  context.list('skins').forEach((skin, index) => {
    const path = `/skins/${index}`;
    const joints = context.indices(skin, 'joints', path, nodes, 'node');
    if (joints.length === 0) context.fail(`${path}/joints`, 'is empty');
    const skeleton = own(skin, 'skeleton');
    if (skeleton !== undefined && !(typeof skeleton === 'number' && nodes[skeleton]))
      context.warn('gltf/skin', `${path}/skeleton`, `is ${quote(skeleton)}, which names no node; it is not used`);
    const matrices = context.index(skin, 'inverseBindMatrices', path, facts, 'accessor');
    if (matrices === undefined) return;
    const { type, count, componentType } = facts[matrices] as AccessorFacts;
    if (componentType !== 5126)
      context.warn(
        'gltf/skin',
        `${path}/inverseBindMatrices`,
        `has components of ${componentType}, but must have floats; they are taken as they are`,
      );
    if (type !== 'MAT4' || count < joints.length)
      context.fail(
        `${path}/inverseBindMatrices`,
        `has ${count} entries of ${type}, but must have a MAT4 for each of ${joints.length} joints`,
      );
  });
}
