import type { Aabb } from '@glanz/bvh';
import type { BenchMesh } from './meshes';

/** Numbers of a ray: origin xyz, tMin, direction xyz, tMax. */
const RAY = 8;
const FAR = 3e38;

/** Random numbers in [0, 1) (mulberry32), seeded. */
export function randomNumbers(seed: number): () => number {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let t = Math.imul(state ^ (state >>> 15), state | 1);
    t ^= t + Math.imul(t ^ (t >>> 7), t | 61);
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}

/** Middle and half the diagonal of a box. */
function sphereAround({ min, max }: Aabb): { center: number[]; radius: number } {
  return {
    center: [0, 1, 2].map((k) => 0.5 * (min[k]! + max[k]!)),
    radius: 0.5 * Math.hypot(...[0, 1, 2].map((k) => max[k]! - min[k]!)),
  };
}

/** Half the side of the room around a mesh, in radii of the mesh. */
const ROOM = 2.5;

/**
 * A mesh in a closed cubic room, so that rays that leave it hit something. Gives the bounds of the mesh alone as well.
 */
export function inRoom({ name, positions, indices }: BenchMesh): { mesh: BenchMesh; bounds: Aabb } {
  const bounds = { min: new Float32Array(3).fill(Infinity), max: new Float32Array(3).fill(-Infinity) };
  positions.forEach((x, i) => {
    bounds.min[i % 3] = Math.min(bounds.min[i % 3]!, x);
    bounds.max[i % 3] = Math.max(bounds.max[i % 3]!, x);
  });
  const { center, radius } = sphereAround(bounds);
  const corners = Array.from(
    { length: 24 },
    (_, i) => center[i % 3]! + ((Math.floor(i / 3) >> (i % 3)) & 1 ? ROOM : -ROOM) * radius,
  );
  const first = positions.length / 3;
  const sides = [
    0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5,
  ].map((i) => first + i);
  const all = {
    name,
    positions: new Float32Array(positions.length + 24),
    indices: new Uint32Array(indices.length + 36),
  };
  all.positions.set(positions);
  all.positions.set(corners, positions.length);
  all.indices.set(indices);
  all.indices.set(sides, indices.length);
  return { mesh: all, bounds };
}

/** Where a camera stands, in radii of the mesh from its middle, and the tangent of half its angle. */
export interface View {
  readonly from: readonly [number, number, number];
  readonly tangent: number;
}

/** From near: the mesh fills the image. */
export const NEAR: View = { from: [1.2, 0.9, 1.6], tangent: 0.4 };
/** From a corner of the room with a lens of 60°: the mesh covers a fifth of the image, its room the rest. */
export const AFAR: View = { from: [2.2, 1.6, 2.3], tangent: 0.577 };

/** One ray through each pixel of a square image from the front right above, in tiles of 8 × 8 pixels. */
export function primaryRays(bounds: Aabb, size: number, { from, tangent }: View = NEAR): Float32Array<ArrayBuffer> {
  const random = randomNumbers(1);
  const { center, radius } = sphereAround(bounds);
  const eye = from.map((x, k) => center[k]! + x * radius);
  const length = Math.hypot(...eye.map((x, k) => center[k]! - x));
  const ahead = eye.map((x, k) => (center[k]! - x) / length);
  const across = Math.hypot(ahead[2]!, ahead[0]!);
  const right = [-ahead[2]! / across, 0, ahead[0]! / across];
  const up = [
    right[1]! * ahead[2]! - right[2]! * ahead[1]!,
    right[2]! * ahead[0]! - right[0]! * ahead[2]!,
    right[0]! * ahead[1]! - right[1]! * ahead[0]!,
  ];
  const rays = new Float32Array(RAY * size * size);
  let at = 0;
  for (let tile = 0; tile < (size / 8) ** 2; tile++) {
    for (let pixel = 0; pixel < 64; pixel++, at += RAY) {
      const x = ((8 * (tile % (size / 8)) + (pixel % 8) + random()) / size) * 2 - 1,
        y = ((8 * Math.floor(tile / (size / 8)) + Math.floor(pixel / 8) + random()) / size) * 2 - 1;
      for (let k = 0; k < 3; k++) {
        rays[at + k] = eye[k]!;
        rays[at + 4 + k] = ahead[k]! + tangent * (x * right[k]! + y * up[k]!);
      }
      rays[at + 7] = FAR;
    }
  }
  return rays;
}

/** Calls back with the point and the normal, on the ray's side, of each ray that has hit something. */
function forEachPoint(
  rays: Float32Array,
  results: Uint32Array,
  { positions, indices }: BenchMesh,
  visit: (point: readonly number[], normal: readonly number[]) => void,
): void {
  const t = new Float32Array(results.buffer, results.byteOffset, results.length);
  for (let i = 0; i < results.length / 2; i++) {
    const triangle = results[2 * i + 1]!;
    if (triangle === 0xffffffff) continue;
    const [a, b, c] = [0, 1, 2].map((corner) => 3 * indices[3 * triangle + corner]!) as [number, number, number];
    const e = [0, 1, 2].map((k) => positions[b + k]! - positions[a + k]!),
      f = [0, 1, 2].map((k) => positions[c + k]! - positions[a + k]!);
    const n = [e[1]! * f[2]! - e[2]! * f[1]!, e[2]! * f[0]! - e[0]! * f[2]!, e[0]! * f[1]! - e[1]! * f[0]!];
    const length = Math.hypot(...n);
    if (!(length > 0)) continue;
    const d = [0, 1, 2].map((k) => rays[RAY * i + 4 + k]!);
    const side = n.reduce((sum, x, k) => sum + x * d[k]!, 0) > 0 ? -1 / length : 1 / length;
    visit(
      [0, 1, 2].map((k) => rays[RAY * i + k]! + t[2 * i]! * d[k]!),
      n.map((x) => x * side),
    );
  }
}

function gather(
  bounds: Aabb,
  rays: Float32Array,
  results: Uint32Array,
  mesh: BenchMesh,
  aim: (normal: readonly number[], point: readonly number[]) => readonly [direction: readonly number[], tMax: number],
): Float32Array<ArrayBuffer> {
  const { radius } = sphereAround(bounds);
  const made = new Float32Array(RAY * (results.length / 2));
  let at = 0;
  forEachPoint(rays, results, mesh, (point, normal) => {
    const [direction, tMax] = aim(normal, point);
    for (let k = 0; k < 3; k++) {
      made[at + k] = point[k]! + 1e-5 * radius * normal[k]!;
      made[at + 4 + k] = direction[k]!;
    }
    made[at + 7] = tMax;
    at += RAY;
  });
  return made.slice(0, at);
}

/** From each point hit, one ray to a random point of a square light above the scene. */
export function shadowRays(
  bounds: Aabb,
  rays: Float32Array,
  results: Uint32Array,
  mesh: BenchMesh,
): Float32Array<ArrayBuffer> {
  const random = randomNumbers(2);
  const { center, radius } = sphereAround(bounds);
  return gather(bounds, rays, results, mesh, (_, point) => [
    [center[0]! + (random() - 0.5) * radius, center[1]! + 1.5 * radius, center[2]! + (random() - 0.5) * radius].map(
      (x, k) => x - point[k]!,
    ),
    1,
  ]);
}

/** From each point hit, one ray to a point above the scene. */
export function pointShadowRays(
  bounds: Aabb,
  rays: Float32Array,
  results: Uint32Array,
  mesh: BenchMesh,
): Float32Array<ArrayBuffer> {
  const { center, radius } = sphereAround(bounds);
  return gather(bounds, rays, results, mesh, (_, point) => [
    [center[0]!, center[1]! + 1.5 * radius, center[2]!].map((x, k) => x - point[k]!),
    1,
  ]);
}

/** From each point hit, one ray in a cosine-distributed direction. */
export function diffuseRays(
  bounds: Aabb,
  rays: Float32Array,
  results: Uint32Array,
  mesh: BenchMesh,
  seed: number,
): Float32Array<ArrayBuffer> {
  const random = randomNumbers(seed);
  return gather(bounds, rays, results, mesh, (normal) => {
    const z = 2 * random() - 1,
      phi = 2 * Math.PI * random(),
      r = Math.sqrt(1 - z * z);
    const d = [normal[0]! + r * Math.cos(phi), normal[1]! + r * Math.sin(phi), normal[2]! + z];
    const length = Math.hypot(...d);
    return [length > 1e-6 ? d.map((x) => x / length) : normal, FAR];
  });
}
