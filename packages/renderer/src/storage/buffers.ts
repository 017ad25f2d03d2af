import { DeviceError } from '../errors';

const SLICE = 16 << 20;

const mebibytes = (bytes: number) => `${(bytes / 2 ** 20).toFixed(1)} MiB`;

/**
 * An array that shaders read from a texture, because it is larger than they can bind of a buffer: see
 * `storage/paged/pages.ts`. Used in place of a buffer.
 */
export interface PagedArray {
  /** Bytes of the texture. */
  readonly size: number;
  /** What kernels bind. */
  readonly view: GPUTextureView;
  /** As `GpuMemory.write`. */
  write(data: ArrayBufferView<ArrayBuffer> | ArrayBuffer, offset: number): void;
  /** Copies the first `bytes` of a buffer to `offset` bytes. */
  copyFrom(encoder: GPUCommandEncoder, buffer: GPUBuffer, offset: number, bytes: number): void;
  /** Copies the `bytes` from `offset` on to the begin of a buffer. */
  copyTo(encoder: GPUCommandEncoder, buffer: GPUBuffer, offset: number, bytes: number): void;
  destroy(): void;
}

/** A buffer, a texture, or what has several. */
interface Owned {
  destroy(): void;
}

/**
 * Owns GPU buffers and textures: counts their bytes, checks every size against the device's limits before it is asked
 * for, and destroys all of them at once.
 */
export class GpuMemory {
  readonly #device: GPUDevice;
  readonly #live = new Map<Owned, { readonly label: string; readonly bytes: number }>();
  #bytes = 0;
  #destroyed = false;

  constructor(device: GPUDevice) {
    this.#device = device;
  }

  /** Whether all has been destroyed. */
  get destroyed(): boolean {
    return this.#destroyed;
  }

  /** Bytes held now. */
  get bytes(): number {
    return this.#bytes;
  }

  /** Bytes held now under labels that a test accepts. */
  bytesOf(accepts: (label: string) => boolean): number {
    let sum = 0;
    for (const { label, bytes } of this.#live.values()) if (accepts(label)) sum += bytes;
    return sum;
  }

  /**
   * A buffer of at least `size` bytes (16 at least, rounded up to 16).
   * @throws {DeviceError} `renderer/limit` naming the limit it exceeds.
   */
  buffer(label: string, size: number, usage: GPUBufferUsageFlags): GPUBuffer {
    const bytes = Math.max(16, Math.ceil(size / 16) * 16);
    const { maxBufferSize, maxStorageBufferBindingSize } = this.#device.limits;
    const storage = (usage & GPU_BUFFER_STORAGE) !== 0;
    const [name, limit] =
      storage && maxStorageBufferBindingSize < maxBufferSize
        ? ['maxStorageBufferBindingSize', maxStorageBufferBindingSize]
        : ['maxBufferSize', maxBufferSize];
    if (bytes > limit) {
      throw new DeviceError(
        'renderer/limit',
        `The buffer "${label}" takes ${mebibytes(bytes)}, but this device's ${name} is ${mebibytes(limit)}: make the ${label.startsWith('film') ? 'image' : 'scene'} smaller, or request a higher limit.`,
      );
    }
    const buffer = this.#device.createBuffer({ label: `glanz ${label}`, size: bytes, usage });
    this.#keep(buffer, label, bytes);
    return buffer;
  }

  /**
   * A buffer filled with `data`. All at once: what is large enough to fill the queue to the GPU's process is written by
   * who can wait in between.
   */
  upload(label: string, data: ArrayBufferView<ArrayBuffer> | ArrayBuffer, usage: GPUBufferUsageFlags): GPUBuffer {
    const buffer = this.buffer(label, data.byteLength, usage | GPU_BUFFER_COPY_DST);
    this.write(buffer, data);
    return buffer;
  }

  /** Writes `data` into `buffer` at `offset` bytes. Lengths are multiples of 4. */
  write(buffer: GPUBuffer, data: ArrayBufferView<ArrayBuffer> | ArrayBuffer, offset = 0): void {
    const [source, start] = ArrayBuffer.isView(data) ? [data.buffer, data.byteOffset] : [data, 0];
    for (let at = 0; at < data.byteLength; at += SLICE) {
      const size = Math.min(SLICE, data.byteLength - at);
      this.#device.queue.writeBuffer(buffer, offset + at, source, start + at, size);
    }
  }

  texture(descriptor: GPUTextureDescriptor, bytes: number): GPUTexture {
    const texture = this.#device.createTexture(descriptor);
    this.#keep(texture, (descriptor.label ?? '').replace(/^glanz /, ''), bytes);
    return texture;
  }

  /** Takes a resource over that others have made. */
  adopt(label: string, buffer: Owned & { readonly size: number }): void {
    this.#keep(buffer, label, buffer.size);
  }

  /** Runs what makes buffers and textures. @returns What it returns, and those that it has made. */
  track<T>(make: () => T): [made: T, resources: readonly Owned[]] {
    const before = this.#live.size;
    // In the order in which they were made.
    return [make(), [...this.#live.keys()].slice(before)];
  }

  /** Destroys one buffer or texture; unknown ones are ignored. */
  release(resource: Owned | undefined): void {
    if (!resource) return;
    const held = this.#live.get(resource);
    if (held === undefined) return;
    this.#live.delete(resource);
    this.#bytes -= held.bytes;
    resource.destroy();
  }

  destroy(): void {
    this.#destroyed = true;
    for (const resource of this.#live.keys()) this.release(resource);
  }

  #keep(resource: Owned, label: string, bytes: number): void {
    this.#live.set(resource, { label, bytes });
    this.#bytes += bytes;
  }
}

// The numeric values of GPUBufferUsage, which Node does not define globally.
export const GPU_BUFFER_MAP_READ = 0x0001;
export const GPU_BUFFER_COPY_SRC = 0x0004;
export const GPU_BUFFER_COPY_DST = 0x0008;
export const GPU_BUFFER_UNIFORM = 0x0040;
export const GPU_BUFFER_STORAGE = 0x0080;
export const GPU_BUFFER_INDIRECT = 0x0100;
export const GPU_TEXTURE_COPY_DST = 0x02;
export const GPU_TEXTURE_BINDING = 0x04;
export const GPU_TEXTURE_RENDER = 0x10;
export const GPU_STAGE_COMPUTE = 0x4;
