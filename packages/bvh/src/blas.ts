import { buildBalanced } from './builders/balanced';
import type { TreeBuilder } from './builders/builder';
import { BvhError } from './error';
import { type Aabb, LEAF_MAX, MAX_PRIMITIVES, TRIANGLE_WORDS, type TriangleMesh } from './layout';

/** Options for {@link buildBlas}. */
export interface BlasOptions {
  /**
   * How to build. `balanced` (default): by surface area heuristic. `fast` of `@glanz/bvh/fast`: a third of the time,
   * for meshes that change every frame. `best` and `bestSplit` of `@glanz/bvh/best`: several times as long, for
   * images that take longer to render than a tree to build.
   */
  readonly builder?: 'balanced' | TreeBuilder;
  /** Maximum number of triangles in a leaf, 1 to 16. Default 4. */
  readonly maxLeafTriangles?: number;
  /** Candidate planes per axis are one less than this; 2 to 64. Default 32. Ignored by `fast`. */
  readonly bins?: number;
}

/** Bottom-level hierarchy: the triangles of one mesh. */
export interface Blas {
  /**
   * Nodes as `bvhNodeStruct` of `@glanz/bvh/wgsl` lays them out, 16 words each; the integers are the same bits seen as
   * Uint32Array. Node 0 is the root.
   */
  readonly nodes: Float32Array<ArrayBuffer>;
  readonly nodeCount: number;
  /**
   * Leaf order → triangle of the mesh. Triangles with a coordinate that is not finite are left out: nothing ever hits
   * them. Every other triangle appears once, or several times after `bestSplit`.
   */
  readonly triangleIndices: Uint32Array<ArrayBuffer>;
  /** Box of all triangles; min > max if there are none. */
  readonly bounds: Aabb;
}

function whole(name: string, value: number, min: number, max: number): void {
  if (!(Number.isInteger(value) && value >= min && value <= max))
    throw new BvhError('bvh/options', `${name} is ${value}, not a whole number from ${min} to ${max}.`);
}

/**
 * Builds the hierarchy of a mesh's triangles. Deterministic. No path from the root has more than `BLAS_MAX_DEPTH` inner
 * nodes, whatever the triangles. The mesh is not retained.
 *
 * @throws {BvhError} `bvh/positions` or `bvh/indices` for arrays of a wrong length or indices out of range,
 * `bvh/too-many` beyond 134 million triangles, `bvh/options`.
 * @example
 * const blas = buildBlas({ positions, indices });
 */
export function buildBlas(mesh: TriangleMesh, options: BlasOptions = {}): Blas {
  const steps = blasSteps(mesh, options);
  let step = steps.next();
  while (!step.done) step = steps.next();
  return step.value;
}

/**
 * The same as {@link buildBlas} in steps of a few milliseconds, for your own scheduling; each yields the completed
 * fraction, 0..1. `buildBlasAsync` of `@glanz/bvh/async` uses it. The mesh must not change until the last step.
 *
 * @throws {BvhError} as `buildBlas`, at the first step or a later one.
 */
export function* blasSteps(mesh: TriangleMesh, options: BlasOptions = {}): Generator<number, Blas> {
  const { maxLeafTriangles = 4, bins = 32, builder = 'balanced' } = options;
  whole('maxLeafTriangles', maxLeafTriangles, 1, LEAF_MAX);
  whole('bins', bins, 2, 64);
  const build = builder === 'balanced' ? buildBalanced : (builder as TreeBuilder | undefined)?.build;
  if (typeof build !== 'function')
    throw new BvhError('bvh/options', `builder is ${builder as string}, not 'balanced' or imported.`);
  const { positions, indices } = mesh;
  const check = (code: string, what: string, { length }: ArrayLike<number>, per: number) => {
    if (length % per !== 0) throw new BvhError(code, `${what} has ${length} entries, not a multiple of ${per}.`);
  };
  check('bvh/positions', 'positions', positions, 3);
  if (indices) check('bvh/indices', 'indices', indices, 3);
  else check('bvh/indices', 'positions', positions, 9);
  const count = Math.floor((indices ? indices.length : positions.length / 3) / 3);
  if (count > MAX_PRIMITIVES)
    throw new BvhError('bvh/too-many', `${count} triangles: one hierarchy holds ${MAX_PRIMITIVES}, split the mesh.`);
  const { bounds, ...tree } = yield* build(mesh, count, { maxLeaf: maxLeafTriangles, bins });
  return {
    ...tree,
    bounds: { min: new Float32Array(bounds.subarray(0, 3)), max: new Float32Array(bounds.subarray(3)) },
  };
}

/**
 * The triangles of a BLAS in leaf order, as the WGSL traversal reads them.
 *
 * @param blas In either layout.
 * @returns 12 words a triangle: v0 xyz and the index of the triangle in the mesh (as u32 bits), v1 xyz and 0, v2 xyz
 * and 0.
 */
export function packTriangles(blas: Pick<Blas, 'triangleIndices'>, mesh: TriangleMesh): Float32Array<ArrayBuffer> {
  const { triangleIndices } = blas;
  const packed = new Float32Array(triangleIndices.length * TRIANGLE_WORDS);
  const words = new Uint32Array(packed.buffer);
  const { positions, indices } = mesh;
  for (let i = 0, to = 0; i < triangleIndices.length; i++, to += TRIANGLE_WORDS) {
    const triangle = triangleIndices[i] as number;
    for (let corner = 0; corner < 3; corner++) {
      const vertex = indices ? (indices[3 * triangle + corner] as number) : 3 * triangle + corner;
      for (let k = 0; k < 3; k++) packed[to + 4 * corner + k] = positions[3 * vertex + k] as number;
    }
    words[to + 3] = triangle;
  }
  return packed;
}
