import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import { afterEach, describe, expect, it } from 'vitest';
import { GpuClock } from '../src/gpu-clock';

afterEach(() => expectNoGpuErrors());

describe('GpuClock', () => {
  it('times submissions made inside, and leaves the queue as it was', async () => {
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
    const group = device.createBindGroup({ layout: pipeline.getBindGroupLayout(0), entries: [{ binding: 0, resource: { buffer } }] });
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
    const start = performance.now();
    const many = await clock.measure(work(8));
    const wall = performance.now() - start;
    expect((Object.getPrototypeOf(device.queue) as GPUQueue).submit).toBe(submit);
    expect(one.submissions).toBe(2);
    expect(many.submissions).toBe(8);
    expect(many.busy).toBeGreaterThan(2 * one.busy);
    expect(many.busy).toBeLessThanOrEqual(many.span * 1.001);
    expect(many.span).toBeLessThanOrEqual(wall);
    expect(many.busy).toBeGreaterThan(0.5 * many.span);
    await expect(clock.measure(() => Promise.resolve())).rejects.toThrow(/submissions/);
    clock.destroy();
    buffer.destroy();
  });
});
