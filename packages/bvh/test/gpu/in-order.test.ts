import { expect, test } from 'vitest';
import { buildBlas, closestHit, type TriangleMesh } from '../../src/index';
import { blasInOrder } from '../../src/gpu/index';
import { randomNumbers, sphere, strewn } from '../shapes';
import { checkBlas } from '../structure';

const identity = (count: number) => Uint32Array.from({ length: count }, (_, i) => i);

test('a hierarchy in a given order is sound, for any number of triangles (seed 3)', () => {
  const random = randomNumbers(3);
  for (const count of [1, 2, 4, 5, 8, 9, 100, 1023]) {
    const mesh = strewn(count, 0.2, random);
    const blas = blasInOrder(mesh, identity(count));
    checkBlas(blas, mesh);
    expect(blas.bounds).toEqual(buildBlas(mesh).bounds);
  }
});

test('queries hit what they hit in the tree of buildBlas, whatever the order (seed 4)', () => {
  const random = randomNumbers(4);
  const soup: TriangleMesh = { positions: strewn(500, 0.3, random).positions };
  for (const mesh of [sphere(24), soup]) {
    const built = buildBlas(mesh);
    const shuffled = built.triangleIndices.slice();
    for (let i = shuffled.length - 1; i > 0; i--) {
      const j = Math.floor((i + 1) * random());
      [shuffled[i], shuffled[j]] = [shuffled[j]!, shuffled[i]!];
    }
    for (const order of [built.triangleIndices, shuffled]) {
      const blas = blasInOrder(mesh, order);
      let hits = 0;
      for (let i = 0; i < 300; i++) {
        const ray = {
          origin: [3 * random() - 1.5, 3 * random() - 1.5, 2],
          direction: [random() - 0.5, random() - 0.5, -2],
        };
        const expected = closestHit(built, mesh, ray);
        expect(closestHit(blas, mesh, ray)).toEqual(expected);
        if (expected) hits++;
      }
      expect(hits).toBeGreaterThan(50);
    }
  }
});

test('of no triangles, a hierarchy that nothing hits', () => {
  const mesh = { positions: new Float32Array(0), indices: new Uint32Array(0) };
  const blas = blasInOrder(mesh, new Uint32Array(0));
  expect(blas.bounds).toEqual(buildBlas(mesh).bounds);
  expect(closestHit(blas, mesh, { origin: [0, 0, 1], direction: [0, 0, -1] })).toBeUndefined();
});
