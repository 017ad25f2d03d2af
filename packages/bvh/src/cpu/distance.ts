import type { Blas } from '../blas';
import { BvhError } from '../error';
import {
  BVH_STACK_SIZE,
  FAR,
  LEAF,
  leafCount,
  leafFirst,
  LEFT,
  LEFT_MIN,
  NODE_WORDS,
  RIGHT,
  RIGHT_MIN,
  type TriangleMesh,
} from '../layout';
import type { Tlas } from '../tlas';
import { NEAREST_NUMBERS, nearestOnTriangle } from './point-triangle';
import { largestStretch, toWorld } from './to-world';
import type { BlasMesh } from './walk';
import { wordsOf } from './words';

/** The point of a mesh that is nearest to another point. */
export interface NearPoint {
  /** Between the two points. */
  readonly distance: number;
  /** xyz, on the mesh. */
  readonly point: readonly [number, number, number];
  /** Triangle of the mesh, as its indices count. */
  readonly triangle: number;
  /** Barycentrics: the point is (1 − u − v) v0 + u v1 + v v2. */
  readonly u: number;
  readonly v: number;
}

/** A {@link NearPoint} on one of several instances; distance and point count in the world. */
export interface InstanceNearPoint extends NearPoint {
  /** Instance, as given to `buildTlas`. */
  readonly instance: number;
}

/** Options for point queries. */
export interface DistanceOptions {
  /** Only points nearer than this count. A bound makes the query faster. Default Infinity. */
  readonly maxDistance?: number;
}

/** The identity, as rows of 3×4. */
const HERE = /* @__PURE__ */ Float64Array.of(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0);

/**
 * The search for the nearest point, nearest boxes first. Made once, it serves any number of points and allocates
 * nothing.
 */
class DistanceWalk {
  /** Squared; of the nearest point so far, at first the bound. */
  squared = 0;
  triangle = -1;
  instance = -1;
  x = 0;
  y = 0;
  z = 0;
  /** The nearest point relative to (x, y, z), and its barycentrics. */
  readonly nearest = new Float64Array(NEAREST_NUMBERS);
  readonly #candidate = new Float64Array(NEAREST_NUMBERS);
  readonly #world = new Float64Array(12);
  /**
   * Nodes and leaves yet to visit, and a lower bound on the squared distance to them. A BLAS pushes its own above
   * those of the TLAS.
   */
  readonly #references = new Uint32Array(BVH_STACK_SIZE);
  readonly #bounds = new Float64Array(BVH_STACK_SIZE);
  #top = 0;

  start(p: ArrayLike<number>, at: number, maxDistance: number): void {
    this.x = p[at] as number;
    this.y = p[at + 1] as number;
    this.z = p[at + 2] as number;
    this.squared = maxDistance * maxDistance;
    this.triangle = this.instance = -1;
    this.#top = 0;
  }

  near(blas: Blas, mesh: TriangleMesh): void {
    this.#search(blas, mesh, this.x, this.y, this.z, 1, HERE, 0);
  }

  nearInstances({ nodes, instanceOrder, toObject: m }: Tlas, instances: readonly BlasMesh[]): void {
    if (instanceOrder.length === 0) return;
    const words = wordsOf(nodes);
    const { x, y, z } = this;
    this.#push(0, 0);
    for (;;) {
      const leaf = this.#nextLeaf(nodes, words, x, y, z, 1, 0);
      if (leaf < 0) return;
      const instance = instanceOrder[leafFirst(leaf)] as number;
      const { blas, mesh } = instances[instance] as BlasMesh;
      const r = 12 * instance;
      const local = (k: number) =>
        (m[r + k] as number) * x +
        (m[r + k + 1] as number) * y +
        (m[r + k + 2] as number) * z +
        (m[r + k + 3] as number);
      // The transform from the world stretches distances by at most this, so bounds in object space are this much
      // larger.
      const stretch = largestStretch(m, r);
      toWorld(m, r, this.#world);
      this.#search(blas, mesh, local(0), local(4), local(8), 1 / (stretch * stretch), this.#world, instance);
    }
  }

  #push(reference: number, bound: number): void {
    this.#bounds[this.#top] = bound;
    this.#references[this.#top++] = reference;
  }

  /** @param scale From squared distances in object space to ones that are not larger than those in the world. */
  #search(
    { nodes, triangleIndices }: Blas,
    { positions: p, indices }: TriangleMesh,
    x: number,
    y: number,
    z: number,
    scale: number,
    m: Float64Array,
    instance: number,
  ): void {
    if (triangleIndices.length === 0) return;
    const words = wordsOf(nodes);
    const base = this.#top;
    const candidate = this.#candidate;
    const m0 = m[0] as number,
      m1 = m[1] as number,
      m2 = m[2] as number,
      m3 = (m[3] as number) - this.x;
    const m4 = m[4] as number,
      m5 = m[5] as number,
      m6 = m[6] as number,
      m7 = (m[7] as number) - this.y;
    const m8 = m[8] as number,
      m9 = m[9] as number,
      m10 = m[10] as number,
      m11 = (m[11] as number) - this.z;
    this.#push(0, 0);
    for (;;) {
      const leaf = this.#nextLeaf(nodes, words, x, y, z, scale, base);
      if (leaf < 0) return;
      const first = leafFirst(leaf),
        end = first + leafCount(leaf);
      for (let i = first; i < end; i++) {
        const triangle = triangleIndices[i] as number;
        let a = 3 * triangle,
          b = a + 1,
          c = a + 2;
        if (indices) {
          a = indices[a] as number;
          b = indices[b] as number;
          c = indices[c] as number;
        }
        const ax = p[3 * a] as number,
          ay = p[3 * a + 1] as number,
          az = p[3 * a + 2] as number;
        const bx = p[3 * b] as number,
          by = p[3 * b + 1] as number,
          bz = p[3 * b + 2] as number;
        const cx = p[3 * c] as number,
          cy = p[3 * c + 1] as number,
          cz = p[3 * c + 2] as number;
        const squared = nearestOnTriangle(
          m0 * ax + m1 * ay + m2 * az + m3,
          m4 * ax + m5 * ay + m6 * az + m7,
          m8 * ax + m9 * ay + m10 * az + m11,
          m0 * bx + m1 * by + m2 * bz + m3,
          m4 * bx + m5 * by + m6 * bz + m7,
          m8 * bx + m9 * by + m10 * bz + m11,
          m0 * cx + m1 * cy + m2 * cz + m3,
          m4 * cx + m5 * cy + m6 * cz + m7,
          m8 * cx + m9 * cy + m10 * cz + m11,
          candidate,
        );
        if (!(squared < this.squared)) continue;
        this.squared = squared;
        this.triangle = triangle;
        this.instance = instance;
        this.nearest.set(candidate);
      }
    }
  }

  /**
   * The next leaf nearer than what was found, in the hierarchy whose root was put at `base` of the stack, without its
   * mark; −1 at the end.
   */
  #nextLeaf(
    nodes: Float32Array,
    words: Uint32Array,
    x: number,
    y: number,
    z: number,
    scale: number,
    base: number,
  ): number {
    const references = this.#references,
      bounds = this.#bounds;
    const limit = this.squared;
    let top = this.#top;
    while (top > base) {
      let reference = references[--top] as number;
      if (!((bounds[top] as number) < limit)) continue;
      while (reference < LEAF) {
        const at = reference * NODE_WORDS;
        const left = boxDistance(nodes, at + LEFT_MIN, x, y, z) * scale;
        const right = nodes[at + RIGHT_MIN] === FAR ? Infinity : boxDistance(nodes, at + RIGHT_MIN, x, y, z) * scale;
        if (left < limit && right < limit) {
          const swap = right < left;
          bounds[top] = swap ? left : right;
          references[top++] = words[at + (swap ? LEFT : RIGHT)] as number;
          reference = words[at + (swap ? RIGHT : LEFT)] as number;
        } else if (left < limit) reference = words[at + LEFT] as number;
        else if (right < limit) reference = words[at + RIGHT] as number;
        else break;
      }
      if (reference < LEAF) continue;
      this.#top = top;
      return reference - LEAF;
    }
    this.#top = top;
    return -1;
  }
}

/** Squared distance to the box whose corners lie at `low` and four words on. */
function boxDistance(nodes: Float32Array, low: number, x: number, y: number, z: number): number {
  const dx = Math.max((nodes[low] as number) - x, 0, x - (nodes[low + 4] as number));
  const dy = Math.max((nodes[low + 1] as number) - y, 0, y - (nodes[low + 5] as number));
  const dz = Math.max((nodes[low + 2] as number) - z, 0, z - (nodes[low + 6] as number));
  return dx * dx + dy * dy + dz * dz;
}

let shared: DistanceWalk | undefined;

/** Point queries have no callbacks, so that only one runs at a time and all can share this. */
const walker = (): DistanceWalk => (shared ??= new DistanceWalk());

function result({ x, y, z, nearest: n, triangle, instance, squared }: DistanceWalk): InstanceNearPoint | undefined {
  if (triangle < 0) return undefined;
  return {
    distance: Math.sqrt(squared),
    point: [x + (n[0] as number), y + (n[1] as number), z + (n[2] as number)],
    triangle,
    u: n[3] as number,
    v: n[4] as number,
    instance,
  };
}

/**
 * The point of a mesh that is nearest to a point; `undefined` if none is nearer than `maxDistance`. In double
 * precision.
 *
 * @param mesh What the BLAS was built, or last refitted, for.
 * @param point xyz.
 * @example
 * const near = closestPoint(blas, mesh, [0, 1, 2]);
 * if (near) console.log(near.distance, near.point, near.triangle);
 */
export function closestPoint(
  blas: Blas,
  mesh: TriangleMesh,
  point: ArrayLike<number>,
  { maxDistance = Infinity }: DistanceOptions = {},
): NearPoint | undefined {
  const walk = walker();
  walk.start(point, 0, maxDistance);
  walk.near(blas, mesh);
  const found = result(walk);
  if (!found) return undefined;
  const { distance, point: at, triangle, u, v } = found;
  return { distance, point: at, triangle, u, v };
}

/**
 * The nearest point of all instances; distances are the world's, whatever the transforms.
 * @param instances BLAS and mesh of each instance, in the order given to `buildTlas`.
 */
export function closestPointInstances(
  tlas: Tlas,
  instances: readonly BlasMesh[],
  point: ArrayLike<number>,
  { maxDistance = Infinity }: DistanceOptions = {},
): InstanceNearPoint | undefined {
  const walk = walker();
  walk.start(point, 0, maxDistance);
  walk.nearInstances(tlas, instances);
  return result(walk);
}

/** Output of a batch of point queries. Arrays may be longer than needed. */
export interface DistanceBatch {
  /** Infinity where no triangle is nearer than `maxDistance`. */
  readonly distance: Float32Array | Float64Array;
  /** Triangle of the mesh; −1 for none. */
  readonly triangle?: Int32Array;
  /** Instance, as given to `buildTlas`; −1 for none; 0 without instances. */
  readonly instance?: Int32Array;
  /** xyz, on the mesh, stride 3. Untouched where there is none. */
  readonly point?: Float32Array | Float64Array;
  /** Barycentrics, as {@link NearPoint} has them. Untouched where there is none. */
  readonly u?: Float32Array | Float64Array;
  readonly v?: Float32Array | Float64Array;
}

function batch(
  points: ArrayLike<number>,
  out: DistanceBatch,
  maxDistance: number,
  go: (walk: DistanceWalk) => void,
): void {
  const count = points.length / 3;
  if (!Number.isInteger(count))
    throw new BvhError('bvh/batch', `points has ${points.length} numbers; it must have three a point.`);
  for (const [name, array] of Object.entries(out) as [string, ArrayLike<number> | undefined][]) {
    const needed = name === 'point' ? 3 * count : count;
    if (array && array.length < needed)
      throw new BvhError('bvh/batch', `out.${name} has ${array.length} entries; ${count} points need ${needed}.`);
  }
  const walk = walker(),
    { nearest } = walk;
  for (let i = 0; i < count; i++) {
    walk.start(points, 3 * i, maxDistance);
    go(walk);
    if (out.triangle) out.triangle[i] = walk.triangle;
    if (out.instance) out.instance[i] = walk.instance;
    out.distance[i] = walk.triangle < 0 ? Infinity : Math.sqrt(walk.squared);
    if (walk.triangle < 0) continue;
    if (out.u) out.u[i] = nearest[3] as number;
    if (out.v) out.v[i] = nearest[4] as number;
    if (!out.point) continue;
    out.point[3 * i] = walk.x + (nearest[0] as number);
    out.point[3 * i + 1] = walk.y + (nearest[1] as number);
    out.point[3 * i + 2] = walk.z + (nearest[2] as number);
  }
}

/**
 * The nearest point of a mesh for each of many points, written into the caller's arrays: nothing is allocated per
 * point.
 *
 * @param points xyz, stride 3.
 * @throws {BvhError} `bvh/batch` for arrays of a wrong length.
 */
export function closestPointBatch(
  blas: Blas,
  mesh: TriangleMesh,
  points: Float32Array | Float64Array,
  out: DistanceBatch,
  { maxDistance = Infinity }: DistanceOptions = {},
): void {
  batch(points, out, maxDistance, (walk) => walk.near(blas, mesh));
}

/** The nearest point of all instances for each of many points. See {@link closestPointBatch}. */
export function closestPointBatchInstances(
  tlas: Tlas,
  instances: readonly BlasMesh[],
  points: Float32Array | Float64Array,
  out: DistanceBatch,
  { maxDistance = Infinity }: DistanceOptions = {},
): void {
  batch(points, out, maxDistance, (walk) => walk.nearInstances(tlas, instances));
}
