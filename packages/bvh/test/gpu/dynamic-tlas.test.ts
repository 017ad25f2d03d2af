import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import { afterAll, afterEach, beforeAll, expect, test } from 'vitest';
import { DynamicTlas } from '../../src/dynamic-tlas';
import { buildBlas, closestHitInstances } from '../../src/index';
import { GpuBuilder, readGpuBoxTree } from '../../src/gpu/index';
import { affine, direction, randomNumbers, sphere } from '../shapes';
import { at, changeAtRandom, checkTlas, type Placing } from '../tlas-structure';
import { upload } from './builds';

let device: GPUDevice, builder: GpuBuilder;
beforeAll(async () => {
  device = await testDevice({ defaultLimits: true, features: [] });
  builder = await GpuBuilder.create(device);
});
afterEach(() => expectNoGpuErrors());
afterAll(() => builder.destroy());

const ball = sphere(6);
const blas = buildBlas(ball);
const { bounds } = blas;

const createOnGpu = (placings: readonly Placing[]) =>
  DynamicTlas.create(placings, async (boxes, count) => {
    const buffer = upload(device, boxes);
    const tree = await builder.buildBoxes({ boxes: buffer, count });
    buffer.destroy();
    try {
      return await readGpuBoxTree(device, tree);
    } finally {
      tree.destroy();
    }
  });

for (const count of [0, 1, 2, 3, 7, 60, 3000]) {
  test(`a tree of the GPU over ${count} instances is whole, and stays so (seed ${170 + count})`, async () => {
    const random = randomNumbers(170 + count);
    const placings: Placing[] = Array.from({ length: count }, (_, i) => {
      if (random() < 0.2) return undefined;
      return { bounds, transform: i % 10 === 9 ? at(1, 1, 1, 0) : affine(random, 5) };
    });
    const tlas = await createOnGpu(placings);
    checkTlas(tlas, placings);
    expect([...tlas.takeChangedNodes()]).toEqual([...Array(tlas.nodeCount).keys()]);
    changeAtRandom(tlas, placings, { bounds, random, turns: count > 100 ? 20 : 100 });
  });
}

test('rays hit what they hit in a tree of the CPU (seed 181)', async () => {
  const random = randomNumbers(181);
  const placings = Array.from({ length: 500 }, () => ({ bounds, transform: affine(random, 5) }));
  const parts = placings.map(() => ({ mesh: ball, blas }));
  const [made, expected] = [await createOnGpu(placings), new DynamicTlas(placings)];
  let hits = 0;
  for (let n = 0; n < 2000; n++) {
    const origin = direction(random).map((x) => 12 * x);
    const ray = { origin, direction: origin.map((x) => 6 * (random() - 0.5) - x) };
    const hit = closestHitInstances(expected, parts, ray);
    if (hit) hits++;
    expect(closestHitInstances(made, parts, ray)).toEqual(hit);
  }
  expect(hits).toBeGreaterThan(500);
});

test('builds by itself where nothing else does', async () => {
  const random = randomNumbers(182);
  const placings = Array.from({ length: 100 }, () => ({ bounds, transform: affine(random, 5) }));
  const made = await DynamicTlas.create(placings, () => Promise.resolve(undefined));
  expect(made.nodes).toEqual(new DynamicTlas(placings).nodes);
});
