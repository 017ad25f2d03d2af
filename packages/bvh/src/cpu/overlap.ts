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
import { VisitedSet } from './visited-set';
import { INSIDE, OUTSIDE, type NumberedRegion, type Region } from './regions';
import { toWorld } from './to-world';
import type { BlasMesh } from './walk';
import { wordsOf } from './words';

export {
  ACROSS,
  BoxRegion,
  ConvexRegion,
  frustumPlanes,
  INSIDE,
  OUTSIDE,
  SphereRegion,
  type NumberedRegion,
  type Region,
} from './regions';

/** Called with a triangle that overlaps; true ends the query. `instance` is 0 for a single level. */
export type OverlapVisitor = (triangle: number, instance: number) => boolean | void;

/**
 * A region of the world as the triangles of an instance see it. Boxes are tested by their bounds in world
 * space.
 */
class PlacedRegion implements Region {
  region!: Region;
  readonly toWorld = new Float64Array(12);

  box(x0: number, y0: number, z0: number, x1: number, y1: number, z1: number): number {
    const m = this.toWorld;
    // Summed up like the corners of triangles, so that rounding leaves none outside.
    const low = (r: number) => {
      const a = m[r] as number,
        b = m[r + 1] as number,
        c = m[r + 2] as number;
      return Math.min(a * x0, a * x1) + Math.min(b * y0, b * y1) + Math.min(c * z0, c * z1) + (m[r + 3] as number);
    };
    const high = (r: number) => {
      const a = m[r] as number,
        b = m[r + 1] as number,
        c = m[r + 2] as number;
      return Math.max(a * x0, a * x1) + Math.max(b * y0, b * y1) + Math.max(c * z0, c * z1) + (m[r + 3] as number);
    };
    return this.region.box(low(0), low(4), low(8), high(0), high(4), high(8));
  }

  triangle(
    ax: number,
    ay: number,
    az: number,
    bx: number,
    by: number,
    bz: number,
    cx: number,
    cy: number,
    cz: number,
  ): boolean {
    const m = this.toWorld;
    const m0 = m[0] as number,
      m1 = m[1] as number,
      m2 = m[2] as number,
      m3 = m[3] as number;
    const m4 = m[4] as number,
      m5 = m[5] as number,
      m6 = m[6] as number,
      m7 = m[7] as number;
    const m8 = m[8] as number,
      m9 = m[9] as number,
      m10 = m[10] as number,
      m11 = m[11] as number;
    return this.region.triangle(
      m0 * ax + m1 * ay + m2 * az + m3,
      m4 * ax + m5 * ay + m6 * az + m7,
      m8 * ax + m9 * ay + m10 * az + m11,
      m0 * bx + m1 * by + m2 * bz + m3,
      m4 * bx + m5 * by + m6 * bz + m7,
      m8 * bx + m9 * by + m10 * bz + m11,
      m0 * cx + m1 * cy + m2 * cz + m3,
      m4 * cx + m5 * cy + m6 * cz + m7,
      m8 * cx + m9 * cy + m10 * cz + m11,
    );
  }
}

/** The traversal of one level or two for a region. Made once, it serves any number of regions and allocates nothing. */
class OverlapWalk {
  /**
   * Nodes and leaves yet to visit, and whether they lie inside the region. A BLAS pushes its own above those of the
   * TLAS.
   */
  readonly #references = new Uint32Array(BVH_STACK_SIZE);
  readonly #inside = new Uint8Array(BVH_STACK_SIZE);
  #top = 0;
  /** Whether the leaf that was found last lies inside the region. */
  #leafInside = false;
  readonly #placed = new PlacedRegion();
  readonly #visited = new VisitedSet();

  /** Whether the visitor has ended it. */
  through(blas: Blas, mesh: TriangleMesh, region: Region, visit: OverlapVisitor): boolean {
    this.#visited.start();
    return this.#search(blas, mesh, region, 0, false, visit);
  }

  #search(
    blas: Blas,
    { positions: p, indices }: TriangleMesh,
    region: Region,
    instance: number,
    inside: boolean,
    visit: OverlapVisitor,
  ): boolean {
    const { nodes, triangleIndices } = blas;
    if (triangleIndices.length === 0) return false;
    const words = wordsOf(nodes);
    const base = this.#top;
    this.#push(0, inside);
    for (;;) {
      const leaf = this.#nextLeaf(nodes, words, region, base);
      if (leaf < 0) return false;
      const all = this.#leafInside;
      const first = leafFirst(leaf),
        end = first + leafCount(leaf);
      for (let i = first; i < end; i++) {
        const triangle = triangleIndices[i] as number;
        if (!all) {
          let a = 3 * triangle,
            b = a + 1,
            c = a + 2;
          if (indices) {
            a = indices[a] as number;
            b = indices[b] as number;
            c = indices[c] as number;
          }
          a *= 3;
          b *= 3;
          c *= 3;
          if (
            !region.triangle(
              p[a] as number,
              p[a + 1] as number,
              p[a + 2] as number,
              p[b] as number,
              p[b + 1] as number,
              p[b + 2] as number,
              p[c] as number,
              p[c + 1] as number,
              p[c + 2] as number,
            )
          )
            continue;
        }
        if (!this.#visited.first(blas, triangle, instance) || visit(triangle, instance) !== true) continue;
        this.#top = base;
        return true;
      }
    }
  }

  throughInstances(
    { nodes, instanceOrder, toObject }: Tlas,
    instances: readonly BlasMesh[],
    region: Region,
    visit: OverlapVisitor,
  ): boolean {
    if (instanceOrder.length === 0) return false;
    const words = wordsOf(nodes);
    const placed = this.#placed;
    placed.region = region;
    this.#visited.start();
    const base = this.#top;
    this.#push(0, false);
    for (;;) {
      const leaf = this.#nextLeaf(nodes, words, region, base);
      if (leaf < 0) return false;
      const instance = instanceOrder[leafFirst(leaf)] as number;
      const { blas, mesh } = instances[instance] as BlasMesh;
      toWorld(toObject, 12 * instance, placed.toWorld);
      if (!this.#search(blas, mesh, placed, instance, this.#leafInside, visit)) continue;
      this.#top = base;
      return true;
    }
  }

  #push(reference: number, inside: boolean): void {
    this.#inside[this.#top] = inside ? 1 : 0;
    this.#references[this.#top++] = reference;
  }

  /** The next leaf that may overlap, without its mark; −1 at the end. */
  #nextLeaf(nodes: Float32Array, words: Uint32Array, region: Region, base: number): number {
    while (this.#top > base) {
      const reference = this.#references[--this.#top] as number;
      const all = this.#inside[this.#top] === 1;
      if (reference >= LEAF) {
        this.#leafInside = all;
        return reference - LEAF;
      }
      const at = reference * NODE_WORDS;
      const right = nodes[at + RIGHT_MIN] === FAR ? OUTSIDE : all ? INSIDE : where(nodes, at + RIGHT_MIN, region);
      const left = all ? INSIDE : where(nodes, at + LEFT_MIN, region);
      if (right !== OUTSIDE) this.#push(words[at + RIGHT] as number, right === INSIDE);
      if (left !== OUTSIDE) this.#push(words[at + LEFT] as number, left === INSIDE);
    }
    return -1;
  }
}

/** Asks about the box whose corners lie at `low` and four words on. */
const where = (nodes: Float32Array, low: number, region: Region): number =>
  region.box(
    nodes[low] as number,
    nodes[low + 1] as number,
    nodes[low + 2] as number,
    nodes[low + 4] as number,
    nodes[low + 5] as number,
    nodes[low + 6] as number,
  );

const idle: OverlapWalk[] = [];

/** Visitors may run further queries, so each query has its own traversal. */
function borrowed(go: (walk: OverlapWalk) => boolean): boolean {
  const walk = idle.pop() ?? new OverlapWalk();
  const ended = go(walk);
  idle.push(walk);
  return ended;
}

/**
 * Reports every triangle that has a point in common with a region, in no particular order and without allocating
 * anything.
 *
 * @param mesh What the BLAS was built, or last refitted, for.
 * @param region A {@link BoxRegion}, {@link SphereRegion} or {@link ConvexRegion}, or one of your own.
 * @param visit Gets the triangle; true ends the query. May itself run further queries.
 * @example
 * forEachOverlap(blas, mesh, new SphereRegion([0, 0, 0], 0.5), (triangle) => void selected.add(triangle));
 */
export function forEachOverlap(blas: Blas, mesh: TriangleMesh, region: Region, visit: OverlapVisitor): void {
  borrowed((walk) => walk.through(blas, mesh, region, visit));
}

/**
 * Reports every triangle of all instances that has a point in common with a region of the world. See
 * {@link forEachOverlap}.
 */
export function forEachOverlapInstances(
  tlas: Tlas,
  instances: readonly BlasMesh[],
  region: Region,
  visit: OverlapVisitor,
): void {
  borrowed((walk) => walk.throughInstances(tlas, instances, region, visit));
}

const first = () => true;

/** Whether any triangle has a point in common with a region. See {@link forEachOverlap}. */
export function overlaps(blas: Blas, mesh: TriangleMesh, region: Region): boolean {
  return borrowed((walk) => walk.through(blas, mesh, region, first));
}

/**
 * Whether any triangle of all instances has a point in common with a region of the world. See {@link forEachOverlap}.
 */
export function overlapsInstances(tlas: Tlas, instances: readonly BlasMesh[], region: Region): boolean {
  return borrowed((walk) => walk.throughInstances(tlas, instances, region, first));
}

/**
 * Output of a batch of regions. `triangle` has any length; triangles beyond it are counted, not stored.
 */
export interface OverlapBatch {
  /**
   * One entry more than there are regions: the triangles of region i are those from `starts[i]` up to `starts[i + 1]`,
   * in no order.
   */
  readonly starts: Uint32Array;
  readonly triangle: Uint32Array;
}

/**
 * The triangles in each of many regions of one kind, written one region after the other into the caller's arrays:
 * nothing is allocated per region.
 *
 * @param region Set to the numbers of each region in turn, e.g. `new BoxRegion()`; it has those of the last one
 * afterwards.
 * @param values `region.numbers` numbers a region: 6 a box (min, max), 4 a sphere (center, radius), 4 a plane.
 * @returns How many triangles there are: where that is more than `out.triangle` holds, call again with longer arrays.
 * @throws {BvhError} `bvh/batch` for arrays of a wrong length.
 */
export function overlapBatch(
  blas: Blas,
  mesh: TriangleMesh,
  region: NumberedRegion,
  values: Float32Array | Float64Array,
  out: OverlapBatch,
): number {
  const { starts, triangle: triangles } = out;
  const count = values.length / region.numbers;
  if (!Number.isInteger(count))
    throw new BvhError('bvh/batch', `values has ${values.length} numbers; it must have ${region.numbers} a region.`);
  if (starts.length <= count)
    throw new BvhError('bvh/batch', `out.starts has ${starts.length} entries; ${count} regions need ${count + 1}.`);
  let found = 0;
  const visit = (triangle: number) => void (triangles[found++] = triangle);
  borrowed((walk) => {
    for (let i = 0; i < count; i++) {
      starts[i] = found;
      region.set(values, i * region.numbers);
      walk.through(blas, mesh, region, visit);
    }
    return false;
  });
  starts[count] = found;
  return found;
}
