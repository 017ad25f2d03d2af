import { buildTlas, packTriangles, type Blas, type Tlas } from '@glanz/bvh';
import { bvhInstanceStruct } from '@glanz/bvh/wgsl';
import type { Instance, Mesh, Scene } from '@glanz/scene';
import { instanceStruct, meshStruct, NONE } from '../kernels/layout';
import { RenderError } from '../errors';
import { breather, buildHierarchies, type HierarchyOptions } from './hierarchies';

/** Node words: 16 a node. */
const NODE_WORDS = 16;
const TRIANGLE_WORDS = 12;

/** A scene's shapes as the kernels read them. */
export interface Geometry {
  /** TLAS nodes first, then the nodes of each mesh in use. */
  readonly nodes: Float32Array<ArrayBuffer>;
  readonly triangles: Float32Array<ArrayBuffer>;
  /** Mesh table, then vertex attributes. Texture binding records follow, see `packAttributes`. */
  readonly attributes: Uint32Array<ArrayBuffer>;
  readonly blas: readonly (Blas | undefined)[];
  readonly tlas: Tlas;
  /** The scene's instance of each instance given to the TLAS. */
  readonly shown: readonly number[];
  /** Scene instances in the order of their GPU records. */
  readonly order: Uint32Array;
  /** Scene instance → GPU record, or NONE. */
  readonly instanceSlots: Uint32Array;
  /** First node and first triangle of each mesh. */
  readonly firstNode: readonly number[];
  readonly firstTriangle: readonly number[];
  readonly triangleCount: number;
  readonly center: readonly [number, number, number];
  readonly radius: number;
  readonly hasVertexColors: boolean;
}

/**
 * Builds the hierarchies and packs shapes and instances.
 *
 * @throws {RenderError} `renderer/no-triangles` if nothing can be seen.
 */
export async function prepareGeometry(scene: Scene, options: HierarchyOptions = {}): Promise<Geometry> {
  const blas: (Blas | undefined)[] = scene.meshes.map(() => undefined);
  const visible = scene.instances.flatMap((instance, index) => (instance.visible !== false && (scene.meshes[instance.mesh] as Mesh).indices.length >= 3 ? [index] : []));
  const used = [...new Set(visible.map((index) => (scene.instances[index] as Instance).mesh))].sort((a, b) => a - b);
  const built = await buildHierarchies(used.map((index) => scene.meshes[index] as Mesh), options);
  used.forEach((index, i) => (blas[index] = built[i]));
  const shown = visible.filter((index) => (blas[(scene.instances[index] as Instance).mesh] as Blas).triangleIndices.length > 0);
  if (shown.length === 0) throw new RenderError('renderer/no-triangles', 'The scene has no visible triangles: nothing to render.');

  const tlas = buildTlas(shown.map((index) => ({ bounds: (blas[(scene.instances[index] as Instance).mesh] as Blas).bounds, transform: (scene.instances[index] as Instance).transform })));
  if (tlas.instanceOrder.length === 0) throw new RenderError('renderer/no-triangles', 'Every instance has a transform that flattens it: nothing to render.');
  const order = Uint32Array.from(tlas.instanceOrder, (i) => shown[i] as number);
  const instanceSlots = new Uint32Array(scene.instances.length).fill(NONE);
  order.forEach((instance, slot) => (instanceSlots[instance] = slot));

  const firstNode: number[] = [];
  const firstTriangle: number[] = [];
  let nodeCount = tlas.nodes.length / NODE_WORDS;
  let triangleCount = 0;
  scene.meshes.forEach((_, i) => {
    firstNode.push(nodeCount);
    firstTriangle.push(triangleCount);
    nodeCount += blas[i]?.nodeCount ?? 0;
    triangleCount += blas[i]?.triangleIndices.length ?? 0;
  });
  const nodes = new Float32Array(nodeCount * NODE_WORDS);
  const triangles = new Float32Array(triangleCount * TRIANGLE_WORDS);
  nodes.set(tlas.nodes);
  const breathe = breather();
  for (const index of used) {
    const mesh = scene.meshes[index] as Mesh;
    const tree = blas[index] as Blas;
    nodes.set(tree.nodes.subarray(0, tree.nodeCount * NODE_WORDS), (firstNode[index] as number) * NODE_WORDS);
    triangles.set(packTriangles(tree, { positions: mesh.positions, indices: mesh.indices }), (firstTriangle[index] as number) * TRIANGLE_WORDS);
    await breathe();
    options.signal?.throwIfAborted();
  }
  const { min, max } = tlas.bounds;
  const center = [0, 1, 2].map((k) => ((min[k] as number) + (max[k] as number)) / 2) as [number, number, number];
  const radius = 0.5 * Math.hypot(...[0, 1, 2].map((k) => (max[k] as number) - (min[k] as number)));
  return {
    nodes,
    triangles,
    attributes: packAttributes(scene, used),
    blas,
    tlas,
    shown,
    order,
    instanceSlots,
    firstNode,
    firstTriangle,
    triangleCount,
    center,
    radius,
    hasVertexColors: used.some((index) => (scene.meshes[index] as Mesh).colors !== undefined),
  };
}

/** The attribute heap: a table of word offsets per mesh, then indices, normals, tangents, colours and uvs. */
function packAttributes(scene: Scene, used: readonly number[]): Uint32Array<ArrayBuffer> {
  const tableWords = (scene.meshes.length * meshStruct.size) / 4;
  let size = tableWords;
  const place = (array: ArrayLike<number> | undefined) => {
    if (!array || array.length === 0) return NONE;
    const at = size;
    size += array.length;
    return at;
  };
  const table = meshStruct.allocate(scene.meshes.length);
  const placed: [number, Float32Array | Uint32Array | undefined][] = [];
  const keep = (array: Float32Array | Uint32Array | undefined) => {
    const at = place(array);
    if (at !== NONE) placed.push([at, array]);
    return at;
  };
  for (const index of used) {
    const mesh = scene.meshes[index] as Mesh;
    meshStruct.write(table, index, {
      indices: keep(mesh.indices),
      normals: keep(mesh.normals),
      tangents: keep(mesh.tangents),
      colors: keep(mesh.colors),
      uv0: keep(mesh.uvs?.[0]),
      uv1: keep(mesh.uvs?.[1]),
    });
  }
  const heap = new Uint32Array(size);
  heap.set(new Uint32Array(table));
  for (const [at, array] of placed) {
    if (array) heap.set(array instanceof Uint32Array ? array : new Uint32Array(array.buffer, array.byteOffset, array.length), at);
  }
  return heap;
}

/** Writes the instance records in GPU order. */
export function packInstances(scene: Scene, geometry: Geometry, firstLight: Uint32Array): ArrayBuffer {
  const buffer = instanceStruct.allocate(geometry.order.length);
  geometry.tlas.instanceOrder.forEach((given, slot) => {
    const index = geometry.order[slot] as number;
    const instance = scene.instances[index] as Instance;
    const m = instance.transform;
    const traversal = bvhInstanceStruct.allocate();
    const inverse = geometry.tlas.toObject.subarray(12 * given, 12 * given + 12);
    bvhInstanceStruct.write(traversal, 0, {
      to_object_0: inverse.subarray(0, 4),
      to_object_1: inverse.subarray(4, 8),
      to_object_2: inverse.subarray(8, 12),
      blas_node: geometry.firstNode[instance.mesh] as number,
      triangle_offset: geometry.firstTriangle[instance.mesh] as number,
      id: index,
      flags: 0,
    });
    const row = (r: number) => [m[r] as number, m[4 + r] as number, m[8 + r] as number, m[12 + r] as number];
    instanceStruct.write(buffer, slot, {
      traversal,
      to_world_0: row(0),
      to_world_1: row(1),
      to_world_2: row(2),
      material: instance.material,
      mesh: instance.mesh,
      first_light: firstLight[index] as number,
      id: index,
    });
  });
  return buffer;
}
