import type { Blas, TriangleMesh } from '../blas';
import { leafCount, leafFirst } from '../layout';
import type { Tlas } from '../tlas';
import { traverse } from './traverse';
import { intersectTriangle, prepareRay, type PreparedRay } from './triangle';

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

/** What an instance is made of. */
export interface BlasMesh {
  readonly blas: Blas;
  readonly mesh: TriangleMesh;
}

const prepare = (ray: Ray): PreparedRay => {
  const { origin: o, direction: d } = ray;
  return prepareRay(o[0] as number, o[1] as number, o[2] as number, d[0] as number, d[1] as number, d[2] as number);
};

interface Found {
  t: number;
  u: number;
  v: number;
  triangle: number;
  instance: number;
}

/** Looks through one BLAS, updating `found`; with `any`, stops at the first hit. */
function search(blas: Blas, mesh: TriangleMesh, ray: PreparedRay, tMin: number, any: boolean, instance: number, found: Found): void {
  if (blas.triangleIndices.length === 0) return;
  const { positions, indices } = mesh;
  const hit = { t: 0, u: 0, v: 0 };
  traverse(blas, ray, tMin, found.t, (reference, end) => {
    const first = leafFirst(reference);
    for (let i = first; i < first + leafCount(reference); i++) {
      const triangle = blas.triangleIndices[i] as number;
      const a = 3 * (indices ? (indices[3 * triangle] as number) : 3 * triangle);
      const b = 3 * (indices ? (indices[3 * triangle + 1] as number) : 3 * triangle + 1);
      const c = 3 * (indices ? (indices[3 * triangle + 2] as number) : 3 * triangle + 2);
      if (intersectTriangle(ray, positions, a, b, c, hit) && hit.t > tMin && hit.t < end) {
        end = hit.t;
        Object.assign(found, hit, { triangle, instance });
        if (any) return -Infinity;
      }
    }
    return end;
  });
}

const start = (ray: Ray): Found => ({ t: ray.tMax ?? Infinity, u: 0, v: 0, triangle: -1, instance: -1 });

/**
 * The nearest triangle that a ray meets, from either side; `undefined` if there is none. In double precision, watertight.
 * @param mesh What the BLAS was built, or last refitted, for.
 */
export function closestHit(blas: Blas, mesh: TriangleMesh, ray: Ray): Hit | undefined {
  const found = start(ray);
  search(blas, mesh, prepare(ray), ray.tMin ?? 0, false, 0, found);
  return found.triangle < 0 ? undefined : { t: found.t, u: found.u, v: found.v, triangle: found.triangle };
}

/** Whether a ray meets any triangle, from either side. */
export function anyHit(blas: Blas, mesh: TriangleMesh, ray: Ray): boolean {
  const found = start(ray);
  search(blas, mesh, prepare(ray), ray.tMin ?? 0, true, 0, found);
  return found.triangle >= 0;
}

function searchInstances(tlas: Tlas, instances: readonly BlasMesh[], ray: Ray, any: boolean): Found {
  const found = start(ray);
  const tMin = ray.tMin ?? 0;
  if (tlas.instanceOrder.length === 0) return found;
  const { origin: o, direction: d } = ray;
  const m = tlas.toObject;
  traverse(tlas, prepare(ray), tMin, found.t, (reference) => {
    const instance = tlas.instanceOrder[leafFirst(reference)] as number;
    const { blas, mesh } = instances[instance] as BlasMesh;
    const at = 12 * instance;
    const row = (r: number, v: ArrayLike<number>) => (m[at + 4 * r] as number) * (v[0] as number) + (m[at + 4 * r + 1] as number) * (v[1] as number) + (m[at + 4 * r + 2] as number) * (v[2] as number);
    const local = prepareRay(row(0, o) + (m[at + 3] as number), row(1, o) + (m[at + 7] as number), row(2, o) + (m[at + 11] as number), row(0, d), row(1, d), row(2, d));
    search(blas, mesh, local, tMin, any, instance, found);
    return any && found.instance >= 0 ? -Infinity : found.t;
  });
  return found;
}

/**
 * The nearest triangle of all instances; t counts along the world's ray.
 * @param instances BLAS and mesh of each instance, in the order given to `buildTlas`.
 */
export function closestHitInstances(tlas: Tlas, instances: readonly BlasMesh[], ray: Ray): InstanceHit | undefined {
  const found = searchInstances(tlas, instances, ray, false);
  return found.instance < 0 ? undefined : { ...found };
}

/** Whether a ray meets a triangle of any instance. See {@link closestHitInstances}. */
export function anyHitInstances(tlas: Tlas, instances: readonly BlasMesh[], ray: Ray): boolean {
  return searchInstances(tlas, instances, ray, true).instance >= 0;
}
