import { gated, wgslModule, type WgslModule } from '@glanz/wgsl';
import { pathSample } from './path.wgsl';

/** Tests the light samples that shading asked for and adds those that arrive. */
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
  if (bvh_any_hit(shadow.origin, shadow.direction, 0.0, shadow.distance)) { return; }
  path_deposit(shadow.path, shadow.group, shadow.contribution);
}
`,
  [path, gated('BVH_FILTER', pathSample), traversal],
);
