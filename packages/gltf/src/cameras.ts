import type { Camera, Scene } from '@glanz/scene';
import type { GltfCamera } from './json';
import type { Matrix } from './matrix';

/** Max distance of cameras from the origin, and max size of their view, in metres, as in `validateScene`. */
const MAX_DISTANCE = 1e12;

/** Volume spanned by the axes of a transform, relative to orthogonal axes of the same lengths: 0 (flat) to 1. */
function relativeVolume(matrix: Matrix): number {
  const m = (i: number) => matrix[i] as number;
  const lengths = Math.hypot(m(0), m(1), m(2)) * Math.hypot(m(4), m(5), m(6)) * Math.hypot(m(8), m(9), m(10));
  const volume =
    m(0) * (m(5) * m(10) - m(6) * m(9)) - m(4) * (m(1) * m(10) - m(2) * m(9)) + m(8) * (m(1) * m(6) - m(2) * m(5));
  return lengths > 0 ? Math.abs(volume) / lengths : 0;
}

/** Adds a camera to the scene; one whose view is invalid is left out, with a warning. */
export function readCamera(
  { name, type, perspective, orthographic }: GltfCamera,
  nodeName: string,
  transform: Matrix,
  scene: Scene,
): void {
  const common = { name: name || nodeName || `camera ${scene.cameras.length}`, transform: [...transform] };
  const leaveOut = (what: string) =>
    void scene.warnings.push({ code: 'gltf/camera', message: `Camera "${common.name}" ${what}; it is left out.` });
  if (!(relativeVolume(transform) > 1e-5)) return leaveOut("is flattened by its node's scale");
  if (!transform.slice(12, 15).every((x) => Math.abs(x) <= MAX_DISTANCE))
    return leaveOut(`is more than ${MAX_DISTANCE} m away from the origin`);
  let made: Camera;
  if (type === 'perspective') {
    const { yfov = 0, aspectRatio = 0 } = perspective ?? {};
    if (!(yfov > 0 && yfov < Math.PI)) return leaveOut(`has a field of view of ${yfov} rad`);
    made = { type: 'perspective', ...common, yfov, ...(aspectRatio > 0 ? { aspect: aspectRatio } : {}) };
  } else {
    const xmag = Math.abs(orthographic?.xmag ?? 0),
      ymag = Math.abs(orthographic?.ymag ?? 0);
    if (![xmag, ymag].every((half) => half > 0 && half <= MAX_DISTANCE))
      return leaveOut(`has a view of ${xmag} and ${ymag} m`);
    made = { type: 'orthographic', ...common, xmag, ymag };
  }
  scene.cameras.push(made);
}
