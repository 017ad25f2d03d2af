import { createGpu } from '@glanz/renderer/node';
import { afterEach, describe, expect, it } from 'vitest';
import { faultsOf, FaultRecorder, instrumentDevice, loseDevice, type Fault } from '../src/faults/index';

const devices: GPUDevice[] = [];
const recorder = new FaultRecorder();

async function open(): Promise<GPUDevice> {
  const { gpu } = await createGpu({ software: 'only' });
  const adapter = await gpu.requestAdapter();
  const device = instrumentDevice(await adapter!.requestDevice(), recorder);
  devices.push(device);
  return device;
}

afterEach(() => {
  for (const device of devices.splice(0)) device.destroy();
  recorder.clear();
});

const STORAGE = 0x80;
const buffer = (device: GPUDevice, label = 'a') => device.createBuffer({ label, size: 64, usage: STORAGE });

/** Plans a fault at the first call of a kind. */
const plan = (point: string, fault: Fault) => {
  recorder.clear({ point, fault });
  recorder.phase = 'test';
};

describe('an instrumented device', () => {
  it('counts calls by label and phase, and what lives', async () => {
    const device = await open();
    recorder.clear();
    recorder.phase = 'one';
    const [a, b] = [buffer(device), buffer(device)];
    recorder.phase = 'two';
    device.createTexture({ label: 'image', size: [4, 2], format: 'rgba16float', usage: 4 });
    buffer(device);
    expect(recorder.points.map(({ name }) => name)).toEqual([
      'createBuffer "a" #1 in one',
      'createBuffer "a" #2 in one',
      'createTexture "image" #1 in two',
      'createBuffer "a" #1 in two',
    ]);
    expect([recorder.live.size, recorder.liveBytes]).toEqual([4, 3 * 64 + 64]);
    a.destroy();
    b.destroy();
    expect([recorder.live.size, recorder.liveBytes]).toEqual([2, 128]);
    device.destroy();
    expect(recorder.live.size).toBe(0);
  });

  it('reports a missing memory to the innermost scope of its kind, and gives an invalid object', async () => {
    const device = await open();
    plan('createBuffer "a" #1 in test', 'out-of-memory');
    device.pushErrorScope('out-of-memory');
    device.pushErrorScope('validation');
    const made = buffer(device);
    const [inner, outer] = [device.popErrorScope(), device.popErrorScope()];
    expect(await inner).toBeNull();
    expect(await outer).toBeInstanceOf(GPUOutOfMemoryError);
    // Using it is an error of the real device.
    device.pushErrorScope('validation');
    device.queue.writeBuffer(made, 0, new Uint8Array(4));
    expect(await device.popErrorScope()).toBeInstanceOf(GPUValidationError);
    expect(recorder.struck?.name).toBe('createBuffer "a" #1 in test');
  });

  it('reports an error that no scope catches to listeners, else to the recorder', async () => {
    const device = await open();
    plan('createBuffer "a" #1 in test', 'validation');
    buffer(device);
    await new Promise((resolve) => setTimeout(resolve, 0));
    expect(recorder.uncaptured).toEqual(['injected: createBuffer failed (validation)']);
    const heard: string[] = [];
    device.addEventListener(
      'uncapturederror',
      (event) => void heard.push((event as GPUUncapturedErrorEvent).error.message),
    );
    plan('createBuffer "a" #1 in test', 'validation');
    buffer(device);
    await new Promise((resolve) => setTimeout(resolve, 0));
    expect([heard, recorder.uncaptured]).toEqual([['injected: createBuffer failed (validation)'], []]);
  });

  it.each(['unknown', 'destroyed'] as const)('is lost for the reason %s', async (reason) => {
    const device = await open();
    plan('createBuffer "a" #2 in test', `lost-${reason}`);
    buffer(device);
    buffer(device);
    expect((await device.lost).reason).toBe(reason);
    const other = await open();
    loseDevice(other, reason);
    expect((await other.lost).reason).toBe(reason);
  });

  it('refuses mapAsync and kernels, and answers late', async () => {
    const device = await open();
    plan('mapAsync "a" #1 in test', 'map');
    const readable = device.createBuffer({ label: 'a', size: 4, usage: 0x1 });
    await expect(readable.mapAsync(1)).rejects.toThrow('injected');
    await readable.mapAsync(1);
    const module = device.createShaderModule({ code: '@compute @workgroup_size(1) fn main() {}' });
    const descriptor = { label: 'k', layout: 'auto', compute: { module, entryPoint: 'main' } } as const;
    plan('createComputePipelineAsync "k" #1 in test', 'compile');
    await expect(device.createComputePipelineAsync(descriptor)).rejects.toThrow('injected');
    await device.createComputePipelineAsync(descriptor);
    plan('onSubmittedWorkDone "" #1 in test', 'late');
    let done = false;
    const work = device.queue.onSubmittedWorkDone().then(() => (done = true));
    await new Promise((resolve) => setTimeout(resolve, 100));
    expect(done).toBe(false);
    await work;
    expect(done).toBe(true);
  });

  it('knows which faults a call can meet', () => {
    expect(faultsOf({ call: 'createBuffer' })).toEqual([
      'lost-unknown',
      'lost-destroyed',
      'out-of-memory',
      'validation',
    ]);
    expect(faultsOf({ call: 'mapAsync' })).toEqual(['lost-unknown', 'lost-destroyed', 'map', 'late']);
    expect(faultsOf({ call: 'createComputePipelineAsync' })).toEqual([
      'lost-unknown',
      'lost-destroyed',
      'compile',
      'late',
    ]);
  });
});
