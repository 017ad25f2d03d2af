import { wgslModule, type WgslModule } from '@glanz/wgsl';
import camera from '../camera/camera.wesl';
import filter from '../camera/filter.wesl';
import random from '../random/random.wesl';

/**
 * First-hit features of one sample per pixel: albedo with coverage, shading normal with depth, and (for sample 0,
 * through the pixel's centre) the ids. Run on demand, with the same camera rays as the image.
 */
export function featuresModule(surface: WgslModule, openpbr: WgslModule, energy: WgslModule): WgslModule {
  return wgslModule(
    'renderer/features',
    /* wgsl */ `
@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
  if (id.x >= batch.pixel_count) { return; }
  let pixel = batch.pixel_offset + id.x;
  let at = vec2u(pixel % frame.size.x, pixel / frame.size.x);
  let first = batch.sample_offset == 0u;
  if (first) {
    feature_ids[pixel] = vec4u(0xffffffffu);
    //#if OPACITY
    opacity_begin(pixel, 0u, 0xffffu);
    //#endif
    let ray = camera_ray(at, vec2f(0.5), vec2f(0.5));
    //#if CULLING
    culling_begin(ray.direction, true);
    //#endif
    let hit = bvh_closest_hit(ray.origin, ray.direction, 0.0, 3.4e38);
    if (hit.instance != 0xffffffffu) { feature_ids[pixel] = vec4u(instances[hit.instance].id, instances[hit.instance].material, 0u, 0u); }
  }
  random_begin(pixel, batch.sample_offset, 0u, frame.seed);
  let offset = filter_offset(random_2());
  let ray = camera_ray(at, offset, random_2());
  //#if OPACITY
  opacity_begin(pixel, batch.sample_offset, 0u);
  //#endif
  //#if CULLING
  culling_begin(ray.direction, true);
  //#endif
  let hit = bvh_closest_hit(ray.origin, ray.direction, 0.0, 3.4e38);
  var albedo = vec4f(0.0);
  var normal = vec4f(0.0);
  if (hit.instance != 0xffffffffu) {
    var s = surface_load(vec4u(bitcast<u32>(hit.u), bitcast<u32>(hit.v), hit.triangle, hit.instance), ray.origin, ray.direction, frame.cone_width);
    let side = select(-1.0, 1.0, dot(s.geometric, ray.direction) <= 0.0);
    let n = side * s.normal;
    let cosine = clamp(-dot(n, ray.direction), 1e-3, 1.0);
    let local_wo = vec3f(sqrt(1.0 - cosine * cosine), 0.0, cosine);
    //#if OPENPBR_COAT_FRAME
    s.parameters = surface_coated(s, side, surface_view_frame(surface_facing(n, -ray.direction), -ray.direction), -ray.direction);
    //#endif
    albedo = vec4f(clamp(openpbr_albedo(openpbr_prepare(s.parameters, local_wo), local_wo), vec3f(0.0), vec3f(1.0)), 1.0);
    normal = vec4f(n, distance(ray.origin, s.position));
  }
  if (!first) {
    albedo += feature_albedo[pixel];
    normal += feature_normal[pixel];
  }
  feature_albedo[pixel] = albedo;
  feature_normal[pixel] = normal;
}
`,
    [surface, openpbr, energy, camera, filter, random],
  );
}
