import type { Instance, Mesh, Scene } from '@glanz/scene';
import type { parametersOf } from '../materials/parameters';

/** Spheres that light paths are aimed at. */
export const CASTERS = 8;

/** Below this roughness lobes are deltas. */
const SMOOTH = 0.01;

/** Up to this one light paths are reflected by rough metals: see light_gloss.wesl. */
const ROUGH = 0.5;

type Sphere = readonly [x: number, y: number, z: number, radius: number];

const spheres = new WeakMap<Float32Array, Sphere>();

/** A sphere around a mesh. */
function meshSphere({ positions }: Mesh): Sphere {
  let sphere = spheres.get(positions);
  if (!sphere) {
    const low = [Infinity, Infinity, Infinity];
    const high = [-Infinity, -Infinity, -Infinity];
    positions.forEach((value, i) => {
      low[i % 3] = Math.min(low[i % 3] as number, value);
      high[i % 3] = Math.max(high[i % 3] as number, value);
    });
    const [x, y, z] = low.map((value, k) => (value + (high[k] as number)) / 2) as [number, number, number];
    let radius = 0;
    for (let i = 0; i < positions.length; i += 3) {
      const offset = [(positions[i] as number) - x, (positions[i + 1] as number) - y, (positions[i + 2] as number) - z];
      radius = Math.max(radius, Math.hypot(...offset));
    }
    spheres.set(positions, (sphere = [x, y, z, radius]));
  }
  return sphere;
}

/** A sphere around a mesh that has been placed by a matrix. */
function placed([x, y, z, radius]: Sphere, m: ArrayLike<number>): Sphere {
  const [px, py, pz] = [0, 1, 2].map((k) => {
    const [a, b, c, d] = [0, 4, 8, 12].map((column) => m[k + column]) as [number, number, number, number];
    return a * x + b * y + c * z + d;
  }) as [number, number, number];
  // At most what the matrix stretches, and a little for rounding.
  const scale = Math.hypot(...[0, 1, 2, 4, 5, 6, 8, 9, 10].map((i) => m[i] as number));
  const columns = [0, 4, 8].map((k) => Math.hypot(...[0, 1, 2].map((i) => m[k + i] as number)));
  const isEven = Math.max(...columns) - Math.min(...columns) < 1e-3 * Math.max(...columns);
  return [px, py, pz, 1.001 * radius * (isEven ? Math.max(...columns) : scale)];
}

const between = (a: Sphere, b: Sphere) => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);

/** The smallest sphere around two. */
function joined(a: Sphere, b: Sphere): Sphere {
  const distance = between(a, b);
  if (distance + b[3] <= a[3]) return a;
  if (distance + a[3] <= b[3]) return b;
  const radius = (distance + a[3] + b[3]) / 2;
  const t = (radius - a[3]) / distance;
  return [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2]), radius];
}

/** Joins the two spheres whose common one has the least area beyond theirs. */
function join(list: Sphere[]): void {
  let best = Infinity;
  let pair: readonly [number, number] = [0, 1];
  for (let i = 0; i < list.length; i++)
    for (let k = i + 1; k < list.length; k++) {
      const [a, b] = [list[i] as Sphere, list[k] as Sphere];
      const growth = joined(a, b)[3] ** 2 - a[3] ** 2 - b[3] ** 2;
      if (growth < best) [best, pair] = [growth, [i, k]];
    }
  const [i, k] = pair;
  list[i] = joined(list[i] as Sphere, list[k] as Sphere);
  list.splice(k, 1);
}

/**
 * The table of light_aim.wesl: spheres around instances that mirror or refract sharply, and rough metals. Which there are
 * decides how noisy caustics are, not how bright.
 *
 * @param scene What is in it.
 * @param isVisible Whether an instance can be hit.
 * @param parameters Of a material.
 * @param options `isSmooth`: whether rays of opaque surfaces with normals leave from the smooth surface, so that light
 * paths do not go on from there; `isGlossy`: whether light paths are reflected by rough metals.
 * @returns The table, without the number of light paths, its second value.
 */
export function castersOf(
  { instances, materials, meshes }: Scene,
  isVisible: (instance: Instance) => boolean,
  parameters: typeof parametersOf,
  { isSmooth, isGlossy }: { readonly isSmooth: boolean; readonly isGlossy: boolean },
): Float32Array<ArrayBuffer> {
  const chosen = materials.map((material) => {
    const p = parameters(material);
    const layered = p.coat_weight + p.fuzz_weight + p.thin_film_weight + p.subsurface_weight > 0;
    const textured = Object.keys(material.textures ?? {}).length > 0;
    const clear = p.transmission_weight > 0 && !p.geometry_thin_walled;
    const fits = p.specular_roughness <= SMOOTH && !layered && !textured;
    const opaque = p.transmission_weight === 0;
    const rough = p.specular_roughness > SMOOTH && p.specular_roughness <= ROUGH && p.base_metalness >= 0.5;
    return {
      clear: fits && clear,
      mirror: fits && p.base_metalness > 0 && opaque,
      glossy: isGlossy && rough && opaque && p.subsurface_weight === 0 && !textured,
    };
  });
  const list: Sphere[] = [];
  const all: Sphere[] = [];
  let hasGlossy = false;
  for (const instance of instances) {
    if (!isVisible(instance)) continue;
    const mesh = meshes[instance.mesh] as Mesh;
    const { clear, mirror, glossy } = chosen[instance.material] as (typeof chosen)[number];
    const sphere = placed(meshSphere(mesh), instance.transform);
    all.push(sphere);
    if (sphere[3] > 0 && (clear || glossy || (mirror && !(isSmooth && mesh.normals)))) {
      list.push(sphere);
      hasGlossy ||= glossy;
    }
    if (list.length > CASTERS) join(list);
  }
  const table = new Float32Array(4 * (2 * CASTERS + 1));
  table[0] = list.length;
  table[2] = Number(hasGlossy);
  const total = list.reduce((sum, sphere) => sum + sphere[3] ** 2, 0);
  let below = 0;
  list.forEach((sphere, i) => {
    const chance = sphere[3] ** 2 / total;
    below += chance;
    // Rays from the environment start outside of everything.
    const away = all.reduce((max, other) => Math.max(max, between(sphere, other) + other[3]), 0);
    table.set([...sphere, chance, below, 1.01 * away, 0], 4 + 8 * i);
  });
  return table;
}
