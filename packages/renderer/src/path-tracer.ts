import type { Camera, Scene } from '@glanz/scene';
import { TileGrid } from './adaptive';
import { deviceLost, RenderError, type DeviceError } from './errors';
import { FeatureLayers } from './film/feature-layers';
import { forBands, renderFeatures } from './film/feature-pass';
import { Film } from './film/film';
import { checkFilmState, FILM_SUMS, type FilmState } from './film/film-state';
import { filmFingerprint } from './film/fingerprint';
import { GroupSettings } from './film/group-settings';
import { groupLayer, varianceLayer, type GroupWeights } from './film/layers';
import { packFrame } from './frame';
import type { GpuMemory } from './gpu/buffers';
import { onDeviceLost } from './gpu/device-loss';
import type { GpuScene } from './gpu/gpu-scene';
import type { KernelCache } from './gpu/kernel-cache';
import { memoryReport } from './gpu/memory-report';
import { readBuffer, readFloats } from './gpu/read-buffer';
import type { Integrator } from './integrator';
import { serves, type KernelName } from './kernels/pipelines';
import type { FilmLayer, LightGroup, PathTracerOptions, PickResult, RenderOptions, RenderProgress, RenderStatistics } from './options';
import { pickPixel } from './pick';
import { checkDepth, checkedSamples, checkSize, kernelFeatures, prepareTracer, type Prepared } from './prepare';
import { Sampling, type SamplingState } from './sampling';
import { cameraUniforms } from './scene/camera';
import { chooseCamera } from './scene/choose-camera';
import type { SceneEditor } from './scene-editor';
import { TracerEdits } from './tracer-edits';
import { viewFlags } from './view';

/**
 * A progressive path tracer for one scene. No DOM: it runs in browsers and in Node alike.
 *
 * @example
 * const tracer = await PathTracer.create(device, scene, { width: 1024, height: 768 });
 * for await (const { samples } of tracer.render({ samples: 256 })) console.log(samples);
 * const pixels = await tracer.read('beauty'); // linear RGBA
 * tracer.destroy();
 */
export class PathTracer extends TracerEdits {
  readonly #device: GPUDevice;
  readonly #memory: GpuMemory;
  readonly #editor: SceneEditor;
  readonly #gpuScene: GpuScene;
  readonly #cache: KernelCache;
  readonly #integrator: Integrator;
  #options: PathTracerOptions;
  #film: Film;
  #camera: Camera;
  /** What the kernels in use can show; the camera above, but for the time that its kernels take. */
  #shownCamera: Camera;
  #sampling: Sampling | undefined;
  #generation = 0;
  #edits = 0;
  #rendering = false;
  #destroyed = false;
  #failure: DeviceError | undefined;
  readonly #features: FeatureLayers;
  readonly #groups: GroupSettings;
  #firstWeights: GroupWeights = [];
  readonly #times: Prepared['times'];
  #badSamples = 0;
  #rays = 0;
  #frameDirty = true;
  readonly #ignoreLoss: () => void;

  private constructor(prepared: Prepared) {
    super();
    this.#device = prepared.device;
    this.#memory = prepared.memory;
    this.#editor = prepared.editor;
    this.#gpuScene = prepared.gpuScene;
    this.#cache = prepared.cache;
    this.#integrator = prepared.integrator;
    this.#film = prepared.film;
    this.#camera = this.#shownCamera = prepared.camera;
    this.#options = prepared.options;
    this.#times = prepared.times;
    this.#groups = new GroupSettings(() => this.#gpuScene.groups.names);
    this.#features = new FeatureLayers({ render: (kernel, samples) => this.#renderFeatures(kernel, samples), copy: (name) => readBuffer(this.#device, this.#film.buffer(name) as GPUBuffer, this.#film.pixels * 16) });
    this.#ignoreLoss = onDeviceLost(this.#device, (info) => (this.#failure ??= deviceLost(info)));
  }

  /**
   * Prepares a scene: builds its hierarchies, uploads it and compiles its kernels.
   *
   * @param device From `requestDevice()`, or any device; it stays the caller's to destroy.
   * @param scene Not changed; edits go through the tracer's methods.
   * @throws {RenderError} `renderer/size`, `renderer/camera`, `renderer/no-triangles`, `renderer/filter`, `renderer/light-groups`, `renderer/option`
   * @throws {SceneError} if the scene's parts do not fit together
   * @throws {DeviceError} `renderer/limit`, `renderer/out-of-memory`, `renderer/gpu-error`, `renderer/device-lost`
   */
  static async create(device: GPUDevice, scene: Scene, options: PathTracerOptions): Promise<PathTracer> {
    const tracer = new PathTracer(await prepareTracer(device, scene, options));
    tracer.reset();
    return tracer;
  }

  /** The tracer's own copy of the scene, with the edits made so far. Read only. */
  get scene(): Scene {
    return this.#editor.scene;
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

  /** Completed samples per pixel; after sampling to a noise target, those of the pixels that have most. */
  get samples(): number {
    return this.#sampling?.samples ?? 0;
  }

  /** Mean radiance and coverage: vec4f per pixel, linear, row-major, top row first. Replaced by `resize()`. */
  get beautyBuffer(): GPUBuffer {
    return this.#film.beauty;
  }

  get statistics(): RenderStatistics {
    const { geometry } = this.#editor;
    const triangles = geometry.triangleCount;
    return {
      triangles,
      instances: geometry.order.length,
      lights: this.#gpuScene.lightCount,
      ...this.#times,
      gpuBytes: this.#memory.bytes,
      memory: memoryReport(this.#memory, { pathsInFlight: this.#integrator.capacity, triangles, pixels: this.#film.pixels, texels: this.#gpuScene.texels }),
      badSamples: this.#badSamples,
    };
  }

  /**
   * Adds samples to the film until it has as many as asked for. Ends quietly when aborted by `signal` or when the film is
   * restarted by an edit; the film keeps what it has.
   *
   * @throws {RenderError} `renderer/busy` while another `render()` of this tracer runs, `renderer/destroyed`, `renderer/samples`
   * @throws {DeviceError} `renderer/device-lost`, `renderer/gpu-error`
   */
  async *render(options: RenderOptions = {}): AsyncGenerator<RenderProgress, void, undefined> {
    this.#check();
    const samples = checkedSamples(options);
    if (this.#rendering) throw new RenderError('renderer/busy', 'This tracer is already rendering: finish or abort the other render() first.');
    this.#rendering = true;
    try {
      const generation = this.#generation;
      const sampling = (this.#sampling ??= this.#newSampling());
      yield* sampling.render({
        samples,
        noise: options.noise,
        budgetMs: options.maxSubmitMs ?? 30,
        current: () => generation === this.#generation && !options.signal?.aborted && !this.#destroyed,
      });
    } finally {
      this.#rendering = false;
    }
  }

  /**
   * Copies a layer of the film to the CPU, top row first.
   *
   * - `beauty`: Float32Array, RGBA, stride 4: linear radiance (mean over samples) and coverage.
   * - `variance`: Float32Array, stride 4: variance of the beauty's mean, RGB, estimated from the means of chunks of 16 samples
   *   (`Infinity` before there are 32 samples), and the pixel's number of samples. Exact on average for independent samples;
   *   with Sobol points it errs on the high side. It is that of the light groups as they were set when the film was begun.
   * - `albedo`: Float32Array, RGBA: directional albedo at the first surface, coverage.
   * - `normal`: Float32Array, xyz0: mean shading normal in the world, towards the camera.
   * - `position`: Float32Array, stride 4: mean position of the first surface in the world, and coverage.
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
    if (layer === 'beauty') {
      const pixels = await readFloats(this.#device, this.#film.beauty, this.#film.pixels * 16);
      const counters = new Uint32Array(await readBuffer(this.#device, this.#integrator.queues, 32));
      this.#badSamples = counters[3] as number;
      return pixels;
    }
    if (layer === 'variance') {
      const [total, moment] = await this.#readFilm('film_total', 'film_moment');
      // With catchers: the picture in which they are what they are, without the one that lacks the objects.
      const weights = this.#integrator.pathsPerSample > 1 ? [...this.#firstWeights, ...this.#firstWeights] : this.#firstWeights;
      return varianceLayer(total as Float32Array, moment as Float32Array, weights);
    }
    return this.#features.read(layer, this.samples);
  }

  /**
   * The light groups and how they are set, in the order of the film's planes. One, `rest`, unless the scene names groups or
   * the option `lightGroups` makes some.
   */
  get lightGroups(): readonly LightGroup[] {
    return this.#groups.list;
  }

  /**
   * Dims or colours the light of a group in the picture as it is: no new sample, the film goes on.
   *
   * @param settings What is left out stays as it is. The intensity must be finite and at least 0, as must the colour.
   * @returns When the picture shows it.
   * @throws {RenderError} `renderer/light-groups` for an unknown group, a value out of range, or with `lightGroups: 'off'`.
   */
  async setLightGroup(name: string, settings: Partial<Pick<LightGroup, 'intensity' | 'color'>>): Promise<void> {
    this.#check();
    if (this.#options.lightGroups === 'off') throw new RenderError('renderer/light-groups', "This tracer keeps no light groups: it was made with lightGroups 'off'.");
    this.#groups.set(name, settings);
    this.#integrator.writeGroups(this.#groups.weights, this.#firstWeights);
    await this.#relight();
  }

  /**
   * The part of one light group in the picture: Float32Array, RGBA, stride 4, as the group is set; all groups add up to the
   * beauty. Alpha is the picture's coverage.
   *
   * @throws {RenderError} `renderer/light-groups` if there is no such group.
   */
  async readLightGroup(name: string): Promise<Float32Array<ArrayBuffer>> {
    this.#check();
    if (this.#integrator.pathsPerSample > 1) throw new RenderError('renderer/light-groups', 'With catchers the picture is no sum of its light groups: they can be set, but not read one by one.');
    const plane = this.#groups.plane(name);
    const weight = this.#groups.weights[plane] as GroupWeights[number];
    const [total, block, moment] = await this.#readFilm('film_total', 'film_block', 'film_moment');
    return groupLayer(total as Float32Array, block as Float32Array, moment as Float32Array, plane, weight);
  }

  /**
   * Copies what the film has accumulated, and where its sampling stands, to the CPU: to go on from there on another device,
   * in another process, or after the tab was closed. Exact at any time, also while `render()` runs.
   *
   * @throws {DeviceError} `renderer/device-lost`, `renderer/out-of-memory`
   */
  async saveFilm(): Promise<FilmState> {
    this.#check();
    // All copies are submitted in one turn, behind the batches that the sampling counts as given out.
    const sampling = (this.#sampling ??= this.#newSampling()).state;
    const { width, height, planes } = this.#film;
    const weights = { first: this.#firstWeights, last: this.#groups.weights };
    const fingerprint = this.#fingerprint();
    const [counters, ...sums] = await Promise.all([readBuffer(this.#device, this.#integrator.queues, 32), ...this.#copyFilm(...FILM_SUMS)]);
    this.#badSamples = new Uint32Array(counters)[3] as number;
    const samples = Math.max(sampling.sample, sampling.tiles ? sampling.counts.reduce((most, count) => Math.max(most, count), 0) : 0);
    return { width, height, planes, samples, badSamples: this.#badSamples, fingerprint, sampling, weights, sums: Object.fromEntries(FILM_SUMS.map((name, i) => [name, sums[i]])) as unknown as FilmState['sums'] };
  }

  /**
   * Puts a saved film in place of the tracer's. The next `render()` goes on from there; what comes out is bit for bit what
   * it would have been without the interruption on the same kind of device. A running `render()` ends.
   *
   * @param state Of a tracer with the same scene, camera and options. It is not changed and can be used again.
   * @returns When the film holds it.
   * @throws {RenderError} `renderer/film-state` if it is of another size, scene, camera, or other options.
   */
  async restoreFilm(state: FilmState): Promise<void> {
    this.#check();
    const film = this.#film;
    checkFilmState(state, { width: film.width, height: film.height, planes: film.planes, fingerprint: this.#fingerprint() }, new TileGrid(film.width, film.height).count);
    this.reset();
    this.#sampling = this.#newSampling(this.#sampling?.paths, state.sampling);
    this.#firstWeights = state.weights.first;
    this.#integrator.writeGroups(this.#groups.weights, this.#firstWeights);
    for (const name of FILM_SUMS) this.#memory.write(film.buffer(name) as GPUBuffer, state.sums[name]);
    this.#memory.write(this.#integrator.queues, Uint32Array.of(state.badSamples), 12);
    this.#badSamples = state.badSamples;
    // The light groups were set otherwise when it was saved.
    if (JSON.stringify(this.#groups.weights) !== JSON.stringify(state.weights.last)) await this.#relight();
    await this.#device.queue.onSubmittedWorkDone();
    this.#check();
  }

  /**
   * Rays that have been traced so far: edges of paths and rays to lights, each once, however much it passes through on its way.
   * Goes on over restarts of the film. Reads a few bytes from the GPU; exact where that happens every four thousand million rays.
   *
   * @throws {DeviceError} `renderer/device-lost`
   */
  async readRayCount(): Promise<number> {
    this.#check();
    const [now] = new Uint32Array(await readBuffer(this.#device, this.#integrator.queues, 32)).subarray(7) as unknown as [number];
    // The GPU counts modulo 2^32.
    this.#rays += (now - this.#rays) >>> 0;
    return this.#rays;
  }

  /** Restarts the film. */
  reset(): void {
    this.#check();
    this.#generation++;
    this.#features.clear();
    this.#frameDirty = true;
    const { flags } = this.#integrator.kernels.features;
    if (Object.entries(viewFlags(this.#camera, this.#options.filter)).every(([name, value]) => flags[name] === value)) this.#shownCamera = this.#camera;
    this.#firstWeights = this.#groups.weights;
    this.#integrator.writeGroups(this.#firstWeights, this.#firstWeights);
    // Keeps what was learned about the GPU's speed.
    if (this.#sampling) this.#sampling = this.#newSampling(this.#sampling.paths);
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
    const chosen = chooseCamera(this.scene, camera, this.#film.width / this.#film.height);
    cameraUniforms(chosen, this.#film.width, this.#film.height);
    this.#camera = chosen;
    return this.#applyFeatures();
  }

  /**
   * Changes the most edges of a path, see `PathTracerOptions.maxDepth`. Restarts the film.
   * @throws {RenderError} `renderer/option`
   */
  setDepth(maxDepth: number): void {
    this.#check();
    checkDepth(maxDepth);
    this.#options = { ...this.#options, maxDepth };
    this.#integrator.limits = { ...this.#integrator.limits, maxDepth };
    this.reset();
  }

  /** Shows the surroundings behind the scene, or leaves the background empty. Restarts the film. */
  setBackground(background: NonNullable<PathTracerOptions['background']>): void {
    this.#check();
    this.#options = { ...this.#options, background };
    this.reset();
  }

  /** Changes the film's size and restarts it. */
  resize(width: number, height: number): void {
    this.#check();
    checkSize(width, height);
    if (width === this.#film.width && height === this.#film.height) return;
    this.#replaceFilm(width, height);
    this.reset();
  }

  /** What lies under a pixel (whole or fractional coordinates from the upper left corner), found on the CPU. */
  pick(x: number, y: number): PickResult | undefined {
    this.#check();
    return pickPixel(this.scene, this.#editor.geometry, this.#camera, this.#film.width, this.#film.height, x, y, (this.#options.backFaceCulling ?? 'off') !== 'off' ? (material) => this.#gpuScene.culls(material) : undefined);
  }

  /** Frees all GPU memory. Idempotent; a running `render()` ends. */
  destroy(): void {
    if (this.#destroyed) return;
    this.#destroyed = true;
    this.#ignoreLoss();
    this.#generation++;
    this.#memory.destroy();
  }

  /** @internal */
  protected async edit(change: (editor: SceneEditor) => boolean | Promise<boolean>): Promise<void> {
    this.#check();
    const result = change(this.#editor);
    const replaced = typeof result === 'boolean' ? result : await result;
    if (this.#destroyed) return;
    if (replaced) this.#integrator.rebind();
    await this.#applyFeatures();
  }

  async #applyFeatures(): Promise<void> {
    const edit = ++this.#edits;
    this.reset();
    const wanted = kernelFeatures(this.#gpuScene.features(), this.#camera, this.#options);
    if (serves(this.#integrator.kernels.features, wanted)) return;
    const kernels = await this.#cache.get(wanted);
    // A later edit has asked for other kernels meanwhile, and will restart the film itself.
    if (this.#destroyed || edit !== this.#edits) return;
    this.#integrator.use(kernels);
    if (kernels.features.planes !== this.#film.planes) this.#replaceFilm(this.#film.width, this.#film.height);
    this.reset();
  }

  #check(): void {
    if (this.#destroyed) throw new RenderError('renderer/destroyed', 'This tracer has been destroyed.');
    if (this.#failure) throw this.#failure;
  }

  /** Composes the beauty again from the film's sums. */
  async #relight(): Promise<void> {
    const kernel = await this.#cache.kernel('relight', this.#integrator.kernels.features);
    if (!this.#destroyed) forBands(this.#film.pixels, (batch) => this.#integrator.submitPixels('relight', kernel, batch));
  }

  #fingerprint(): string {
    return filmFingerprint(this.scene, this.#shownCamera, this.#options);
  }

  #newSampling(paths?: number, state?: SamplingState): Sampling {
    const film = this.#film;
    return new Sampling(
      {
        width: film.width,
        height: film.height,
        capacity: Math.floor(this.#integrator.limit / this.#integrator.pathsPerSample),
        queue: this.#device.queue,
        submit: (batch) => {
          this.#writeFrame();
          this.#integrator.submit(batch);
        },
        check: () => {
          if (this.#failure) throw this.#failure;
        },
        setPixels: (list) => film.setPixels(list),
        measure: () => this.#measureNoise(),
      },
      paths,
      state,
    );
  }

  async #measureNoise(): Promise<Float32Array> {
    const kernel = await this.#cache.kernel('noise', this.#integrator.kernels.features);
    this.#check();
    this.#writeFrame();
    const { columns, rows } = new TileGrid(this.#film.width, this.#film.height);
    this.#integrator.submitTiles(kernel, columns, rows);
    return readFloats(this.#device, this.#film.buffer('film_noise') as GPUBuffer, 16 * columns * rows);
  }

  #writeFrame(): void {
    if (!this.#frameDirty) return;
    this.#integrator.writeFrame(packFrame(this.#shownCamera, this.#film, this.#gpuScene, this.#editor.geometry, this.#options));
    this.#frameDirty = false;
  }

  async #renderFeatures(name: KernelName, samples: number): Promise<void> {
    const kernel = await this.#cache.kernel(name, this.#integrator.kernels.features);
    this.#check();
    this.#writeFrame();
    await renderFeatures(this.#device, this.#integrator, name, kernel, this.#film, samples);
  }

  #copyFilm(...names: readonly string[]): Promise<Float32Array<ArrayBuffer>>[] {
    return names.map((name) => readFloats(this.#device, this.#film.buffer(name) as GPUBuffer));
  }

  #readFilm(...names: readonly string[]): Promise<Float32Array[]> {
    return Promise.all(this.#copyFilm(...names));
  }

  #replaceFilm(width: number, height: number): void {
    this.#film.destroy();
    this.#film = new Film(this.#memory, width, height, this.#integrator.kernels.features.planes);
    this.#sampling = undefined;
    this.#integrator.rebind(this.#film);
  }
}
