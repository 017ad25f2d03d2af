import type { Film } from '../film/film';
import type { FrameHistory } from '../film/frame-history';
import type { GroupWeights } from '../film/layers';
import type { GpuMemory } from '../storage/buffers';
import type { ResourceProvider } from '../storage/scene-resources';
import type { KernelSet } from './kernel-cache';
import { CONNECT_CROSSINGS, WALK_STEPS } from './limits';
import { PathMemory } from './path-memory';
import { aovBatchStruct, batchStruct } from '../storage/layout';
import { createBindGroup, MAX_LIGHT_GROUPS, type BindGroupName } from '../storage/resources';
import type { Kernel, KernelFeatures, KernelName } from './pipelines';
import type { Batch } from '../schedule/scheduler';
import { usesIndirectDispatch } from '../device/software';

/** Which samples of a batch record their AOVs, and whether they are traced for nothing else. */
export interface AovBatch {
  /** Number of the first sample that does. */
  readonly begin: number;
  /** Number of the first sample after those. */
  readonly end: number;
  readonly only: boolean;
}

/**
 * Maximum workgroups of kernels after the first edge, which loop over the paths that are left. Workgroups without a path
 * take time, and too few leave the GPU idle: with 4,096, samples take up to 12 % longer on an H200, with one for each
 * 64 paths of a batch up to 21 %.
 */
const LATER_GROUPS = 16384;

const NO_AOVS: AovBatch = { begin: 0, end: 0, only: false };

/** Where paths leave their light. */
export type PathFilm = Pick<Film, 'pixels' | 'buffer' | 'bytes'>;

/** Light paths, which are traced before each batch where they are requested: `session/light-paths.ts`. */
export interface LightTracing {
  /** What kernels bind by this name, if it is theirs. */
  buffer(name: string): GPUBuffer | undefined;
  writeFrame(frame: ArrayBuffer): void;
  rebind(group?: BindGroupName): void;
  /** Traces the light paths of a batch, and the batch in parts. */
  submit(batch: Batch, trace: (part: Batch) => void): void;
}

/** Light samples that frames keep for the next one: `session/light-reuse.ts`. */
export interface LightReuse {
  /** The film begins again. @param reuses Whether it takes light samples from the one before, and leaves some. */
  restart(reuses: boolean): void;
  /**
   * A batch is about to be traced.
   *
   * @param rebind Called where textures have changed places.
   * @returns Numbers of the film's frame and of the one before; 0 where there is none, the first one also where light
   * samples are not reused.
   */
  begin(rebind: () => void): readonly [now: number, before: number];
  /** What kernels bind by this name, if it is theirs. */
  resource(name: string): GPUTextureView | undefined;
  /** The GPU has refused something, perhaps these textures: the next film makes others. */
  discard(): void;
}

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
  readonly #paths: PathMemory;
  /** Bind groups by what they bind: kernels that bind the same share one. */
  readonly #groups: Readonly<Record<BindGroupName, Map<string, GPUBindGroup>>> = {
    launch: new Map(),
    scene: new Map(),
    film: new Map(),
  };
  readonly #indirect: boolean;
  /** The bind groups of the pass that is being encoded, by their numbers. */
  #bound: (GPUBindGroup | undefined)[] = [];
  /** As it was written. */
  #aovs: AovBatch | undefined;
  limits: DepthLimits;
  lights: LightTracing | undefined;
  reuse: LightReuse | undefined;
  /** Number of the film's first sample. */
  firstSample = 0;
  #kernels: KernelSet;
  #film: PathFilm;

  /** @param features Those of the kernels that {@link begin} will bring. */
  constructor(
    device: GPUDevice,
    memory: GpuMemory,
    scene: ResourceProvider,
    features: KernelFeatures,
    film: PathFilm,
    requested: number | undefined,
    limits: DepthLimits,
  ) {
    this.#device = device;
    this.#memory = memory;
    this.#scene = scene;
    this.#kernels = { features, kernels: {} };
    this.#film = film;
    this.limits = limits;
    this.#indirect = usesIndirectDispatch(device);
    this.#paths = new PathMemory(device, memory, features, film.pixels, requested, () => this.rebind('launch'));
  }

  /**
   * Does what the first batch would do with a kernel, while others still compile: makes its bind groups, and with an
   * early kernel lets the browser build its validation of indirect dispatches.
   */
  prewarm(name: KernelName, kernel: Kernel): void {
    this.#groupsOf(kernel);
    // The dispatch sizes are still 0: nothing runs.
    if (name === 'generate' && this.#indirect)
      this.#pass('glanz prewarm', (pass) => this.#run(pass, kernel, { indirect: 0 }));
  }

  /** The kernels are there, for the features that it was made with. */
  begin(kernels: KernelSet): void {
    this.#kernels = kernels;
  }

  /** Paths that there is memory for. */
  get capacity(): number {
    return this.#paths.capacity;
  }

  /** Paths that there may be memory for: a batch of so many will be given it. */
  get limit(): number {
    return this.#paths.limit;
  }

  /** Of the film. */
  get pixels(): number {
    return this.#film.pixels;
  }

  /** Paths of a sample: one, with catchers two. */
  get pathsPerSample(): number {
    return this.#kernels.features.flags.CATCHER ? 2 : 1;
  }

  get kernels(): KernelSet {
    return this.#kernels;
  }

  /** Of the paths. `queues` begins with a header: word 3 counts dropped samples, word 7 rays. */
  get buffers(): PathMemory['buffers'] {
    return this.#paths.buffers;
  }

  /**
   * Makes the buffers that other kernels need, where those there are too small.
   * @returns `use` puts kernels and buffers in place; `discard` frees the buffers. Nothing has changed before.
   */
  prepare(kernels: KernelSet): { readonly use: () => void; readonly discard: () => void } {
    const paths = this.#paths.prepare(kernels.features);
    return {
      use: () => {
        this.#kernels = kernels;
        paths.use();
      },
      discard: paths.discard,
    };
  }

  /**
   * To be called when buffers or textures of the scene or the film were replaced.
   * @param group What they belong to; by default all is bound again, as after the GPU has refused something.
   */
  rebind(group?: BindGroupName): void {
    for (const name of group ? [group] : (Object.keys(this.#groups) as BindGroupName[])) this.#groups[name].clear();
    this.#aovs = undefined;
    this.lights?.rebind(group);
    if (!group) this.reuse?.discard();
  }

  /** From now on paths go to this film. */
  useFilm(film: PathFilm): void {
    this.#film = film;
    this.rebind('film');
  }

  writeFrame(frame: ArrayBuffer): void {
    this.#memory.write(this.#paths.buffers.frame, frame);
    this.lights?.writeFrame(frame);
  }

  /** The frame before, for motion: see `FrameHistory.pack`. */
  writeHistory({ uniforms, moves }: ReturnType<FrameHistory['pack']>): void {
    this.#paths.fitMoves(moves.byteLength);
    this.#memory.write(this.#paths.buffers.history, uniforms);
    this.#memory.write(this.#paths.buffers.history_moves, moves);
  }

  /** Weights of the light groups: as they are now, and as they were when the film was begun. */
  writeGroups(now: GroupWeights, first: GroupWeights): void {
    const data = new Float32Array(8 * MAX_LIGHT_GROUPS);
    now.forEach((weight, i) => data.set(weight, 4 * i));
    first.forEach((weight, i) => data.set(weight, 4 * (MAX_LIGHT_GROUPS + i)));
    this.#memory.write(this.#paths.buffers.light_groups, data);
  }

  /**
   * Paths that a batch may hold now. Where it could hold more, memory for those is asked for, and used once the GPU has
   * granted it; where it has not, batches stay as they are.
   */
  room(paths: number): number {
    return this.#paths.room(paths);
  }

  /**
   * Traces the batch's paths, which there must be {@link room} for, and adds them to the film.
   * @param aovs What to do about their AOVs, where the kernels record such.
   */
  submit(batch: Batch, aovs: AovBatch = NO_AOVS): void {
    if (this.lights && !aovs.only) this.lights.submit(batch, (part) => this.#submit(part, aovs));
    else this.#submit(batch, aovs);
  }

  #submit(batch: Batch, aovs: AovBatch): void {
    const { kernels, features } = this.#kernels;
    const [frame, before] = (features.flags.LIGHT_REUSE && this.reuse?.begin(() => this.rebind('film'))) || [0, 0];
    this.#writeBatch(batch, frame, before);
    this.#writeAovs(aovs);
    const paths = batch.pixelCount * batch.sampleCount * this.pathsPerSample;
    const recorded = features.flags.AOVS === true && batch.sampleOffset < aovs.end;
    this.#pass('glanz batch', (pass) => {
      const run = (name: KernelName, work: number | { readonly indirect: number }) =>
        this.#run(pass, kernels[name] as Kernel, work);
      run('begin', 1);
      const all = Math.ceil(paths / 64);
      run('generate', all);
      const steps = this.#steps(features.flags);
      for (let step = 1; step <= steps; step++) {
        const groups = step === 1 ? all : Math.min(all, LATER_GROUPS);
        const sized = (indirect: number) => (this.#indirect ? { indirect } : groups);
        run('intersect', sized(0));
        if (step === 1 && frame > 0 && !aovs.only) run('reservoirs', all);
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
    else pass.dispatchWorkgroupsIndirect(this.#paths.buffers.dispatch, work.indirect);
  }

  #writeBatch(batch: Batch, reuse = 0, reuseBefore = 0): void {
    const data = batchStruct.allocate();
    batchStruct.write(data, 0, {
      pixel_offset: batch.pixelOffset,
      pixel_count: batch.pixelCount,
      sample_offset: batch.sampleOffset,
      sample_count: batch.sampleCount,
      path_count: batch.pixelCount * batch.sampleCount * this.pathsPerSample,
      first_sample: this.firstSample,
      reuse,
      reuse_before: reuseBefore,
    });
    this.#memory.write(this.#paths.buffers.batch, data);
  }

  #writeAovs(aovs: AovBatch): void {
    const last = this.#aovs;
    const same = aovs.begin === last?.begin && aovs.end === last.end && aovs.only === last.only;
    if (!this.#kernels.features.flags.AOVS || same) return;
    const data = aovBatchStruct.allocate();
    aovBatchStruct.write(data, 0, { begin: aovs.begin, end: aovs.end, only: aovs.only ? 1 : 0 });
    this.#memory.write(this.#paths.buffers.aov_batch, data);
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
    const own = (this.#paths.buffers as Record<string, GPUBuffer>)[name];
    if (own) return { buffer: own };
    const light = this.lights?.buffer(name);
    if (light) return { buffer: light };
    const kept = this.reuse?.resource(name);
    if (kept) return kept;
    const film = this.#film.buffer(name);
    return film ? { buffer: film, size: this.#film.bytes(film) } : this.#scene.resource(name);
  }
}
