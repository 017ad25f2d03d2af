// Dawn whose devices are lost, for the program as a process of its own: GPU_WEBGPU names this file.
// GLANZ_TEST_NO_MEMORY: labels of the buffers for which there is no memory.
// GLANZ_TEST_LOSE_AT: the submission at which the first device is lost. GLANZ_TEST_DEVICES: devices that can be had.
import * as dawn from 'webgpu';

export const { globals } = dawn;
const loseAt = Number(process.env.GLANZ_TEST_LOSE_AT ?? 0);
const maxDevices = Number(process.env.GLANZ_TEST_DEVICES ?? Infinity);
const noMemory = process.env.GLANZ_TEST_NO_MEMORY;
let devices = 0;

function watch(device) {
  let submits = 0;
  let fire;
  const injected = new Promise((done) => (fire = done));
  Object.defineProperty(device, 'lost', { value: Promise.race([injected, device.lost]) });
  const createBuffer = device.createBuffer.bind(device);
  device.createBuffer = (descriptor) =>
    createBuffer(descriptor.label === noMemory ? { ...descriptor, size: 2 ** 50 } : descriptor);
  const submit = device.queue.submit.bind(device.queue);
  device.queue.submit = (buffers) => {
    if (++submits === loseAt) {
      fire({ reason: 'unknown', message: 'injected loss' });
      device.destroy();
    }
    return submit(buffers);
  };
}

export function create(options) {
  const gpu = dawn.create(options);
  const requestAdapter = gpu.requestAdapter.bind(gpu);
  gpu.requestAdapter = async (options) => {
    const adapter = await requestAdapter(options);
    if (!adapter) return adapter;
    const requestDevice = adapter.requestDevice.bind(adapter);
    adapter.requestDevice = async (descriptor) => {
      if (devices >= maxDevices) throw new Error('injected refusal');
      const device = await requestDevice(descriptor);
      if (++devices === 1) watch(device);
      return device;
    };
    return adapter;
  };
  return gpu;
}
