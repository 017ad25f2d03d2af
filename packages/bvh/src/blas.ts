import { buildBalanced } from './build/balanced';
import { BvhError } from './error';
import { LEAF_MAX, MAX_PRIMITIVES, TRIANGLE_WORDS, type Aabb } from './layout';

/** Triangles to build over or to trace. */
export interface TriangleMesh {
  /** xyz per vertex, stride 3. */
  readonly positions: Float32Array;
  /** Three per triangle, into the vertices. Absent: the vertices are taken in threes. */
  readonly indices?: Uint32Array | Uint16Array | undefined;
}

/** What {@link buildBlas} may be told. */
export interface BlasOptions {
  /** Most triangles in a leaf, 1 to 16. Default 4. */
  readonly maxLeafTriangles?: number;
  /** Candidate planes per axis are one less than this; 2 to 64. Default 16. */
  readonly bins?: number;
}

/** Bottom-level hierarchy: the triangles of one mesh. */
export interface Blas {
  /** Nodes as {@link bvhNodeStruct} lays them out, 16 words each; the integers are the same bits seen as Uint32Array. Node 0 is the root. */
  readonly nodes: Float32Array<ArrayBuffer>;
  readonly nodeCount: number;
  /**
   * Leaf order → triangle of the mesh. Triangles with a coordinate that is not finite are left out: nothing ever hits
   * them.
   */
  readonly triangleIndices: Uint32Array<ArrayBuffer>;
  /** Box of all triangles; min > max if there are none. */
  readonly bounds: Aabb;
}

/** How many triangles a mesh has. */
export const triangleCount = (mesh: TriangleMesh): number => Math.floor((mesh.indices ? mesh.indices.length : mesh.positions.length / 3) / 3);

/**
 * Boxes of triangles.
 * @param boxes Takes six numbers a triangle: min xyz, max xyz.
 * @throws {BvhError} `bvh/indices` for an index beyond the vertices.
 */
export function triangleBoxes(mesh: TriangleMesh, boxes: Float32Array): void {
  const { positions, indices } = mesh;
  const vertices = Math.floor(positions.length / 3);
  const count = triangleCount(mesh);
  for (let i = 0; i < count; i++) {
    const ia = indices ? (indices[3 * i] as number) : 3 * i;
    const ib = indices ? (indices[3 * i + 1] as number) : 3 * i + 1;
    const ic = indices ? (indices[3 * i + 2] as number) : 3 * i + 2;
    if (ia >= vertices || ib >= vertices || ic >= vertices) {
      throw new BvhError('bvh/indices', `Triangle ${i} uses vertex ${Math.max(ia, ib, ic)} of ${vertices}: every index must be below the number of vertices.`);
    }
    const a = 3 * ia, b = 3 * ib, c = 3 * ic;
    for (let k = 0; k < 3; k++) {
      const p = positions[a + k] as number, q = positions[b + k] as number, r = positions[c + k] as number;
      // Comparisons would drop a NaN in silence; Math.min and Math.max keep it.
      boxes[6 * i + k] = Math.min(p, q, r);
      boxes[6 * i + 3 + k] = Math.max(p, q, r);
    }
  }
}

/**
 * Builds the hierarchy of a mesh's triangles by binned surface area heuristic. Deterministic. No way from the root has
 * more than `BLAS_MAX_DEPTH` inner nodes, whatever the triangles. The mesh is read, not kept.
 *
 * @throws {BvhError} `bvh/positions` or `bvh/indices` for arrays of a wrong length or indices out of range,
 * `bvh/too-many` beyond 134 million triangles, `bvh/options`.
 * @example
 * const blas = buildBlas({ positions, indices });
 */
export function buildBlas(mesh: TriangleMesh, options: BlasOptions = {}): Blas {
  const { maxLeafTriangles = 4, bins = 16 } = options;
  if (!(Number.isInteger(maxLeafTriangles) && maxLeafTriangles >= 1 && maxLeafTriangles <= LEAF_MAX)) throw new BvhError('bvh/options', `maxLeafTriangles is ${maxLeafTriangles}; it must be a whole number from 1 to ${LEAF_MAX}.`);
  if (!(Number.isInteger(bins) && bins >= 2 && bins <= 64)) throw new BvhError('bvh/options', `bins is ${bins}; it must be a whole number from 2 to 64.`);
  if (mesh.positions.length % 3 !== 0) throw new BvhError('bvh/positions', `positions has ${mesh.positions.length} numbers; it must have three a vertex.`);
  if (mesh.indices ? mesh.indices.length % 3 !== 0 : mesh.positions.length % 9 !== 0) throw new BvhError('bvh/indices', `${mesh.indices ? `indices has ${mesh.indices.length} entries` : `positions has ${mesh.positions.length / 3} vertices`}; it must have three a triangle.`);
  const count = triangleCount(mesh);
  if (count > MAX_PRIMITIVES) throw new BvhError('bvh/too-many', `The mesh has ${count} triangles; one hierarchy holds ${MAX_PRIMITIVES}: split the mesh.`);
  const { nodes, nodeCount, triangleIndices, bounds } = buildBalanced(mesh, maxLeafTriangles, bins);
  return { nodes, nodeCount, triangleIndices, bounds: { min: Float32Array.from(bounds.subarray(0, 3)), max: Float32Array.from(bounds.subarray(3)) } };
}

/** The indices of boxes without NaN or infinity. */
export function finiteBoxes(boxes: Float32Array): Uint32Array<ArrayBuffer> {
  const kept = new Uint32Array(boxes.length / 6);
  let count = 0;
  for (let i = 0; i < kept.length; i++) {
    const b = 6 * i;
    // A sum is finite only if each part is: six numbers of 3.4e38 at most cannot overflow a double.
    const sum = (boxes[b] as number) + (boxes[b + 1] as number) + (boxes[b + 2] as number) + (boxes[b + 3] as number) + (boxes[b + 4] as number) + (boxes[b + 5] as number);
    if (Number.isFinite(sum)) kept[count++] = i;
  }
  return count === kept.length ? kept : kept.slice(0, count);
}

/** The box around those of `boxes` that `indices` names. */
export function boundsOf(boxes: Float32Array, indices: Uint32Array): { readonly min: Float32Array; readonly max: Float32Array } {
  const min = new Float32Array(3).fill(Infinity);
  const max = new Float32Array(3).fill(-Infinity);
  for (const index of indices) {
    for (let k = 0; k < 3; k++) {
      min[k] = Math.min(min[k] as number, boxes[6 * index + k] as number);
      max[k] = Math.max(max[k] as number, boxes[6 * index + 3 + k] as number);
    }
  }
  return { min, max };
}

/**
 * The triangles of a BLAS in leaf order, as the WGSL traversal wants them.
 *
 * @returns 12 words a triangle: v0 xyz and the index of the triangle in the mesh (as u32 bits), v1 xyz and 0, v2 xyz and 0.
 */
export function packTriangles(blas: Blas, mesh: TriangleMesh): Float32Array<ArrayBuffer> {
  const { triangleIndices } = blas;
  const { positions, indices } = mesh;
  const packed = new Float32Array(triangleIndices.length * TRIANGLE_WORDS);
  const words = new Uint32Array(packed.buffer);
  for (let i = 0; i < triangleIndices.length; i++) {
    const triangle = triangleIndices[i] as number;
    for (let corner = 0; corner < 3; corner++) {
      const from = 3 * (indices ? (indices[3 * triangle + corner] as number) : 3 * triangle + corner);
      const to = i * TRIANGLE_WORDS + corner * 4;
      packed[to] = positions[from] as number;
      packed[to + 1] = positions[from + 1] as number;
      packed[to + 2] = positions[from + 2] as number;
    }
    words[i * TRIANGLE_WORDS + 3] = triangle;
  }
  return packed;
}
