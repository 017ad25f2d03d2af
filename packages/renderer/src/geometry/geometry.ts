import { packTriangles } from '@glanz/bvh';
import type { DynamicTlas } from '@glanz/bvh/dynamic-tlas';
import { bvhInstanceStruct } from '@glanz/bvh/wgsl';
import type { Instance, Mesh, Scene } from '@glanz/scene';
import { bindingStruct, INSTANCE_CATCHER, instanceStruct, meshStruct, NONE } from '../storage/layout';
import { createYielder, trianglesOf } from './hierarchies';
import type { Hierarchy, MeshRegion } from './hierarchy';
import type { ShapeBytes, ShapeSlice } from '../storage/shape-arrays';
import type { CompactShapes } from './compact-shapes';
import { joinedRanges, Placement } from './placement';

/** Node words: 16 a node. */
const NODE_WORDS = 16;
const TRIANGLE_WORDS = 12;

/** A scene's shapes: hierarchies, and where everything lies in the GPU's buffers. */
export interface Geometry {
  /** Changes in place as instances move, appear and disappear. */
  readonly placement: Placement;
  readonly blas: readonly (Hierarchy | undefined)[];
  /** Nodes kept for the upper levels at the beginning of the node buffer. */
  readonly tlasNodes: number;
  readonly regions: readonly MeshRegion[];
  readonly nodeCount: number;
  /** Stored triangles of the meshes in use. */
  readonly triangleCount: number;
  /** Bytes of the array that holds them. */
  readonly triangleBytes: number;
  /** Writes the shapes, where they are compact. */
  readonly compact: CompactShapes | undefined;
  /** Words of the mesh table and of all attributes. */
  readonly attributeWords: number;
  readonly hasVertexColors: boolean;
}

const attributesOf = (mesh: Mesh) => [
  mesh.indices,
  mesh.normals,
  mesh.tangents,
  mesh.colors,
  mesh.uvs?.[0],
  mesh.uvs?.[1],
];

/** Words that a mesh's attributes take. */
export const attributeWords = (mesh: Mesh, compact?: CompactShapes): number =>
  attributesOf(mesh).reduce((sum, array, i) => sum + wordsOf(array, i, compact), 0);

/** Words that one of {@link attributesOf} takes. */
const wordsOf = (array: ArrayLike<number> | undefined, i: number, compact?: CompactShapes) =>
  (array?.length ?? 0) * (compact?.shares[i] ?? 1);

/** Bytes of an array of triangles. @param records Of compact shapes: triangles and vertices. */
const bytesOfTriangles = (triangles: number, records: number, compact: CompactShapes | undefined) =>
  compact ? 16 * records : 48 * triangles;

/**
 * Lays a scene's shapes out.
 *
 * @param tlas Upper levels, where they are built already.
 * @throws {RenderError} `renderer/no-triangles` if nothing can be seen.
 */
export function layOutGeometry(
  scene: Scene,
  blas: readonly (Hierarchy | undefined)[],
  compact?: CompactShapes,
  tlas?: DynamicTlas,
): Geometry {
  const placement = new Placement(scene, blas, tlas);
  const tlasNodes = placement.nodeCapacity;
  const regions: MeshRegion[] = [];
  let nodeCount = tlasNodes;
  let triangleCount = 0;
  // Vertices follow all triangles.
  let firstVertex = blas.reduce((sum, tree) => sum + (tree?.triangleIndices.length ?? 0), 0);
  let words = (scene.meshes.length * meshStruct.size) / 4;
  scene.meshes.forEach((mesh, i) => {
    const tree = blas[i];
    const region = {
      firstNode: nodeCount,
      nodes: tree?.nodeCount ?? 0,
      firstTriangle: triangleCount,
      triangles: tree?.triangleIndices.length ?? 0,
      firstVertex,
      // Those of a mesh that the GPU has posed are computed when they are read.
      vertices: tree && compact ? mesh.positions.length / 3 : 0,
      firstWord: words,
      words: tree ? attributeWords(mesh, compact) : 0,
    };
    regions.push(region);
    nodeCount += region.nodes;
    triangleCount += region.triangles;
    firstVertex += region.vertices;
    words += region.words;
  });
  return {
    placement,
    blas,
    tlasNodes,
    regions,
    nodeCount,
    triangleCount,
    triangleBytes: bytesOfTriangles(triangleCount, firstVertex, compact),
    compact,
    attributeWords: words,
    hasVertexColors: scene.meshes.some((mesh, i) => blas[i] !== undefined && mesh.colors !== undefined),
  };
}

/** What hierarchies will have, about, as if all meshes were visible: two triangles a node. */
export function expectedShapes(
  { meshes }: Scene,
  compact?: CompactShapes,
): Pick<Geometry, 'nodeCount' | 'triangleBytes' | 'attributeWords'> {
  const triangles = trianglesOf(meshes);
  const records = compact ? meshes.reduce((sum, { positions }) => sum + positions.length / 3, triangles) : triangles;
  return {
    nodeCount: triangles / 2,
    triangleBytes: bytesOfTriangles(triangles, records, compact),
    attributeWords: meshes.reduce((sum, mesh) => sum + attributeWords(mesh, compact), 0),
  };
}

/**
 * Bytes that a scene's shapes take, with the bindings of its textures.
 *
 * @param geometry Where there are no hierarchies yet: about as much.
 */
export function shapeBytes(
  scene: Scene,
  geometry: ReturnType<typeof expectedShapes> = expectedShapes(scene),
): ShapeBytes {
  const bindings = scene.materials.flatMap(({ textures = {} }) => Object.keys(textures)).length;
  return {
    nodes: 4 * geometry.nodeCount * NODE_WORDS,
    triangles: geometry.triangleBytes,
    attributes: 4 * geometry.attributeWords + bindings * bindingStruct.size,
  };
}

/** Bytes and triangles that are written at once: a millisecond or two of work. */
const SLICE_BYTES = 1 << 20;
const SLICE_TRIANGLES = 1 << 14;

function* slicesOf(
  buffer: ShapeSlice['buffer'],
  offset: number,
  array: Float32Array | Uint32Array,
): Generator<ShapeSlice> {
  for (let at = 0; at < array.byteLength; at += SLICE_BYTES)
    yield {
      buffer,
      offset: offset + at,
      data: new Uint8Array(
        array.buffer as ArrayBuffer,
        array.byteOffset + at,
        Math.min(SLICE_BYTES, array.byteLength - at),
      ),
    };
}

/**
 * Shapes for the GPU, slice by slice: upper levels, mesh table, then the nodes, triangles and attributes of each mesh.
 * Of a mesh whose hierarchy is on the GPU, they lack what `HierarchyOnGpu.place` copies.
 */
export function* shapeSlices(scene: Scene, geometry: Geometry): Generator<ShapeSlice> {
  for (const { first, nodes } of geometry.placement.allNodes()) yield* slicesOf('nodes', 4 * first * NODE_WORDS, nodes);
  const records = new Uint32Array(scene.meshes.length * RECORD_WORDS);
  const { compact } = geometry;
  scene.meshes.forEach((mesh, index) =>
    writeRecord(
      records,
      index * RECORD_WORDS,
      mesh,
      geometry.blas[index],
      geometry.regions[index] as MeshRegion,
      compact,
    ),
  );
  yield* slicesOf('attributes', 0, records);
  for (const [index, mesh] of scene.meshes.entries())
    yield* regionSlices(mesh, geometry.blas[index], geometry.regions[index] as MeshRegion, compact);
}

/** What a region of a mesh holds. */
function* regionSlices(
  mesh: Mesh,
  tree: Hierarchy | undefined,
  region: MeshRegion,
  compact: CompactShapes | undefined,
): Generator<ShapeSlice> {
  if (!tree) return;
  const { firstNode, firstTriangle, firstWord } = region;
  const { positions, indices } = mesh;
  // What is on the GPU already is copied there.
  const { nodes, nodeCount, triangleIndices } = tree;
  if (nodes) yield* slicesOf('nodes', 4 * firstNode * NODE_WORDS, nodes.subarray(0, nodeCount * NODE_WORDS));
  if (compact) yield* compact.slices(mesh, tree, region);
  for (let first = 0; nodes && !compact && first < triangleIndices.length; first += SLICE_TRIANGLES) {
    const data = packTriangles(
      { triangleIndices: triangleIndices.subarray(first, first + SLICE_TRIANGLES) },
      { positions, indices },
    );
    yield { buffer: 'triangles', offset: 4 * (firstTriangle + first) * TRIANGLE_WORDS, data };
  }
  let word = firstWord;
  for (const [i, array] of attributesOf(mesh).entries()) {
    const words = wordsOf(array, i, compact);
    if (!array || words === 0) continue;
    if (compact && words < array.length) yield* compact.tangentSlices(4 * word, array as Float32Array);
    else if (nodes || array !== indices) yield* slicesOf('attributes', 4 * word, array);
    word += words;
  }
}

/** One mesh as the kernels read it: its row of the mesh table, and its region. Its hierarchy has nodes on the CPU. */
export function* meshSlices(
  index: number,
  mesh: Mesh,
  tree: Hierarchy | undefined,
  region: MeshRegion,
  compact: CompactShapes | undefined,
): Generator<ShapeSlice> {
  const data = new Uint32Array(RECORD_WORDS);
  writeRecord(data, 0, mesh, tree, region, compact);
  yield { buffer: 'attributes', offset: index * meshStruct.size, data };
  yield* regionSlices(mesh, tree, region, compact);
}

/** Slices up to so many bytes together are given as one. */
const JOINED_BYTES = 1 << 18;

/**
 * The same with fewer slices, to be written before the next is asked for: those that follow each other in their buffer
 * are joined while they are small, since each write costs more than the bytes of a small mesh.
 */
export function* joinSlices(slices: Iterable<ShapeSlice>): Generator<ShapeSlice> {
  const open = new Map<
    ShapeSlice['buffer'],
    { offset: number; bytes: number; readonly memory: Uint8Array<ArrayBuffer> }
  >();
  for (const slice of slices) {
    const { buffer, offset, data } = slice;
    if (2 * data.byteLength > JOINED_BYTES) {
      yield slice;
      continue;
    }
    let joined = open.get(buffer);
    if (!joined) open.set(buffer, (joined = { offset, bytes: 0, memory: new Uint8Array(JOINED_BYTES) }));
    if (offset !== joined.offset + joined.bytes || joined.bytes + data.byteLength > JOINED_BYTES) {
      if (joined.bytes > 0) yield { buffer, offset: joined.offset, data: joined.memory.subarray(0, joined.bytes) };
      joined.offset = offset;
      joined.bytes = 0;
    }
    joined.memory.set(new Uint8Array(data.buffer, data.byteOffset, data.byteLength), joined.bytes);
    joined.bytes += data.byteLength;
  }
  for (const [buffer, { offset, bytes, memory }] of open)
    if (bytes > 0) yield { buffer, offset, data: memory.subarray(0, bytes) };
}

/**
 * All slices of {@link shapeSlices}, made while yielding to the event loop now and then. All hierarchies have nodes on
 * the CPU. The arrays of meshes and hierarchies are shared, not copied.
 */
export async function packGeometry(scene: Scene, geometry: Geometry): Promise<ShapeSlice[]> {
  const slices: ShapeSlice[] = [];
  const yieldIfDue = createYielder();
  for (const slice of shapeSlices(scene, geometry)) {
    slices.push(slice);
    await yieldIfDue();
  }
  return slices;
}

const RECORD_WORDS = meshStruct.size / 4;
/** Where a row of the mesh table says where each attribute begins, in words. */
const ATTRIBUTE_PLACES = (['indices', 'normals', 'tangents', 'colors', 'uv0', 'uv1'] as const).map(
  (name) => meshStruct.offsetOf(name) / 4,
);

/** Writes a mesh's row of the mesh table. */
function writeRecord(
  records: Uint32Array,
  at: number,
  mesh: Mesh,
  tree: Hierarchy | undefined,
  { firstWord, firstVertex }: MeshRegion,
  compact: CompactShapes | undefined,
): void {
  let word = firstWord;
  attributesOf(mesh).forEach((array, i) => {
    const present = tree !== undefined && array !== undefined && array.length > 0;
    const words = wordsOf(array, i, compact);
    records[at + (ATTRIBUTE_PLACES[i] as number)] = present ? (words > 0 ? word : firstVertex) : NONE;
    if (present) word += words;
  });
}

/** Instance records up to so far apart are written at once, with those in between; farther, where there are many. */
const JOINED_RECORDS = 8;

/** Ranges of instances, from the first up to the second number, that hold those of `indices` and few others. */
export const instanceRanges = (indices: readonly number[]) =>
  joinedRanges(Uint32Array.from(indices).sort(), JOINED_RECORDS + (indices.length >> 10));

/** Writes the records of the scene's instances from `from` up to `to`. */
export function packInstances(
  scene: Scene,
  geometry: Geometry,
  firstLight: Uint32Array,
  from = 0,
  to = scene.instances.length,
): ArrayBuffer {
  const buffer = instanceStruct.allocate(to - from);
  const [floats, words] = [new Float32Array(buffer), new Uint32Array(buffer)];
  for (let index = from; index < to; index++)
    writeInstance(floats, words, (index - from) * INSTANCE_WORDS, scene, geometry, index, firstLight);
  return buffer;
}

const INSTANCE_WORDS = instanceStruct.size / 4;
const traversalWord = (name: Parameters<typeof bvhInstanceStruct.offsetOf>[0]) =>
  (instanceStruct.offsetOf('traversal') + bvhInstanceStruct.offsetOf(name)) / 4;
/** Where the members of a record are, in words. */
const AT = {
  toObject: traversalWord('to_object_0'),
  blasNode: traversalWord('blas_node'),
  triangleOffset: traversalWord('triangle_offset'),
  traversalId: traversalWord('id'),
  flags: traversalWord('flags'),
  toWorld: instanceStruct.offsetOf('to_world_0') / 4,
  material: instanceStruct.offsetOf('material') / 4,
  mesh: instanceStruct.offsetOf('mesh') / 4,
  firstLight: instanceStruct.offsetOf('first_light') / 4,
  id: instanceStruct.offsetOf('id') / 4,
};

/** Writes word by word, for there may be hundreds of thousands. */
function writeInstance(
  floats: Float32Array,
  words: Uint32Array,
  at: number,
  scene: Scene,
  { regions, placement }: Geometry,
  index: number,
  firstLight: Uint32Array,
): void {
  const { transform, mesh, material, catcher } = scene.instances[index] as Instance;
  const { firstNode, firstTriangle } = regions[mesh] as MeshRegion;
  const { toObject } = placement.tlas;
  for (let k = 0; k < 12; k++) {
    floats[at + AT.toObject + k] = toObject[12 * index + k] as number;
    floats[at + AT.toWorld + k] = transform[4 * (k & 3) + (k >> 2)] as number;
  }
  words[at + AT.blasNode] = firstNode;
  words[at + AT.triangleOffset] = firstTriangle;
  words[at + AT.traversalId] = index;
  words[at + AT.flags] = catcher ? INSTANCE_CATCHER : 0;
  words[at + AT.material] = material;
  words[at + AT.mesh] = mesh;
  words[at + AT.firstLight] = firstLight[index] as number;
  words[at + AT.id] = index;
}
