import { wgslModule, type WgslModule } from '@glanz/wgsl';
import camera from '../camera/camera.wesl';
import filter from '../camera/filter.wesl';
import random from '../random/random.wesl';

/**
 * Sums of world positions of the first surface, with the number of hits. Run on demand, with the image's camera rays.
 */
export function positionModule(traversal: WgslModule): WgslModule {
  return wgslModule(
    'renderer/position',
    /* wgsl */ `
@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
  if (id.x >= batch.pixel_count) { return; }
  let pixel = batch.pixel_offset + id.x;
  random_begin(pixel, batch.sample_offset, 0u, frame.seed);
  let offset = filter_offset(random_2());
  let ray = camera_ray(vec2u(pixel % frame.size.x, pixel / frame.size.x), offset, random_2());
  //#if OPACITY
  opacity_begin(pixel, batch.sample_offset, 0u);
  //#endif
  //#if CULLING
  culling_begin(ray.direction, true);
  //#endif
  let hit = bvh_closest_hit(ray.origin, ray.direction, 0.0, 3.4e38);
  var sum = select(feature_position[pixel], vec4f(0.0), batch.sample_offset == 0u);
  if (hit.instance != 0xffffffffu) {
    let a = triangles[3u * hit.triangle].xyz;
    let p = vec4f(a + hit.u * (triangles[3u * hit.triangle + 1u].xyz - a) + hit.v * (triangles[3u * hit.triangle + 2u].xyz - a), 1.0);
    sum += vec4f(dot(instances[hit.instance].to_world_0, p), dot(instances[hit.instance].to_world_1, p), dot(instances[hit.instance].to_world_2, p), 1.0);
  }
  feature_position[pixel] = sum;
}
`,
    [camera, filter, random, traversal],
  );
}
