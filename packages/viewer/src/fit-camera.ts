import type { Camera } from '@glanz/scene';

/** Width over height that a camera without an aspect ratio is assumed to have. */
const USUAL_ASPECT = 4 / 3;

/** The camera as it fits an image of another aspect ratio: no part of the view is cropped. */
export function fitCamera(camera: Camera, aspect: number): Camera {
  if (camera.type === 'panorama') return camera;
  if (camera.type === 'orthographic') {
    const { xmag, ymag } = camera;
    return xmag / ymag > aspect ? { ...camera, ymag: xmag / aspect } : { ...camera, xmag: ymag * aspect };
  }
  const { aspect: made = USUAL_ASPECT } = camera;
  return aspect >= made ? camera : { ...camera, yfov: 2 * Math.atan((Math.tan(camera.yfov / 2) * made) / aspect) };
}
