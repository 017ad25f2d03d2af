import { gated, wgslModule, type WgslModule } from '@glanz/wgsl';
import { media, mediaFront } from './media.wgsl';
import { pathSample } from './path.wgsl';

/** Surfaces that a light sample may pass because they are not there: more hide the light. */
export const CONNECT_CROSSINGS = 32;

/**
 * Tests the light samples that shading asked for and adds those that arrive.
 *
 * @param traversal With `bvh_any_hit`, or for scenes with NULL_SURFACES `bvh_closest_hit`.
 */
export const connect = (path: WgslModule, traversal: WgslModule): WgslModule => wgslModule(
  'renderer/connect',
  /* wgsl */ `
@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
  if (id.x >= queues.shadow_active) { return; }
  let shadow = shadows[id.x];
  //#if BVH_FILTER
  opacity_begin(paths[shadow.path].pixel, path_sample(shadow.path), 2u * queues.depth + 1u);
  //#endif
  //#if CATCHER
  traversal_root = select(0u, frame.catcher_root, paths[shadow.path].role == PATH_WITHOUT);
  //#endif
  //#if NULL_SURFACES
  var origin = shadow.origin;
  var stack = shadow.media;
  var left = shadow.distance;
  var passed = vec3f(1.0);
  for (var i = 0u; i < ${CONNECT_CROSSINGS}u; i++) {
    let hit = bvh_closest_hit(origin, shadow.direction, 0.0, left);
    let arrived = hit.instance == 0xffffffffu;
    passed *= media_transmittance(stack, select(hit.t, left, arrived));
    if (arrived) {
      path_deposit(shadow.path, shadow.group, shadow.contribution * passed);
      return;
    }
    let point = media_point(hit);
    let front = dot(point.normal, shadow.direction) <= 0.0;
    let crossing = media_cross(stack, instances[hit.instance].material, front);
    if (!crossing.nothing) { return; }
    stack = crossing.beyond;
    origin = bvh_offset_origin(point.position, select(point.normal, -point.normal, front), point.magnitude);
    left -= hit.t;
  }
  //#else
  if (bvh_any_hit(shadow.origin, shadow.direction, 0.0, shadow.distance)) { return; }
  path_deposit(shadow.path, shadow.group, shadow.contribution);
  //#endif
}
`,
  [path, gated('BVH_FILTER', pathSample), traversal, gated('NULL_SURFACES', media), gated('NULL_SURFACES', mediaFront)],
);
