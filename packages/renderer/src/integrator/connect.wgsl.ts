import { gated, wgslModule, type WgslModule } from '@glanz/wgsl';
import { MATERIAL_STRAIGHT } from '../storage/layout';
import { media, mediaFront } from '../materials/media.wgsl';
import { pathSample } from '../path/path.wgsl';

/** Surfaces that a light sample may pass, smooth thin walls and those that are not there: more hide the light. */
export const CONNECT_CROSSINGS = 32;

/**
 * Tests the light samples that shading asked for and adds those that arrive.
 *
 * @param traversal With `bvh_any_hit`, or for scenes with NULL_SURFACES `bvh_closest_hit`.
 * @param straight With `straight_transmittance`, for scenes with STRAIGHT.
 */
export const connect = (path: WgslModule, traversal: WgslModule, straight: WgslModule): WgslModule =>
  wgslModule(
    'renderer/connect',
    /* wgsl */ `
@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
  if (id.x >= queues.shadow_active) { return; }
  let shadow = shadow_load(id.x);
  //#if OPACITY
  opacity_begin(path_pixel(shadow.path), path_sample(shadow.path), 2u * queues.depth + 1u);
  //#endif
  //#if CATCHER
  traversal_root = select(0u, frame.catcher_root, path_role(shadow.path) == PATH_WITHOUT);
  //#endif
  //#if NULL_SURFACES
  var stack = shadow.media;
  var passed = vec3f(1.0);
  // The ray stays what it is: a new origin off each surface would aim it past its end, and into the light.
  var past = 0.0;
  for (var i = 0u; i < ${CONNECT_CROSSINGS}u; i++) {
    let hit = bvh_closest_hit(shadow.origin, shadow.direction, past, shadow.distance);
    let arrived = hit.instance == 0xffffffffu;
    passed *= media_transmittance(stack, select(hit.t, shadow.distance, arrived) - past);
    if (arrived) {
      path_deposit(shadow.path, shadow.group, shadow.contribution * passed);
      return;
    }
    past = hit.t;
    //#if STRAIGHT
    if ((materials[instances[hit.instance].material].flags & ${MATERIAL_STRAIGHT}u) != 0u) {
      let s = surface_load(vec4u(bitcast<u32>(hit.u), bitcast<u32>(hit.v), hit.triangle, hit.instance), shadow.origin, shadow.direction, 0.0);
      passed *= straight_transmittance(s, shadow.direction);
      if (all(passed == vec3f(0.0))) { return; }
      continue;
    }
    //#endif
    let crossing = media_cross(stack, instances[hit.instance].material, dot(media_normal(hit), shadow.direction) <= 0.0);
    if (!crossing.nothing) { return; }
    stack = crossing.beyond;
  }
  //#else
  if (bvh_any_hit(shadow.origin, shadow.direction, 0.0, shadow.distance)) { return; }
  path_deposit(shadow.path, shadow.group, shadow.contribution);
  //#endif
}
`,
    [
      path,
      gated('OPACITY', pathSample),
      traversal,
      gated('NULL_SURFACES', media),
      gated('NULL_SURFACES', mediaFront),
      gated('STRAIGHT', straight),
    ],
  );
