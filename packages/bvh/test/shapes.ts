import type { TriangleMesh } from '../src/index';

/** A seeded generator of numbers in [0, 1) (mulberry32). */
export function randomNumbers(seed: number): () => number {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let t = state;
    t = Math.imul(t ^ (t >>> 15), t | 1);
    t ^= t + Math.imul(t ^ (t >>> 7), t | 61);
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}

/** Triangles of one size strewn over a cube of side 2 around the origin; no two share a vertex. */
export function strewn(
  count: number,
  size: number,
  random: () => number,
): Required<Pick<TriangleMesh, 'positions'>> & { indices: Uint32Array } {
  const positions = new Float32Array(count * 9);
  for (let i = 0; i < count; i++) {
    for (let k = 0; k < 3; k++) {
      const center = 2 * random() - 1;
      for (let corner = 0; corner < 3; corner++) positions[9 * i + 3 * corner + k] = center + size * (random() - 0.5);
    }
  }
  return { positions, indices: Uint32Array.from({ length: count * 3 }, (_, i) => i) };
}

/** A closed, welded sphere: no seam, every edge shared by two triangles. */
export function sphere(
  segments: number,
  radius = 1,
  center: readonly number[] = [0, 0, 0],
): { positions: Float32Array; indices: Uint32Array } {
  const rings = segments / 2;
  const positions: number[] = [];
  const indices: number[] = [];
  const put = (theta: number, phi: number) =>
    positions.push(
      ...[Math.sin(theta) * Math.cos(phi), Math.cos(theta), Math.sin(theta) * Math.sin(phi)].map(
        (x, k) => x * radius + (center[k] as number),
      ),
    );
  put(0, 0);
  for (let i = 1; i < rings; i++)
    for (let j = 0; j < segments; j++) put((i * Math.PI) / rings, (j * 2 * Math.PI) / segments);
  put(Math.PI, 0);
  const at = (i: number, j: number) => 1 + (i - 1) * segments + (j % segments);
  const last = 1 + (rings - 1) * segments;
  for (let j = 0; j < segments; j++) {
    indices.push(0, at(1, j + 1), at(1, j));
    for (let i = 1; i < rings - 1; i++)
      indices.push(at(i, j), at(i, j + 1), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j));
    indices.push(last, at(rings - 1, j), at(rings - 1, j + 1));
  }
  return { positions: new Float32Array(positions), indices: new Uint32Array(indices) };
}

/** What a ray meets. */
export interface BruteHit {
  t: number;
  u: number;
  v: number;
  triangle: number;
}

/** All hits by Möller and Trumbore's test on every triangle: slow, and nothing in common with the package's test. */
export function bruteForceAll(
  mesh: TriangleMesh,
  o: ArrayLike<number>,
  d: ArrayLike<number>,
  tMin = 0,
  tMax = Infinity,
): BruteHit[] {
  const { positions: p, indices } = mesh;
  const count = indices ? indices.length / 3 : p.length / 9;
  const hits: BruteHit[] = [];
  const ox = o[0]!,
    oy = o[1]!,
    oz = o[2]!,
    dx = d[0]!,
    dy = d[1]!,
    dz = d[2]!;
  for (let i = 0; i < count; i++) {
    const a = 3 * (indices ? indices[3 * i]! : 3 * i),
      b = 3 * (indices ? indices[3 * i + 1]! : 3 * i + 1),
      c = 3 * (indices ? indices[3 * i + 2]! : 3 * i + 2);
    const ax = p[a]!,
      ay = p[a + 1]!,
      az = p[a + 2]!;
    const e0 = p[b]! - ax,
      e1 = p[b + 1]! - ay,
      e2 = p[b + 2]! - az;
    const f0 = p[c]! - ax,
      f1 = p[c + 1]! - ay,
      f2 = p[c + 2]! - az;
    const q0 = dy * f2 - dz * f1,
      q1 = dz * f0 - dx * f2,
      q2 = dx * f1 - dy * f0;
    const det = e0 * q0 + e1 * q1 + e2 * q2;
    if (det === 0 || !Number.isFinite(det)) continue;
    const s0 = ox - ax,
      s1 = oy - ay,
      s2 = oz - az;
    const u = (s0 * q0 + s1 * q1 + s2 * q2) / det;
    const r0 = s1 * e2 - s2 * e1,
      r1 = s2 * e0 - s0 * e2,
      r2 = s0 * e1 - s1 * e0;
    const v = (dx * r0 + dy * r1 + dz * r2) / det;
    const t = (f0 * r0 + f1 * r1 + f2 * r2) / det;
    if (u >= 0 && v >= 0 && u + v <= 1 && t > tMin && t < tMax) hits.push({ t, u, v, triangle: i });
  }
  return hits;
}

/** Nearest hit of {@link bruteForceAll}. */
export function bruteForce(
  mesh: TriangleMesh,
  o: ArrayLike<number>,
  d: ArrayLike<number>,
  tMax = Infinity,
): BruteHit | undefined {
  let best: BruteHit | undefined;
  for (const hit of bruteForceAll(mesh, o, d, 0, tMax)) if (!best || hit.t < best.t) best = hit;
  return best;
}

/** The mesh with each vertex transformed, in double precision. */
export function baked(mesh: TriangleMesh, m: ArrayLike<number>): TriangleMesh {
  const positions = Float64Array.from(mesh.positions, (_, i) => {
    const v = i - (i % 3),
      r = i % 3;
    return (
      m[r]! * mesh.positions[v]! + m[4 + r]! * mesh.positions[v + 1]! + m[8 + r]! * mesh.positions[v + 2]! + m[12 + r]!
    );
  });
  return { indices: mesh.indices, positions: positions as unknown as Float32Array };
}

/** A random direction of unit length. */
export function direction(random: () => number): [number, number, number] {
  const z = 2 * random() - 1,
    phi = 2 * Math.PI * random(),
    r = Math.sqrt(1 - z * z);
  return [r * Math.cos(phi), r * Math.sin(phi), z];
}

/** A random affine transform, column-major: rotation-like axes of different lengths, sheared, at times mirrored. */
export function affine(random: () => number, spread = 2): Float64Array {
  const m = new Float64Array(16);
  m[15] = 1;
  let determinant = 0;
  while (Math.abs(determinant) < 0.05) {
    for (let c = 0; c < 3; c++) for (let r = 0; r < 3; r++) m[4 * c + r] = 1.6 * (random() - 0.5);
    determinant =
      m[0]! * (m[5]! * m[10]! - m[6]! * m[9]!) -
      m[4]! * (m[1]! * m[10]! - m[2]! * m[9]!) +
      m[8]! * (m[1]! * m[6]! - m[2]! * m[5]!);
  }
  for (let r = 0; r < 3; r++) m[12 + r] = spread * (2 * random() - 1);
  return m;
}
