import { frameCamera, validateScene, type Camera, type Environment, type Material, type Scene } from '@glanz/scene';
import { DeviceError, RenderError } from './errors';
import { Film, readBuffer } from './film';
import { GPU_BUFFER_COPY_DST, GPU_BUFFER_COPY_SRC, GPU_BUFFER_INDIRECT, GPU_BUFFER_STORAGE, GPU_BUFFER_UNIFORM, GpuMemory } from './gpu/buffers';
import { GpuScene } from './gpu/gpu-scene';
import { KernelCache, type KernelSet } from './gpu/kernel-cache';
import { packFrame } from './frame';
import { batchStruct, pathStruct, shadowStruct, frameStruct } from './kernels/layout';
import type { Kernel, KernelFeatures, KernelName } from './kernels/pipelines';
import type { FilmLayer, PathTracerOptions, PickResult, RenderOptions, RenderProgress, RenderStatistics } from './options';
import { pickPixel } from './pick';
import { findMaterial } from './scene/materials';
import { prepareGeometry, type Geometry } from './scene/geometry';
import { Scheduler, type Batch } from './scheduler';

/** Queue header words before the items. */
const QUEUE_WORDS = 8;
/** Samples that the feature layers average at most. */
const FEATURE_SAMPLES = 64;

/**
 * A progressive path tracer for one scene. No DOM: it runs in browsers and in Node alike.
 *
 * @example
 * const tracer = await PathTracer.create(device, scene, { width: 1024, height: 768 });
 * for await (const { samples } of tracer.render({ samples: 256 })) console.log(samples);
 * const pixels = await tracer.read('beauty'); // linear RGBA
 * tracer.destroy();
 */
export class PathTracer {
  readonly #device: GPUDevice;
  readonly #memory: GpuMemory;
  readonly #scene: Scene;
  readonly #geometry: Geometry;
  readonly #gpuScene: GpuScene;
  readonly #cache: KernelCache;
  readonly #options: PathTracerOptions;
  readonly #capacity: number;
  readonly #buffers: Readonly<Record<'frame' | 'batch' | 'paths' | 'queues' | 'shadows' | 'dispatch', GPUBuffer>>;
  readonly #groups = new Map<KernelName, GPUBindGroup>();
  #kernels: KernelSet;
  #film: Film;
  #camera: Camera;
  #scheduler: Scheduler | undefined;
  #generation = 0;
  #rendering = false;
  #destroyed = false;
  #failure: DeviceError | undefined;
  #featureSamples = 0;
  #statistics: RenderStatistics;
  #frameDirty = true;

  private constructor(device: GPUDevice, memory: GpuMemory, scene: Scene, geometry: Geometry, gpuScene: GpuScene, cache: KernelCache, kernels: KernelSet, options: PathTracerOptions, statistics: RenderStatistics) {
    this.#device = device;
    this.#memory = memory;
    this.#scene = scene;
    this.#geometry = geometry;
    this.#gpuScene = gpuScene;
    this.#cache = cache;
    this.#kernels = kernels;
    this.#options = options;
    this.#statistics = statistics;
    this.#camera = resolveCamera(scene, options.camera, options.width / options.height);
    const limit = device.limits.maxStorageBufferBindingSize;
    const wanted = options.pathsInFlight ?? Math.min(1 << 20, Math.max(1 << 16, options.width * options.height * 4));
    // One dispatch covers at most 65,535 workgroups of 64 paths.
    this.#capacity = Math.max(64, Math.min(wanted, Math.floor(limit / pathStruct.size), 65535 * 64));
    this.#buffers = {
      frame: memory.buffer('frame', frameStruct.size, GPU_BUFFER_UNIFORM | GPU_BUFFER_COPY_DST),
      batch: memory.buffer('batch', batchStruct.size, GPU_BUFFER_UNIFORM | GPU_BUFFER_COPY_DST),
      paths: memory.buffer('paths', this.#capacity * pathStruct.size, GPU_BUFFER_STORAGE),
      queues: memory.buffer('queues', (QUEUE_WORDS + 2 * this.#capacity) * 4, GPU_BUFFER_STORAGE | GPU_BUFFER_COPY_SRC),
      shadows: memory.buffer('shadows', (kernels.features.flags.NEXT_EVENT ? this.#capacity : 1) * shadowStruct.size, GPU_BUFFER_STORAGE),
      dispatch: memory.buffer('dispatch', 32, GPU_BUFFER_STORAGE | GPU_BUFFER_INDIRECT),
    };
    this.#film = new Film(memory, options.width, options.height);
    void device.lost.then((info) => {
      if (!this.#destroyed) this.#failure ??= new DeviceError('renderer/device-lost', `The GPU device was lost (${info.reason}): ${info.message || 'no details'}. The scene is safe: request a new device and create the tracer again.`);
    });
  }

  /**
   * Prepares a scene: builds its hierarchies, uploads it and compiles its kernels.
   *
   * @param device From `requestDevice()`, or any device; it stays the caller's to destroy.
   * @param scene Not changed; edits go through the tracer's methods.
   * @throws {RenderError} `renderer/size`, `renderer/camera`, `renderer/no-triangles`
   * @throws {SceneError} if the scene's parts do not fit together
   * @throws {DeviceError} `renderer/limit`, `renderer/out-of-memory`, `renderer/gpu-error`, `renderer/device-lost`
   */
  static async create(device: GPUDevice, scene: Scene, options: PathTracerOptions): Promise<PathTracer> {
    checkSize(options.width, options.height);
    validateScene(scene);
    const own: Scene = { ...scene, materials: scene.materials.map((material) => ({ ...material })) };
    const { hierarchies, signal, onProgress } = options;
    signal?.throwIfAborted();
    const t0 = performance.now();
    onProgress?.({ stage: 'bvh', done: 0 });
    const geometry = await prepareGeometry(own, { hierarchies, signal, onProgress: (done) => onProgress?.({ stage: 'bvh', done }) });
    const t1 = performance.now();
    onProgress?.({ stage: 'upload', done: 0 });
    const memory = new GpuMemory(device);
    try {
      device.pushErrorScope('out-of-memory');
      device.pushErrorScope('validation');
      let gpuScene: GpuScene;
      try {
        gpuScene = new GpuScene(device, memory, own, geometry, { multipleScattering: options.multipleScattering ?? true, sampler: options.sampler ?? 'sobol' });
      } finally {
        await throwScopes(device);
      }
      const t2 = performance.now();
      onProgress?.({ stage: 'upload', done: 1 });
      const cache = new KernelCache(device);
      const kernels = await cache.get(gpuScene.features(), (done) => onProgress?.({ stage: 'compile', done }));
      signal?.throwIfAborted();
      const t3 = performance.now();
      const statistics: RenderStatistics = {
        triangles: geometry.triangleCount,
        instances: geometry.order.length,
        lights: gpuScene.lightCount,
        bvhMs: t1 - t0,
        uploadMs: t2 - t1,
        compileMs: t3 - t2,
        gpuBytes: memory.bytes,
        badSamples: 0,
      };
      device.pushErrorScope('out-of-memory');
      device.pushErrorScope('validation');
      let tracer: PathTracer;
      try {
        tracer = new PathTracer(device, memory, own, geometry, gpuScene, cache, kernels, options, statistics);
      } finally {
        await throwScopes(device);
      }
      tracer.reset();
      return tracer;
    } catch (error) {
      memory.destroy();
      throw error;
    }
  }

  /** The tracer's own copy of the scene, with the edits made so far. Read only. */
  get scene(): Scene {
    return this.#scene;
  }

  get width(): number {
    return this.#film.width;
  }

  get height(): number {
    return this.#film.height;
  }

  get camera(): Camera {
    return this.#camera;
  }

  /** Completed samples per pixel. */
  get samples(): number {
    return this.#scheduler?.samples ?? 0;
  }

  /** Mean radiance and coverage: vec4f per pixel, linear, row-major, top row first. Replaced by `resize()`. */
  get beautyBuffer(): GPUBuffer {
    return this.#film.beauty;
  }

  get statistics(): RenderStatistics {
    return { ...this.#statistics, gpuBytes: this.#memory.bytes };
  }

  /**
   * Adds samples to the film until it has as many as asked for. Ends quietly when aborted by `signal` or when the film is
   * restarted by an edit; the film keeps what it has.
   *
   * @throws {RenderError} `renderer/busy` while another `render()` of this tracer runs, `renderer/destroyed`, `renderer/samples`
   * @throws {DeviceError} `renderer/device-lost`, `renderer/gpu-error`
   */
  async *render(options: RenderOptions = {}): AsyncGenerator<RenderProgress, void, undefined> {
    const target = options.samples ?? 64;
    this.#check();
    if (!Number.isInteger(target) || target < 1) throw new RenderError('renderer/samples', `The number of samples must be a whole number of at least 1, not ${target}.`);
    if (this.#rendering) throw new RenderError('renderer/busy', 'This tracer is already rendering: finish or abort the other render() first.');
    this.#rendering = true;
    try {
      yield* this.#run(target, options);
    } finally {
      this.#rendering = false;
    }
  }

  async *#run(target: number, options: RenderOptions): AsyncGenerator<RenderProgress, void, undefined> {
    const generation = this.#generation;
    const start = performance.now();
    const scheduler = (this.#scheduler ??= new Scheduler({ pixels: this.#film.pixels, capacity: this.#capacity, budgetMs: options.maxSubmitMs ?? 30 }));
    scheduler.budget = options.maxSubmitMs ?? 30;
    const first = scheduler.samples;
    let reported = first;
    let lastDone = start;
    const inFlight: { batch: Batch; done: Promise<number>; after: number }[] = [];
    const current = () => generation === this.#generation && !options.signal?.aborted && !this.#destroyed;
    for (;;) {
      while (inFlight.length < 2 && current()) {
        const batch = scheduler.next(target);
        if (!batch) break;
        const submitted = performance.now();
        this.#submit(batch);
        inFlight.push({ batch, after: scheduler.samples, done: this.#device.queue.onSubmittedWorkDone().then(() => performance.now() - Math.max(submitted, lastDone)) });
      }
      const oldest = inFlight.shift();
      if (!oldest) return;
      const milliseconds = await oldest.done;
      lastDone = performance.now();
      if (this.#failure) throw this.#failure;
      scheduler.measured(oldest.batch, milliseconds);
      if (!current()) {
        await Promise.all(inFlight.map(({ done }) => done));
        return;
      }
      if (oldest.after > reported) {
        reported = oldest.after;
        const elapsedMs = performance.now() - start;
        const rate = (reported - first) / elapsedMs;
        yield { samples: reported, targetSamples: target, elapsedMs, remainingMs: rate > 0 ? (target - reported) / rate : Infinity, samplesPerSecond: rate * 1000 };
      }
    }
  }

  /**
   * Copies a layer of the film to the CPU, top row first.
   *
   * - `beauty`: Float32Array, RGBA, stride 4: linear radiance (mean over samples) and coverage.
   * - `albedo`: Float32Array, RGBA: directional albedo at the first surface, coverage.
   * - `normal`: Float32Array, xyz0: mean shading normal in the world, towards the camera.
   * - `depth`: Float32Array, stride 1: metres along the ray; 0 where there is no surface.
   * - `objectId`, `materialId`: Uint32Array, stride 1: scene indices at the pixel's centre; 0xffffffff for none.
   *
   * @throws {DeviceError} `renderer/device-lost`
   */
  async read(layer: 'objectId' | 'materialId'): Promise<Uint32Array<ArrayBuffer>>;
  async read(layer: Exclude<FilmLayer, 'objectId' | 'materialId'>): Promise<Float32Array<ArrayBuffer>>;
  async read(layer: FilmLayer): Promise<Float32Array<ArrayBuffer> | Uint32Array<ArrayBuffer>>;
  async read(layer: FilmLayer): Promise<Float32Array<ArrayBuffer> | Uint32Array<ArrayBuffer>> {
    this.#check();
    const bytes = this.#film.pixels * 16;
    if (layer === 'beauty') {
      const pixels = new Float32Array(await readBuffer(this.#device, this.#film.beauty, bytes));
      const counters = new Uint32Array(await readBuffer(this.#device, this.#buffers.queues, 32));
      this.#statistics = { ...this.#statistics, badSamples: counters[3] as number };
      return pixels;
    }
    const count = await this.#renderFeatures();
    const { albedo, normal, ids } = this.#film.features();
    if (layer === 'objectId' || layer === 'materialId') {
      const all = new Uint32Array(await readBuffer(this.#device, ids, bytes));
      return Uint32Array.from({ length: this.#film.pixels }, (_, i) => all[4 * i + (layer === 'objectId' ? 0 : 1)] as number);
    }
    const sums = new Float32Array(await readBuffer(this.#device, layer === 'albedo' ? albedo : normal, bytes));
    if (layer === 'albedo') return sums.map((value) => value / count);
    if (layer === 'normal') return sums.map((value, i) => (i % 4 === 3 ? 0 : value / count));
    const coverage = new Float32Array(await readBuffer(this.#device, albedo, bytes));
    return Float32Array.from({ length: this.#film.pixels }, (_, i) => ((coverage[4 * i + 3] as number) > 0 ? (sums[4 * i + 3] as number) / (coverage[4 * i + 3] as number) : 0));
  }

  /** Restarts the film. */
  reset(): void {
    this.#check();
    this.#generation++;
    this.#featureSamples = 0;
    this.#frameDirty = true;
    // Keeps what was learned about the GPU's speed.
    this.#scheduler = this.#scheduler?.restarted();
    const encoder = this.#device.createCommandEncoder({ label: 'glanz reset' });
    this.#film.clear(encoder);
    this.#device.queue.submit([encoder.finish()]);
  }

  /** Looks through another camera: one of the scene's by index or name, or any. Restarts the film. */
  setCamera(camera: Camera | number | string): void {
    this.#camera = resolveCamera(this.#scene, camera, this.#film.width / this.#film.height);
    this.reset();
  }

  /**
   * Changes parameters of a material and restarts the film. Where the change calls for kernels that are not there yet
   * (a lobe appears), the old ones serve until the new ones are ready.
   *
   * @returns When the picture shows the change in full.
   * @throws {RenderError} `renderer/material` if there is no such material.
   */
  async setMaterial(nameOrIndex: string | number, parameters: Material['parameters']): Promise<void> {
    this.#check();
    const index = findMaterial(this.#scene, nameOrIndex);
    const material = this.#scene.materials[index];
    if (!material) throw new RenderError('renderer/material', `The scene has no material ${JSON.stringify(nameOrIndex)}; it has: ${this.#scene.materials.map((m) => m.name).join(', ')}.`);
    material.parameters = { ...material.parameters, ...parameters };
    if (this.#gpuScene.updateMaterial(index)) this.#groups.clear();
    await this.#applyFeatures();
  }

  /** Replaces the surroundings and restarts the film. */
  async setEnvironment(environment: Environment | undefined): Promise<void> {
    this.#check();
    if (environment) this.#scene.environment = environment;
    else delete this.#scene.environment;
    this.#gpuScene.updateEnvironment(environment);
    this.#groups.clear();
    await this.#applyFeatures();
  }

  /** Changes the film's size and restarts it. */
  resize(width: number, height: number): void {
    this.#check();
    checkSize(width, height);
    if (width === this.#film.width && height === this.#film.height) return;
    this.#film.destroy();
    this.#film = new Film(this.#memory, width, height);
    this.#scheduler = undefined;
    this.#groups.clear();
    this.reset();
  }

  /** What lies under a pixel (whole or fractional coordinates from the upper left corner), found on the CPU. */
  pick(x: number, y: number): PickResult | undefined {
    this.#check();
    return pickPixel(this.#scene, this.#geometry, this.#camera, this.#film.width, this.#film.height, x, y);
  }

  /** Frees all GPU memory. Idempotent; a running `render()` ends. */
  destroy(): void {
    if (this.#destroyed) return;
    this.#destroyed = true;
    this.#generation++;
    this.#memory.destroy();
  }

  async #applyFeatures(): Promise<void> {
    this.reset();
    const features = this.#gpuScene.features();
    const generation = this.#generation;
    const kernels = await this.#cache.get(features);
    // A later edit has asked for other kernels meanwhile, and will restart the film itself.
    if (this.#destroyed || kernels === this.#kernels || generation !== this.#generation) return;
    this.#use(kernels, features);
    this.reset();
  }

  #use(kernels: KernelSet, features: KernelFeatures): void {
    this.#kernels = kernels;
    this.#groups.clear();
    const bytes = this.#capacity * shadowStruct.size;
    if (features.flags.NEXT_EVENT && this.#buffers.shadows.size < bytes) {
      this.#memory.release(this.#buffers.shadows);
      (this.#buffers as Record<string, GPUBuffer>).shadows = this.#memory.buffer('shadows', bytes, GPU_BUFFER_STORAGE);
    }
  }

  #check(): void {
    if (this.#destroyed) throw new RenderError('renderer/destroyed', 'This tracer has been destroyed.');
    if (this.#failure) throw this.#failure;
  }

  #group(name: KernelName, kernel: Kernel): GPUBindGroup {
    let group = this.#groups.get(name);
    if (!group) {
      const film: Record<string, GPUBuffer> = { film_block: this.#film.block, film_total: this.#film.total, beauty: this.#film.beauty };
      if (name === 'features') {
        const { albedo, normal, ids } = this.#film.features();
        Object.assign(film, { feature_albedo: albedo, feature_normal: normal, feature_ids: ids });
      }
      const names = [...kernel.resources, ...kernel.sceneBindings.map(([binding]) => binding)];
      const entries = names.map((resource, binding) => {
        const own = (this.#buffers as Record<string, GPUBuffer>)[resource] ?? film[resource];
        const found = own ? { buffer: own } : this.#gpuScene.resource(resource);
        if (!found) throw new DeviceError('renderer/gpu-error', `Kernel "${name}" wants "${resource}", which nothing provides.`);
        return { binding, resource: found };
      });
      group = this.#device.createBindGroup({ label: `glanz ${name}`, layout: kernel.layout, entries });
      this.#groups.set(name, group);
    }
    return group;
  }

  #writeBatch(batch: Batch): void {
    const data = batchStruct.allocate();
    batchStruct.write(data, 0, { pixel_offset: batch.pixelOffset, pixel_count: batch.pixelCount, sample_offset: batch.sampleOffset, sample_count: batch.sampleCount });
    this.#memory.write(this.#buffers.batch, data);
    if (this.#frameDirty) {
      this.#memory.write(this.#buffers.frame, packFrame(this.#camera, this.#film, this.#gpuScene, this.#geometry, this.#options));
      this.#frameDirty = false;
    }
  }

  #submit(batch: Batch): void {
    this.#writeBatch(batch);
    const { kernels, features } = this.#kernels;
    const encoder = this.#device.createCommandEncoder({ label: 'glanz batch' });
    const pass = encoder.beginComputePass({ label: 'glanz batch' });
    const paths = batch.pixelCount * batch.sampleCount;
    const run = (name: KernelName, work: number | { readonly indirect: number }) => {
      const kernel = kernels[name] as Kernel;
      pass.setPipeline(kernel.pipeline);
      pass.setBindGroup(0, this.#group(name, kernel));
      if (typeof work === 'number') pass.dispatchWorkgroups(work);
      else pass.dispatchWorkgroupsIndirect(this.#buffers.dispatch, work.indirect);
    };
    run('begin', 1);
    run('generate', Math.ceil(paths / 64));
    const depth = this.#options.maxDepth ?? 8;
    for (let edge = 1; edge <= depth; edge++) {
      run('intersect', { indirect: 0 });
      run('shade', { indirect: 0 });
      if (edge === depth) break;
      run('advance', 1);
      if (features.flags.NEXT_EVENT) run('connect', { indirect: 16 });
    }
    run('resolve', Math.ceil(batch.pixelCount / 64));
    pass.end();
    this.#device.queue.submit([encoder.finish()]);
  }

  async #renderFeatures(): Promise<number> {
    const target = Math.min(FEATURE_SAMPLES, Math.max(1, this.samples));
    if (this.#featureSamples >= target) return this.#featureSamples;
    const kernel = await this.#cache.kernel('features', this.#kernels.features);
    this.#check();
    const group = this.#group('features', kernel);
    const band = Math.min(this.#film.pixels, 65535 * 64);
    for (let sample = 0; sample < target; sample++) {
      for (let pixel = 0; pixel < this.#film.pixels; pixel += band) {
        const count = Math.min(band, this.#film.pixels - pixel);
        this.#writeBatch({ pixelOffset: pixel, pixelCount: count, sampleOffset: sample, sampleCount: 1 });
        const encoder = this.#device.createCommandEncoder({ label: 'glanz features' });
        const pass = encoder.beginComputePass({ label: 'glanz features' });
        pass.setPipeline(kernel.pipeline);
        pass.setBindGroup(0, group);
        pass.dispatchWorkgroups(Math.ceil(count / 64));
        pass.end();
        this.#device.queue.submit([encoder.finish()]);
      }
      if (sample % 4 === 3) await this.#device.queue.onSubmittedWorkDone();
    }
    this.#featureSamples = target;
    return target;
  }
}

function checkSize(width: number, height: number): void {
  if (!Number.isInteger(width) || !Number.isInteger(height) || width < 1 || height < 1) {
    throw new RenderError('renderer/size', `A picture of ${width} × ${height} pixels cannot be rendered: both must be whole numbers of at least 1.`);
  }
}

function resolveCamera(scene: Scene, camera: Camera | number | string | undefined, aspect: number): Camera {
  if (typeof camera === 'object') return camera;
  if (camera === undefined) return scene.cameras[0] ?? frameCamera(scene, { aspect });
  const found = typeof camera === 'number' ? scene.cameras[camera] : scene.cameras.find(({ name }) => name === camera);
  if (!found) throw new RenderError('renderer/camera', `The scene has no camera ${JSON.stringify(camera)}; it has: ${scene.cameras.map(({ name }) => name).join(', ') || 'none'}.`);
  return found;
}

/** Closes the two error scopes opened around an upload and throws what they caught. */
async function throwScopes(device: GPUDevice): Promise<void> {
  const validation = await device.popErrorScope();
  const memory = await device.popErrorScope();
  if (memory) throw new DeviceError('renderer/out-of-memory', `The GPU has not enough memory for this scene: ${memory.message}`);
  if (validation) throw new DeviceError('renderer/gpu-error', `The GPU refused the scene: ${validation.message}`);
}
