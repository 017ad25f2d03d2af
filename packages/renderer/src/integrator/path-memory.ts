import { inErrorScopes } from '../device/error-scopes';
import { pathLayout } from '../path/path-layout';
import { BLOCK } from '../storage/blocks';
import {
  GPU_BUFFER_COPY_DST,
  GPU_BUFFER_COPY_SRC,
  GPU_BUFFER_INDIRECT,
  GPU_BUFFER_STORAGE,
  GPU_BUFFER_UNIFORM,
  type GpuMemory,
} from '../storage/buffers';
import { aovBatchStruct, batchStruct, frameStruct, historyStruct, shadowRecords } from '../storage/layout';
import { MAX_LIGHT_GROUPS } from '../storage/resources';
import type { KernelFeatures } from './pipelines';

/** Queue header words before the items. */
const QUEUE_WORDS = 8;

/** One dispatch covers at most 65,535 workgroups of 64 threads. */
export const MAX_THREADS = 65535 * 64;

type LaunchBuffer =
  | 'frame'
  | 'batch'
  | 'aov_batch'
  | 'history'
  | 'history_moves'
  | 'light_groups'
  | 'paths'
  | 'queues'
  | 'shadows'
  | 'dispatch';

/** How many paths may be kept on the GPU at once. Large GPUs are known by the size of their buffers. */
export function pathLimit(device: GPUDevice, requested: number | undefined, features: KernelFeatures): number {
  const max =
    BLOCK *
    Math.floor(
      device.limits.maxStorageBufferBindingSize /
        (BLOCK * Math.max(pathLayout(features).records.size, shadowRecords(features.flags).size)),
    );
  const standard = device.limits.maxBufferSize >= 2 ** 31 - 4 ? 1 << 22 : 1 << 20;
  return Math.max(64, Math.min(requested ?? standard, max, MAX_THREADS));
}

/** The buffers of a launch: paths in flight with their queues, and the uniforms of a batch. */
export class PathMemory {
  readonly buffers: Record<LaunchBuffer, GPUBuffer>;
  readonly #device: GPUDevice;
  readonly #memory: GpuMemory;
  readonly #requested: number | undefined;
  readonly #onReplace: () => void;
  #features: KernelFeatures;
  #capacity: number;
  #growing = false;
  /** A number of paths that the GPU has refused memory for. */
  #refused = Infinity;

  /**
   * @param features Of the kernels that trace the paths.
   * @param pixels Of the film.
   * @param requested Paths in flight, by the option; default: by the device.
   * @param onReplace Called when a buffer was replaced: bind groups with it are no longer right.
   */
  constructor(
    device: GPUDevice,
    memory: GpuMemory,
    features: KernelFeatures,
    pixels: number,
    requested: number | undefined,
    onReplace: () => void,
  ) {
    this.#device = device;
    this.#memory = memory;
    this.#features = features;
    this.#requested = requested;
    this.#onReplace = onReplace;
    // A sample of the whole image; more when the GPU turns out to be fast.
    const capacity = Math.min(this.limit, Math.max(1 << 16, pixels));
    this.#capacity = capacity;
    const uniform = (label: string, bytes: number) =>
      memory.buffer(label, bytes, GPU_BUFFER_UNIFORM | GPU_BUFFER_COPY_DST);
    this.buffers = {
      frame: uniform('frame', frameStruct.size),
      batch: uniform('batch', batchStruct.size),
      aov_batch: uniform('AOV batch', aovBatchStruct.size),
      history: uniform('history', historyStruct.size),
      history_moves: this.#moves(64),
      light_groups: uniform('light groups', 2 * MAX_LIGHT_GROUPS * 16),
      paths: memory.buffer('paths', pathLayout(features).records.bytes(capacity), GPU_BUFFER_STORAGE),
      queues: this.#queues(capacity),
      shadows: memory.buffer(
        'shadows',
        shadowRecords(features.flags).bytes(features.flags.NEXT_EVENT ? capacity : 1),
        GPU_BUFFER_STORAGE,
      ),
      dispatch: memory.buffer('dispatch', 32, GPU_BUFFER_STORAGE | GPU_BUFFER_INDIRECT),
    };
  }

  /** Paths that there is memory for. */
  get capacity(): number {
    return this.#capacity;
  }

  /** Paths that there may be memory for. */
  get limit(): number {
    return pathLimit(this.#device, this.#requested, this.#features);
  }

  /**
   * Makes the buffers that other kernels need, where those there are too small.
   * @returns `use` puts them in place; `discard` frees them. Nothing has changed before.
   */
  prepare(features: KernelFeatures): { readonly use: () => void; readonly discard: () => void } {
    // Paths that carry more may be too large for as many of them.
    const capacity = Math.min(this.#capacity, pathLimit(this.#device, this.#requested, features));
    const made = this.#records(features, capacity);
    return {
      use: () => {
        this.#features = features;
        this.#capacity = capacity;
        this.#refused = Infinity;
        this.#replace(made);
      },
      discard: () => this.#discard(made),
    };
  }

  /** Makes room for the instances that have moved, see `FrameHistory.pack`. */
  fitMoves(bytes: number): void {
    if (bytes > this.buffers.history_moves.size) this.#replace({ history_moves: this.#moves(bytes) });
  }

  /** See `Integrator.room`. */
  room(paths: number): number {
    const requested = Math.min(paths, this.limit);
    if (requested > this.#capacity && requested < this.#refused && !this.#growing) {
      this.#growing = true;
      this.#grow(requested)
        .catch(() => (this.#refused = Math.min(this.#refused, requested)))
        .finally(() => (this.#growing = false));
    }
    return this.#capacity;
  }

  async #grow(paths: number): Promise<void> {
    const features = this.#features;
    const { result: made, verified } = inErrorScopes(this.#device, 'more paths at once', () => ({
      ...this.#records(features, paths),
      queues: this.#queues(paths),
    }));
    await verified.catch((error: unknown) => {
      this.#discard(made);
      throw error;
    });
    // Other kernels have come meanwhile, whose paths may be larger.
    if (features !== this.#features || this.#memory.destroyed) return this.#discard(made);
    this.#capacity = paths;
    // The counts of dropped samples and of rays go on.
    const encoder = this.#device.createCommandEncoder({ label: 'glanz queues' });
    encoder.copyBufferToBuffer(this.buffers.queues, 0, made.queues, 0, QUEUE_WORDS * 4);
    this.#device.queue.submit([encoder.finish()]);
    this.#replace(made);
  }

  /** Buffers for the records of so many paths, where those there are too small. */
  #records(features: KernelFeatures, paths: number): Partial<Record<LaunchBuffer, GPUBuffer>> {
    const bytes = {
      paths: pathLayout(features).records.bytes(paths),
      shadows: features.flags.NEXT_EVENT ? shadowRecords(features.flags).bytes(paths) : 0,
    };
    const names = (['paths', 'shadows'] as const).filter((name) => this.buffers[name].size < bytes[name]);
    return Object.fromEntries(names.map((name) => [name, this.#memory.buffer(name, bytes[name], GPU_BUFFER_STORAGE)]));
  }

  #queues(paths: number): GPUBuffer {
    const usage = GPU_BUFFER_STORAGE | GPU_BUFFER_COPY_SRC | GPU_BUFFER_COPY_DST;
    return this.#memory.buffer('queues', (QUEUE_WORDS + 2 * paths) * 4, usage);
  }

  #moves(bytes: number): GPUBuffer {
    return this.#memory.buffer('history moves', bytes, GPU_BUFFER_STORAGE | GPU_BUFFER_COPY_DST);
  }

  #replace(made: Partial<Record<LaunchBuffer, GPUBuffer>>): void {
    for (const [name, buffer] of Object.entries(made) as [LaunchBuffer, GPUBuffer][]) {
      this.#memory.release(this.buffers[name]);
      this.buffers[name] = buffer;
    }
    this.#onReplace();
  }

  #discard(made: Partial<Record<LaunchBuffer, GPUBuffer>>): void {
    Object.values(made).forEach((buffer) => this.#memory.release(buffer));
  }
}
