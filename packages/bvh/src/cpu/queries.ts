import type { Blas } from '../blas';
import type { TriangleMesh } from '../layout';
import type { Tlas } from '../tlas';
import { borrow, giveBack, type BlasMesh, type RayWalk } from './walk';

export type { BlasMesh } from './walk';

/** A ray: points `origin + t · direction` with tMin < t < tMax. */
export interface Ray {
  /** xyz. */
  readonly origin: ArrayLike<number>;
  /** xyz, not zero; need not have unit length. */
  readonly direction: ArrayLike<number>;
  /** Default 0. */
  readonly tMin?: number;
  /** Default Infinity. */
  readonly tMax?: number;
}

/** A point where a ray meets a triangle. */
export interface Hit {
  /** Distance in units of the ray's direction. */
  readonly t: number;
  /** Barycentrics: the point is (1 − u − v) v0 + u v1 + v v2. */
  readonly u: number;
  readonly v: number;
  /** Triangle of the mesh, as its indices count. */
  readonly triangle: number;
}

/** A {@link Hit} on one of several instances. */
export interface InstanceHit extends Hit {
  /** Instance, as given to `buildTlas`. */
  readonly instance: number;
}

const start = ({ origin, direction, tMin = 0, tMax = Infinity }: Ray): RayWalk => {
  const walk = borrow();
  walk.start(origin, 0, direction, 0, tMin, tMax);
  return walk;
};

const end = (walk: RayWalk): RayWalk => {
  giveBack(walk);
  return walk;
};

/**
 * The nearest triangle that a ray meets, from either side; `undefined` if there is none. In double precision,
 * watertight.
 * @param mesh What the BLAS was built, or last refitted, for.
 */
export function closestHit(blas: Blas, mesh: TriangleMesh, ray: Ray): Hit | undefined {
  const walk = start(ray);
  walk.through(blas, mesh, false);
  const { t, u, v, triangle } = end(walk);
  return triangle < 0 ? undefined : { t, u, v, triangle };
}

/** Whether a ray meets any triangle, from either side. */
export function anyHit(blas: Blas, mesh: TriangleMesh, ray: Ray): boolean {
  const walk = start(ray);
  walk.through(blas, mesh, true);
  return end(walk).triangle >= 0;
}

/**
 * The nearest triangle of all instances; t counts along the world's ray.
 * @param instances BLAS and mesh of each instance, in the order given to `buildTlas`.
 */
export function closestHitInstances(tlas: Tlas, instances: readonly BlasMesh[], ray: Ray): InstanceHit | undefined {
  const walk = start(ray);
  walk.throughInstances(tlas, instances, false);
  const { t, u, v, triangle, instance } = end(walk);
  return triangle < 0 ? undefined : { t, u, v, triangle, instance };
}

/** Whether a ray meets a triangle of any instance. See {@link closestHitInstances}. */
export function anyHitInstances(tlas: Tlas, instances: readonly BlasMesh[], ray: Ray): boolean {
  const walk = start(ray);
  walk.throughInstances(tlas, instances, true);
  return end(walk).triangle >= 0;
}
