import { wgslModule, type WgslModule } from '@glanz/wgsl/module';
import { BVH_STACK_SIZE } from '../layout';
import bvhObjectRay from './object_ray.wesl';
import { checkedStackSize } from './stack-size';
import bvhTriangleTest from './triangle.wesl';
import { bvhTypes } from './types.wgsl';

const box = wgslModule(
  'bvh/box',
  /* wgsl */ `
// Where the ray enters a box, given by the bits of its corners; larger than t_max if it does not. The far side is moved out by eight ulps, so that rounding
// loses no hit on the border (Ize 2013, "Robust BVH Ray Traversal"): half an ulp or two for the sum, and the two and a half
// that WGSL allows for the reciprocal, on both sides.
fn bvh_enter_box(ray: BvhRay, min_words: vec4u, max_words: vec4u, t_min: f32, t_max: f32) -> f32 {
  let low = bitcast<vec3f>(min_words.xyz);
  let high = bitcast<vec3f>(max_words.xyz);
  let near = fma(select(high, low, ray.forward), ray.inverse, ray.near);
  let far = fma(select(low, high, ray.forward), ray.inverse, ray.far);
  let enter = max(max(near.x, near.y), max(near.z, t_min));
  let leave = min(min(far.x, far.y), min(far.z, t_max)) * 1.000001;
  return select(BVH_OUTSIDE, enter, enter <= leave);
}

const BVH_OUTSIDE = 3.4028234e38;
const BVH_LEAF = 0x80000000u;
const BVH_END = 0xffffffffu;
`,
  [bvhTriangleTest],
);

/**
 * Closest-hit and any-hit differ in a few lines, which must be text: a run-time switch would cost registers in both.
 *
 * One loop serves both levels. "reference" is what to look at next; the inner loop goes down until it holds a leaf or
 * an end mark, of which there is one at the bottom of the stack and one where an instance was entered. Bounded, as
 * every reference is visited at most once.
 */
const traversal = (name: 'closest' | 'any', stackSize = BVH_STACK_SIZE): WgslModule => {
  const any = name === 'any';
  // Where the stack may be too small for the trees after all: hits are lost, but rays come to an end. A place is left
  // for the mark of an instance.
  const guard = stackSize < BVH_STACK_SIZE ? `if (top < ${stackSize - 1}u) ` : '';
  return wgslModule(
    `bvh/${name}-hit`,
    /* wgsl */ `
fn bvh_${name}_hit(origin: vec3f, direction: vec3f, t_min: f32, t_max: f32) -> ${any ? 'bool' : 'BvhHit'} {
  var hit = BvhHit(t_max, 0.0, 0.0, 0u, BVH_MISS);
  var stack: array<u32, ${stackSize}>;
  stack[0] = BVH_END;
  var top = 1u;
  var reference = 0u;
  var ray = bvh_ray(origin, direction);
  var frame: BvhFrame;
  var instance = BVH_MISS;
  var first_node = 0u;
  var first_triangle = 0u;
  loop {
    while ((reference & BVH_LEAF) == 0u) {
      let node = bvh_node(first_node + reference);
      let left = bvh_enter_box(ray, node.left_min, node.left_max, t_min, hit.t);
      let right = bvh_enter_box(ray, node.right_min, node.right_max, t_min, hit.t);
      let left_child = node.left_min.w;
      let right_child = node.left_max.w;
      let in_left = left < BVH_OUTSIDE;
      let in_right = right < BVH_OUTSIDE;
      if (in_left && in_right) {
        let swap = right < left;
        ${guard}{
          stack[top] = select(right_child, left_child, swap);
          top++;
        }
        reference = select(left_child, right_child, swap);
      } else if (in_left || in_right) {
        reference = select(right_child, left_child, in_left);
      } else {
        top--;
        reference = stack[top];
      }
    }
    if (reference == BVH_END) {
      if (instance == BVH_MISS) { break; }
      instance = BVH_MISS;
      first_node = 0u;
      ray = bvh_ray(origin, direction);
    } else if (instance == BVH_MISS) {
      instance = reference & 0x7ffffffu;
      let placed = bvh_instance(instance);
      ray = bvh_object_ray(placed, origin, direction);
      frame = bvh_frame(ray.direction);
      first_node = placed.blas_node;
      first_triangle = placed.triangle_offset;
      stack[top] = BVH_END;
      top++;
      reference = 0u;
      continue;
    } else {
      let first = first_triangle + (reference & 0x7ffffffu);
      let end = first + ((reference >> 27u) & 15u) + 1u;
      for (var triangle = first; triangle < end; triangle++) {
        let found = bvh_intersect_triangle(ray.origin, frame, bvh_triangle(triangle));
        if (found.x > t_min && found.x < hit.t) {
          let candidate = BvhHit(found.x, found.y, found.z, triangle, instance);
          //#if BVH_FILTER
          if (!bvh_accept(candidate)) { continue; }
          //#endif
          ${any ? 'return true;' : 'hit = candidate;'}
        }
      }
    }
    top--;
    reference = stack[top];
  }
  return ${any ? 'false' : 'hit'};
}
`,
    [bvhTypes, bvhObjectRay, box],
  );
};

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
 * {@link bvhClosestHit} or {@link bvhAnyHit} with a stack for trees that are less deep than they might be: WGSL clears
 * all of it for each ray. Make it once for each pipeline, and do not put it beside the constant of the same query:
 * `compose` refuses two modules of one name.
 *
 * @param stackSize Entries. As `packHierarchy` tells it, or more. With less, rays lose hits where they enter more than
 * it holds.
 * @throws {BvhError} `bvh/options` for what is no whole number from 3 to {@link BVH_STACK_SIZE}.
 */
export const bvhTraversal = (query: 'closest' | 'any', stackSize: number): WgslModule =>
  traversal(query, checkedStackSize(stackSize, BVH_STACK_SIZE));
