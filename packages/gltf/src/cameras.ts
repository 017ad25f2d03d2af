import type { Camera, Scene } from '@glanz/scene';
import type { GltfCamera } from './json';
import type { Matrix } from './matrix';

/** Metres that cameras of a scene may be away from the origin, and that they may see: what `validateScene` accepts. */
const MAX_DISTANCE = 1e12;

/** How far the axes of a transform are from lying in a plane: the volume that they span over that of a box, 0 to 1. */
function spread(matrix: Matrix): number {
  const m = (i: number) => matrix[i] as number;
  const lengths = Math.hypot(m(0), m(1), m(2)) * Math.hypot(m(4), m(5), m(6)) * Math.hypot(m(8), m(9), m(10));
  const volume =
    m(0) * (m(5) * m(10) - m(6) * m(9)) - m(4) * (m(1) * m(10) - m(2) * m(9)) + m(8) * (m(1) * m(6) - m(2) * m(5));
  return lengths > 0 ? Math.abs(volume) / lengths : 0;
}

/** Adds a camera to the scene; one that shows nothing is left out, with a warning. */
export function readCamera(
  { name, type, perspective, orthographic }: GltfCamera,
  nodeName: string,
  transform: Matrix,
  scene: Scene,
): void {
  const common = { name: name || nodeName || `camera ${scene.cameras.length}`, transform: [...transform] };
  const leaveOut = (what: string) =>
    void scene.warnings.push({ code: 'gltf/camera', message: `Camera "${common.name}" ${what}; it is left out.` });
  if (!(spread(transform) > 1e-5)) return leaveOut("is flattened by its node's scale");
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
