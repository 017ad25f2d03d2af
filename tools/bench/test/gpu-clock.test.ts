import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import { afterEach, beforeAll, describe, expect, it } from 'vitest';
import { GpuClock } from '../src/gpu-clock';

// Brings the names of WebGPU too.
beforeAll(() => testDevice());
afterEach(() => expectNoGpuErrors());

/** A device whose clock advances only by what its command buffers take, in nanoseconds. */
function steadyDevice() {
  let now = 0n;
  const stamps: bigint[] = [];
  class Queue {
    submit(buffers: Iterable<{ readonly takes?: number; readonly stamp?: number }>): undefined {
      // Between two submissions the GPU waits.
      now += 1000n;
      for (const { takes, stamp } of buffers) {
        if (stamp !== undefined) stamps[stamp] = now;
        now += BigInt(takes ?? 0);
      }
    }
  }
  const buffer = () => ({
    mapAsync: () => Promise.resolve(),
    getMappedRange: (_: number, bytes: number) => BigUint64Array.from(stamps.slice(0, bytes / 8)).buffer,
    unmap: () => undefined,
  });
  const encoder = () => {
    let stamp: number | undefined;
    return {
      beginComputePass: ({ timestampWrites }: { timestampWrites: { beginningOfPassWriteIndex: number } }) => {
        stamp = timestampWrites.beginningOfPassWriteIndex;
        return { end: () => undefined };
      },
      resolveQuerySet: () => undefined,
      copyBufferToBuffer: () => undefined,
      finish: () => (stamp === undefined ? {} : { stamp }),
    };
  };
  return {
    features: new Set(['timestamp-query']),
    queue: new Queue(),
    createQuerySet: () => ({}),
    createBuffer: buffer,
    createCommandEncoder: encoder,
  };
}

describe('GpuClock', () => {
  it('sums what submissions take, without the gaps between them', async () => {
    const device = steadyDevice();
    const clock = GpuClock.create(device as unknown as GPUDevice)!;
    const work =
      (...takes: number[][]) =>
      () =>
        Promise.resolve(
          takes.forEach((together) => device.queue.submit(together.map((nanoseconds) => ({ takes: nanoseconds })))),
        );
    expect(await clock.measure(work([2e6]))).toEqual({ busy: 2, span: 2, submissions: 1 });
    expect(await clock.measure(work([1e6, 2e6], [5e5]))).toEqual({ busy: 3.5, span: 3.501, submissions: 2 });
    // Work outside of a measurement is not counted.
    await work([1e9])();
    expect(await clock.measure(work([0], [3e6], [0]))).toEqual({ busy: 3, span: 3.002, submissions: 3 });
  });

  it('counts submissions on a real device, and leaves its queue as it was', async () => {
    const device = await testDevice();
    const clock = GpuClock.create(device);
    if (!clock) throw new Error('the software GPU has timestamp queries');
    const module = device.createShaderModule({
      code: `@group(0) @binding(0) var<storage, read_write> data: array<u32>;
@compute @workgroup_size(64) fn main(@builtin(global_invocation_id) id: vec3u) {
  var x = id.x;
  for (var i = 0u; i < 20000u; i++) { x = x * 1664525u + 1013904223u; }
  data[id.x] = x;
}`,
    });
    const pipeline = await device.createComputePipelineAsync({ layout: 'auto', compute: { module } });
    const buffer = device.createBuffer({ size: 4 * 6400, usage: GPUBufferUsage.STORAGE });
    const group = device.createBindGroup({
      layout: pipeline.getBindGroupLayout(0),
      entries: [{ binding: 0, resource: { buffer } }],
    });
    const work = (times: number) => async () => {
      for (let i = 0; i < times; i++) {
        const encoder = device.createCommandEncoder();
        const pass = encoder.beginComputePass();
        pass.setPipeline(pipeline);
        pass.setBindGroup(0, group);
        pass.dispatchWorkgroups(100);
        pass.end();
        device.queue.submit([encoder.finish()]);
      }
      await device.queue.onSubmittedWorkDone();
    };
    const { submit } = Object.getPrototypeOf(device.queue) as GPUQueue;
    await clock.measure(work(1));
    const one = await clock.measure(work(2));
    const many = await clock.measure(work(8));
    expect((Object.getPrototypeOf(device.queue) as GPUQueue).submit).toBe(submit);
    expect(one.submissions).toBe(2);
    expect(many.submissions).toBe(8);
    for (const { busy, span } of [one, many]) {
      expect(busy).toBeGreaterThan(0);
      // Sums of milliseconds round.
      expect(busy).toBeLessThanOrEqual(span * (1 + 1e-12));
    }
    await expect(clock.measure(() => Promise.resolve())).rejects.toThrow(/submissions/);
    clock.destroy();
    buffer.destroy();
  });
});
