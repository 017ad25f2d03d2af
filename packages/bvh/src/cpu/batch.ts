import type { Blas } from '../blas';
import type { TriangleMesh } from '../layout';
import { BvhError } from '../error';
import type { Tlas } from '../tlas';
import { borrow, giveBack, type BlasMesh, type RayWalk } from './walk';

/** Words of a ray in a batch. */
export const RAY_WORDS = 8;

/**
 * Output of a batch of rays. Arrays may be longer than needed; entries beyond the rays are unchanged.
 */
export interface HitBatch {
  /** Distance in units of the ray's direction; Infinity for a miss. */
  readonly t: Float32Array | Float64Array;
  /** Triangle of the mesh; −1 for a miss. */
  readonly triangle: Int32Array;
  /** Barycentrics: the point is (1 − u − v) v0 + u v1 + v v2. Untouched for a miss. */
  readonly u?: Float32Array | Float64Array;
  readonly v?: Float32Array | Float64Array;
  /** Instance, as given to `buildTlas`; −1 for a miss. Only written by {@link closestHitBatchInstances}. */
  readonly instance?: Int32Array;
}

/** How many rays there are. Throws where an array of the output is too short. */
export function rayCount(rays: ArrayLike<number>, out: object): number {
  const count = rays.length / RAY_WORDS;
  if (!Number.isInteger(count))
    throw new BvhError(
      'bvh/batch',
      `rays has ${rays.length} numbers; it must have ${RAY_WORDS} a ray: origin xyz, tMin, direction xyz, tMax.`,
    );
  for (const [name, array] of Object.entries(out) as [string, ArrayLike<number> | undefined][]) {
    if (array && array.length < count)
      throw new BvhError('bvh/batch', `out.${name} has ${array.length} entries; ${count} rays need as many.`);
  }
  return count;
}

/** Starts a ray of a batch. */
export function startRay(walk: RayWalk, rays: ArrayLike<number>, ray: number): void {
  const at = RAY_WORDS * ray;
  walk.start(rays, at, rays, at + 4, rays[at + 3] as number, rays[at + 7] as number);
}

/** Traces each ray in turn and reports it; allocates nothing per ray. */
function each(
  rays: ArrayLike<number>,
  out: object,
  go: (walk: RayWalk) => void,
  done: (ray: number, walk: RayWalk) => void,
): void {
  const count = rayCount(rays, out);
  const walk = borrow();
  for (let ray = 0; ray < count; ray++) {
    startRay(walk, rays, ray);
    go(walk);
    done(ray, walk);
  }
  giveBack(walk);
}

function closest(rays: ArrayLike<number>, out: HitBatch, go: (walk: RayWalk) => void): void {
  each(rays, out, go, (ray, { t, u, v, triangle, instance }) => {
    out.triangle[ray] = triangle;
    if (out.instance) out.instance[ray] = instance;
    out.t[ray] = triangle < 0 ? Infinity : t;
    if (triangle < 0) return;
    if (out.u) out.u[ray] = u;
    if (out.v) out.v[ray] = v;
  });
}

/**
 * The nearest triangle that each of many rays meets, written into the caller's arrays: nothing is allocated per ray.
 *
 * @param rays 8 numbers a ray: origin xyz, tMin, direction xyz, tMax, as GPU kernels read them; see `Ray`.
 * @throws {BvhError} `bvh/batch` for arrays of a wrong length.
 * @example
 * const out = { t: new Float32Array(count), triangle: new Int32Array(count) };
 * closestHitBatch(blas, mesh, rays, out);
 */
export function closestHitBatch(
  blas: Blas,
  mesh: TriangleMesh,
  rays: Float32Array | Float64Array,
  out: HitBatch,
): void {
  closest(rays, out, (walk) => walk.through(blas, mesh, false));
}

/** The nearest triangle of all instances for each of many rays. See {@link closestHitBatch}. */
export function closestHitBatchInstances(
  tlas: Tlas,
  instances: readonly BlasMesh[],
  rays: Float32Array | Float64Array,
  out: HitBatch,
): void {
  closest(rays, out, (walk) => walk.throughInstances(tlas, instances, false));
}

/**
 * Whether each of many rays meets any triangle: 1 or 0. See {@link closestHitBatch}.
 * @throws {BvhError} `bvh/batch` for arrays of a wrong length.
 */
export function anyHitBatch(blas: Blas, mesh: TriangleMesh, rays: Float32Array | Float64Array, hit: Uint8Array): void {
  each(
    rays,
    { hit },
    (walk) => walk.through(blas, mesh, true),
    (ray, { triangle }) => void (hit[ray] = triangle < 0 ? 0 : 1),
  );
}

/** Whether each of many rays meets a triangle of any instance. See {@link anyHitBatch}. */
export function anyHitBatchInstances(
  tlas: Tlas,
  instances: readonly BlasMesh[],
  rays: Float32Array | Float64Array,
  hit: Uint8Array,
): void {
  each(
    rays,
    { hit },
    (walk) => walk.throughInstances(tlas, instances, true),
    (ray, { triangle }) => void (hit[ray] = triangle < 0 ? 0 : 1),
  );
}
