import type { Mesh, Scene } from '@glanz/scene';
import { refractsLight } from './interiors';

/** Cosine between a triangle and the normals of its corners from which on it is flat. */
const FLAT = 1 - 1e-6;

const dot = (a: readonly number[], b: readonly number[]) => a.reduce((sum, x, k) => sum + x * b[k]!, 0);

type Areas = readonly [all: number, flat: number];

const known = new WeakMap<Mesh, Areas>();

/** Of large meshes so many triangles are looked at, evenly spread. */
const LOOKED_AT = 10_000;

/** Areas of all triangles, and of those whose corners have the triangle's own normal. */
function areasOf({ positions, normals, indices }: Mesh): Areas {
  let [all, flat] = [0, 0];
  const count = indices?.length ?? positions.length / 3;
  const every = Math.ceil(count / 3 / LOOKED_AT);
  for (let i = 0; i < count; i += 3 * every) {
    const corners = [i, i + 1, i + 2].map((at) => 3 * (indices?.[at] ?? at));
    const [u, v] = [1, 2].map((corner) =>
      [0, 1, 2].map((k) => positions[corners[corner]! + k]! - positions[corners[0]! + k]!),
    ) as [number[], number[]];
    const face = [0, 1, 2].map((k) => u[(k + 1) % 3]! * v[(k + 2) % 3]! - u[(k + 2) % 3]! * v[(k + 1) % 3]!);
    const area = Math.hypot(...face);
    all += area;
    const bent = corners.some((at) => {
      const normal = normals && [...normals.subarray(at, at + 3)];
      return normal && !(dot(face, normal) >= FLAT * area * Math.hypot(...normal));
    });
    if (!bent) flat += area;
  }
  return [every * all, every * flat];
}

/**
 * Whether light samples for media behind smooth glass pay: they find ways through flat parts of its surface alone (see
 * `refracted_way.wesl`), and most of the surface is flat.
 */
export function hasFlatInterfaces({ materials, instances, meshes }: Scene): boolean {
  const chosen = materials.map(refractsLight);
  if (!chosen.includes(true)) return false;
  const shapes = new Set(instances.flatMap(({ material, mesh }) => (chosen[material] ? [meshes[mesh]!] : [])));
  let [all, flat] = [0, 0];
  for (const mesh of shapes) {
    const areas = known.get(mesh) ?? areasOf(mesh);
    known.set(mesh, areas);
    all += areas[0];
    flat += areas[1];
  }
  return flat > 0.5 * all;
}
