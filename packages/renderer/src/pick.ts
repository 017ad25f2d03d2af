import { closestHitInstances, type BlasMesh } from '@glanz/bvh';
import type { Camera, Instance, Mesh, Scene } from '@glanz/scene';
import type { PickResult } from './options';
import { cameraUniforms } from './scene/camera';
import type { Geometry } from './scene/geometry';
import { transformPoint } from './scene/matrix';

/**
 * What lies under a point of the film, through the middle of the lens. Textured opacity is not looked at: a hole in a
 * leaf still picks the leaf.
 */
export function pickPixel(scene: Scene, geometry: Geometry, camera: Camera, width: number, height: number, x: number, y: number): PickResult | undefined {
  const view = cameraUniforms(camera, width, height);
  const sx = ((2 * x) / width - 1) * view.half_extent[0];
  const sy = (1 - (2 * y) / height) * view.half_extent[1];
  const along = (k: number, a: number, b: number, c: number) => a * (view.camera_right[k] as number) + b * (view.camera_up[k] as number) + c * (view.camera_forward[k] as number);
  const toward = [0, 1, 2].map((k) => {
    if (camera.type === 'panorama') return along(k, Math.sin(sx) * Math.cos(sy), Math.sin(sy), Math.cos(sx) * Math.cos(sy));
    return camera.type === 'orthographic' ? (view.camera_forward[k] as number) : along(k, sx, sy, 1);
  });
  const origin = [0, 1, 2].map((k) => (view.camera_origin[k] as number) + (camera.type === 'orthographic' ? along(k, sx, sy, 0) : 0));
  const length = Math.hypot(...toward);
  const direction = toward.map((d) => d / length);

  const parts = geometry.shown.map((index): BlasMesh => {
    const { mesh } = scene.instances[index] as Instance;
    return { blas: geometry.blas[mesh] as BlasMesh['blas'], mesh: scene.meshes[mesh] as Mesh };
  });
  const hit = closestHitInstances(geometry.tlas, parts, { origin, direction });
  if (!hit) return undefined;
  const index = geometry.shown[hit.instance] as number;
  const instance = scene.instances[index] as Instance;
  const { positions, indices } = scene.meshes[instance.mesh] as Mesh;
  const local = [0, 1, 2].map((k) => {
    const corner = (c: number) => positions[3 * (indices[3 * hit.triangle + c] as number) + k] as number;
    return (1 - hit.u - hit.v) * corner(0) + hit.u * corner(1) + hit.v * corner(2);
  }) as [number, number, number];
  const position: [number, number, number] = [0, 0, 0];
  transformPoint(instance.transform, ...local, position);
  const depth = position.reduce((sum, p, k) => sum + (p - (view.camera_origin[k] as number)) * (view.camera_forward[k] as number), 0);
  return { instance: index, material: instance.material, position, distance: hit.t, depth };
}
