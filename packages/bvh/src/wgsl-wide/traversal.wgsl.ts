import { wgslModule, type WgslModule } from '@glanz/wgsl/module';
import bvhObjectRay from '../wgsl/object_ray.wesl';
import bvhTriangleTest from '../wgsl/triangle.wesl';
import records from '../wgsl/records.wesl';
import { checkedStackSize } from '../wgsl/stack-size';
import { BvhInstance } from '../wgsl/structs';
import { WIDE_STACK_SIZE } from '../wide/layout';
import { bvhNodeStruct } from './structs';

/** The structs of the traversal: `BvhNode`, `BvhInstance`, `BvhTriangle`, `BvhHit` and the constant `BVH_MISS`. */
export const bvhTypes = wgslModule('bvh/wide-types', '', [bvhNodeStruct.module, BvhInstance, records]);

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

// Not unpack4x8unorm, whose scaling to 1 is work for nothing.
fn bvh_bytes(word: u32) -> vec4f {
  return vec4f((vec4u(word) >> vec4u(0u, 8u, 16u, 24u)) & vec4u(255u));
}

// Which of four boxes the ray is in, a bit each; a box has a byte of every word.
fn bvh_inside_four(near_words: vec3u, far_words: vec3u, scale: vec3f, near: vec3f, far: vec3f, t_min: f32, t_max: f32) -> u32 {
  let enter = max(max(bvh_bytes(near_words.x) * scale.x + near.x, bvh_bytes(near_words.y) * scale.y + near.y), max(bvh_bytes(near_words.z) * scale.z + near.z, vec4f(t_min)));
  let leave = min(min(bvh_bytes(far_words.x) * scale.x + far.x, bvh_bytes(far_words.y) * scale.y + far.y), min(bvh_bytes(far_words.z) * scale.z + far.z, vec4f(t_max)));
  // Sums of bits, as they are quicker than "or" on one GPU at least.
  return dot(select(vec4u(0u), vec4u(1u, 2u, 4u, 8u), enter <= leave), vec4u(1u));
}

fn bvh_enter_children(ray: BvhRay, octant: u32, node: BvhNode, t_min: f32, t_max: f32) -> BvhEntered {
  let steps = node.frame.w;
  let step = vec3f(bitcast<f32>((steps & 0xffu) << 23u), bitcast<f32>((steps & 0xff00u) << 15u), bitcast<f32>((steps & 0xff0000u) << 7u));
  let scale = step * ray.inverse;
  let start = (bitcast<vec3f>(node.frame.xyz) - ray.origin) * ray.inverse;
  // More than all rounding here can be, so that no hit on a border is lost.
  let slack = (abs(start) + abs(scale) * 255.0) * 4.7683716e-7;
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
  let inside = bvh_inside_four(vec3u(near_x.x, near_y.x, near_z.x), vec3u(far_x.x, far_y.x, far_z.x), scale, near, far, t_min, t_max)
    | (bvh_inside_four(vec3u(near_x.y, near_y.y, near_z.y), vec3u(far_x.y, far_y.y, far_z.y), scale, near, far, t_min, t_max) << 4u);
  // Bits change places as their numbers do under "xor octant".
  let are_nodes = steps >> 24u;
  var nodes = inside & are_nodes;
  nodes = select(nodes, ((nodes & 0x55u) << 1u) | ((nodes >> 1u) & 0x55u), (octant & 1u) != 0u);
  nodes = select(nodes, ((nodes & 0x33u) << 2u) | ((nodes >> 2u) & 0x33u), (octant & 2u) != 0u);
  nodes = select(nodes, ((nodes & 0x0fu) << 4u) | (nodes >> 4u), (octant & 4u) != 0u);
  var primitives = 0u;
  for (var leaves = inside & ~are_nodes; leaves != 0u; leaves &= leaves - 1u) {
    let place = countTrailingZeros(leaves);
    let kind = (select(node.children.z, node.children.w, place >= 4u) >> (8u * (place & 3u))) & 0xffu;
    primitives |= ((1u << (kind >> 5u)) - 1u) << (kind & 31u);
  }
  return BvhEntered(nodes << 24u, primitives);
}
`,
  [bvhTypes, bvhTriangleTest],
);

/**
 * Closest-hit and any-hit differ in a few lines, which must be text.
 *
 * "group" holds the child nodes of one node that are still to visit: the first of all its child nodes, and a word with
 * those entered (upper byte, the highest bit is next) and those there are (lower byte). The stack takes what is left of
 * a group while one of its nodes is looked at, so one entry a level is enough. The inner loop goes down until a node
 * has primitives to test, so that neighbouring threads test theirs together. It serves both levels: "waiting" are the
 * instances of the node of the TLAS that was looked at last. Bounded, as every node and instance is visited at most
 * once.
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
    var primitives = 0u;
    var first_primitive = 0u;
    while (primitives == 0u) {
      if (group.y <= 0xffffffu) {
        if (top == bottom) { break; }
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
      primitives = entered.primitives;
      first_primitive = node.children.y;
    }
    if (primitives != 0u && instance != BVH_MISS) {
      for (; primitives != 0u; primitives &= primitives - 1u) {
        let triangle = first_triangle + first_primitive + countTrailingZeros(primitives);
        let found = bvh_intersect_triangle(ray.origin, frame, bvh_triangle(triangle));
        if (found.x > t_min && found.x < hit.t) {
          let candidate = BvhHit(found.x, found.y, found.z, triangle, instance);
          //#if BVH_FILTER
          if (!bvh_accept(candidate)) { continue; }
          //#endif
          ${any ? 'return true;' : 'hit = candidate;'}
        }
      }
      continue;
    }
    if (primitives != 0u) {
      waiting = primitives;
      first_waiting = first_primitive;
    } else if (instance == BVH_MISS) {
      break;
    } else if (waiting == 0u) {
      // Out of the instance, and no other beside it: on in the TLAS.
      instance = BVH_MISS;
      first_node = 0u;
      bottom = 0u;
      ray = bvh_ray(origin, direction);
      octant = bvh_octant(ray.inverse);
      continue;
    }
    instance = first_waiting + countTrailingZeros(waiting);
    waiting &= waiting - 1u;
    let placed = bvh_instance(instance);
    ray = bvh_object_ray(placed, origin, direction);
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
  }
  return ${any ? 'false' : 'hit'};
}
`,
    [bvhTypes, bvhObjectRay, children],
  );
};

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
export const bvhTraversal = (query: 'closest' | 'any', stackSize: number): WgslModule =>
  traversal(query, checkedStackSize(stackSize, WIDE_STACK_SIZE));
