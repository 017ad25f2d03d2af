import { expect, test } from 'vitest';
import { buildBlas, BvhError, closestHit } from '../src/index';
import { refitBlas } from '../src/refit';
import { bruteForce, direction, randomNumbers, sphere, strewn } from './shapes';
import { checkBlas } from './structure';

test('a refitted tree finds what brute force finds in the moved mesh (seed 21)', () => {
  const random = randomNumbers(21);
  const mesh = sphere(24);
  const blas = buildBlas(mesh);
  const positions = mesh.positions.map((x, i) => x * (1 + 0.3 * Math.sin(i)) + 0.2);
  const moved = { positions, indices: mesh.indices };
  refitBlas(blas, moved);
  checkBlas(blas, moved);
  for (let k = 0; k < 3; k++)
    expect(blas.bounds.min[k]).toBe(positions.filter((_, i) => i % 3 === k).reduce((a, b) => Math.min(a, b)));
  for (let i = 0; i < 300; i++) {
    const ray = { origin: direction(random).map((x) => 3 * x), direction: direction(random) };
    const expected = bruteForce(moved, ray.origin, ray.direction);
    const hit = closestHit(blas, moved, ray);
    expect(hit?.triangle).toBe(expected?.triangle);
  }
});

test('refitting to the same mesh changes nothing', () => {
  const mesh = strewn(500, 0.2, randomNumbers(22));
  for (const part of [mesh, { positions: mesh.positions.subarray(0, 9) }]) {
    const blas = buildBlas(part);
    const before = structuredClone(blas);
    refitBlas(blas, part);
    expect(blas).toEqual(before);
  }
});

test('another mesh and lost vertices are refused', () => {
  const mesh = strewn(10, 0.2, randomNumbers(24));
  const blas = buildBlas(mesh);
  expect(() => refitBlas(blas, { positions: mesh.positions.subarray(0, 81) })).toThrow(BvhError);
  expect(() => refitBlas(blas, { positions: mesh.positions.map(() => NaN) })).toThrow(/no|not finite/);
  for (const bad of [NaN, Infinity, -Infinity]) {
    const positions = mesh.positions.slice();
    positions[50] = bad;
    expect(() => refitBlas(buildBlas(mesh), { positions })).toThrow(/^Triangle 5 /);
  }
  expect(() =>
    refitBlas(buildBlas(mesh), { positions: mesh.positions, indices: mesh.indices.subarray(0, 27) }),
  ).toThrow(/^Triangle 9 /);
});
