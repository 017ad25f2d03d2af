import type { Blas } from '../blas';
import type { TriangleMesh } from '../layout';
import { BvhError } from '../error';
import type { Tlas } from '../tlas';
import { rayCount, startRay } from './batch';
import { VisitedSet } from './visited-set';
import type { Hit, InstanceHit, Ray } from './queries';
import { borrow, giveBack, type BlasMesh, type HitVisitor } from './walk';

export type { HitVisitor } from './walk';

/** Filters hits for a visitor: a triangle that is in several leaves is reported once. */
class HitFilter {
  readonly #visited = new VisitedSet();
  #blas: Blas | undefined;
  #instances: readonly BlasMesh[] = [];
  #visit: HitVisitor = () => undefined;
  readonly visitor: HitVisitor = (t, u, v, triangle, instance) =>
    this.#visited.first(this.#blas ?? (this.#instances[instance] as BlasMesh).blas, triangle, instance) &&
    this.#visit(t, u, v, triangle, instance) === true;

  /** For one BLAS, or for the instances. */
  over(blas: Blas | undefined, instances: readonly BlasMesh[], visit: HitVisitor): HitVisitor {
    this.#blas = blas;
    this.#instances = instances;
    this.#visit = visit;
    return this.next();
  }

  /** For another ray. */
  next(): HitVisitor {
    this.#visited.start();
    return this.visitor;
  }
}

const idle: HitFilter[] = [];
const NONE: readonly BlasMesh[] = [];

/**
 * Reports every triangle that a ray hits, from either side, in no particular order and without allocating anything.
 * Where a ray passes through an edge or a vertex, it meets each triangle there.
 *
 * @param visit Gets t, u, v and the triangle, as in `Hit`; true ends the query. May itself run further queries.
 */
export function forEachHit(
  blas: Blas,
  mesh: TriangleMesh,
  { origin, direction, tMin = 0, tMax = Infinity }: Ray,
  visit: HitVisitor,
): void {
  const walk = borrow();
  walk.start(origin, 0, direction, 0, tMin, tMax);
  const filter = idle.pop() ?? new HitFilter();
  walk.through(blas, mesh, false, filter.over(blas, NONE, visit));
  idle.push(filter);
  giveBack(walk);
}

/** Reports every triangle of all instances that a ray hits. See {@link forEachHit}. */
export function forEachHitInstances(
  tlas: Tlas,
  instances: readonly BlasMesh[],
  { origin, direction, tMin = 0, tMax = Infinity }: Ray,
  visit: HitVisitor,
): void {
  const walk = borrow();
  walk.start(origin, 0, direction, 0, tMin, tMax);
  const filter = idle.pop() ?? new HitFilter();
  walk.throughInstances(tlas, instances, false, filter.over(undefined, instances, visit));
  idle.push(filter);
  giveBack(walk);
}

/** All triangles that a ray meets, from either side, the nearest first; those of one distance by their number. */
export function allHits(blas: Blas, mesh: TriangleMesh, ray: Ray): Hit[] {
  const hits: Hit[] = [];
  forEachHit(blas, mesh, ray, (t, u, v, triangle) => void hits.push({ t, u, v, triangle }));
  return hits.sort((a, b) => a.t - b.t || a.triangle - b.triangle);
}

/** All triangles of all instances that a ray meets, the nearest first. */
export function allHitsInstances(tlas: Tlas, instances: readonly BlasMesh[], ray: Ray): InstanceHit[] {
  const hits: InstanceHit[] = [];
  forEachHitInstances(
    tlas,
    instances,
    ray,
    (t, u, v, triangle, instance) => void hits.push({ t, u, v, triangle, instance }),
  );
  return hits.sort((a, b) => a.t - b.t || a.instance - b.instance || a.triangle - b.triangle);
}

/**
 * Output of {@link allHitsBatch}. The arrays of hits have any length; hits beyond it are counted, not stored.
 */
export interface AllHitsBatch {
  /**
   * One entry more than there are rays: the hits of ray i are those from `starts[i]` up to `starts[i + 1]`, in no
   * order.
   */
  readonly starts: Uint32Array;
  readonly triangle: Uint32Array;
  readonly t?: Float32Array | Float64Array;
  readonly u?: Float32Array | Float64Array;
  readonly v?: Float32Array | Float64Array;
}

/**
 * All triangles that each of many rays meets, written one ray after the other into the caller's arrays.
 *
 * @param rays 8 numbers a ray: origin xyz, tMin, direction xyz, tMax.
 * @returns How many hits there are: where that is more than `out.triangle` holds, call again with longer arrays.
 * @throws {BvhError} `bvh/batch` for arrays of a wrong length.
 */
export function allHitsBatch(
  blas: Blas,
  mesh: TriangleMesh,
  rays: Float32Array | Float64Array,
  out: AllHitsBatch,
): number {
  const { starts, triangle: triangles, t: ts, u: us, v: vs } = out;
  const count = rayCount(rays, {});
  if (starts.length <= count)
    throw new BvhError('bvh/batch', `out.starts has ${starts.length} entries; ${count} rays need ${count + 1}.`);
  let found = 0;
  const visit: HitVisitor = (t, u, v, triangle) => {
    triangles[found] = triangle;
    if (ts) ts[found] = t;
    if (us) us[found] = u;
    if (vs) vs[found] = v;
    found++;
  };
  const walk = borrow();
  const filter = new HitFilter();
  filter.over(blas, NONE, visit);
  for (let ray = 0; ray < count; ray++) {
    starts[ray] = found;
    startRay(walk, rays, ray);
    walk.through(blas, mesh, false, filter.next());
  }
  starts[count] = found;
  giveBack(walk);
  return found;
}
