import type { WgslModule } from '@glanz/wgsl/module';
import { WIDE_STACK_SIZE } from '../../wide/layout';
import { withStack, type BvhQuery } from '../stack';
import { bvhTypes } from './types';
import anyHit from './wide_any_hit.wesl';
import closestHit from './wide_closest_hit.wesl';

const traversal = (query: BvhQuery, stackSize = WIDE_STACK_SIZE): WgslModule =>
  withStack(query === 'any' ? anyHit : closestHit, bvhTypes, query, stackSize, WIDE_STACK_SIZE);

/**
 * `fn bvh_closest_hit(origin: vec3f, direction: vec3f, t_min: f32, t_max: f32) -> BvhHit` over the wide layout of
 * `widenBlas` and `widenTlas`: everything else is as in the module of the same name of `@glanz/bvh/wgsl`, the functions
 * that the host supplies too, so a host chooses a layout by its import.
 */
export const bvhClosestHit: WgslModule = traversal('closest');

/**
 * `fn bvh_any_hit(origin: vec3f, direction: vec3f, t_min: f32, t_max: f32) -> bool` over the wide layout. See
 * {@link bvhClosestHit}.
 */
export const bvhAnyHit: WgslModule = traversal('any');

/**
 * {@link bvhClosestHit} or {@link bvhAnyHit} with a stack for trees that are less deep than they might be: see the
 * function of the same name of `@glanz/bvh/wgsl`.
 *
 * @param stackSize Entries. As `packHierarchy` tells it, or more. With less, rays lose hits where they enter more than
 * it holds.
 * @throws {BvhError} `bvh/options` for what is no whole number from 3 to `BVH_STACK_SIZE`.
 */
export const bvhTraversal = (query: BvhQuery, stackSize: number): WgslModule => traversal(query, stackSize);
