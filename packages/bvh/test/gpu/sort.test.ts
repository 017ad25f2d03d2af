import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import { expect, test } from 'vitest';
import { COPY_DST, COPY_SRC, STORAGE, createBuffers, readBuffer } from '../../src/gpu/device';
import { compileCommon } from '../../src/gpu/kernels';
import { listPhases, submitPhases } from '../../src/gpu/passes';
import { planBuild } from '../../src/gpu/plan';
import { randomNumbers } from '../shapes';

const HOLE = 0xffffffff;

test('the radix sort orders keys as Array.sort does, equal ones by their place, without holes (seed 1)', async () => {
  const device = await testDevice({ defaultLimits: true, features: [] });
  const kernels = await compileCommon(device);
  const random = randomNumbers(1);
  // One tile, several, and more than one workgroup adds up.
  for (const [count, distinct] of [
    [1, 1],
    [1000, 2 ** 30],
    [10_000, 5],
    [70_000, 2 ** 30],
  ] as const) {
    const plan = planBuild(count);
    const scratch = await createBuffers(device, plan.sizes, STORAGE | COPY_SRC | COPY_DST);
    const keys = Uint32Array.from({ length: count }, () =>
      count > 1 && random() < 0.3 ? HOLE : Math.floor(distinct * random()) * Math.floor(2 ** 30 / distinct),
    );
    const expected = [...keys.keys()].filter((i) => keys[i] !== HOLE).sort((a, b) => keys[a]! - keys[b]! || a - b);
    device.queue.writeBuffer(scratch['keys A'], 0, keys);
    const globals = new Uint32Array(32);
    globals[6] = expected.length;
    device.queue.writeBuffer(scratch.globals, 0, globals);
    const { sort } = listPhases(plan, kernels, scratch, {
      kernel: kernels.codes,
      buffers: {},
      params: { count, vertices: 0, maxLeaf: 4, maxDepth: 40 },
    });
    submitPhases(device, [['sort', sort]]);
    const order = new Uint32Array(await readBuffer(device, scratch['values A'], 4 * count));
    expect([...order.subarray(0, expected.length)]).toEqual(expected);
    for (const buffer of Object.values(scratch)) buffer.destroy();
  }
  await expectNoGpuErrors();
});
