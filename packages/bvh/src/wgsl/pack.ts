import { packTriangles, type Blas } from '../blas';
import { BvhError } from '../error';
import { TRIANGLE_WORDS, type TriangleMesh } from '../layout';
import type { Tlas } from '../tlas';
import type { WideBlas, WideTlas } from '../wide/widen';
import { stackSizeOf } from './stack-size';
import { bvhInstanceStruct } from './structs';

/** A mesh with its hierarchy, in either layout. */
export interface HierarchyPart {
  readonly blas: Pick<Blas | WideBlas, 'nodes' | 'nodeCount' | 'triangleIndices'>;
  /** What the BLAS was built, or last refitted, for. */
  readonly mesh: TriangleMesh;
}

/** The contents of the three buffers that `bvhBuffers` declares, each of at least one element. */
export interface PackedHierarchy {
  /** Nodes of the TLAS, then those of each BLAS: 64 bytes a node, 80 in the wide layout. */
  readonly nodes: ArrayBuffer;
  /** 12 words a triangle, as {@link packTriangles} makes them, mesh after mesh. */
  readonly triangles: Float32Array<ArrayBuffer>;
  /** As `bvhInstanceStruct` lays them out, in the TLAS's leaf order; `id` is the instance as given to `buildTlas`. */
  readonly instances: ArrayBuffer;
  /** Entries that a ray's stack needs for these trees: see `bvhTraversal`. A TLAS of other transforms may be deeper. */
  readonly stackSize: number;
}

/** Bytes of what stands for instances where there are none: buffers cannot be empty. */
const NO_INSTANCE = 64;

/**
 * Packs a two-level hierarchy for the GPU. A BLAS that several instances share is stored once.
 *
 * @param tlas The TLAS; all BLASes have the same layout.
 * @param parts Mesh and BLAS of each instance, in the order given to `buildTlas`.
 * @throws {BvhError} `bvh/parts` where an instance has none, `bvh/layout` where a BLAS is of another layout than the
 * TLAS.
 * @example
 * const { nodes, triangles, instances } = packHierarchy(tlas, placed.map(({ blas, mesh }) => ({ blas, mesh })));
 */
export function packHierarchy(
  tlas: Pick<Tlas | WideTlas, 'nodes' | 'nodeCount' | 'instanceOrder' | 'toObject'>,
  parts: readonly HierarchyPart[],
): PackedHierarchy {
  const { instanceOrder, toObject } = tlas;
  const stride = tlas.nodes.byteLength / tlas.nodeCount;
  const starts = new Map<HierarchyPart['blas'], readonly [node: number, triangle: number]>();
  const meshes: Float32Array[] = [];
  let nodeCount = tlas.nodeCount,
    triangleCount = 0;
  const instances = bvhInstanceStruct.allocate(instanceOrder.length);
  for (const [slot, given] of instanceOrder.entries()) {
    const part = parts[given];
    if (!part)
      throw new BvhError('bvh/parts', `The TLAS has an instance ${given}, but there are ${parts.length} parts.`);
    const { blas, mesh } = part;
    let start = starts.get(blas);
    if (!start) {
      if (blas.nodes.byteLength !== stride * blas.nodeCount)
        throw new BvhError(
          'bvh/layout',
          `The BLAS of instance ${given} has nodes of ${blas.nodes.byteLength / blas.nodeCount} bytes, the TLAS of ${stride}: widen both or none.`,
        );
      starts.set(blas, (start = [nodeCount, triangleCount]));
      meshes.push(packTriangles(blas, mesh));
      nodeCount += blas.nodeCount;
      triangleCount += blas.triangleIndices.length;
    }
    const row = (r: number) => toObject.subarray(12 * given + 4 * r, 12 * given + 4 * r + 4);
    bvhInstanceStruct.write(instances, slot, {
      to_object_0: row(0),
      to_object_1: row(1),
      to_object_2: row(2),
      blas_node: start[0],
      triangle_offset: start[1],
      id: given,
      flags: 0,
    });
  }
  const nodes = new Uint8Array(stride * nodeCount);
  const put = (from: Float32Array | Uint32Array, at: number) =>
    nodes.set(new Uint8Array(from.buffer, from.byteOffset, from.byteLength), stride * at);
  put(tlas.nodes, 0);
  for (const [blas, [first]] of starts) put(blas.nodes, first);
  const triangles = new Float32Array(TRIANGLE_WORDS * Math.max(1, triangleCount));
  meshes.reduce((at, packed) => (triangles.set(packed, at), at + packed.length), 0);
  return {
    nodes: nodes.buffer,
    triangles,
    instances: instanceOrder.length > 0 ? instances : new ArrayBuffer(NO_INSTANCE),
    stackSize: stackSizeOf(tlas, starts.keys()),
  };
}
