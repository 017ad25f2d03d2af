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
export function strewn(count: number, size: number, random: () => number): Required<Pick<TriangleMesh, 'positions'>> & { indices: Uint32Array } {
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
export function sphere(segments: number, radius = 1, center: readonly number[] = [0, 0, 0]): { positions: Float32Array; indices: Uint32Array } {
  const rings = segments / 2;
  const positions: number[] = [];
  const indices: number[] = [];
  const put = (theta: number, phi: number) => positions.push(...[Math.sin(theta) * Math.cos(phi), Math.cos(theta), Math.sin(theta) * Math.sin(phi)].map((x, k) => x * radius + (center[k] as number)));
  put(0, 0);
  for (let i = 1; i < rings; i++) for (let j = 0; j < segments; j++) put((i * Math.PI) / rings, (j * 2 * Math.PI) / segments);
  put(Math.PI, 0);
  const at = (i: number, j: number) => 1 + (i - 1) * segments + (j % segments);
  const last = 1 + (rings - 1) * segments;
  for (let j = 0; j < segments; j++) {
    indices.push(0, at(1, j + 1), at(1, j));
    for (let i = 1; i < rings - 1; i++) indices.push(at(i, j), at(i, j + 1), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j));
    indices.push(last, at(rings - 1, j), at(rings - 1, j + 1));
  }
  return { positions: new Float32Array(positions), indices: new Uint32Array(indices) };
}

/** Nearest hit by Möller and Trumbore's test on every triangle: slow, and nothing in common with the package's test. */
export function bruteForce(mesh: TriangleMesh, o: ArrayLike<number>, d: ArrayLike<number>, tMax = Infinity): { t: number; u: number; v: number; triangle: number } | undefined {
  const { positions: p, indices } = mesh;
  let best: { t: number; u: number; v: number; triangle: number } | undefined;
  const count = indices ? indices.length / 3 : p.length / 9;
  const cross = (a: number[], b: number[]) => [a[1]! * b[2]! - a[2]! * b[1]!, a[2]! * b[0]! - a[0]! * b[2]!, a[0]! * b[1]! - a[1]! * b[0]!];
  const dot = (a: ArrayLike<number>, b: ArrayLike<number>) => a[0]! * b[0]! + a[1]! * b[1]! + a[2]! * b[2]!;
  for (let i = 0; i < count; i++) {
    const at = (c: number) => 3 * (indices ? (indices[3 * i + c] as number) : 3 * i + c);
    const v = [0, 1, 2].map((c) => [p[at(c)]!, p[at(c) + 1]!, p[at(c) + 2]!]);
    const e1 = v[1]!.map((x, k) => x - v[0]![k]!), e2 = v[2]!.map((x, k) => x - v[0]![k]!);
    const q = cross(Array.from(d), e2);
    const det = dot(e1, q);
    if (det === 0 || !Number.isFinite(det)) continue;
    const s = v[0]!.map((x, k) => o[k]! - x);
    const u = dot(s, q) / det;
    const r = cross(s, e1);
    const w = dot(d, r) / det;
    const t = dot(e2, r) / det;
    if (u >= 0 && w >= 0 && u + w <= 1 && t > 0 && t < (best?.t ?? tMax)) best = { t, u, v: w, triangle: i };
  }
  return best;
}

/** A random direction of unit length. */
export function direction(random: () => number): [number, number, number] {
  const z = 2 * random() - 1, phi = 2 * Math.PI * random(), r = Math.sqrt(1 - z * z);
  return [r * Math.cos(phi), r * Math.sin(phi), z];
}

/** A random affine transform, column-major: rotation-like axes of different lengths, sheared, at times mirrored. */
export function affine(random: () => number, spread = 2): Float64Array {
  const m = new Float64Array(16);
  m[15] = 1;
  let determinant = 0;
  while (Math.abs(determinant) < 0.05) {
    for (let c = 0; c < 3; c++) for (let r = 0; r < 3; r++) m[4 * c + r] = 1.6 * (random() - 0.5);
    determinant = m[0]! * (m[5]! * m[10]! - m[6]! * m[9]!) - m[4]! * (m[1]! * m[10]! - m[2]! * m[9]!) + m[8]! * (m[1]! * m[6]! - m[2]! * m[5]!);
  }
  for (let r = 0; r < 3; r++) m[12 + r] = spread * (2 * random() - 1);
  return m;
}
