import { expect, test } from 'vitest';
import { DynamicTlas } from '../src/dynamic-tlas';
import { anyHitInstances, buildBlas, buildTlas, closestHitInstances, type TlasInstance } from '../src/index';
import { NODE_WORDS } from '../src/layout';
import { sahCost } from '../src/statistics';
import { affine, baked, bruteForce, direction, randomNumbers, sphere, strewn } from './shapes';
import { at, changeAtRandom, checkTlas, type Placing } from './tlas-structure';

const ball = sphere(6);
const { bounds } = buildBlas(ball);
const placed = (transform: ArrayLike<number>): TlasInstance => ({ bounds, transform });

for (const count of [0, 1, 2, 3, 7, 60]) {
  test(`a long sequence of changes to ${count} instances keeps the tree whole (seed ${70 + count})`, () => {
    const random = randomNumbers(70 + count);
    const placings: Placing[] = Array.from({ length: count }, () =>
      random() < 0.7 ? placed(affine(random, 5)) : undefined,
    );
    const tlas = new DynamicTlas(placings);
    checkTlas(tlas, placings);
    changeAtRandom(tlas, placings, { bounds, random, turns: 400 });
  });
}

test('rays agree with brute force after thousands of edits (seed 81)', () => {
  const random = randomNumbers(81);
  const meshes = [sphere(6), strewn(20, 0.4, random)].map((mesh) => ({ mesh, blas: buildBlas(mesh) }));
  const parts = Array.from({ length: 200 }, (_, i) => meshes[i % 2]!);
  const where = parts.map(() => affine(random, 4));
  const visible = parts.map(() => true);
  const placing = (i: number) => (visible[i] ? { bounds: parts[i]!.blas.bounds, transform: where[i]! } : undefined);
  const tlas = new DynamicTlas(parts.map((_, i) => placing(i)));
  let hits = 0;
  for (let round = 0; round < 10; round++) {
    for (let turn = 0; turn < 300; turn++) {
      const i = Math.floor(random() * parts.length);
      if (random() < 0.4) visible[i] = !visible[i];
      else where[i] = affine(random, 4);
      tlas.update([[i, placing(i)]]);
    }
    const shown = parts.flatMap(({ mesh }, i) => (visible[i] ? [{ i, world: baked(mesh, where[i]!) }] : []));
    for (let n = 0; n < 60; n++) {
      const origin = direction(random).map((x) => 12 * x);
      const ray = { origin, direction: origin.map((x) => 6 * (random() - 0.5) - x) };
      const all = shown.map(({ i, world }) => ({ i, t: bruteForce(world, ray.origin, ray.direction)?.t ?? Infinity }));
      const nearest = all.reduce((a, b) => (b.t < a.t ? b : a));
      const hit = closestHitInstances(tlas, parts, ray);
      expect(hit?.t ?? Infinity).toBeCloseTo(nearest.t, 8);
      expect(anyHitInstances(tlas, parts, ray)).toBe(nearest.t < Infinity);
      if (hit) {
        hits++;
        expect(all.find(({ i }) => i === hit.instance)?.t).toBeCloseTo(nearest.t, 8);
      }
    }
  }
  expect(hits).toBeGreaterThan(200);
});

test('a change writes some nodes of many, and reports which (seed 82)', () => {
  const random = randomNumbers(82);
  const placings: Placing[] = Array.from({ length: 20000 }, () =>
    placed(at(200 * random(), 200 * random(), 200 * random())),
  );
  const tlas = new DynamicTlas(placings);
  const copy = new Float32Array(20000 * NODE_WORDS);
  const upload = () => {
    const changed = tlas.takeChangedNodes();
    for (const node of changed)
      copy.set(tlas.nodes.subarray(node * NODE_WORDS, (node + 1) * NODE_WORDS), node * NODE_WORDS);
    return changed.length;
  };
  expect(upload()).toBe(19999);
  const written: number[] = [];
  for (let turn = 0; turn < 300; turn++) {
    const i = Math.floor(random() * placings.length);
    placings[i] = random() < 0.5 ? undefined : placed(at(200 * random(), 200 * random(), 200 * random()));
    tlas.update([[i, placings[i]]]);
    written.push(upload());
    expect(tlas.takeChangedNodes()).toHaveLength(0);
  }
  expect(Math.max(...written)).toBeLessThan(100);
  expect(written.reduce((a, b) => a + b) / 300).toBeLessThan(40);
  expect(new Uint32Array(copy.buffer, 0, tlas.nodes.length)).toEqual(
    new Uint32Array(tlas.nodes.buffer, 0, tlas.nodes.length),
  );
  checkTlas(tlas, placings);
});

test('the cost stays near that of a new tree, however the instances move (seed 83)', () => {
  const random = randomNumbers(83);
  const place = () => placed(at(30 * random(), 30 * random(), 30 * random()));
  const placings: Placing[] = Array.from({ length: 1000 }, place);
  const tlas = new DynamicTlas(placings);
  let worst = 0;
  for (let turn = 0; turn < 3000; turn++) {
    const i = Math.floor(random() * placings.length);
    placings[i] = place();
    tlas.update([[i, placings[i]]]);
    if (turn % 100 === 99) worst = Math.max(worst, sahCost(tlas) / sahCost(buildTlas(placings as TlasInstance[])));
  }
  expect(worst).toBeLessThan(1.5);
});

test('instances along a line, added one by one, stay within the depth (seed 84)', () => {
  const placings: Placing[] = new Array<Placing>(3000).fill(undefined);
  const tlas = new DynamicTlas(placings);
  for (let i = 0; i < placings.length; i++) {
    placings[i] = placed(at(2 ** (i / 40), 0, 0, 0.001));
    tlas.update([[i, placings[i]]]);
  }
  checkTlas(tlas, placings);
  for (let i = 0; i < placings.length; i += 2) tlas.update([[i, (placings[i] = undefined)]]);
  checkTlas(tlas, placings);
});

test('the same changes give the same nodes; wrong ones change nothing', () => {
  const make = () => {
    const random = randomNumbers(85);
    const tlas = new DynamicTlas(Array.from({ length: 300 }, () => placed(affine(random, 6))));
    for (let turn = 0; turn < 200; turn++)
      tlas.update([[Math.floor(random() * 300), random() < 0.5 ? undefined : placed(affine(random, 6))]]);
    return tlas;
  };
  const [a, b] = [make(), make()];
  expect(a.nodes).toEqual(b.nodes);
  const before = a.nodes.slice();
  for (const [wrong, code] of [
    [[300, undefined], 'bvh/instance'],
    [[-1, undefined], 'bvh/instance'],
    [[0.5, undefined], 'bvh/instance'],
    [[1, placed([1])], 'bvh/transform'],
  ] as const) {
    expect(() => a.update([[0, undefined], wrong])).toThrow(expect.objectContaining({ code }));
  }
  expect(a.nodes).toEqual(before);
});
