import { compose } from '@glanz/wgsl/compose';
import type { WgslModule } from '@glanz/wgsl/module';
import { beginShaderModule } from '@glanz/wgsl/shader';
import { BvhError } from '../error';

// The constants of WebGPU, which exist as globals in browsers only.
export const MAP_READ = 0x1;
export const COPY_SRC = 0x4;
export const COPY_DST = 0x8;
export const UNIFORM = 0x40;
export const STORAGE = 0x80;
const QUERY_RESOLVE = 0x200;
const COMPUTE = 0x4;

/** How a shader uses a binding. */
export type BindingKind = 'uniform' | 'read' | 'write';

/** A compiled shader with the layout of its bindings. */
export interface Kernel {
  readonly pipeline: GPUComputePipeline;
  readonly layout: GPUBindGroupLayout;
}

/**
 * Compiles a shader with one entry point, `main`.
 *
 * @throws {BvhError} `bvh/pipeline` with the driver's message.
 */
export async function compileKernel(
  device: GPUDevice,
  label: string,
  module: WgslModule,
  flags: Readonly<Record<string, boolean>>,
  bindings: Readonly<Record<number, BindingKind>>,
): Promise<Kernel> {
  const types = { uniform: 'uniform', read: 'read-only-storage', write: 'storage' } as const;
  const layout = device.createBindGroupLayout({
    label,
    entries: Object.entries(bindings).map(([binding, kind]) => ({
      binding: Number(binding),
      visibility: COMPUTE,
      buffer: { type: types[kind] },
    })),
  });
  const shader = beginShaderModule(device, compose([module], { flags }), label);
  try {
    const pipeline = device.createComputePipelineAsync({
      label,
      layout: device.createPipelineLayout({ bindGroupLayouts: [layout] }),
      compute: { module: shader.module, entryPoint: 'main' },
    });
    // If the text is invalid, the next line throws.
    pipeline.catch(() => undefined);
    await shader.checked;
    return { pipeline: await pipeline, layout };
  } catch (cause) {
    throw new BvhError(
      'bvh/pipeline',
      `The GPU's driver did not compile the shader "${label}": ${(cause as Error).message}. Update the driver.`,
      { cause },
    );
  }
}

/**
 * Makes buffers, all or none.
 *
 * @throws {BvhError} `bvh/memory` where the GPU has no memory for them.
 */
export async function createBuffers<Name extends string>(
  device: GPUDevice,
  sizes: Readonly<Record<Name, number>>,
  usage: number,
): Promise<Record<Name, GPUBuffer>> {
  device.pushErrorScope('out-of-memory');
  const buffers = Object.entries<number>(sizes).map(
    ([name, size]) => [name, device.createBuffer({ label: `bvh ${name}`, size, usage })] as const,
  );
  if (!(await device.popErrorScope())) return Object.fromEntries(buffers) as Record<Name, GPUBuffer>;
  for (const [, buffer] of buffers) buffer.destroy();
  const bytes = Object.values<number>(sizes).reduce((sum, size) => sum + size, 0);
  throw new BvhError(
    'bvh/memory',
    `The GPU has no memory for ${bytes} bytes, which the build of a hierarchy needs: free memory, split the mesh, or build on the CPU.`,
  );
}

/** Copies a part of a buffer to the CPU. */
export async function readBuffer(device: GPUDevice, buffer: GPUBuffer, size: number): Promise<ArrayBuffer> {
  const staging = device.createBuffer({ label: 'bvh read', size, usage: MAP_READ | COPY_DST });
  const encoder = device.createCommandEncoder({ label: 'bvh read' });
  encoder.copyBufferToBuffer(buffer, 0, staging, 0, size);
  device.queue.submit([encoder.finish()]);
  try {
    await staging.mapAsync(MAP_READ);
    return staging.getMappedRange().slice(0);
  } catch (cause) {
    throw new BvhError('bvh/device', 'The GPU device was lost during a build: request another one.', { cause });
  } finally {
    staging.destroy();
  }
}

/** Timestamps around passes. */
export class PassClock {
  readonly #device: GPUDevice;
  readonly #set: GPUQuerySet;
  readonly #resolved: GPUBuffer;
  readonly #names: readonly string[];

  constructor(device: GPUDevice, names: readonly string[]) {
    this.#device = device;
    this.#names = names;
    this.#set = device.createQuerySet({ label: 'bvh phases', type: 'timestamp', count: 2 * names.length });
    this.#resolved = device.createBuffer({ size: 16 * names.length, usage: QUERY_RESOLVE | COPY_SRC });
  }

  writes(name: string): GPUComputePassTimestampWrites {
    const at = 2 * this.#names.indexOf(name);
    return { querySet: this.#set, beginningOfPassWriteIndex: at, endOfPassWriteIndex: at + 1 };
  }

  resolve(encoder: GPUCommandEncoder): void {
    encoder.resolveQuerySet(this.#set, 0, 2 * this.#names.length, this.#resolved, 0);
  }

  /** Milliseconds by name, and from the first to the last. */
  async read(): Promise<Record<string, number>> {
    const times = new BigUint64Array(await readBuffer(this.#device, this.#resolved, 16 * this.#names.length));
    const span = (from: number, to: number) => Number((times[to] as bigint) - (times[from] as bigint)) / 1e6;
    const phases = this.#names.map((name, i) => [name, span(2 * i, 2 * i + 1)] as const);
    return { ...Object.fromEntries(phases), total: span(0, times.length - 1) };
  }

  destroy(): void {
    this.#set.destroy();
    this.#resolved.destroy();
  }
}
