import { expect, test } from 'vitest';
import { anyHit, anyHitInstances, buildBlas, buildTlas, closestHit, closestHitInstances } from '../../src/index';
import { affine, baked, bruteForce, direction, randomNumbers, sphere, strewn } from '../shapes';

for (const seed of [41, 42, 43, 44]) {
  test(`closestHit and anyHit agree with brute force (seed ${seed})`, () => {
    const random = randomNumbers(seed);
    const mesh = strewn(400, [0.1, 0.2, 0.6, 2][seed % 4]!, random);
    const blas = buildBlas(mesh);
    let hits = 0;
    for (let i = 0; i < 400; i++) {
      // From anywhere around towards the middle, with directions of any length.
      const origin = [0, 1, 2].map(() => 4 * random() - 2);
      const length = 0.1 + 3 * random();
      const ray = { origin, direction: origin.map((x) => (random() - 0.5 - x) * length) };
      const expected = bruteForce(mesh, ray.origin, ray.direction);
      const hit = closestHit(blas, mesh, ray);
      expect(hit?.triangle).toBe(expected?.triangle);
      expect(anyHit(blas, mesh, ray)).toBe(expected !== undefined);
      if (!hit || !expected) continue;
      hits++;
      expect(hit.t).toBeCloseTo(expected.t, 9);
      expect(hit.u).toBeCloseTo(expected.u, 7);
      expect(hit.v).toBeCloseTo(expected.v, 7);
      // The interval is open at both ends.
      expect(anyHit(blas, mesh, { ...ray, tMax: hit.t })).toBe(false);
      expect(anyHit(blas, mesh, { ...ray, tMax: hit.t * (1 + 1e-12) })).toBe(true);
      const behind = closestHit(blas, mesh, { ...ray, tMin: hit.t });
      if (behind) expect(behind.t).toBeGreaterThan(hit.t);
    }
    expect(hits).toBeGreaterThan(20);
  });
}

test('instances: transforms with shear and mirrors agree with brute force on transformed triangles (seed 45)', () => {
  const random = randomNumbers(45);
  const meshes = [sphere(8), strewn(60, 0.4, random)];
  const parts = meshes.map((mesh) => ({ mesh, blas: buildBlas(mesh) }));
  const placed = Array.from({ length: 30 }, (_, i) => ({ ...parts[i % 2]!, transform: affine(random, 3) }));
  const tlas = buildTlas(placed.map(({ blas, transform }) => ({ bounds: blas.bounds, transform })));
  const inWorld = placed.map(({ mesh, transform }) => baked(mesh, transform));
  let hits = 0;
  for (let i = 0; i < 300; i++) {
    const origin = direction(random).map((x) => 5 * x);
    const ray = { origin, direction: origin.map((x) => 4 * (random() - 0.5) - x) };
    const all = inWorld.map((mesh) => bruteForce(mesh, ray.origin, ray.direction));
    const nearest = all.reduce((best, hit, j) => (hit && hit.t < (best < 0 ? Infinity : all[best]!.t) ? j : best), -1);
    const hit = closestHitInstances(tlas, placed, ray);
    expect(hit?.instance ?? -1).toBe(nearest);
    expect(anyHitInstances(tlas, placed, ray)).toBe(nearest >= 0);
    if (!hit) continue;
    hits++;
    expect(hit.triangle).toBe(all[nearest]!.triangle);
    expect(hit.t).toBeCloseTo(all[nearest]!.t, 8);
  }
  expect(hits).toBeGreaterThan(50);
});

test('no ray from inside a closed mesh gets out, through vertices and edges neither (seed 46)', () => {
  const random = randomNumbers(46);
  for (const [radius, center] of [
    [1, [0, 0, 0]],
    [0.001, [5, 3, 1]],
    [10000, [20000, 0, 0]],
  ] as const) {
    const mesh = sphere(32, radius, center);
    const blas = buildBlas(mesh);
    const { positions: p, indices } = mesh;
    for (let i = 0; i < indices.length; i += 3) {
      const [a, b] = [3 * indices[i]!, 3 * indices[i + 1]!];
      const s = random();
      const origin = direction(random).map((x, k) => 0.3 * radius * x + center[k]!);
      for (const weight of [0, 0.5, s]) {
        const target = [0, 1, 2].map((k) => (1 - weight) * p[a + k]! + weight * p[b + k]! - origin[k]!);
        expect(anyHit(blas, mesh, { origin, direction: target })).toBe(true);
      }
    }
  }
});

test('axis-aligned rays along the faces of boxes are safe', () => {
  const mesh = sphere(16);
  const blas = buildBlas(mesh);
  for (const direction of [
    [1, 0, 0],
    [0, -1, 0],
    [0, 0, 1],
    [-1, -0, 0],
  ])
    expect(closestHit(blas, mesh, { origin: [0, 0, 0], direction })?.t).toBeCloseTo(1, 6);
});

test('no ray gets between boxes that touch along an edge, aimed at it to the last bit from close to a large mesh (seed 47)', () => {
  // Rows of quads of 1 km and more whose boxes touch in planes; rounding moves the vertices by far more than the
  // distance of the ray's origin from the edge is known to.
  const random = randomNumbers(47);
  const side = 12,
    size = 1000;
  const positions: number[] = [],
    indices: number[] = [];
  for (let i = 0; i <= side; i++)
    for (let j = 0; j <= side; j++) positions.push((i - side / 2) * size, (j - side / 2) * size, 0);
  for (let i = 0; i < side; i++)
    for (let j = 0; j < side; j++) {
      const a = i * (side + 1) + j,
        b = a + side + 1;
      indices.push(a, b, b + 1, a, b + 1, a + 1);
    }
  const mesh = { positions: new Float32Array(positions), indices: new Uint32Array(indices) };
  const blas = buildBlas(mesh, { maxLeafTriangles: 1 });
  for (let i = 0; i < 20000; i++) {
    const height = 10 ** (-6 * random());
    const slip = () => (random() - 0.5) * 10 ** (-20 * random());
    const edge = [(1 + Math.floor(random() * (side - 1)) - side / 2) * size, size * side * (random() - 0.5)];
    if (i & 1) edge.reverse();
    const origin = [edge[0]! + height * (random() - 0.5), edge[1]! + height * (random() - 0.5), height];
    expect(
      anyHit(blas, mesh, {
        origin,
        direction: [edge[0]! + slip() - origin[0]!, edge[1]! + slip() - origin[1]!, -height],
      }),
    ).toBe(true);
  }
});

test('directions of any length and tMin below zero', () => {
  const mesh = { positions: new Float32Array([-1, -1, 0, 3, -1, 0, -1, 3, 0]) };
  const blas = buildBlas(mesh);
  for (const length of [1e-280, 1e-30, 1, 1e30, 1e280]) {
    expect(closestHit(blas, mesh, { origin: [0, 0, 2], direction: [0, 0, -length] })!.t * length).toBeCloseTo(2, 12);
    expect(
      closestHit(blas, mesh, { origin: [0, 0, -2], direction: [0.01 * length, 0, -length], tMin: -Infinity })!.t *
        length,
    ).toBeCloseTo(-2, 12);
  }
  expect(closestHit(blas, mesh, { origin: [-1, 0, -2], direction: [0, 0, -1], tMin: -5 })!.t).toBe(-2);
  for (const bad of [
    { origin: [0, 0, 2], direction: [0, 0, 0] },
    { origin: [NaN, 0, 2], direction: [0, 0, -1] },
    { origin: [0, 0, 2], direction: [0, NaN, -1] },
  ])
    expect(closestHit(blas, mesh, bad)).toBeUndefined();
});
