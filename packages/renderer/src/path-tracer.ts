import { validateScene, type Camera, type Environment, type Material, type Scene } from '@glanz/scene';
import { DeviceError, RenderError } from './errors';
import { FEATURE_SAMPLES, renderFeatures } from './film/feature-pass';
import { Film } from './film/film';
import { LAYER_SOURCES, unpackLayer, type FeatureLayer } from './film/layers';
import { packFrame } from './frame';
import { GpuMemory } from './gpu/buffers';
import { withErrorScopes } from './gpu/error-scopes';
import { GpuScene } from './gpu/gpu-scene';
import { KernelCache } from './gpu/kernel-cache';
import type { KernelFeatures } from './kernels/pipelines';
import { readBuffer } from './gpu/read-buffer';
import { Integrator, pathCapacity } from './integrator';
import type { FilmLayer, PathTracerOptions, PickResult, RenderOptions, RenderProgress, RenderStatistics } from './options';
import { pickPixel } from './pick';
import { renderLoop } from './render-loop';
import { cameraUniforms } from './scene/camera';
import { chooseCamera } from './scene/choose-camera';
import { prepareGeometry, type Geometry } from './scene/geometry';
import { findMaterial } from './scene/materials';
import { Scheduler, type Batch } from './scheduler';
import { viewFlags } from './view';

/** What {@link PathTracer.create} has put together. */
interface Prepared {
  readonly device: GPUDevice;
  readonly memory: GpuMemory;
  readonly scene: Scene;
  readonly geometry: Geometry;
  readonly gpuScene: GpuScene;
  readonly cache: KernelCache;
  readonly integrator: Integrator;
  readonly film: Film;
  readonly camera: Camera;
  readonly options: PathTracerOptions;
  readonly statistics: RenderStatistics;
}

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
  readonly #integrator: Integrator;
  readonly #options: PathTracerOptions;
  #film: Film;
  #camera: Camera;
  /** What the kernels in use can show; the camera above, but for the time that its kernels take. */
  #shownCamera: Camera;
  #scheduler: Scheduler | undefined;
  #generation = 0;
  #edits = 0;
  #rendering = false;
  #destroyed = false;
  #failure: DeviceError | undefined;
  #features: { readonly samples: number; readonly done: Promise<void> } | undefined;
  #statistics: RenderStatistics;
  #frameDirty = true;

  private constructor(prepared: Prepared) {
    this.#device = prepared.device;
    this.#memory = prepared.memory;
    this.#scene = prepared.scene;
    this.#geometry = prepared.geometry;
    this.#gpuScene = prepared.gpuScene;
    this.#cache = prepared.cache;
    this.#integrator = prepared.integrator;
    this.#film = prepared.film;
    this.#camera = this.#shownCamera = prepared.camera;
    this.#options = prepared.options;
    this.#statistics = prepared.statistics;
    void this.#device.lost.then((info) => {
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
      const gpuScene = await withErrorScopes(device, () => new GpuScene(device, memory, own, geometry, { multipleScattering: options.multipleScattering ?? true, sampler: options.sampler ?? 'sobol' }));
      const t2 = performance.now();
      onProgress?.({ stage: 'upload', done: 1 });
      const cache = new KernelCache(device);
      const camera = chooseCamera(own, options.camera, options.width / options.height);
      const kernels = await cache.get(kernelFeatures(gpuScene, camera, options), (done) => onProgress?.({ stage: 'compile', done }));
      signal?.throwIfAborted();
      const t3 = performance.now();
      const tracer = await withErrorScopes(device, () => {
        const film = new Film(memory, options.width, options.height);
        const integrator = new Integrator(device, memory, gpuScene, kernels, film, pathCapacity(device, options), options.maxDepth ?? 8);
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
        return new PathTracer({ device, memory, scene: own, geometry, gpuScene, cache, integrator, film, camera, options, statistics });
      });
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
      const generation = this.#generation;
      const budgetMs = options.maxSubmitMs ?? 30;
      const scheduler = (this.#scheduler ??= new Scheduler({ pixels: this.#film.pixels, capacity: this.#integrator.capacity, budgetMs }));
      scheduler.budget = budgetMs;
      yield* renderLoop({
        scheduler,
        target,
        queue: this.#device.queue,
        submit: (batch) => this.#submit(batch),
        current: () => generation === this.#generation && !options.signal?.aborted && !this.#destroyed,
        check: () => {
          if (this.#failure) throw this.#failure;
        },
      });
    } finally {
      this.#rendering = false;
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
      const counters = new Uint32Array(await readBuffer(this.#device, this.#integrator.queues, 32));
      this.#statistics = { ...this.#statistics, badSamples: counters[3] as number };
      return pixels;
    }
    return this.#readFeature(layer, bytes);
  }

  /** Restarts the film. */
  reset(): void {
    this.#check();
    this.#generation++;
    this.#features = undefined;
    this.#frameDirty = true;
    const { flags } = this.#integrator.kernels.features;
    if (Object.entries(viewFlags(this.#camera, this.#options.filter)).every(([name, value]) => flags[name] === value)) this.#shownCamera = this.#camera;
    // Keeps what was learned about the GPU's speed.
    this.#scheduler = this.#scheduler?.restarted();
    const encoder = this.#device.createCommandEncoder({ label: 'glanz reset' });
    this.#film.clear(encoder);
    this.#device.queue.submit([encoder.finish()]);
  }

  /**
   * Looks through another camera: one of the scene's by index or name, or any. Restarts the film. A camera of another kind
   * (projection, with or without a lens) brings another small kernel; the old view stays until it is there.
   *
   * @returns When the picture shows it.
   * @throws {RenderError} `renderer/camera` if there is no such camera, or it is degenerate.
   */
  setCamera(camera: Camera | number | string): Promise<void> {
    this.#check();
    const chosen = chooseCamera(this.#scene, camera, this.#film.width / this.#film.height);
    cameraUniforms(chosen, this.#film.width, this.#film.height);
    this.#camera = chosen;
    return this.#applyFeatures();
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
    if (this.#gpuScene.updateMaterial(index)) this.#integrator.rebind();
    await this.#applyFeatures();
  }

  /** Replaces the surroundings and restarts the film. */
  async setEnvironment(environment: Environment | undefined): Promise<void> {
    this.#check();
    if (environment) this.#scene.environment = environment;
    else delete this.#scene.environment;
    this.#gpuScene.updateEnvironment(environment);
    this.#integrator.rebind();
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
    this.#integrator.rebind(this.#film);
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
    const edit = ++this.#edits;
    this.reset();
    const kernels = await this.#cache.get(kernelFeatures(this.#gpuScene, this.#camera, this.#options));
    // A later edit has asked for other kernels meanwhile, and will restart the film itself.
    if (this.#destroyed || kernels === this.#integrator.kernels || edit !== this.#edits) return;
    this.#integrator.use(kernels);
    this.reset();
  }

  #check(): void {
    if (this.#destroyed) throw new RenderError('renderer/destroyed', 'This tracer has been destroyed.');
    if (this.#failure) throw this.#failure;
  }

  #submit(batch: Batch): void {
    this.#writeFrame();
    this.#integrator.submit(batch);
  }

  #writeFrame(): void {
    if (!this.#frameDirty) return;
    this.#integrator.writeFrame(packFrame(this.#shownCamera, this.#film, this.#gpuScene, this.#geometry, this.#options));
    this.#frameDirty = false;
  }

  async #readFeature(layer: FeatureLayer, bytes: number): Promise<Float32Array<ArrayBuffer> | Uint32Array<ArrayBuffer>> {
    const target = Math.min(FEATURE_SAMPLES, Math.max(1, this.samples));
    // Layers read at the same time share one pass.
    let features = this.#features;
    if (!features || features.samples < target) this.#features = features = { samples: target, done: this.#renderFeatures(target, features?.done) };
    await features.done;
    const count = features.samples;
    const sources = await Promise.all(LAYER_SOURCES[layer].map((name) => readBuffer(this.#device, this.#film.buffer(name) as GPUBuffer, bytes)));
    return unpackLayer(layer, sources, count);
  }

  async #renderFeatures(samples: number, after: Promise<void> | undefined): Promise<void> {
    await after;
    const kernel = await this.#cache.kernel('features', this.#integrator.kernels.features);
    this.#check();
    this.#writeFrame();
    await renderFeatures(this.#device, this.#integrator, kernel, this.#film, samples);
  }
}

function kernelFeatures(scene: GpuScene, camera: Camera, options: PathTracerOptions): KernelFeatures {
  const features = scene.features();
  return { ...features, flags: { ...features.flags, ...viewFlags(camera, options.filter) } };
}

function checkSize(width: number, height: number): void {
  if (!Number.isInteger(width) || !Number.isInteger(height) || width < 1 || height < 1) {
    throw new RenderError('renderer/size', `A picture of ${width} × ${height} pixels cannot be rendered: both must be whole numbers of at least 1.`);
  }
}
