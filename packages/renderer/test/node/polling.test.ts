import { promisify } from 'node:util';
import { afterAll, beforeAll, expect, it } from 'vitest';
import { createGpu } from '../../src/node';

// The process is this file's own: what Dawn calls can be counted from the first call on.
const immediate = globalThis.setImmediate;
let calls = 0;
let device: GPUDevice;

beforeAll(async () => {
  const counting = (callback: (...args: unknown[]) => void, ...args: unknown[]) => {
    calls++;
    return immediate(callback, ...args);
  };
  Object.defineProperties(counting, Object.getOwnPropertyDescriptors(immediate));
  globalThis.setImmediate = counting as unknown as typeof setImmediate;
  const adapter = await (await createGpu({ software: 'only' })).gpu.requestAdapter();
  device = await adapter!.requestDevice();
});
afterAll(() => {
  globalThis.setImmediate = immediate;
  device.destroy();
});

/** Calls of `setImmediate` while a GPU that computes for so many rounds is waited for. */
async function callsOf(rounds: number): Promise<number> {
  const module = device.createShaderModule({
    code: `@group(0) @binding(0) var<storage, read_write> x: array<f32>;
override rounds: i32;
@compute @workgroup_size(64) fn main(@builtin(local_invocation_index) i: u32) {
  var s = x[i];
  for (var k = 0; k < rounds; k++) { s = sin(s) + 1.0; }
  x[i] = s;
}`,
  });
  const pipeline = device.createComputePipeline({ layout: 'auto', compute: { module, constants: { rounds } } });
  const buffer = device.createBuffer({ size: 256, usage: GPUBufferUsage.STORAGE });
  const entries = [{ binding: 0, resource: { buffer } }];
  const encoder = device.createCommandEncoder();
  const pass = encoder.beginComputePass();
  pass.setPipeline(pipeline);
  pass.setBindGroup(0, device.createBindGroup({ layout: pipeline.getBindGroupLayout(0), entries }));
  pass.dispatchWorkgroups(1);
  pass.end();
  device.queue.submit([encoder.finish()]);
  const before = calls;
  await device.queue.onSubmittedWorkDone();
  buffer.destroy();
  return calls - before;
}

it('a wait for a software GPU takes the same few turns of the event loop whatever the GPU computes', async () => {
  // Some milliseconds and some hundred of them. Without pauses the second takes tens of thousands of turns.
  await callsOf(1e4);
  const [short, long] = [await callsOf(1e4), await callsOf(1e6)];
  expect(long).toBeGreaterThan(0);
  expect(short).toBeLessThan(20);
  expect(long).toBeLessThan(20);
});

it('leaves setImmediate as it is for others', async () => {
  const before = calls;
  const order: unknown[] = [];
  await new Promise<void>((done) => {
    setTimeout(() => {
      setTimeout(() => done(), 0);
      setImmediate((...args: unknown[]) => order.push(...args), 'a', 'b');
    }, 0);
  });
  expect(order).toEqual(['a', 'b']);
  expect(await promisify(setImmediate)('value')).toBe('value');
  const cancelled = setImmediate(() => order.push('cancelled'));
  clearImmediate(cancelled);
  await new Promise((done) => setImmediate(done));
  expect(order).toEqual(['a', 'b']);
  expect(calls - before).toBeGreaterThan(2);
});
