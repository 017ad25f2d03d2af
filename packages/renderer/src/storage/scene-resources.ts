import type { Pages } from './paged/pages';
import type { ResourceName } from './resources';
import {
  GPU_BUFFER_COPY_DST,
  GPU_BUFFER_COPY_SRC,
  GPU_BUFFER_STORAGE,
  GPU_TEXTURE_BINDING,
  GPU_TEXTURE_COPY_DST,
  type GpuMemory,
  type PagedArray,
} from './buffers';

/** Where kernels find the buffers, textures and samplers that they bind. */
export interface ResourceProvider {
  /** The resource of this name; `undefined` if it is not this provider's. */
  resource(name: string): GPUBindingResource | undefined;
}

/** What an edit has allocated and replaced. */
export interface ResourceLog {
  /** Whether memory was asked for. */
  readonly allocated: boolean;
  /** Frees what was replaced. */
  readonly settle: () => void;
  /** Puts back what was replaced, and frees what took its place. */
  readonly undo: () => void;
}

type SceneResource = GPUBuffer | GPUTexture | PagedArray;

/**
 * The named buffers and textures of a scene. What an edit replaces can be kept until it is known whether the edit
 * holds.
 */
export class SceneResources {
  /** Holds the arrays that are too large for buffers, from when they are made on. */
  pages: Pages | undefined;
  readonly #memory: GpuMemory;
  readonly #buffers = new Map<ResourceName, GPUBuffer | PagedArray>();
  readonly #textures = new Map<ResourceName, GPUTexture>();
  #log: { readonly made: SceneResource[]; readonly replaced: SceneResource[] } | undefined;

  /** @param pages See {@link pages}. */
  constructor(memory: GpuMemory, pages?: Pages) {
    this.#memory = memory;
    this.pages = pages;
  }

  buffer(name: ResourceName): GPUBuffer | PagedArray | undefined {
    return this.#buffers.get(name);
  }

  texture(name: ResourceName): GPUTexture | undefined {
    return this.#textures.get(name);
  }

  /** Creates a storage buffer of this name and replaces the present one. */
  make(name: ResourceName, bytes: number): GPUBuffer | PagedArray {
    const buffer =
      this.pages?.make(this.#memory, name, bytes) ??
      this.#memory.buffer(name, bytes, GPU_BUFFER_STORAGE | GPU_BUFFER_COPY_DST | GPU_BUFFER_COPY_SRC);
    this.#replace(this.#buffers, name, buffer);
    return buffer;
  }

  /**
   * Makes a storage buffer of this name and fills it. All at once: large ones are filled by who can wait in between.
   */
  upload(name: ResourceName, data: ArrayBufferView<ArrayBuffer> | ArrayBuffer): void {
    this.make(name, data.byteLength);
    this.write(name, data);
  }

  /** Writes into the buffer of this name, at `offset` bytes. */
  write(name: ResourceName, data: ArrayBufferView<ArrayBuffer> | ArrayBuffer, offset = 0): void {
    const buffer = this.#buffers.get(name) as GPUBuffer | PagedArray;
    if ('view' in buffer) buffer.write(data, offset);
    else this.#memory.write(buffer, data, offset);
  }

  /** Creates an empty texture of this name and replaces the present one. */
  makeTexture(
    name: ResourceName,
    descriptor: Omit<GPUTextureDescriptor, 'label' | 'usage'>,
    bytes: number,
  ): GPUTexture {
    const texture = this.#memory.texture(
      { ...descriptor, label: `glanz ${name}`, usage: GPU_TEXTURE_BINDING | GPU_TEXTURE_COPY_DST },
      bytes,
    );
    this.#replace(this.#textures, name, texture);
    return texture;
  }

  /**
   * Keeps what is replaced while `edit` runs, until the log is settled.
   * @param undone Called when the log has been undone, also where `edit` throws.
   */
  record<T>(edit: () => T, undone: () => void): ResourceLog & { readonly result: T } {
    const log = { made: [] as SceneResource[], replaced: [] as SceneResource[] };
    const [buffers, textures, pages] = [[...this.#buffers], [...this.#textures], this.pages];
    const undo = () => {
      this.pages = pages;
      for (const [name, buffer] of buffers) this.#buffers.set(name, buffer);
      for (const [name, texture] of textures) this.#textures.set(name, texture);
      for (const resource of log.made) this.#memory.release(resource);
      undone();
    };
    this.#log = log;
    try {
      const result = edit();
      return {
        result,
        allocated: log.made.length > 0,
        settle: () => log.replaced.forEach((resource) => this.#memory.release(resource)),
        undo,
      };
    } catch (error) {
      undo();
      throw error;
    } finally {
      this.#log = undefined;
    }
  }

  #replace<T extends SceneResource>(of: Map<ResourceName, T>, name: ResourceName, resource: T): void {
    const before = of.get(name);
    if (this.#log) {
      this.#log.made.push(resource);
      if (before) this.#log.replaced.push(before);
    } else this.#memory.release(before);
    of.set(name, resource);
  }
}
