import { gated, wgslModule, type WgslModule } from '@glanz/wgsl';
import { areaLightGathering } from '../lights/area-lights.wgsl';
import { pathSample } from '../path/path.wgsl';
import { volumeModule } from './volume.wgsl';

/** Finds the nearest surface of every active path; inside of media, what happens on the way there. */
export function intersect(path: WgslModule, traversal: WgslModule): WgslModule {
  const areas = areaLightGathering(path);
  return wgslModule(
    'renderer/intersect',
    /* wgsl */ `
@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
  if (id.x >= queues.active_count) { return; }
  let index = queues.items[(queues.depth & 1u) * queues.capacity + id.x];
  //#if OPACITY
  opacity_begin(path_pixel(index), path_sample(index), 2u * queues.depth);
  //#endif
  //#if CULLING
  //#if PATH_DEPTH
  culling_begin(path_direction(index), (path_counters(index) & 0xffffu) == 0u);
  //#else
  culling_begin(path_direction(index), queues.depth == 0u);
  //#endif
  //#endif
  //#if CATCHER
  traversal_root = select(0u, frame.catcher_root, path_role(index) == PATH_WITHOUT && queues.depth > 0u);
  //#endif
  //#if MEDIA
  let entry = media_top(path_media(index));
  if (entry != 0u) {
    volume_travel(index, entry);
    return;
  }
  //#endif
  let hit = bvh_closest_hit(path_origin(index), path_direction(index), 0.0, 3.4e38);
  //#if AREA_LIGHTS
  area_light_gather(index, path_origin(index), path_direction(index), hit.t, path_throughput(index), vec3f(0.0), false);
  //#endif
  path_set_hit(index, vec4u(bitcast<u32>(hit.u), bitcast<u32>(hit.v), hit.triangle, hit.instance));
}
`,
    [
      path,
      gated('OPACITY', pathSample),
      traversal,
      gated('AREA_LIGHTS', areas),
      gated('MEDIA', volumeModule(traversal, areas)),
    ],
  );
}
