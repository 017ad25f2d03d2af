import { wgslModule, type WgslModule } from '@glanz/wgsl';
import { camera } from './camera.wgsl';
import { filter } from './filter.wgsl';
import { pathCone, pathSample } from './path.wgsl';

/** Starts the paths of a batch: path i is sample ⌊i / pixels⌋ of pixel i mod pixels. */
export const generate = (path: WgslModule): WgslModule => wgslModule(
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
  paths[index].origin = ray.origin;
  paths[index].pdf = 0.0;
  paths[index].direction = ray.direction;
  paths[index].cone = cone_pack(frame.cone_width, vec3f(0.0));
  paths[index].throughput = vec3f(1.0);
  // 2 until something but glass has been met: it counts as 1, see path_plane.
  paths[index].alpha = 2.0;
  paths[index].pixel = pixel;
  path_clear(index);
  //#if CATCHER
  paths[index].role = select(PATH_OBJECT, PATH_WITHOUT, index >= batch.pixel_count * batch.sample_count);
  //#endif
  //#if PATH_STATE
  paths[index].bounces = 0u;
  paths[index].spread = 0.0;
  //#endif
  //#if MEDIA
  paths[index].media = vec2u(0u);
  paths[index].counters = 0u;
  paths[index].travelled = 0.0;
  paths[index].wavelength = 0.0;
  //#endif
  queues.items[index] = index;
}
`,
  [path, pathSample, pathCone, camera, filter],
);
