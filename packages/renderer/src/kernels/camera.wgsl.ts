import { wgslModule } from '@glanz/wgsl';
import { frameStruct } from './layout';
import { random } from './random.wgsl';

/** Camera rays: perspective with an optional thin lens (uniform disk, planar focus), or orthographic. Box pixel filter. */
export const camera = wgslModule(
  'renderer/camera',
  /* wgsl */ `
struct CameraRay {
  origin: vec3f,
  direction: vec3f,
}

// Concentric map of the square to the unit disk (Shirley and Chiu 1997).
fn camera_disk(u: vec2f) -> vec2f {
  let o = 2.0 * u - 1.0;
  if (o.x == 0.0 && o.y == 0.0) { return vec2f(0.0); }
  if (abs(o.x) > abs(o.y)) {
    let phi = 0.7853981633974483 * (o.y / o.x);
    return o.x * vec2f(cos(phi), sin(phi));
  }
  let phi = 1.5707963267948966 - 0.7853981633974483 * (o.x / o.y);
  return o.y * vec2f(cos(phi), sin(phi));
}

// The ray through the point "offset" of a pixel, (0.5, 0.5) being its centre.
fn camera_ray(pixel: vec2u, offset: vec2f, lens: vec2f) -> CameraRay {
  let film = ((vec2f(pixel) + offset) / vec2f(frame.size)) * vec2f(2.0, -2.0) + vec2f(-1.0, 1.0);
  let p = film * frame.half_extent;
  if (frame.camera_kind == 1u) {
    let origin = frame.camera_origin + frame.camera_right * p.x + frame.camera_up * p.y;
    return CameraRay(origin, frame.camera_forward);
  }
  let through = frame.camera_forward + frame.camera_right * p.x + frame.camera_up * p.y;
  if (frame.lens_radius <= 0.0) {
    return CameraRay(frame.camera_origin, normalize(through));
  }
  let disk = camera_disk(lens) * frame.lens_radius;
  let shift = frame.camera_right * disk.x + frame.camera_up * disk.y;
  return CameraRay(frame.camera_origin + shift, normalize(through * frame.focus_distance - shift));
}
`,
  [frameStruct.module, random],
);
