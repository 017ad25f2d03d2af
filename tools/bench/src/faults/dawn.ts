// Dawn with faults, for programs of their own: GPU_WEBGPU names the bundle of this file.
// GLANZ_FAULT_RECORD: where to write the calls. GLANZ_FAULT_PLAN: the point and the fault, as JSON.
import { writeFileSync } from 'node:fs';
import { FaultRecorder, instrumentDevice, type Fault } from '@glanz/gpu/faults';
import * as dawn from 'webgpu';

/** WebGPU's constants and classes. */
export const globals = dawn.globals as object;

const { GLANZ_FAULT_RECORD: file, GLANZ_FAULT_PLAN: plan } = process.env;
const recorder = new FaultRecorder();
recorder.clear(plan === undefined ? undefined : (JSON.parse(plan) as { point: string; fault: Fault }));
recorder.phase = 'device 1';
let devices = 0;
if (file !== undefined)
  process.on('exit', () =>
    writeFileSync(
      file,
      JSON.stringify({
        struck: recorder.struck,
        points: recorder.points,
        live: [...recorder.live.values()].map(({ label }) => label),
        devices,
      }),
    ),
  );

/** As Dawn's; only the first device is instrumented, so that a fault can be recovered from. */
export function create(options: string[]): GPU {
  const gpu = dawn.create(options);
  const requestAdapter = gpu.requestAdapter.bind(gpu);
  gpu.requestAdapter = async (requested) => {
    const adapter = await requestAdapter(requested);
    if (!adapter) return adapter;
    const requestDevice = adapter.requestDevice.bind(adapter);
    adapter.requestDevice = async (descriptor) => {
      const device = await requestDevice(descriptor);
      return ++devices === 1 ? instrumentDevice(device, recorder) : device;
    };
    return adapter;
  };
  return gpu;
}
