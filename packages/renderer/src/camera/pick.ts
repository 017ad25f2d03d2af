import { closestHitInstances, type BlasMesh, type InstanceHit, type Ray } from '@glanz/bvh';
import { forEachHitInstances } from '@glanz/bvh/all-hits';
import type { Camera, Instance, Mesh, Scene } from '@glanz/scene';
import type { PickResult } from '../options';
import { cameraUniforms } from './camera';
import type { Geometry } from '../geometry/geometry';
import { determinant3, transformPoint } from '../geometry/matrix';

/**
 * The surface under a point of the film, through the middle of the lens. Textured opacity is ignored: a hole in a leaf
 * still picks the leaf.
 *
 * @param culls Whether a material's back faces are invisible; default: none are.
 */
export function pickPixel(
  scene: Scene,
  geometry: Geometry,
  camera: Camera,
  width: number,
  height: number,
  x: number,
  y: number,
  culls?: (material: number) => boolean,
): PickResult | undefined {
  const view = cameraUniforms(camera, width, height);
  const sx = ((2 * x) / width - 1) * view.half_extent[0];
  const sy = (1 - (2 * y) / height) * view.half_extent[1];
  const along = (k: number, a: number, b: number, c: number) =>
    a * (view.camera_right[k] as number) + b * (view.camera_up[k] as number) + c * (view.camera_forward[k] as number);
  const toward = [0, 1, 2].map((k) => {
    if (camera.type === 'panorama')
      return along(k, Math.sin(sx) * Math.cos(sy), Math.sin(sy), Math.cos(sx) * Math.cos(sy));
    return camera.type === 'orthographic' ? (view.camera_forward[k] as number) : along(k, sx, sy, 1);
  });
  const origin = [0, 1, 2].map(
    (k) => (view.camera_origin[k] as number) + (camera.type === 'orthographic' ? along(k, sx, sy, 0) : 0),
  );
  const length = Math.hypot(...toward);
  const direction = toward.map((d) => d / length);

  const parts = partsOf(scene, geometry);
  const { tlas } = geometry.placement;
  const ray: Ray = { origin, direction };
  const hit = culls ? nearestSeen(scene, geometry, parts, ray, culls) : closestHitInstances(tlas, parts, ray);
  if (!hit) return undefined;
  const index = hit.instance;
  const instance = scene.instances[index] as Instance;
  const { positions, indices } = scene.meshes[instance.mesh] as Mesh;
  const local = [0, 1, 2].map((k) => {
    const corner = (c: number) => positions[3 * (indices[3 * hit.triangle + c] as number) + k] as number;
    return (1 - hit.u - hit.v) * corner(0) + hit.u * corner(1) + hit.v * corner(2);
  }) as [number, number, number];
  const position: [number, number, number] = [0, 0, 0];
  transformPoint(instance.transform, ...local, position);
  const depth = position.reduce(
    (sum, p, k) => sum + (p - (view.camera_origin[k] as number)) * (view.camera_forward[k] as number),
    0,
  );
  return { instance: index, material: instance.material, position, distance: hit.t, depth };
}

/** What each instance is made of, by the list of hierarchies: another one whenever a mesh is replaced. */
const partsKnown = /* @__PURE__ */ new WeakMap<Geometry['blas'], readonly BlasMesh[]>();

function partsOf(scene: Scene, { blas }: Geometry): readonly BlasMesh[] {
  let parts = partsKnown.get(blas);
  if (!parts) {
    const byMesh = scene.meshes.map((mesh, i): BlasMesh => ({
      mesh,
      // Asked for when a ray comes near the mesh: for a hierarchy on the GPU another one is made then.
      get blas() {
        return (blas[i]?.gpu?.forQueries() ?? blas[i]) as BlasMesh['blas'];
      },
    }));
    partsKnown.set(blas, (parts = scene.instances.map(({ mesh }) => byMesh[mesh] as BlasMesh)));
  }
  return parts;
}

/** The nearest triangle whose front a ray comes to, or whose material has no back that is looked through. */
function nearestSeen(
  scene: Scene,
  geometry: Geometry,
  parts: readonly BlasMesh[],
  ray: Ray,
  culls: (material: number) => boolean,
): InstanceHit | undefined {
  let hit: InstanceHit | undefined;
  forEachHitInstances(geometry.placement.tlas, parts, ray, (t, u, v, triangle, nth) => {
    if (hit && t >= hit.t) return;
    const instance = scene.instances[nth] as Instance;
    if (!culls(instance.material) || isFront(instance, scene.meshes[instance.mesh] as Mesh, triangle, ray.direction))
      hit = { t, u, v, triangle, instance: nth };
  });
  return hit;
}

/**
 * Whether a ray comes to the front of a triangle, which its winding tells; in a mirroring instance, the other way
 * round.
 */
function isFront(
  { transform }: Instance,
  { positions, indices }: Mesh,
  triangle: number,
  direction: ArrayLike<number>,
): boolean {
  const [a, b, c] = [0, 1, 2].map((corner) => {
    const [x, y, z] = positions.subarray(3 * (indices[3 * triangle + corner] as number)) as unknown as [
      number,
      number,
      number,
    ];
    const placed: number[] = [];
    transformPoint(transform, x, y, z, placed);
    return placed;
  }) as [number[], number[], number[]];
  const from = (corner: number[]) => corner.map((value, k) => value - (a[k] as number));
  return determinant3([...from(b), 0, ...from(c), 0, ...Array.from(direction)]) * determinant3(transform) <= 0;
}
