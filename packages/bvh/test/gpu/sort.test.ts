import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import { expect, test } from 'vitest';
import { COPY_DST, COPY_SRC, STORAGE, createBuffers, readBuffer } from '../../src/gpu/device';
import { compileCommon } from '../../src/gpu/kernels';
import { listPhases, submitPhases } from '../../src/gpu/passes';
import { planBuild } from '../../src/gpu/plan';
import { randomNumbers } from '../shapes';

const HOLE = 0xffffffff;

/** The 48 bits of three coordinates of 16, taken in turn from the highest on. */
function morton(cell: readonly number[]): number {
  let code = 0;
  for (let bit = 15; bit >= 0; bit--) for (const x of cell) code = 2 * code + ((x >> bit) & 1);
  return code;
}

test('primitives come in the order of their Morton codes, equal ones by their place, without holes (seed 1)', async () => {
  const device = await testDevice({ defaultLimits: true, features: [] });
  const kernels = await compileCommon(device);
  const random = randomNumbers(1);
  // One tile, several, and more than one workgroup adds up; many equal codes.
  for (const [count, distinct] of [
    [1, 1],
    [1000, 65536],
    [10_000, 2],
    [70_000, 65536],
  ] as const) {
    const plan = planBuild(count);
    const scratch = await createBuffers(device, plan.sizes, STORAGE | COPY_SRC | COPY_DST);
    // Points in the middle of cells of a cube of 65,536, whose size every number holds.
    const primitives = new Float32Array(8 * count);
    const words = new Uint32Array(primitives.buffer);
    const codes = new Float64Array(count).fill(Infinity);
    for (let i = 0; i < count; i++) {
      if (count > 1 && random() < 0.3) {
        words[8 * i + 3] = HOLE;
        continue;
      }
      const cell = [0, 1, 2].map(() => Math.floor(distinct * random()) * (65536 / distinct));
      codes[i] = morton(cell);
      for (let k = 0; k < 3; k++) primitives[8 * i + k] = primitives[8 * i + 4 + k] = cell[k]! + 0.5;
    }
    const expected = [...codes.keys()]
      .filter((i) => codes[i]! < Infinity)
      .sort((a, b) => codes[a]! - codes[b]! || a - b);
    device.queue.writeBuffer(scratch.primitives, 0, primitives);
    const globals = new Uint32Array(32);
    // Bits of 0 and of 65,536 as integers in the order of floats, the minimum complemented.
    globals.fill(~0x80000000, 0, 3).fill(0xc7800000, 3, 6);
    globals[6] = expected.length;
    device.queue.writeBuffer(scratch.globals, 0, globals);
    const { primitives: made, sort } = listPhases(plan, kernels, scratch, {
      kernel: kernels.codes,
      buffers: {},
      params: { count, vertices: 0, maxLeaf: 4, maxDepth: 40 },
    });
    submitPhases(device, [['sort', [...made.slice(1), ...sort]]]);
    const order = new Uint32Array(await readBuffer(device, scratch['values A'], 4 * count));
    expect([...order.subarray(0, expected.length)]).toEqual(expected);
    for (const buffer of Object.values(scratch)) buffer.destroy();
  }
  await expectNoGpuErrors();
});
