import { wgslModule, type WgslModule } from '@glanz/wgsl/module';
import { bvhTriangleTest } from '../wgsl/triangle.wgsl';
import { bvhRecords } from '../wgsl/types.wgsl';
import { checkedStackSize } from '../wgsl/stack-size';
import { WIDE_STACK_SIZE } from '../wide/layout';
import { bvhNodeStruct } from './structs';

/** The structs of the traversal: `BvhNode`, `BvhInstance`, `BvhTriangle`, `BvhHit` and the constant `BVH_MISS`. */
export const bvhTypes = wgslModule('bvh/wide-types', '', [bvhNodeStruct.module, bvhRecords]);

const children = wgslModule(
  'bvh/wide-children',
  /* wgsl */ `
// Which children of a node a ray enters: nodes by their places in the order of the ray, from bit 24 on, primitives by bits
// counted from the node's first.
struct BvhEntered {
  nodes: u32,
  primitives: u32,
}

// Of a direction's signs: a child's place xor this grows towards where the ray comes from.
fn bvh_octant(direction: vec3f) -> u32 {
  return dot(select(vec3u(0u), vec3u(4u, 2u, 1u), direction >= vec3f(0.0)), vec3u(1u));
}

fn bvh_enter_four(kinds: u32, place: u32, octant: u32, inside: vec4<bool>) -> BvhEntered {
  var entered = BvhEntered(0u, 0u);
  for (var i = 0u; i < 4u; i++) {
    if (inside[i]) {
      let kind = (kinds >> (8u * i)) & 0xffu;
      if (kind >= 0xe0u) { entered.nodes |= 1u << (24u + ((place + i) ^ octant)); }
      else { entered.primitives |= ((1u << (kind >> 5u)) - 1u) << (kind & 31u); }
    }
  }
  return entered;
}

fn bvh_enter_children(ray: BvhRay, octant: u32, node: BvhNode, t_min: f32, t_max: f32) -> BvhEntered {
  // A byte unpacks to its 255th part.
  let steps = node.frame.w;
  let step = vec3f(bitcast<f32>((steps & 0xffu) << 23u), bitcast<f32>((steps & 0xff00u) << 15u), bitcast<f32>((steps & 0xff0000u) << 7u));
  let scale = step * 255.0 * ray.inverse;
  let start = (bitcast<vec3f>(node.frame.xyz) - ray.origin) * ray.inverse;
  // More than all rounding here can be, so that no hit on a border is lost.
  let slack = (abs(start) + abs(scale)) * 4.7683716e-7;
  let near = start - slack;
  let far = start + slack;
  let low_x = node.boxes[0].xy;
  let low_y = node.boxes[0].zw;
  let low_z = node.boxes[1].xy;
  let high_x = node.boxes[1].zw;
  let high_y = node.boxes[2].xy;
  let high_z = node.boxes[2].zw;
  let near_x = select(high_x, low_x, ray.forward.x);
  let near_y = select(high_y, low_y, ray.forward.y);
  let near_z = select(high_z, low_z, ray.forward.z);
  let far_x = select(low_x, high_x, ray.forward.x);
  let far_y = select(low_y, high_y, ray.forward.y);
  let far_z = select(low_z, high_z, ray.forward.z);
  var entered = BvhEntered(0u, 0u);
  for (var half = 0u; half < 2u; half++) {
    let enter = max(max(unpack4x8unorm(near_x[half]) * scale.x + near.x, unpack4x8unorm(near_y[half]) * scale.y + near.y), max(unpack4x8unorm(near_z[half]) * scale.z + near.z, vec4f(t_min)));
    let leave = min(min(unpack4x8unorm(far_x[half]) * scale.x + far.x, unpack4x8unorm(far_y[half]) * scale.y + far.y), min(unpack4x8unorm(far_z[half]) * scale.z + far.z, vec4f(t_max)));
    let four = bvh_enter_four(node.children[2u + half], 4u * half, octant, enter <= leave);
    entered.nodes |= four.nodes;
    entered.primitives |= four.primitives;
  }
  return entered;
}
`,
  [bvhTypes, bvhTriangleTest],
);

/**
 * Closest-hit and any-hit differ in a few lines, which must be text.
 *
 * "group" holds the child nodes of one node that are still to visit: the first of all its child nodes, and a word with those
 * entered (upper byte, the highest bit is next) and those there are (lower byte). The stack takes what is left of a group
 * while one of its nodes is looked at, so one entry a level is enough. One loop serves both levels: "waiting" are the
 * instances of the node of the TLAS that was looked at last. Bounded, as every node and instance is visited at most once.
 */
const traversal = (name: 'closest' | 'any', stackSize = WIDE_STACK_SIZE): WgslModule => {
  const any = name === 'any';
  // Where the stack may be too small for the trees after all: hits are lost, but rays come to an end.
  const guard = stackSize < WIDE_STACK_SIZE ? ` && top < ${stackSize}u` : '';
  return wgslModule(
    `bvh/wide-${name}-hit`,
    /* wgsl */ `
fn bvh_${name}_hit(origin: vec3f, direction: vec3f, t_min: f32, t_max: f32) -> ${any ? 'bool' : 'BvhHit'} {
  var hit = BvhHit(t_max, 0.0, 0.0, 0u, BVH_MISS);
  var stack: array<vec2u, ${stackSize}>;
  var top = 0u;
  var bottom = 0u;
  var ray = bvh_ray(origin, direction);
  var octant = bvh_octant(ray.inverse);
  var group = vec2u(0u, 0x80000000u);
  var frame: BvhFrame;
  var instance = BVH_MISS;
  var first_node = 0u;
  var first_triangle = 0u;
  var waiting = 0u;
  var first_waiting = 0u;
  loop {
    if (waiting != 0u && instance == BVH_MISS) {
      instance = first_waiting + countTrailingZeros(waiting);
      waiting &= waiting - 1u;
      let placed = bvh_instance(instance);
      let point = vec4f(origin, 1.0);
      ray = bvh_ray(
        vec3f(dot(placed.to_object_0, point), dot(placed.to_object_1, point), dot(placed.to_object_2, point)),
        vec3f(dot(placed.to_object_0.xyz, direction), dot(placed.to_object_1.xyz, direction), dot(placed.to_object_2.xyz, direction)),
      );
      octant = bvh_octant(ray.inverse);
      frame = bvh_frame(ray.direction);
      first_node = placed.blas_node;
      first_triangle = placed.triangle_offset;
      if (group.y > 0xffffffu${guard}) {
        stack[top] = group;
        top++;
      }
      bottom = top;
      group = vec2u(0u, 0x80000000u);
    } else if (group.y <= 0xffffffu) {
      if (top == bottom) {
        if (instance == BVH_MISS) { break; }
        // Out of the instance.
        instance = BVH_MISS;
        first_node = 0u;
        bottom = 0u;
        ray = bvh_ray(origin, direction);
        octant = bvh_octant(ray.inverse);
        continue;
      }
      top--;
      group = stack[top];
    }
    let bit = firstLeadingBit(group.y);
    group.y ^= 1u << bit;
    let before = group.y & ((1u << ((bit - 24u) ^ octant)) - 1u);
    if (group.y > 0xffffffu${guard}) {
      stack[top] = group;
      top++;
    }
    let node = bvh_node(first_node + group.x + countOneBits(before & 0xffu));
    let entered = bvh_enter_children(ray, octant, node, t_min, hit.t);
    group = vec2u(node.children.x, entered.nodes | (node.frame.w >> 24u));
    if (instance == BVH_MISS) {
      waiting = entered.primitives;
      first_waiting = node.children.y;
    } else {
      for (var left = entered.primitives; left != 0u; left &= left - 1u) {
        let triangle = first_triangle + node.children.y + countTrailingZeros(left);
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
  }
  return ${any ? 'false' : 'hit'};
}
`,
    [bvhTypes, children],
  );
};

/**
 * `fn bvh_closest_hit(origin: vec3f, direction: vec3f, t_min: f32, t_max: f32) -> BvhHit` over the wide layout of
 * `widenBlas` and `widenTlas`: everything else is as in the module of the same name of `@glanz/bvh/wgsl`, the functions that
 * the host supplies too, so a host chooses a layout by its import.
 */
export const bvhClosestHit: WgslModule = traversal('closest');

/** `fn bvh_any_hit(origin: vec3f, direction: vec3f, t_min: f32, t_max: f32) -> bool` over the wide layout. See {@link bvhClosestHit}. */
export const bvhAnyHit: WgslModule = traversal('any');

/**
 * {@link bvhClosestHit} or {@link bvhAnyHit} with a stack for trees that are less deep than they might be: see the function
 * of the same name of `@glanz/bvh/wgsl`.
 *
 * @param stackSize Entries. As `packHierarchy` tells it, or more. With less, rays lose hits where they enter more than it holds.
 * @throws {BvhError} `bvh/options` for what is no whole number from 3 to `BVH_STACK_SIZE`.
 */
export const bvhTraversal = (query: 'closest' | 'any', stackSize: number): WgslModule => traversal(query, checkedStackSize(stackSize, WIDE_STACK_SIZE));
