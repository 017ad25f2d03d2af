import { packTriangles } from '@glanz/bvh';
import { bvhInstanceStruct } from '@glanz/bvh/wgsl';
import type { Instance, Mesh, Scene } from '@glanz/scene';
import { INSTANCE_CATCHER, instanceStruct, meshStruct, NONE } from '../storage/layout';
import { createYielder, buildHierarchies, type HierarchyOptions } from './hierarchies';
import type { Hierarchy, MeshRegion } from './hierarchy';
import { isShown, Placement } from './placement';

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
  /** Words of the mesh table and of all attributes. */
  readonly attributeWords: number;
  readonly hasVertexColors: boolean;
}

/** Shapes as the kernels read them. */
export interface PackedGeometry {
  /** Upper levels first, then the nodes of each mesh in use. */
  readonly nodes: Float32Array<ArrayBuffer>;
  readonly triangles: Float32Array<ArrayBuffer>;
  /** Mesh table, then vertex attributes. Texture binding records follow. */
  readonly attributes: Uint32Array<ArrayBuffer>;
}

/** Meshes that visible instances use, in order. */
function usedMeshes(scene: Scene): number[] {
  return [...new Set(scene.instances.filter((instance) => isShown(scene, instance)).map(({ mesh }) => mesh))].sort(
    (a, b) => a - b,
  );
}

/** The meshes in use that have no hierarchy yet. */
export function missingMeshes(scene: Scene, blas: readonly (Hierarchy | undefined)[]): number[] {
  return usedMeshes(scene).filter((index) => !blas[index]);
}

/**
 * Builds the hierarchies that are missing.
 *
 * @param blas Hierarchies that are there already, by mesh.
 */
export async function prepareHierarchies(
  scene: Scene,
  options: HierarchyOptions = {},
  blas: readonly (Hierarchy | undefined)[] = [],
): Promise<(Hierarchy | undefined)[]> {
  const all = scene.meshes.map((_, i) => blas[i]);
  const missing = missingMeshes(scene, all);
  const built = await buildHierarchies(
    missing.map((index) => scene.meshes[index] as Mesh),
    options,
  );
  missing.forEach((index, i) => (all[index] = built[i]));
  return all;
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
export function attributeWords(mesh: Mesh): number {
  return attributesOf(mesh).reduce((sum, array) => sum + (array?.length ?? 0), 0);
}

/**
 * Lays a scene's shapes out.
 *
 * @throws {RenderError} `renderer/no-triangles` if nothing can be seen.
 */
export function layOutGeometry(scene: Scene, blas: readonly (Hierarchy | undefined)[]): Geometry {
  const placement = new Placement(scene, blas);
  const tlasNodes = placement.nodeCapacity;
  const regions: MeshRegion[] = [];
  let nodeCount = tlasNodes;
  let triangleCount = 0;
  let words = (scene.meshes.length * meshStruct.size) / 4;
  scene.meshes.forEach((mesh, i) => {
    const tree = blas[i];
    const region = {
      firstNode: nodeCount,
      nodes: tree?.nodeCount ?? 0,
      firstTriangle: triangleCount,
      triangles: tree?.triangleIndices.length ?? 0,
      firstWord: words,
      words: tree ? attributeWords(mesh) : 0,
    };
    regions.push(region);
    nodeCount += region.nodes;
    triangleCount += region.triangles;
    words += region.words;
  });
  return {
    placement,
    blas,
    tlasNodes,
    regions,
    nodeCount,
    triangleCount,
    attributeWords: words,
    hasVertexColors: scene.meshes.some((mesh, i) => blas[i] !== undefined && mesh.colors !== undefined),
  };
}

/**
 * Builds all hierarchies in use and lays the shapes out.
 *
 * @throws {RenderError} `renderer/no-triangles` if nothing can be seen.
 */
export async function prepareGeometry(scene: Scene, options: HierarchyOptions = {}): Promise<Geometry> {
  return layOutGeometry(scene, await prepareHierarchies(scene, options));
}

/** Bytes and triangles that are written at once: a millisecond or two of work. */
const SLICE_BYTES = 1 << 20;
const SLICE_TRIANGLES = 1 << 14;

/** A part of one of the buffers of shapes. */
export interface ShapeSlice {
  readonly buffer: keyof PackedGeometry;
  /** Where in the buffer, in bytes. */
  readonly offset: number;
  readonly data: ArrayBufferView<ArrayBuffer>;
}

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
 * Shapes for the GPU, slice by slice: what {@link packGeometry} gives as a whole, without ever holding it. Slices are
 * to be written or copied before the next is asked for. Of a mesh whose hierarchy is on the GPU, they lack what
 * `HierarchyOnGpu.place` copies.
 */
export function* shapeSlices(scene: Scene, geometry: Geometry): Generator<ShapeSlice> {
  for (const { first, nodes } of geometry.placement.allNodes()) yield* slicesOf('nodes', 4 * first * NODE_WORDS, nodes);
  const records = new Uint32Array(scene.meshes.length * RECORD_WORDS);
  scene.meshes.forEach((mesh, index) =>
    writeRecord(records, index * RECORD_WORDS, mesh, geometry.blas[index], geometry.regions[index] as MeshRegion),
  );
  yield* slicesOf('attributes', 0, records);
  for (const [index, mesh] of scene.meshes.entries()) {
    const region = geometry.regions[index] as MeshRegion;
    const tree = geometry.blas[index];
    if (!tree) continue;
    const { positions, indices } = mesh;
    // What is on the GPU already is copied there.
    const { nodes } = tree;
    if (nodes)
      yield* slicesOf('nodes', 4 * region.firstNode * NODE_WORDS, nodes.subarray(0, region.nodes * NODE_WORDS));
    for (let first = 0; nodes && first < tree.triangleIndices.length; first += SLICE_TRIANGLES) {
      const data = packTriangles(
        { triangleIndices: tree.triangleIndices.subarray(first, first + SLICE_TRIANGLES) },
        { positions, indices },
      );
      yield { buffer: 'triangles', offset: 4 * (region.firstTriangle + first) * TRIANGLE_WORDS, data };
    }
    let word = region.firstWord;
    for (const array of attributesOf(mesh)) {
      if (!array) continue;
      if (nodes || array !== indices) yield* slicesOf('attributes', 4 * word, array);
      word += array.length;
    }
  }
}

/** Slices up to so many bytes together are given as one. */
const JOINED_BYTES = 1 << 18;

/**
 * The same with fewer slices: those that follow each other in their buffer are joined while they are small, since each
 * write costs more than the bytes of a small mesh.
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

/** Writes shapes for the GPU, yielding to the event loop now and then. All hierarchies have nodes on the CPU. */
export async function packGeometry(scene: Scene, geometry: Geometry, signal?: AbortSignal): Promise<PackedGeometry> {
  const packed = {
    nodes: new Float32Array(geometry.nodeCount * NODE_WORDS),
    triangles: new Float32Array(geometry.triangleCount * TRIANGLE_WORDS),
    attributes: new Uint32Array(geometry.attributeWords),
  };
  const yieldIfDue = createYielder();
  for (const { buffer, offset, data } of shapeSlices(scene, geometry)) {
    new Uint8Array(packed[buffer].buffer).set(new Uint8Array(data.buffer, data.byteOffset, data.byteLength), offset);
    await yieldIfDue();
    signal?.throwIfAborted();
  }
  return packed;
}

/** One mesh as the kernels read it. */
export interface PackedMesh {
  /** Its row of the mesh table. */
  readonly record: Uint32Array<ArrayBuffer>;
  readonly nodes: Float32Array<ArrayBuffer>;
  readonly triangles: Float32Array<ArrayBuffer>;
  readonly attributes: Uint32Array<ArrayBuffer>;
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
  { firstWord }: MeshRegion,
): void {
  let word = firstWord;
  attributesOf(mesh).forEach((array, i) => {
    const present = tree !== undefined && array !== undefined && array.length > 0;
    records[at + (ATTRIBUTE_PLACES[i] as number)] = present ? word : NONE;
    if (present) word += array.length;
  });
}

/** Writes one mesh for its region. Its hierarchy, if it has one, has nodes on the CPU. */
export function packMesh(mesh: Mesh, tree: Hierarchy | undefined, region: MeshRegion): PackedMesh {
  const record = new Uint32Array(RECORD_WORDS);
  writeRecord(record, 0, mesh, tree, region);
  if (!tree?.nodes)
    return { record, nodes: new Float32Array(), triangles: new Float32Array(), attributes: new Uint32Array() };
  const attributes = new Uint32Array(attributeWords(mesh));
  let at = 0;
  for (const array of attributesOf(mesh)) {
    if (!array) continue;
    attributes.set(
      array instanceof Uint32Array ? array : new Uint32Array(array.buffer, array.byteOffset, array.length),
      at,
    );
    at += array.length;
  }
  return {
    record,
    nodes: tree.nodes.subarray(0, tree.nodeCount * NODE_WORDS),
    triangles: packTriangles(tree, { positions: mesh.positions, indices: mesh.indices }),
    attributes,
  };
}

/** Instance records up to so far apart are written at once, with those in between. */
const JOINED_RECORDS = 8;

/** Ranges of instances, from the first up to the second number, that hold those of `indices` and few others. */
export function* instanceRanges(indices: readonly number[]): Generator<readonly [from: number, to: number]> {
  const sorted = Uint32Array.from(indices).sort();
  for (let i = 0; i < sorted.length;) {
    const first = sorted[i++] as number;
    let end = first + 1;
    while (i < sorted.length && (sorted[i] as number) <= end + JOINED_RECORDS) end = (sorted[i++] as number) + 1;
    yield [first, end];
  }
}

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
