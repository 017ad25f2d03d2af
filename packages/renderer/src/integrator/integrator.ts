import type { Film } from '../film/film';
import type { FrameHistory } from '../film/frame-history';
import type { GroupWeights } from '../film/layers';
import {
  GPU_BUFFER_COPY_DST,
  GPU_BUFFER_COPY_SRC,
  GPU_BUFFER_INDIRECT,
  GPU_BUFFER_STORAGE,
  GPU_BUFFER_UNIFORM,
  type GpuMemory,
} from '../storage/buffers';
import { inErrorScopes } from '../device/error-scopes';
import type { ResourceProvider } from '../storage/scene-resources';
import type { KernelSet } from './kernel-cache';
import { CONNECT_CROSSINGS, WALK_STEPS } from './limits';
import { BLOCK } from '../storage/blocks';
import { aovBatchStruct, batchStruct, frameStruct, historyStruct, shadowRecords } from '../storage/layout';
import { pathLayout } from '../path/path-layout';
import { createBindGroup, MAX_LIGHT_GROUPS, type BindGroupName } from '../storage/resources';
import type { Kernel, KernelFeatures, KernelName } from './pipelines';
import type { Batch } from '../schedule/scheduler';
import { isSoftware } from '../device/software';

/** Queue header words before the items. */
const QUEUE_WORDS = 8;

/** One dispatch covers at most 65,535 workgroups of 64 threads. */
export const MAX_THREADS = 65535 * 64;

type OwnBuffer =
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
export function pathLimit(device: GPUDevice, wanted: number | undefined, features: KernelFeatures): number {
  const most =
    BLOCK *
    Math.floor(
      device.limits.maxStorageBufferBindingSize /
        (BLOCK * Math.max(pathLayout(features).records.size, shadowRecords(features.flags).size)),
    );
  const standard = device.limits.maxBufferSize >= 2 ** 31 - 4 ? 1 << 22 : 1 << 20;
  return Math.max(64, Math.min(wanted ?? standard, most, MAX_THREADS));
}

/** Which samples of a batch record their AOVs, and whether they are traced for nothing else. */
export interface AovBatch {
  /** Number of the first sample that does. */
  readonly begin: number;
  /** Number of the first sample after those. */
  readonly end: number;
  readonly only: boolean;
}

const NO_AOVS: AovBatch = { begin: 0, end: 0, only: false };

/** How long paths may become. */
export interface DepthLimits {
  /** Edges. */
  readonly maxDepth: number;
  /** Scattering events in media. */
  readonly maxVolumeDepth: number;
}

/** The paths in flight and the kernels that move them: encodes batches, knows nothing of time or targets. */
export class Integrator {
  readonly #device: GPUDevice;
  readonly #memory: GpuMemory;
  readonly #scene: ResourceProvider;
  readonly #buffers: Record<OwnBuffer, GPUBuffer>;
  /** Bind groups by what they bind: kernels that bind the same share one. */
  readonly #groups: Readonly<Record<BindGroupName, Map<string, GPUBindGroup>>> = {
    launch: new Map(),
    scene: new Map(),
    film: new Map(),
  };
  readonly #wanted: number | undefined;
  /**
   * Whether the GPU itself says how many threads a kernel shall have: only as many as there are paths left. A CPU, for
   * which each group of threads is work, gains by that. For a GPU those that end at once are nothing, and it is slow
   * with WebGPU, which checks each number on the GPU before it believes it: a path of 256 edges takes 22 times as long
   * on an H200.
   */
  readonly #counted: boolean;
  #capacity: number;
  #growing = false;
  /** The bind groups of the pass that is being encoded, by their numbers. */
  #bound: (GPUBindGroup | undefined)[] = [];
  /** A number of paths that the GPU has refused memory for. */
  #refused = Infinity;
  /** As it was written. */
  #aovs: AovBatch | undefined;
  limits: DepthLimits;
  /** Number of the film's first sample. */
  firstSample = 0;
  #kernels: KernelSet;
  #film: Film;

  /** @param features Those of the kernels that {@link begin} will bring. */
  constructor(
    device: GPUDevice,
    memory: GpuMemory,
    scene: ResourceProvider,
    features: KernelFeatures,
    film: Film,
    wanted: number | undefined,
    limits: DepthLimits,
  ) {
    this.#device = device;
    this.#memory = memory;
    this.#scene = scene;
    this.#kernels = { features, kernels: {} };
    this.#film = film;
    this.limits = limits;
    this.#wanted = wanted;
    const { adapterInfo } = device as { readonly adapterInfo?: GPUAdapterInfo };
    this.#counted = adapterInfo !== undefined && isSoftware(adapterInfo);
    // A sample of the whole image; more when the GPU turns out to be fast.
    const capacity = Math.min(pathLimit(device, wanted, features), Math.max(1 << 16, film.pixels));
    this.#capacity = capacity;
    this.#buffers = {
      frame: memory.buffer('frame', frameStruct.size, GPU_BUFFER_UNIFORM | GPU_BUFFER_COPY_DST),
      batch: memory.buffer('batch', batchStruct.size, GPU_BUFFER_UNIFORM | GPU_BUFFER_COPY_DST),
      aov_batch: memory.buffer('AOV batch', aovBatchStruct.size, GPU_BUFFER_UNIFORM | GPU_BUFFER_COPY_DST),
      history: memory.buffer('history', historyStruct.size, GPU_BUFFER_UNIFORM | GPU_BUFFER_COPY_DST),
      history_moves: memory.buffer('history moves', 64, GPU_BUFFER_STORAGE | GPU_BUFFER_COPY_DST),
      light_groups: memory.buffer('light groups', 2 * MAX_LIGHT_GROUPS * 16, GPU_BUFFER_UNIFORM | GPU_BUFFER_COPY_DST),
      paths: memory.buffer('paths', pathLayout(features).records.bytes(capacity), GPU_BUFFER_STORAGE),
      queues: memory.buffer(
        'queues',
        (QUEUE_WORDS + 2 * capacity) * 4,
        GPU_BUFFER_STORAGE | GPU_BUFFER_COPY_SRC | GPU_BUFFER_COPY_DST,
      ),
      shadows: memory.buffer(
        'shadows',
        shadowRecords(features.flags).bytes(features.flags.NEXT_EVENT ? capacity : 1),
        GPU_BUFFER_STORAGE,
      ),
      dispatch: memory.buffer('dispatch', 32, GPU_BUFFER_STORAGE | GPU_BUFFER_INDIRECT),
    };
  }

  /**
   * Does what the first batch would do with a kernel, while others still compile: makes its bind groups, and with an
   * early kernel lets the browser build its validation of indirect dispatches.
   */
  prewarm(name: KernelName, kernel: Kernel): void {
    this.#groupsOf(kernel);
    // The dispatch sizes are still 0: nothing runs.
    if (name === 'generate' && this.#counted)
      this.#pass('glanz prewarm', (pass) => this.#run(pass, kernel, { indirect: 0 }));
  }

  /** The kernels are there, for the features that it was made with. */
  begin(kernels: KernelSet): void {
    this.#kernels = kernels;
  }

  /** Paths that there is memory for. */
  get capacity(): number {
    return this.#capacity;
  }

  /** Paths that there may be memory for: a batch of so many will be given it. */
  get limit(): number {
    return pathLimit(this.#device, this.#wanted, this.#kernels.features);
  }

  /** Paths of a sample: one, with catchers two. */
  get pathsPerSample(): number {
    return this.#kernels.features.flags.CATCHER ? 2 : 1;
  }

  get kernels(): KernelSet {
    return this.#kernels;
  }

  /** The queue header; word 3 counts dropped samples, word 7 rays. */
  get queues(): GPUBuffer {
    return this.#buffers.queues;
  }

  /**
   * Makes the buffers that other kernels need, where those there are too small.
   * @returns `use` puts kernels and buffers in place; `discard` frees the buffers. Nothing has changed before.
   */
  prepare(kernels: KernelSet): { readonly use: () => void; readonly discard: () => void } {
    // Paths that carry more may be too large for as many of them.
    const capacity = Math.min(this.#capacity, pathLimit(this.#device, this.#wanted, kernels.features));
    const made = this.#makePathBuffers(kernels.features, capacity, (name, bytes) => this.#buffers[name].size < bytes);
    return {
      use: () => {
        this.#kernels = kernels;
        this.#capacity = capacity;
        this.#refused = Infinity;
        this.#replace(made);
      },
      discard: () => Object.values(made).forEach((buffer) => this.#memory.release(buffer)),
    };
  }

  #makePathBuffers(
    features: KernelFeatures,
    paths: number,
    needed: (name: 'paths' | 'shadows', bytes: number) => boolean,
  ): Partial<Record<OwnBuffer, GPUBuffer>> {
    const bytes = {
      paths: pathLayout(features).records.bytes(paths),
      shadows: features.flags.NEXT_EVENT ? shadowRecords(features.flags).bytes(paths) : 0,
    };
    const names = (['paths', 'shadows'] as const).filter((name) => needed(name, bytes[name]));
    return Object.fromEntries(names.map((name) => [name, this.#memory.buffer(name, bytes[name], GPU_BUFFER_STORAGE)]));
  }

  #replace(made: Partial<Record<OwnBuffer, GPUBuffer>>): void {
    for (const [name, buffer] of Object.entries(made) as [OwnBuffer, GPUBuffer][]) {
      this.#memory.release(this.#buffers[name]);
      this.#buffers[name] = buffer;
    }
    this.rebind('launch');
  }

  /**
   * To be called when buffers or textures of the scene or the film were replaced.
   * @param group What they belong to; by default all is bound again, as after the GPU has refused something.
   */
  rebind(group?: BindGroupName): void {
    for (const name of group ? [group] : (Object.keys(this.#groups) as BindGroupName[])) this.#groups[name].clear();
    this.#aovs = undefined;
  }

  /** From now on paths go to this film. */
  useFilm(film: Film): void {
    this.#film = film;
    this.rebind('film');
  }

  writeFrame(frame: ArrayBuffer): void {
    this.#memory.write(this.#buffers.frame, frame);
  }

  /** The frame before, for motion: see `FrameHistory.pack`. */
  writeHistory({ uniforms, moves }: ReturnType<FrameHistory['pack']>): void {
    if (moves.byteLength > this.#buffers.history_moves.size)
      this.#replace({
        history_moves: this.#memory.buffer('history moves', moves.byteLength, GPU_BUFFER_STORAGE | GPU_BUFFER_COPY_DST),
      });
    this.#memory.write(this.#buffers.history, uniforms);
    this.#memory.write(this.#buffers.history_moves, moves);
  }

  /** Weights of the light groups: as they are now, and as they were when the film was begun. */
  writeGroups(now: GroupWeights, first: GroupWeights): void {
    const data = new Float32Array(8 * MAX_LIGHT_GROUPS);
    now.forEach((weight, i) => data.set(weight, 4 * i));
    first.forEach((weight, i) => data.set(weight, 4 * (MAX_LIGHT_GROUPS + i)));
    this.#memory.write(this.#buffers.light_groups, data);
  }

  /**
   * Paths that a batch may hold now. Where it could hold more, memory for those is asked for, and used once the GPU has
   * granted it; where it has not, batches stay as they are.
   */
  room(paths: number): number {
    const wanted = Math.min(paths, this.limit);
    if (wanted > this.#capacity && wanted < this.#refused && !this.#growing) {
      this.#growing = true;
      this.#grow(wanted)
        .catch(() => (this.#refused = Math.min(this.#refused, wanted)))
        .finally(() => (this.#growing = false));
    }
    return this.#capacity;
  }

  async #grow(paths: number): Promise<void> {
    const kernels = this.#kernels;
    const { result: made, verified } = inErrorScopes(this.#device, 'more paths at once', () => ({
      ...this.#makePathBuffers(kernels.features, paths, (name, bytes) => this.#buffers[name].size < bytes),
      queues: this.#memory.buffer(
        'queues',
        (QUEUE_WORDS + 2 * paths) * 4,
        GPU_BUFFER_STORAGE | GPU_BUFFER_COPY_SRC | GPU_BUFFER_COPY_DST,
      ),
    }));
    const discard = () => Object.values(made).forEach((buffer) => this.#memory.release(buffer));
    await verified.catch((error: unknown) => {
      discard();
      throw error;
    });
    // Other kernels have come meanwhile, whose paths may be larger.
    if (kernels !== this.#kernels || this.#memory.destroyed) return discard();
    this.#capacity = paths;
    // The counts of dropped samples and of rays go on.
    const encoder = this.#device.createCommandEncoder({ label: 'glanz queues' });
    encoder.copyBufferToBuffer(this.#buffers.queues, 0, made.queues, 0, QUEUE_WORDS * 4);
    this.#device.queue.submit([encoder.finish()]);
    this.#replace(made);
  }

  /**
   * Traces the batch's paths, which there must be {@link room} for, and adds them to the film.
   * @param aovs What to do about their AOVs, where the kernels record such.
   */
  submit(batch: Batch, aovs: AovBatch = NO_AOVS): void {
    this.#writeBatch(batch);
    this.#writeAovs(aovs);
    const { kernels, features } = this.#kernels;
    const paths = batch.pixelCount * batch.sampleCount * this.pathsPerSample;
    const recorded = features.flags.AOVS === true && batch.sampleOffset < aovs.end;
    this.#pass('glanz batch', (pass) => {
      const run = (name: KernelName, work: number | { readonly indirect: number }) =>
        this.#run(pass, kernels[name] as Kernel, work);
      run('begin', 1);
      run('generate', Math.ceil(paths / 64));
      // Kernels end at once in threads beyond the paths that are left.
      const sized = (indirect: number) => (this.#counted ? { indirect } : Math.ceil(paths / 64));
      const steps = this.#steps(features.flags);
      for (let step = 1; step <= steps; step++) {
        run('intersect', sized(0));
        run('shade', sized(0));
        if (step === steps) break;
        run('advance', 1);
        if (features.flags.NEXT_EVENT && !aovs.only) run('connect', sized(16));
      }
      if (!aovs.only) run('resolve', Math.ceil(batch.pixelCount / 64));
      if (recorded) run('aov', Math.ceil(batch.pixelCount / 64));
      if (recorded && features.flags.AOV_IDS) run('aov_ids', Math.ceil(batch.pixelCount / 64));
    });
  }

  /** Steps after which every path has ended: one an edge, and those in which none is completed. */
  #steps(flags: Readonly<Record<string, boolean>>): number {
    const walking = flags.SCATTERING ? Math.ceil(this.limits.maxVolumeDepth / WALK_STEPS) : 0;
    return this.limits.maxDepth + walking + (flags.NULL_SURFACES ? CONNECT_CROSSINGS : 0);
  }

  /** Runs a kernel that has a thread for each pixel of the batch. */
  submitPixels(name: KernelName, kernel: Kernel, batch: Batch): void {
    this.#writeBatch(batch);
    this.#pass(`glanz ${name}`, (pass) => this.#run(pass, kernel, Math.ceil(batch.pixelCount / 64)));
  }

  /** Runs the kernel that sums up noise, a workgroup a tile. */
  submitTiles(kernel: Kernel, columns: number, rows: number): void {
    this.#pass('glanz noise', (pass) => {
      this.#bind(pass, kernel);
      pass.dispatchWorkgroups(columns, rows);
    });
  }

  #pass(label: string, encode: (pass: GPUComputePassEncoder) => void): void {
    const encoder = this.#device.createCommandEncoder({ label });
    const pass = encoder.beginComputePass({ label });
    this.#bound = [];
    encode(pass);
    pass.end();
    this.#device.queue.submit([encoder.finish()]);
  }

  #run(pass: GPUComputePassEncoder, kernel: Kernel, work: number | { readonly indirect: number }): void {
    this.#bind(pass, kernel);
    if (typeof work === 'number') pass.dispatchWorkgroups(work);
    else pass.dispatchWorkgroupsIndirect(this.#buffers.dispatch, work.indirect);
  }

  #writeBatch(batch: Batch): void {
    const data = batchStruct.allocate();
    batchStruct.write(data, 0, {
      pixel_offset: batch.pixelOffset,
      pixel_count: batch.pixelCount,
      sample_offset: batch.sampleOffset,
      sample_count: batch.sampleCount,
      path_count: batch.pixelCount * batch.sampleCount * this.pathsPerSample,
      first_sample: this.firstSample,
    });
    this.#memory.write(this.#buffers.batch, data);
  }

  #writeAovs(aovs: AovBatch): void {
    const last = this.#aovs;
    const same = aovs.begin === last?.begin && aovs.end === last.end && aovs.only === last.only;
    if (!this.#kernels.features.flags.AOVS || same) return;
    const data = aovBatchStruct.allocate();
    aovBatchStruct.write(data, 0, { begin: aovs.begin, end: aovs.end, only: aovs.only ? 1 : 0 });
    this.#memory.write(this.#buffers.aov_batch, data);
    this.#aovs = aovs;
  }

  /** Sets a kernel, and those of its bind groups that the one before had otherwise. */
  #bind(pass: GPUComputePassEncoder, kernel: Kernel): void {
    pass.setPipeline(kernel.pipeline);
    this.#groupsOf(kernel).forEach((group, index) => {
      if (this.#bound[index] === group) return;
      pass.setBindGroup(index, group);
      this.#bound[index] = group;
    });
  }

  #groupsOf(kernel: Kernel): GPUBindGroup[] {
    return kernel.groups.map((group, index) => {
      const made = this.#groups[group.group];
      let found = made.get(group.key);
      if (!found) {
        const layout = kernel.layouts[index] as GPUBindGroupLayout;
        found = createBindGroup(this.#device, layout, group, (name) => this.#resource(name));
        made.set(group.key, found);
      }
      return found;
    });
  }

  #resource(name: string): GPUBindingResource | undefined {
    const own = (this.#buffers as Record<string, GPUBuffer>)[name];
    if (own) return { buffer: own };
    const film = this.#film.buffer(name);
    return film ? { buffer: film, size: this.#film.bytes(film) } : this.#scene.resource(name);
  }
}
