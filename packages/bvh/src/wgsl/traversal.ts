import type { WgslModule } from '@glanz/wgsl/module';
import { BVH_STACK_SIZE } from '../layout';
import anyHit from './any_hit.wesl';
import closestHit from './closest_hit.wesl';
import { withStack, type BvhQuery } from './stack';
import { bvhTypes } from './types';

const traversal = (query: BvhQuery, stackSize = BVH_STACK_SIZE): WgslModule =>
  withStack(query === 'any' ? anyHit : closestHit, bvhTypes, query, stackSize, BVH_STACK_SIZE);

/**
 * `fn bvh_closest_hit(origin: vec3f, direction: vec3f, t_min: f32, t_max: f32) -> BvhHit`: the nearest triangle with
 * t_min < t < t_max; `instance` is `BVH_MISS` if there is none.
 *
 * The direction need not have unit length; t counts in it, in the world as in object space. It must not be zero. The
 * host supplies, in a module of its own:
 * ```wgsl
 * fn bvh_node(index: u32) -> BvhNode          // TLAS from 0 on, each BLAS from its instances' blas_node on
 * fn bvh_instance(index: u32) -> BvhInstance  // in the TLAS's leaf order; there must be one
 * fn bvh_triangle(index: u32) -> BvhTriangle  // leaf order, each mesh from its instances' triangle_offset on
 * fn bvh_accept(hit: BvhHit) -> bool          // only with the flag BVH_FILTER: may turn a candidate down (alpha test)
 * ```
 * `bvh_accept` may be asked about candidates in any order, and about one that is not the nearest.
 */
export const bvhClosestHit: WgslModule = traversal('closest');

/**
 * `fn bvh_any_hit(origin: vec3f, direction: vec3f, t_min: f32, t_max: f32) -> bool`: whether there is a triangle with
 * t_min < t < t_max. See {@link bvhClosestHit}.
 */
export const bvhAnyHit: WgslModule = traversal('any');

/**
 * {@link bvhClosestHit} or {@link bvhAnyHit} with a smaller stack, for trees of a known depth: WGSL clears the whole
 * stack for each ray. Create it once per pipeline, and do not combine it with the constant of the same query: `compose`
 * refuses two modules of one name.
 *
 * @param stackSize Entries. As `packHierarchy` tells it, or more. With less, rays lose hits where they enter more than
 * it holds.
 * @throws {BvhError} `bvh/options` for what is no whole number from 3 to {@link BVH_STACK_SIZE}.
 */
export const bvhTraversal = (query: BvhQuery, stackSize: number): WgslModule => traversal(query, stackSize);
