import type { Camera } from '@glanz/scene';

/** Width over height that a camera without a word about it is taken to be made for. */
const USUAL_ASPECT = 4 / 3;

/** The camera as it fits an image of another shape than its author had in mind: nothing of the view is cut off. */
export function fitCamera(camera: Camera, aspect: number): Camera {
  if (camera.type === 'panorama') return camera;
  if (camera.type === 'orthographic') {
    const { xmag, ymag } = camera;
    return xmag / ymag > aspect ? { ...camera, ymag: xmag / aspect } : { ...camera, xmag: ymag * aspect };
  }
  const { aspect: made = USUAL_ASPECT } = camera;
  return aspect >= made ? camera : { ...camera, yfov: 2 * Math.atan((Math.tan(camera.yfov / 2) * made) / aspect) };
}
