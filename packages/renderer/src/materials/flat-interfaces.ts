import type { Mesh, Scene } from '@glanz/scene';
import { refractsLight } from './interiors';

/** Of large meshes so many triangles are looked at, evenly spread. */
const LOOKED_AT = 10_000;

/** Square of the distance between the unit normals of two corners up to which their triangle is flat. */
const FLAT = 1e-6;

/** The share of triangles whose corners have one normal: the triangle's own. */
function flatShare({ normals, indices }: Mesh): number {
  if (!normals) return 1;
  let [all, flat] = [0, 0];
  for (let i = 0; i < indices.length; i += 3 * Math.ceil(indices.length / 3 / LOOKED_AT)) {
    const differs = (corner: number, k: number) =>
      normals[3 * indices[i + corner]! + k]! - normals[3 * indices[i]! + k]!;
    const apart = (corner: number) => Math.hypot(differs(corner, 0), differs(corner, 1), differs(corner, 2)) ** 2;
    all++;
    if (apart(1) + apart(2) <= FLAT) flat++;
  }
  return flat / all;
}

/**
 * Whether light samples for media behind smooth glass pay: they find ways through flat parts of its surface alone (see
 * `refracted_way.wesl`), and of one of them most triangles are flat.
 */
export function hasFlatInterfaces({ materials, instances, meshes }: Scene): boolean {
  const chosen = materials.map(refractsLight);
  if (!chosen.includes(true)) return false;
  const shapes = new Set(instances.flatMap(({ material, mesh }) => (chosen[material] ? [meshes[mesh]!] : [])));
  return [...shapes].some((mesh) => flatShare(mesh) > 0.5);
}
