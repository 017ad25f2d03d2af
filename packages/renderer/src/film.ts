import { GPU_BUFFER_COPY_DST, GPU_BUFFER_COPY_SRC, GPU_BUFFER_MAP_READ, GPU_BUFFER_STORAGE, type GpuMemory } from './gpu/buffers';
import { DeviceError } from './errors';

/** The buffers of one picture: sums, mean and, once asked for, the first-hit features. */
export class Film {
  readonly width: number;
  readonly height: number;
  readonly block: GPUBuffer;
  readonly total: GPUBuffer;
  /** Mean radiance and coverage, vec4f per pixel, row-major, top row first. */
  readonly beauty: GPUBuffer;
  #features: { readonly albedo: GPUBuffer; readonly normal: GPUBuffer; readonly ids: GPUBuffer } | undefined;
  readonly #memory: GpuMemory;

  constructor(memory: GpuMemory, width: number, height: number) {
    this.#memory = memory;
    this.width = width;
    this.height = height;
    const bytes = width * height * 16;
    const usage = GPU_BUFFER_STORAGE | GPU_BUFFER_COPY_SRC | GPU_BUFFER_COPY_DST;
    this.block = memory.buffer('film block', bytes, usage);
    this.total = memory.buffer('film total', bytes, usage);
    this.beauty = memory.buffer('film beauty', bytes, usage);
  }

  get pixels(): number {
    return this.width * this.height;
  }

  /** Albedo, normal and id buffers; made on first use. */
  features(): { readonly albedo: GPUBuffer; readonly normal: GPUBuffer; readonly ids: GPUBuffer } {
    const bytes = this.pixels * 16;
    const usage = GPU_BUFFER_STORAGE | GPU_BUFFER_COPY_SRC | GPU_BUFFER_COPY_DST;
    return (this.#features ??= {
      albedo: this.#memory.buffer('film albedo', bytes, usage),
      normal: this.#memory.buffer('film normal', bytes, usage),
      ids: this.#memory.buffer('film ids', bytes, usage),
    });
  }

  /** Zeroes the sums. */
  clear(encoder: GPUCommandEncoder): void {
    for (const buffer of [this.block, this.total, this.beauty]) encoder.clearBuffer(buffer);
  }

  destroy(): void {
    for (const buffer of [this.block, this.total, this.beauty, this.#features?.albedo, this.#features?.normal, this.#features?.ids]) this.#memory.release(buffer);
  }
}

/**
 * Copies a GPU buffer to the CPU.
 * @throws {DeviceError} `renderer/device-lost` if the device went away meanwhile.
 */
export async function readBuffer(device: GPUDevice, source: GPUBuffer, bytes: number, offset = 0): Promise<ArrayBuffer> {
  const staging = device.createBuffer({ label: 'glanz read', size: bytes, usage: GPU_BUFFER_MAP_READ | GPU_BUFFER_COPY_DST });
  try {
    const encoder = device.createCommandEncoder({ label: 'glanz read' });
    encoder.copyBufferToBuffer(source, offset, staging, 0, bytes);
    device.queue.submit([encoder.finish()]);
    await staging.mapAsync(1);
    return staging.getMappedRange().slice(0);
  } catch (cause) {
    throw new DeviceError('renderer/device-lost', `Reading back from the GPU failed: ${(cause as Error).message}`, { cause });
  } finally {
    staging.destroy();
  }
}
