import { compose } from '@glanz/wgsl/compose';
import type { WgslModule } from '@glanz/wgsl/module';
import { beginShaderModule } from '@glanz/wgsl/shader';
import { DenoiseError } from './error';

// The constants of WebGPU, which exist as globals in browsers only.
export const MAP_READ = 0x1;
export const COPY_SRC = 0x4;
export const COPY_DST = 0x8;
export const QUERY_RESOLVE = 0x200;
export const UNIFORM = 0x40;
export const STORAGE = 0x80;
const COMPUTE = 0x4;

/** What offsets of bindings are multiples of on every device. */
export const ALIGNMENT = 256;

/** How a shader uses a binding. */
export type BindingKind = 'uniform' | 'dynamic' | 'read' | 'write';

/** A compiled shader with the layout of its bindings. */
export interface Kernel {
  readonly pipeline: GPUComputePipeline;
  readonly layout: GPUBindGroupLayout;
}

/** Rejects with `denoise/device` when the device is lost. */
export function lossOf(device: GPUDevice): Promise<never> {
  const lost = device.lost.then(({ message }) => {
    throw new DenoiseError(
      'denoise/device',
      `The GPU device was lost: ${message || 'no reason is known'}. Create another device, and a Denoiser on it.`,
    );
  });
  lost.catch(() => undefined);
  return lost;
}

/**
 * Compiles a shader.
 *
 * @throws {DenoiseError} `denoise/pipeline` with the driver's message.
 */
export async function compileKernel(
  device: GPUDevice,
  label: string,
  module: WgslModule,
  flags: Readonly<Record<string, boolean>>,
  bindings: Readonly<Record<number, BindingKind>>,
  entryPoint = 'main',
): Promise<Kernel> {
  const layout = device.createBindGroupLayout({
    label,
    entries: Object.entries(bindings).map(([binding, kind]) => ({
      binding: Number(binding),
      visibility: COMPUTE,
      buffer: {
        type: kind === 'read' ? 'read-only-storage' : kind === 'write' ? 'storage' : 'uniform',
        hasDynamicOffset: kind === 'dynamic',
      },
    })),
  });
  const shader = beginShaderModule(device, compose([module], { flags }), label);
  try {
    const pipeline = device.createComputePipelineAsync({
      label,
      layout: device.createPipelineLayout({ bindGroupLayouts: [layout] }),
      compute: { module: shader.module, entryPoint },
    });
    // If the text is invalid, the next line throws.
    pipeline.catch(() => undefined);
    await shader.checked;
    return { pipeline: await pipeline, layout };
  } catch (cause) {
    throw new DenoiseError(
      'denoise/pipeline',
      `The GPU's driver did not compile the shader "${label}": ${(cause as Error).message}. Update the driver.`,
      { cause },
    );
  }
}

/** A part of a buffer for a bind group. */
export interface Window {
  readonly buffer: GPUBuffer;
  readonly offset: number;
  readonly size: number;
}

/** Makes a bind group of `resources` by binding number. */
export const bindGroup = (
  device: GPUDevice,
  kernel: Kernel,
  resources: Readonly<Record<number, Window>>,
): GPUBindGroup =>
  device.createBindGroup({
    label: kernel.pipeline.label,
    layout: kernel.layout,
    entries: Object.entries(resources).map(([binding, resource]) => ({ binding: Number(binding), resource })),
  });

/**
 * Makes buffers, all or none.
 *
 * @returns `undefined` where the GPU has no memory for them.
 */
export async function tryBuffers(
  device: GPUDevice,
  descriptors: readonly GPUBufferDescriptor[],
): Promise<GPUBuffer[] | undefined> {
  device.pushErrorScope('out-of-memory');
  const buffers = descriptors.map((descriptor) => device.createBuffer(descriptor));
  if (!(await device.popErrorScope())) return buffers;
  for (const buffer of buffers) buffer.destroy();
  return undefined;
}

/** Copies an image of four floats a pixel to the CPU. */
export async function readImage(
  device: GPUDevice,
  { buffer, width, height }: { readonly buffer: GPUBuffer; readonly width: number; readonly height: number },
): Promise<Float32Array<ArrayBuffer>> {
  const size = 16 * width * height;
  const staging = device.createBuffer({ label: 'denoise read', size, usage: MAP_READ | COPY_DST });
  const encoder = device.createCommandEncoder({ label: 'denoise read' });
  encoder.copyBufferToBuffer(buffer, 0, staging, 0, size);
  device.queue.submit([encoder.finish()]);
  try {
    await staging.mapAsync(MAP_READ);
    return new Float32Array(staging.getMappedRange().slice(0));
  } finally {
    staging.destroy();
  }
}

/** A buffer with this content. */
export function filledBuffer(device: GPUDevice, label: string, data: ArrayBuffer, usage: number): GPUBuffer {
  const buffer = device.createBuffer({ label, size: Math.ceil(data.byteLength / 16) * 16, usage: usage | COPY_DST });
  device.queue.writeBuffer(buffer, 0, data);
  return buffer;
}
