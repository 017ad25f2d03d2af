import { expect, test } from 'vitest';
import { buildBlas, buildTlas, BvhError, TLAS_MAX_DEPTH } from '../src/index';
import { affine, randomNumbers, sphere } from './shapes';
import { checkStructure } from './structure';

const ball = sphere(8);
const { bounds } = buildBlas(ball);
const identity = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];

test('boxes hold every transformed vertex (seed 31)', () => {
  const random = randomNumbers(31);
  const transforms = Array.from({ length: 500 }, () => affine(random));
  const tlas = buildTlas(transforms.map((transform) => ({ bounds, transform })));
  checkStructure(
    tlas,
    500,
    (leaf) => {
      const m = transforms[tlas.instanceOrder[leaf]!]!;
      const box = [1, 1, 1, -1, -1, -1].map((s) => s * Infinity);
      for (let v = 0; v < ball.positions.length; v += 3) {
        for (let r = 0; r < 3; r++) {
          const x = m[r]! * ball.positions[v]! + m[4 + r]! * ball.positions[v + 1]! + m[8 + r]! * ball.positions[v + 2]! + m[12 + r]!;
          box[r] = Math.min(box[r]!, x);
          box[3 + r] = Math.max(box[3 + r]!, x);
        }
      }
      return box;
    },
    1,
    TLAS_MAX_DEPTH,
  );
});

test('toObject undoes the transform (seed 32)', () => {
  const random = randomNumbers(32);
  for (let i = 0; i < 50; i++) {
    const m = affine(random);
    const { toObject } = buildTlas([{ bounds, transform: m }]);
    const p = [random(), random(), random()];
    const w = [0, 1, 2].map((r) => m[r]! * p[0]! + m[4 + r]! * p[1]! + m[8 + r]! * p[2]! + m[12 + r]!);
    for (let r = 0; r < 3; r++) expect(toObject[4 * r]! * w[0]! + toObject[4 * r + 1]! * w[1]! + toObject[4 * r + 2]! * w[2]! + toObject[4 * r + 3]!).toBeCloseTo(p[r]!, 10);
  }
});

test('instances that cannot be hit are left out', () => {
  const flat = [1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
  const broken = [NaN, ...identity.slice(1)];
  const empty = buildBlas({ positions: new Float32Array(0) }).bounds;
  const tlas = buildTlas([{ bounds, transform: flat }, { bounds, transform: identity }, { bounds, transform: broken }, { bounds: empty, transform: identity }]);
  expect([...tlas.instanceOrder]).toEqual([1]);
  expect(buildTlas([]).instanceOrder).toHaveLength(0);
  expect(() => buildTlas([{ bounds, transform: [1] }])).toThrow(BvhError);
});
