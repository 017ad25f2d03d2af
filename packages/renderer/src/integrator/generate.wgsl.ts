import { wgslModule, type WgslModule } from '@glanz/wgsl';
import camera from '../camera/camera.wesl';
import filter from '../camera/filter.wesl';
import { pathCone, pathSample } from '../path/path.wgsl';
import random from '../random/random.wesl';

/** Starts the paths of a batch: path i is sample ⌊i / pixels⌋ of pixel i mod pixels. */
export const generate = (path: WgslModule): WgslModule =>
  wgslModule(
    'renderer/generate',
    /* wgsl */ `
@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
  let index = id.x;
  if (index >= batch.path_count) { return; }
  let pixel = film_pixels[batch.pixel_offset + index % batch.pixel_count];
  random_begin(pixel, path_sample(index), 0u, frame.seed);
  let offset = filter_offset(random_2());
  let ray = camera_ray(vec2u(pixel % frame.size.x, pixel / frame.size.x), offset, random_2());
  path_set_origin(index, ray.origin);
  path_set_pdf(index, 0.0);
  path_set_direction(index, ray.direction);
  path_set_cone(index, cone_pack(frame.cone_width, vec3f(0.0)));
  path_set_throughput(index, vec3f(1.0));
  // 2 until something but glass has been met: it counts as 1, see path_plane.
  path_set_alpha(index, 2.0);
  path_set_pixel(index, pixel);
  path_clear(index);
  //#if CATCHER
  path_set_role(index, select(PATH_OBJECT, PATH_WITHOUT, index >= batch.pixel_count * batch.sample_count));
  //#endif
  //#if PATH_STATE
  path_set_bounces(index, 0u);
  path_set_spread(index, 0.0);
  //#endif
  //#if MEDIA
  path_set_media(index, vec2u(0u));
  path_set_counters(index, 0u);
  path_set_travelled(index, 0.0);
  path_set_wavelength(index, 0.0);
  //#endif
  queues.items[index] = index;
}
`,
    [path, pathSample, pathCone, camera, filter, random],
  );
