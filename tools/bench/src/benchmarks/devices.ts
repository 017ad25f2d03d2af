import { setFlagsFromString } from 'node:v8';
import { runInNewContext } from 'node:vm';
import { requestDevice } from '@glanz/renderer';
import { createGpu } from '@glanz/renderer/node';
import type { Benchmark, Figure } from '../benchmark';
import { BenchError } from '../error';
import { slope } from '../faults/soak';
import { createTracer, render } from '../faults/tracer-steps';

const SHADER = `
@group(0) @binding(0) var<storage, read_write> values: array<f32>;
@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) { values[id.x] = sqrt(f32(id.x)); }
`;

/** Computes something with a new device, and destroys the device. */
async function useDevice(gpu: GPU): Promise<void> {
  const adapter = await gpu.requestAdapter();
  if (!adapter) throw new BenchError('bench/failed', 'The GPU has no adapter.');
  const device = await adapter.requestDevice();
  const module = device.createShaderModule({ code: SHADER });
  const pipeline = await device.createComputePipelineAsync({ layout: 'auto', compute: { module, entryPoint: 'main' } });
  const buffer = device.createBuffer({ size: 2 ** 20, usage: GPUBufferUsage.STORAGE });
  const bindGroup = device.createBindGroup({
    layout: pipeline.getBindGroupLayout(0),
    entries: [{ binding: 0, resource: { buffer } }],
  });
  const encoder = device.createCommandEncoder();
  const pass = encoder.beginComputePass();
  pass.setPipeline(pipeline);
  pass.setBindGroup(0, bindGroup);
  pass.dispatchWorkgroups(64);
  pass.end();
  device.queue.submit([encoder.finish()]);
  await device.queue.onSubmittedWorkDone();
  buffer.destroy();
  device.destroy();
}

/** Renders with a new device, and destroys the device before the tracer, or after it. */
async function useTracer(gpu: GPU, isLost: boolean): Promise<void> {
  const device = await requestDevice({ gpu });
  const tracer = await createTracer(device);
  await render(tracer, 1);
  if (isLost) device.destroy();
  tracer.destroy();
  if (!isLost) device.destroy();
}

const USES: Readonly<Record<string, (gpu: GPU) => Promise<void>>> = {
  webgpu: useDevice,
  tracer: (gpu) => useTracer(gpu, false),
  'lost-tracer': (gpu) => useTracer(gpu, true),
};

/** What a destroyed device leaves behind in the process, with and without our code: the control of `soak`. */
export const benchmark: Benchmark = {
  description: 'opens, uses and destroys devices: the memory that each leaves in the process, the control of soak',
  options: {
    count: { type: 'string', help: 'devices; default 600' },
    use: {
      type: 'string',
      help: `what uses them, of ${Object.keys(USES).join(', ')}; default webgpu, which is without our code`,
    },
  },
  async run({ log, quick, gpu: name, values }) {
    const count = values['count'] === undefined ? (quick ? 60 : 600) : Number(values['count']);
    if (!Number.isInteger(count) || count < 12)
      throw new BenchError('bench/option', `--count ${values['count']}: it must be a whole number of at least 12.`);
    const use = USES[values['use'] ?? 'webgpu'];
    if (!use)
      throw new BenchError('bench/option', `--use ${values['use']}: it must be of ${Object.keys(USES).join(', ')}.`);
    const { gpu, adapterName, software } = await createGpu(name === undefined ? { software: 'only' } : { gpu: name });
    setFlagsFromString('--expose-gc');
    const collect = runInNewContext('gc') as () => void;
    const points: { readonly devices: number; readonly heapBytes: number; readonly rssBytes: number }[] = [];
    for (let devices = 1; devices <= count; devices++) {
      await use(gpu);
      // Dawn releases objects in tasks of their own.
      await new Promise((resolve) => setTimeout(resolve, 2));
      if (devices % Math.floor(count / 12) !== 0) continue;
      collect();
      collect();
      const { heapUsed: heapBytes, rss: rssBytes } = process.memoryUsage();
      points.push({ devices, heapBytes, rssBytes });
      log(
        `${devices} devices: heap ${(heapBytes / 2 ** 20).toFixed(1)} MiB, RSS ${(rssBytes / 2 ** 20).toFixed(0)} MiB`,
      );
    }
    // The first third fills caches.
    const later = points.slice(4);
    const figure = (what: string, value: (point: (typeof points)[number]) => number): Figure => {
      const { slope: mean, ci95 } = slope(later.map((point) => [point.devices, value(point) / 1024]));
      return { name: `${what} of each destroyed device`, unit: 'KiB', runs: later.length, mean, ci95 };
    };
    return {
      settings: { count, use: values['use'] ?? 'webgpu' },
      figures: [figure('heap', ({ heapBytes }) => heapBytes), figure('RSS', ({ rssBytes }) => rssBytes)],
      gpu: { name: adapterName, software },
      details: { points },
    };
  },
};
