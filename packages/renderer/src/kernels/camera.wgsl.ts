import { wgslModule } from '@glanz/wgsl';
import { frameStruct } from './layout';

/**
 * Camera rays. Perspective through a pinhole, or through a thin lens with planar focus (CAMERA_LENS) that is round or a
 * regular polygon (CAMERA_BLADES); parallel (CAMERA_ORTHOGRAPHIC); or all around (CAMERA_PANORAMA).
 */
export const camera = wgslModule(
  'renderer/camera',
  /* wgsl */ `
struct CameraRay {
  origin: vec3f,
  direction: vec3f,
}

//#if CAMERA_LENS
//#if CAMERA_BLADES
// A uniform point of a regular polygon with its corners on the unit circle.
fn camera_aperture(u: vec2f) -> vec2f {
  let count = f32(frame.lens_blades);
  let at = u.x * count;
  let blade = min(floor(at), count - 1.0);
  let root = sqrt(clamp(at - blade, 0.0, 1.0));
  let step = 6.283185307179586 / count;
  let first = frame.lens_rotation + blade * step;
  let a = vec2f(cos(first), sin(first));
  let b = vec2f(cos(first + step), sin(first + step));
  return root * ((1.0 - u.y) * a + u.y * b);
}
//#else
// Concentric map of the square to the unit disk (Shirley and Chiu 1997).
fn camera_aperture(u: vec2f) -> vec2f {
  let o = 2.0 * u - 1.0;
  if (o.x == 0.0 && o.y == 0.0) { return vec2f(0.0); }
  if (abs(o.x) > abs(o.y)) {
    let phi = 0.7853981633974483 * (o.y / o.x);
    return o.x * vec2f(cos(phi), sin(phi));
  }
  let phi = 1.5707963267948966 - 0.7853981633974483 * (o.x / o.y);
  return o.y * vec2f(cos(phi), sin(phi));
}
//#endif
//#endif

// The ray through the point "offset" of a pixel, (0.5, 0.5) being its centre.
fn camera_ray(pixel: vec2u, offset: vec2f, lens: vec2f) -> CameraRay {
  let film = ((vec2f(pixel) + offset) / vec2f(frame.size)) * vec2f(2.0, -2.0) + vec2f(-1.0, 1.0);
  let p = film * frame.half_extent;
  //#if CAMERA_PANORAMA
  // half_extent holds half a turn across and a quarter turn up.
  let across = cos(p.y) * (frame.camera_right * sin(p.x) + frame.camera_forward * cos(p.x));
  return CameraRay(frame.camera_origin, normalize(across + frame.camera_up * sin(p.y)));
  //#else
  //#if CAMERA_ORTHOGRAPHIC
  return CameraRay(frame.camera_origin + frame.camera_right * p.x + frame.camera_up * p.y, frame.camera_forward);
  //#else
  let through = frame.camera_forward + frame.camera_right * p.x + frame.camera_up * p.y;
  //#if CAMERA_LENS
  let point = camera_aperture(lens) * frame.lens_radius;
  let shift = frame.camera_right * point.x + frame.camera_up * point.y;
  return CameraRay(frame.camera_origin + shift, normalize(through * frame.focus_distance - shift));
  //#else
  return CameraRay(frame.camera_origin, normalize(through));
  //#endif
  //#endif
  //#endif
}
`,
  [frameStruct.module],
);
