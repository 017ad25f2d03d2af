import type { Blas } from '../blas';
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
import { intersectTriangle, prepareRay, RAY_NUMBERS } from './triangle';
import { wordsOf } from './words';

/** Mesh and hierarchy of an instance. */
export interface BlasMesh {
  readonly blas: Blas;
  readonly mesh: TriangleMesh;
}

/**
 * Called with the numbers of a hit, so that nothing is allocated; true ends the traversal. `instance` is 0 for a single
 * level.
 */
export type HitVisitor = (t: number, u: number, v: number, triangle: number, instance: number) => boolean | void;

/** Moves the far side of a box out by more than rounding can move it in. */
const OUTWARD = 2 ** -50;

/** Where a ray enters the box whose corners lie at `low` and four words on; Infinity if it does not. */
function enter(nodes: Float32Array, low: number, ray: Float64Array, tMin: number, tMax: number): number {
  const x0 = ((nodes[low] as number) - (ray[15] as number)) * (ray[3] as number),
    x1 = ((nodes[low + 4] as number) - (ray[18] as number)) * (ray[3] as number);
  const y0 = ((nodes[low + 1] as number) - (ray[16] as number)) * (ray[4] as number),
    y1 = ((nodes[low + 5] as number) - (ray[19] as number)) * (ray[4] as number);
  const z0 = ((nodes[low + 2] as number) - (ray[17] as number)) * (ray[5] as number),
    z1 = ((nodes[low + 6] as number) - (ray[20] as number)) * (ray[5] as number);
  const near = Math.max(Math.min(x0, x1), Math.min(y0, y1), Math.min(z0, z1), tMin);
  const far = Math.min(Math.max(x0, x1), Math.max(y0, y1), Math.max(z0, z1), tMax);
  return near <= far + Math.abs(far) * OUTWARD ? near : Infinity;
}

/**
 * The traversal of one level or two by a ray, nearer boxes first. One object serves any number of rays in sequence and
 * allocates no memory.
 */
export class RayWalk {
  /** The end of the ray; of the last hit, once there is one. */
  t = 0;
  u = 0;
  v = 0;
  /** Triangle of the mesh; −1: no hit yet. */
  triangle = -1;
  instance = -1;
  #tMin = 0;
  readonly #origin = new Float64Array(3);
  readonly #direction = new Float64Array(3);
  /** Nodes and leaves yet to visit, and where the ray enters them. A BLAS pushes its own above those of the TLAS. */
  readonly #references = new Uint32Array(BVH_STACK_SIZE);
  readonly #entries = new Float64Array(BVH_STACK_SIZE);
  #top = 0;
  readonly #world = new Float64Array(RAY_NUMBERS);
  readonly #local = new Float64Array(RAY_NUMBERS);
  readonly #localOrigin = new Float64Array(3);
  readonly #localDirection = new Float64Array(3);
  readonly #hit = new Float64Array(3);

  /** Starts the ray whose origin lies at `o[i]` and whose direction at `d[j]`. */
  start(o: ArrayLike<number>, i: number, d: ArrayLike<number>, j: number, tMin: number, tMax: number): void {
    for (let k = 0; k < 3; k++) {
      this.#origin[k] = o[i + k] as number;
      this.#direction[k] = d[j + k] as number;
    }
    this.#tMin = tMin;
    this.t = tMax;
    this.triangle = this.instance = -1;
    this.#top = 0;
  }

  /** Traverses one BLAS; with `any`, up to the first hit. A visitor gets all hits in no order, and t is unchanged. */
  through(blas: Blas, mesh: TriangleMesh, any: boolean, visit?: HitVisitor): void {
    if (blas.triangleIndices.length === 0) return;
    prepareRay(this.#world, this.#origin, this.#direction, blas.bounds);
    this.#search(blas, mesh, this.#world, 0, any, visit);
  }

  /** Traverses all instances. */
  throughInstances(tlas: Tlas, instances: readonly BlasMesh[], any: boolean, visit?: HitVisitor): void {
    if (tlas.instanceOrder.length === 0) return;
    const { nodes, instanceOrder, toObject: m } = tlas;
    const origin = this.#origin,
      direction = this.#direction;
    prepareRay(this.#world, origin, direction, tlas.bounds);
    const words = wordsOf(nodes);
    this.#push(0, -Infinity);
    for (;;) {
      const leaf = this.#nextLeaf(nodes, words, this.#world, 0);
      if (leaf < 0) return;
      const instance = instanceOrder[leafFirst(leaf)] as number;
      const { blas, mesh } = instances[instance] as BlasMesh;
      const from = this.#localOrigin,
        to = this.#localDirection;
      for (let k = 0, r = 12 * instance; k < 3; k++, r += 4) {
        const a = m[r] as number,
          b = m[r + 1] as number,
          c = m[r + 2] as number;
        from[k] =
          a * (origin[0] as number) + b * (origin[1] as number) + c * (origin[2] as number) + (m[r + 3] as number);
        to[k] = a * (direction[0] as number) + b * (direction[1] as number) + c * (direction[2] as number);
      }
      prepareRay(this.#local, from, to, blas.bounds);
      if (this.#search(blas, mesh, this.#local, instance, any, visit)) return;
    }
  }

  #push(reference: number, entry: number): void {
    this.#entries[this.#top] = entry;
    this.#references[this.#top++] = reference;
  }

  /** Tests the triangles along the ray. @returns Whether the traversal is over. */
  #search(
    blas: Blas,
    { positions, indices }: TriangleMesh,
    ray: Float64Array,
    instance: number,
    any: boolean,
    visit: HitVisitor | undefined,
  ): boolean {
    const { nodes, triangleIndices } = blas;
    const hit = this.#hit,
      tMin = this.#tMin;
    const base = this.#top;
    const words = wordsOf(nodes);
    this.#push(0, -Infinity);
    for (;;) {
      const leaf = this.#nextLeaf(nodes, words, ray, base);
      if (leaf < 0) return false;
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
        if (!intersectTriangle(ray, positions, 3 * a, 3 * b, 3 * c, hit)) continue;
        const t = hit[0] as number;
        if (!(t > tMin && t < this.t)) continue;
        if (visit) {
          if (visit(t, hit[1] as number, hit[2] as number, triangle, instance) === true) return true;
          continue;
        }
        this.t = t;
        this.u = hit[1] as number;
        this.v = hit[2] as number;
        this.triangle = triangle;
        this.instance = instance;
        if (any) return true;
      }
    }
  }

  /**
   * The next leaf that the ray meets in the hierarchy whose root was put at `base` of the stack, without its mark; −1
   * at the end.
   */
  #nextLeaf(nodes: Float32Array, words: Uint32Array, ray: Float64Array, base: number): number {
    const references = this.#references,
      entries = this.#entries;
    const tMin = this.#tMin,
      tMax = this.t;
    let top = this.#top;
    while (top > base) {
      let reference = references[--top] as number;
      if ((entries[top] as number) > tMax + Math.abs(tMax) * OUTWARD) continue;
      while (reference < LEAF) {
        const at = reference * NODE_WORDS;
        const left = enter(nodes, at + LEFT_MIN, ray, tMin, tMax),
          right = enter(nodes, at + RIGHT_MIN, ray, tMin, tMax);
        const inLeft = left < Infinity;
        // A tree of one leaf has no right child; its place must not lead there a second time.
        const inRight = right < Infinity && nodes[at + RIGHT_MIN] !== FAR;
        if (inLeft && inRight) {
          const swap = right < left;
          entries[top] = swap ? left : right;
          references[top++] = words[at + (swap ? LEFT : RIGHT)] as number;
          reference = words[at + (swap ? RIGHT : LEFT)] as number;
        } else if (inLeft) reference = words[at + LEFT] as number;
        else if (inRight) reference = words[at + RIGHT] as number;
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

const idle: RayWalk[] = [];

/** A walk that is not in use, as visitors may run further queries. Return it with {@link giveBack}. */
export const borrow = (): RayWalk => idle.pop() ?? new RayWalk();

/** Returns a walk to the pool. After an exception it is garbage collected instead. */
export const giveBack = (walk: RayWalk): void => void idle.push(walk);
