import { expect, test } from 'vitest';
import { buildBlas, buildTlas, BvhError, closestHitInstances, TLAS_MAX_DEPTH } from '../src/index';
import { refitBlas } from '../src/refit';
import { affine, baked, bruteForce, direction, randomNumbers, sphere, strewn } from './shapes';
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
          const x =
            m[r]! * ball.positions[v]! +
            m[4 + r]! * ball.positions[v + 1]! +
            m[8 + r]! * ball.positions[v + 2]! +
            m[12 + r]!;
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
    for (let r = 0; r < 3; r++)
      expect(
        toObject[4 * r]! * w[0]! + toObject[4 * r + 1]! * w[1]! + toObject[4 * r + 2]! * w[2]! + toObject[4 * r + 3]!,
      ).toBeCloseTo(p[r]!, 10);
  }
});

test('instances that cannot be hit are left out', () => {
  const flat = [1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
  const broken = [NaN, ...identity.slice(1)];
  const empty = buildBlas({ positions: new Float32Array(0) }).bounds;
  const tlas = buildTlas([
    { bounds, transform: flat },
    { bounds, transform: identity },
    { bounds, transform: broken },
    { bounds: empty, transform: identity },
  ]);
  expect([...tlas.instanceOrder]).toEqual([1]);
  expect(buildTlas([]).instanceOrder).toHaveLength(0);
  expect(() => buildTlas([{ bounds, transform: [1] }])).toThrow(BvhError);
});

test('mirrors, shears and uneven scales: hits where the formula says', () => {
  const corner = { positions: new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0]) };
  const blas = buildBlas(corner);
  // x and y swapped in sign, scaled by 2 and 3, sheared along x with z, moved.
  const transform = [-2, 0, 0, 0, 0, 3, 0, 0, 4, 0, 1, 0, 10, 20, 30, 1];
  const tlas = buildTlas([{ bounds: blas.bounds, transform }]);
  const hit = closestHitInstances(tlas, [{ blas, mesh: corner }], {
    origin: [10 - 2 * 0.25, 20 + 3 * 0.5, 35],
    direction: [0, 0, -2],
  })!;
  expect([hit.t, hit.u, hit.v]).toEqual([2.5, 0.25, 0.5].map((x) => expect.closeTo(x, 12)));
  expect(
    closestHitInstances(tlas, [{ blas, mesh: corner }], {
      origin: [10 + 2 * 0.25, 20 + 3 * 0.5, 35],
      direction: [0, 0, -2],
    }),
  ).toBeUndefined();
  // Sheared: what the object sees as straight down comes aslant.
  const aslant = closestHitInstances(tlas, [{ blas, mesh: corner }], {
    origin: [10 - 2 * 0.25 + 4 * 7, 20 + 3 * 0.5, 30 + 7],
    direction: [-4, 0, -1],
  })!;
  expect([aslant.t, aslant.u, aslant.v]).toEqual([7, 0.25, 0.5].map((x) => expect.closeTo(x, 12)));
});

for (const [name, spread] of [
  ['mirrored', [-1, 1, 1]],
  ['point-mirrored', [-1, -1, -1]],
  ['needle', [50, 1, 0.02]],
  ['card', [1, 1e-4, 1]],
] as const) {
  test(`${name} instances agree with brute force on transformed triangles (seed 33)`, () => {
    const random = randomNumbers(33);
    const mesh = sphere(10),
      blas = buildBlas(mesh);
    const placed = Array.from({ length: 12 }, () => {
      const transform = affine(random, 2);
      for (let c = 0; c < 3; c++) for (let r = 0; r < 3; r++) transform[4 * c + r]! *= spread[c]!;
      return { mesh, blas, transform };
    });
    const tlas = buildTlas(placed.map(({ transform }) => ({ bounds: blas.bounds, transform })));
    const inWorld = placed.map(({ transform }) => baked(mesh, transform));
    let hits = 0;
    for (let i = 0; i < 200; i++) {
      const aim = inWorld[i % 12]!.positions,
        v = 3 * Math.floor((random() * aim.length) / 3);
      const origin = direction(random).map((x) => 30 * x);
      // At a point within a triangle's reach, so that thin things are hit, too.
      const ray = { origin, direction: origin.map((x, k) => aim[v + k]! + 0.01 * (random() - 0.5) - x) };
      const all = inWorld.map((part) => bruteForce(part, ray.origin, ray.direction));
      const nearest = Math.min(...all.map((hit) => hit?.t ?? Infinity));
      const hit = closestHitInstances(tlas, placed, ray);
      expect(hit?.t ?? Infinity).toBeCloseTo(nearest, 8);
      if (hit) expect(all[hit.instance]?.t).toBeCloseTo(nearest, 8);
      if (hit) hits++;
    }
    expect(hits).toBeGreaterThan(40);
  });
}

test('a part is swapped by one new BLAS and a new TLAS: the others stay as they are, to the bit (seed 34)', () => {
  const random = randomNumbers(34);
  const parts = [sphere(12), strewn(80, 0.4, random), sphere(8)].map((mesh) => ({
    mesh: mesh as { positions: Float32Array; indices: Uint32Array },
    blas: buildBlas(mesh),
  }));
  const placed = Array.from({ length: 9 }, (_, i) => ({ part: i % 3, transform: affine(random, 3) }));
  const scene = () => {
    const instances = placed.map(({ part }) => parts[part]!);
    return {
      instances,
      tlas: buildTlas(placed.map(({ part, transform }) => ({ bounds: parts[part]!.blas.bounds, transform }))),
    };
  };
  const rays = Array.from({ length: 200 }, () => {
    const origin = direction(random).map((x) => 6 * x);
    return { origin, direction: origin.map((x) => 4 * (random() - 0.5) - x) };
  });
  const check = () => {
    const { instances, tlas } = scene();
    const inWorld = placed.map(({ part, transform }) => baked(parts[part]!.mesh, transform));
    for (const ray of rays) {
      const nearest = Math.min(...inWorld.map((mesh) => bruteForce(mesh, ray.origin, ray.direction)?.t ?? Infinity));
      expect(closestHitInstances(tlas, instances, ray)?.t ?? Infinity).toBeCloseTo(nearest, 8);
    }
  };
  check();
  const untouched = [parts[0]!, parts[2]!];
  const before = structuredClone(untouched);
  const mesh = strewn(150, 0.7, random);
  parts[1] = { mesh, blas: buildBlas(mesh) };
  check();
  // A part that moves: refitted, and its new bounds go into the next TLAS.
  mesh.positions.forEach((x, i) => (mesh.positions[i] = 1.5 * x + 0.3));
  refitBlas(parts[1].blas, mesh);
  check();
  expect([parts[0], parts[2]]).toEqual(before);
  expect(parts[0]).toBe(untouched[0]);
});
