import { wgslModule } from '@glanz/wgsl';
import { frameStruct, LIGHT_NODE_DISTANT, LIGHT_NODE_LEAF, lightStruct } from '../storage/layout';
import random from '../random/random.wesl';

/**
 * The choice of a light by the tree that `lightTreeSteps` makes; pbrt 4's bound of how much a node may light a place.
 * The choice may depend on the surface's normal, which paths therefore remember, in 16 bits: whoever asks for a
 * probability later must ask with the same normal that the light was chosen with.
 *
 * - `fn light_tree_pick(draw: f32, position: vec3f, normal: vec3f) -> LightPick`; the normal is 0 where light may come
 *   from all sides.
 * - `fn light_tree_probability(light: u32, position: vec3f, normal: vec3f) -> f32`
 */
export const lightTree = /* @__PURE__ */ wgslModule(
  'renderer/light-tree',
  /* wgsl */ `
struct LightPick {
  light: u32,
  // 0: none lights the place.
  probability: f32,
  // What is left of the draw: as uniform, and as evenly spread over those that chose this light.
  rest: f32,
}

// Cosine and sine of a − b for angles from 0 to π, of 0 if b is the larger.
fn light_tree_less(a: vec2f, b: vec2f) -> vec2f {
  if (a.x > b.x) { return vec2f(1.0, 0.0); }
  return vec2f(a.x * b.x + a.y * b.y, a.y * b.x - a.x * b.y);
}

fn light_tree_angle(cosine: f32) -> vec2f {
  let c = clamp(cosine, -1.0, 1.0);
  return vec2f(c, sqrt(1.0 - c * c));
}

// What a node may give at most, roughly.
fn light_tree_importance(node: u32, position: vec3f, normal: vec3f) -> f32 {
  let axis = lights[node].b;
  let spread = light_tree_angle(lights[node].c.x);
  var importance = lights[node].c.z;
  var towards = -axis;
  var around = spread;
  if ((lights[node].kind & ${LIGHT_NODE_DISTANT}u) == 0u) {
    let offset = lights[node].a - position;
    let radius2 = lights[node].probability * lights[node].probability;
    let distance2 = dot(offset, offset);
    importance /= max(max(distance2, radius2), 1e-20);
    // Inside of the bounds anything is possible.
    if (distance2 <= radius2) { return importance; }
    towards = offset * inverseSqrt(distance2);
    around = vec2f(sqrt(1.0 - radius2 / distance2), sqrt(radius2 / distance2));
    let off = light_tree_less(light_tree_less(light_tree_angle(-dot(axis, towards)), spread), around);
    if (off.x <= lights[node].c.y) { return 0.0; }
    importance *= off.x;
  }
  if (any(normal != vec3f(0.0))) {
    // The normal is rounded: what lies a little below its horizon keeps a chance.
    importance *= max(light_tree_less(light_tree_angle(dot(normal, towards)), around).x, 0.0) + 0.02;
  }
  return importance;
}

fn light_tree_pick(draw: f32, position: vec3f, normal: vec3f) -> LightPick {
  var node = frame.light_count;
  var u = draw;
  var probability = 1.0;
  // Each choice takes bits off the draw: of 24, ten are kept.
  var enough = 6.103515625e-5;
  for (var level = 0u; level < 33u; level++) {
    let child = lights[node].other;
    if (probability < enough) {
      u = random_fresh();
      enough = probability * 6.103515625e-5;
    }
    if ((lights[node].kind & ${LIGHT_NODE_LEAF}u) != 0u) { return LightPick(child, probability, min(u, 0.99999994)); }
    let first = light_tree_importance(child, position, normal);
    let sum = first + light_tree_importance(child + 1u, position, normal);
    if (!(sum > 0.0)) { break; }
    let share = first / sum;
    if (u < share) {
      node = child;
      u /= share;
      probability *= share;
    } else {
      node = child + 1u;
      u = (u - share) / (1.0 - share);
      probability *= 1.0 - share;
    }
  }
  return LightPick(0u, 0.0, 0.0);
}

fn light_tree_probability(light: u32, position: vec3f, normal: vec3f) -> f32 {
  // Lights without power are not in the tree.
  if (lights[light].probability <= 0.0) { return 0.0; }
  var node = frame.light_count;
  var trail = lights[light].other;
  var probability = 1.0;
  for (var level = 0u; level < 33u; level++) {
    if ((lights[node].kind & ${LIGHT_NODE_LEAF}u) != 0u) { return probability; }
    let child = lights[node].other;
    let first = light_tree_importance(child, position, normal);
    let second = light_tree_importance(child + 1u, position, normal);
    let taken = select(first, second, (trail & 1u) != 0u);
    if (!(taken > 0.0)) { break; }
    probability *= taken / (first + second);
    node = child + (trail & 1u);
    trail >>= 1u;
  }
  return 0.0;
}
`,
  [lightStruct.module, frameStruct.module, random],
);
