import type { Camera } from '@glanz/scene';

/** The point on a camera's axis that is nearest to the vertical through the world's origin, where products stand. */
function pivot({ transform: m }: Camera): [x: number, z: number] {
  const [fx, fz, px, pz] = [-m[8]!, -m[10]!, m[12]!, m[14]!];
  const along = -(fx * px + fz * pz) / Math.max(fx * fx + fz * fz, 1e-12);
  return [px + along * fx, pz + along * fz];
}

/** A camera turned about the vertical through what it looks at, by an angle in radians. */
export function orbited(camera: Camera, angle: number): Camera {
  const [x, z] = pivot(camera);
  const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
  const transform = Array.from(camera.transform);
  for (const column of [0, 4, 8, 12]) {
    const [offX, offZ] = column === 12 ? [x, z] : [0, 0];
    const [vx, vz] = [camera.transform[column]! - offX, camera.transform[column + 2]! - offZ];
    transform[column] = cos * vx + sin * vz + offX;
    transform[column + 2] = cos * vz - sin * vx + offZ;
  }
  return { ...camera, transform } as Camera;
}
