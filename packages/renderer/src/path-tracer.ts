import { loadPart } from '@glanz/wgsl';
import type { Camera, Scene } from '@glanz/scene';
import { EditSession } from './session/edit-session';
import { deviceLost, RenderError, type DeviceError } from './errors';
import type { EditEffect, Move } from './film/edit-effect';
import { FilmSession } from './session/film-session';
import type { FilmState } from './film/film-state';
import { filmFingerprint } from './film/fingerprint';
import { packFrame } from './session/frame';
import type { GpuMemory } from './storage/buffers';
import { onDeviceLost } from './device/device-loss';
import type { GpuScene } from './scene/gpu-scene';
import { unlessAborted } from './session/abort';
import { memoryReport } from './session/memory-report';
import { readBuffer } from './storage/read-buffer';
import type { Integrator } from './integrator/integrator';
import { checkFirstSample, checkRenderScale, checkSize, resolveOptions, type TracerSettings } from './option-checks';
import type {
  AovName,
  FilmAov,
  FilmLayer,
  HistoryFrame,
  LightGroup,
  PathTracerOptions,
  PickResult,
  RenderOptions,
  RenderProgress,
  RenderStatistics,
  TracerDenoiser,
} from './options';
import { pickPixel } from './camera/pick';
import { prepareTracer, type Prepared } from './prepare';
import { kernelFeatures } from './preparation';
import { cameraUniforms } from './camera/camera';
import { chooseCamera } from './camera/choose-camera';
import type { SceneChange } from './scene/scene-change';
import type { SceneEditor } from './scene/scene-editor';
import { TracerEdits } from './tracer-edits';
import { viewFlags } from './camera/view';

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
  readonly #integrator: Integrator;
  readonly #session: FilmSession;
  readonly #edits: EditSession;
  readonly #times: Prepared['times'];
  readonly #textures: Prepared['textures'];
  readonly #ignoreLoss: () => void;
  #options: TracerSettings;
  #camera: Camera;
  /** The camera that the present kernels show: differs from #camera while kernels for it compile. */
  #shownCamera: Camera;
  #destroyed = false;
  #failure: DeviceError | undefined;
  #rays = 0;
  /**
   * Whether edits leave the film as it is, so that the samples after them add to those before: the film is the mean over
   * all states that it was rendered in. For motion blur, see `renderShutter()` of `@glanz/renderer/shutter`. An edit that
   * needs other kernels restarts the film in any case, as do {@link reset} and {@link resize}. Default: no.
   */
  declare accumulates: boolean | undefined;

  private constructor(prepared: Prepared) {
    super();
    const { device, memory, gpuScene, cache, integrator } = prepared;
    this.#device = device;
    this.#memory = memory;
    this.#editor = prepared.editor;
    this.#gpuScene = gpuScene;
    this.#integrator = integrator;
    this.#camera = this.#shownCamera = prepared.camera;
    this.#options = prepared.options;
    this.#times = prepared.times;
    this.#textures = prepared.textures;
    this.#session = new FilmSession(
      {
        device,
        memory,
        cache,
        integrator,
        groupNames: () => gpuScene.groups.names,
        packFrame: (film) => packFrame(this.#shownCamera, film, gpuScene, this.#editor.geometry, this.#options),
        camera: () => this.#shownCamera,
        fingerprint: () =>
          filmFingerprint(this.scene, this.#shownCamera, this.#options, !!this.#editor.geometry.compact),
        check: () => this.#check(),
        ready: () => this.#edits.verifying,
      },
      prepared.film,
    );
    this.#edits = new EditSession({
      device,
      memory,
      gpuScene,
      cache,
      integrator,
      film: this.#session,
      features: () => kernelFeatures(gpuScene.features(), this.#camera, this.#options),
      edited: (effect, moves) => this.#restart(this.accumulates ? 'keeps' : effect, undefined, moves),
      restart: () => this.#restart('invalidates'),
    });
    this.#ignoreLoss = onDeviceLost(device, (info) => (this.#failure ??= deviceLost(info)));
  }

  /**
   * Prepares a scene: builds its hierarchies, uploads it and compiles its kernels.
   *
   * @param device From `requestDevice()`, or any device; it stays the caller's to destroy.
   * @param scene Not changed; edits go through the tracer's methods.
   * @throws {RenderError} `renderer/size`, `renderer/camera`, `renderer/no-triangles`, `renderer/filter`,
   * `renderer/light-groups`, `renderer/option`
   * @throws {SceneError} if the scene's parts do not fit together, or its textures into `memory.budgetMiB`
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

  /**
   * Pixels of the image, and of what {@link read} returns: those that it was given times {@link renderScale}, rounded,
   * at least 1.
   */
  get width(): number {
    return this.#session.film.width;
  }

  /** See {@link width}. */
  get height(): number {
    return this.#session.film.height;
  }

  get camera(): Camera {
    return this.#camera;
  }

  /** Completed samples per pixel; after sampling to a noise target, those of the pixels that have most. */
  get samples(): number {
    return this.#session.samples;
  }

  /** Mean radiance and coverage: vec4f per pixel, linear, row-major, top row first. Replaced by `resize()`. */
  get beautyBuffer(): GPUBuffer {
    return this.#session.film.beauty;
  }

  /**
   * Updates the variance of {@link beautyBuffer}, for kernels that run after it: vec4f per pixel as {@link read} gives
   * the layer `variance`, infinity where it is not known.
   *
   * @returns The tracer's own buffer, which the next call writes again; `resize()` frees it.
   * @throws {DeviceError} `renderer/device-lost`, `renderer/out-of-memory`, `renderer/gpu-error`
   */
  async varianceBuffer(): Promise<GPUBuffer> {
    this.#check();
    return this.#session.reader.varianceBuffer();
  }

  /** The frame that the film showed before it began again, if the same surfaces can be found in it. */
  get history(): HistoryFrame | undefined {
    return this.#session.history;
  }

  /** The first-hit AOVs that are requested, see `PathTracerOptions.aovs`. */
  get aovs(): readonly AovName[] {
    return this.#options.aovs;
  }

  /**
   * A first-hit AOV on the GPU, for kernels that run after it: guides of a denoiser, compositing. It accumulates the
   * film's first 64 samples and restarts with the film.
   *
   * @throws {RenderError} `renderer/aov` if it is not requested, or its kernels are not there yet.
   * @example
   * const tracer = await PathTracer.create(device, scene, { width, height, aovs: ['albedo', 'normal'] });
   * for await (const progress of tracer.render({ samples: 16 })) void progress;
   * const { buffer, stride, offset } = tracer.aov('albedo'); // albedo[i] = buffer[stride * pixel + offset + i]
   */
  aov(name: AovName): FilmAov {
    this.#check();
    return this.#session.aovs.aov(name);
  }

  /**
   * Requests other first-hit AOVs than before. The film continues: kernels that record them are compiled, and the
   * samples that it has get their AOVs by tracing their paths again as far as these need.
   *
   * @param aovs All that are requested from now on; none of them costs nothing.
   * @param options `signal` ends the wait: the promise rejects with its reason. An abort before the edit begins changes
   * nothing; later the AOVs stay requested, and {@link read} records the samples that they still lack.
   * @returns When {@link aov} has them, for as many samples as the film has, at most 64, at least one.
   * @throws {RenderError} `renderer/option` for other names.
   * @throws {DeviceError} `renderer/limit`, `renderer/out-of-memory`, `renderer/gpu-error`, `renderer/device-lost`
   */
  async setAovs(
    aovs: readonly AovName[],
    { signal }: { readonly signal?: AbortSignal | undefined } = {},
  ): Promise<void> {
    const edit = this.#edits.run(() => {
      signal?.throwIfAborted();
      this.#check();
      resolveOptions({ aovs });
      const before = this.#options.aovs;
      const request = (names: readonly AovName[]) => {
        this.#options = { ...this.#options, aovs: names };
      };
      return {
        effect: 'keeps',
        isStale: () => signal?.aborted === true,
        apply: () => {
          request([...aovs]);
          return false;
        },
        undo: () => request(before),
      };
    });
    await unlessAborted(edit, signal);
    if (!this.#destroyed) await this.#session.aovs.fill(signal);
  }

  /**
   * Compiles the kernels with which films can reuse light samples of the frame before, for moving views (see {@link
   * reset}), or those without. The film continues. No effect with catchers, without lights, and for scenes so large that
   * the GPU's buffers do not hold them.
   *
   * @returns When the kernels are there.
   * @throws {RenderError} `renderer/destroyed`
   * @throws {DeviceError} `renderer/out-of-memory`, `renderer/gpu-error`, `renderer/device-lost`
   */
  async setLightReuse(on: boolean): Promise<void> {
    const { lightReuse } = await loadPart('light-reuse', import('./session/light-reuse'));
    this.#check();
    this.#integrator.reuse ??= lightReuse(this.#memory, () => {
      const { width, height } = this.#session.film;
      return { width, height, lights: this.#gpuScene.lightIds.generation };
    });
    await this.#edits.run(() => {
      this.#check();
      const before = this.#options.lightReuse;
      const request = (lightReuse = false) => {
        this.#options = { ...this.#options, lightReuse };
      };
      return {
        effect: 'keeps',
        isStale: () => false,
        apply: () => {
          request(on);
          return false;
        },
        undo: () => request(before),
      };
    });
  }

  get statistics(): RenderStatistics {
    const { geometry } = this.#editor;
    const triangles = geometry.triangleCount;
    return {
      triangles,
      instances: geometry.placement.tlas.count,
      lights: this.#gpuScene.lightCount,
      ...this.#times,
      gpuBytes: this.#memory.bytes,
      memory: memoryReport(this.#memory, {
        pathsInFlight: this.#integrator.capacity,
        triangles,
        pixels: this.#session.film.fullWidth * this.#session.film.fullHeight,
        texels: this.#gpuScene.texels,
        textures: this.#textures,
      }),
      badSamples: this.#session.badSamples,
    };
  }

  /**
   * Adds samples to the film until it has the requested number. Ends without an error when `signal` aborts or an edit
   * restarts the film; the film keeps its samples. If the GPU rejects a batch, the next `render()` restarts the film.
   *
   * @throws {RenderError} `renderer/busy` while another `render()` of this tracer runs, `renderer/destroyed`,
   * `renderer/samples`
   * @throws {DeviceError} `renderer/device-lost`, `renderer/out-of-memory`, `renderer/gpu-error`
   */
  async *render(options: RenderOptions = {}): AsyncGenerator<RenderProgress, void, undefined> {
    this.#check();
    yield* this.#session.render(options);
  }

  /**
   * Copies a layer of the film to the CPU, top row first.
   *
   * - `beauty`: Float32Array, RGBA, stride 4: linear radiance (mean over samples) and coverage.
   * - `variance`: Float32Array, stride 4: variance of the beauty's mean, RGB, estimated from the means of chunks of 16
   *   samples (`Infinity` before there are 32 samples), and the pixel's number of samples. Exact on average for
   *   independent samples; with Sobol points it errs on the high side. It is that of the light groups as they were set
   *   when the film was begun.
   * - `albedo`: Float32Array, RGBA: albedo and coverage.
   * - `normal`: Float32Array, stride 4: normal and 0.
   * - `position`: Float32Array, stride 4: position and coverage.
   * - `coverage`, `depth`, `virtualDepth`, `roughness`: Float32Array, stride 1.
   * - `objectId`, `materialId`: Uint32Array, stride 1.
   * - `motion`: Float32Array, stride 2.
   *
   * The layers but the first two are first-hit AOVs, see {@link AovName}. One that is not requested is requested here,
   * as {@link setAovs} does, and stays so: request what will be read with `PathTracerOptions.aovs`, and kernels are
   * compiled once.
   *
   * @throws {DeviceError} `renderer/device-lost`, `renderer/out-of-memory`, `renderer/gpu-error`
   */
  async read(layer: 'objectId' | 'materialId'): Promise<Uint32Array<ArrayBuffer>>;
  async read(layer: Exclude<FilmLayer, 'objectId' | 'materialId'>): Promise<Float32Array<ArrayBuffer>>;
  async read(layer: FilmLayer): Promise<Float32Array<ArrayBuffer> | Uint32Array<ArrayBuffer>>;
  async read(layer: FilmLayer): Promise<Float32Array<ArrayBuffer> | Uint32Array<ArrayBuffer>> {
    this.#check();
    if (layer !== 'beauty' && layer !== 'variance' && !this.aovs.includes(layer))
      await this.setAovs([...this.aovs, layer]);
    return this.#session.read(layer);
  }

  /**
   * The image denoised, for stills: linear RGBA, stride 4, top row first. The film stays as it is. Requests the AOVs
   * `albedo` and `normal` where they are not, as {@link read} does.
   *
   * @param denoiser On this tracer's device; it stays the caller's to destroy.
   * @param options `signal` ends it with the signal's reason.
   * @throws {DeviceError} `renderer/device-lost`, `renderer/out-of-memory`, `renderer/gpu-error`; and what the denoiser
   * throws.
   * @example
   * const denoiser = await FilmDenoiser.create(device, { color: weights }); // of @glanz/denoise/film
   * const pixels = await tracer.denoised(denoiser);
   */
  async denoised<Result>(
    denoiser: TracerDenoiser<PathTracer, Result>,
    options: { readonly signal?: AbortSignal } = {},
  ): Promise<Float32Array<ArrayBuffer>> {
    this.#check();
    const guides = (['albedo', 'normal'] as const).filter((name) => !this.aovs.includes(name));
    if (guides.length > 0) await this.setAovs([...this.aovs, ...guides], options);
    return denoiser.read(await denoiser.denoiseTracer(this, options));
  }

  /**
   * The light groups and how they are set, in the order of the film's light passes. One, `rest`, unless the scene names
   * groups or the option `lightGroups` makes some.
   */
  get lightGroups(): readonly LightGroup[] {
    return this.#session.groups.list;
  }

  /**
   * Changes the intensity and colour of a light group in the existing image: no new samples are needed, and the film
   * continues.
   *
   * @param settings Omitted settings do not change. Intensity and colour must be finite and at least 0.
   * @returns When the image shows it.
   * @throws {RenderError} `renderer/light-groups` for an unknown group, a value out of range, or with
   * `lightGroups: 'off'`.
   */
  async setLightGroup(name: string, settings: Partial<Pick<LightGroup, 'intensity' | 'color'>>): Promise<void> {
    this.#check();
    if (this.#options.lightGroups === 'off')
      throw new RenderError('renderer/light-groups', "The option lightGroups is 'off'.");
    await this.#session.setGroup(name, settings);
  }

  /**
   * The part of one light group in the image: Float32Array, RGBA, stride 4, as the group is set; all groups add up to
   * the beauty. Alpha is the image's coverage.
   *
   * @throws {RenderError} `renderer/light-groups` if there is no such group.
   */
  async readLightGroup(name: string): Promise<Float32Array<ArrayBuffer>> {
    this.#check();
    if (this.#integrator.pathsPerSample > 1)
      throw new RenderError('renderer/light-groups', 'With catchers, light groups can be set, but not read.');
    return this.#session.readGroup(name);
  }

  /**
   * Copies the accumulated film and the state of its sampling to the CPU, to continue on another device, in another
   * process, or after the tab was closed. Exact at any time, also while `render()` runs.
   *
   * @param options `beauty: false` leaves that sum at 0, for films that are going to be merged, which makes it again:
   * there is a quarter less to copy.
   * @throws {DeviceError} `renderer/device-lost`, `renderer/out-of-memory`
   */
  async saveFilm({ beauty = true }: { readonly beauty?: boolean } = {}): Promise<FilmState> {
    this.#check();
    return this.#session.save(beauty);
  }

  /**
   * Replaces the tracer's film by a saved one. The next `render()` continues from it; on the same kind of device the
   * result is bit-identical to that without the interruption. A running `render()` ends.
   *
   * @param state Of a tracer with the same scene, camera and options, or merged from such. It is not changed and can be
   * used again. The film begins at the state's first sample from then on, see {@link reset}.
   * @returns When the film holds it.
   * @throws {RenderError} `renderer/film-state` if it is of another size, scene, camera, or other options, or was merged
   * from films between whose samples some are missing.
   */
  async restoreFilm(state: FilmState): Promise<void> {
    this.#check();
    await this.#session.restore(state);
  }

  /**
   * Rays that have been traced so far: edges of paths and rays to lights, each once, however much it passes through on
   * its way. Goes on over restarts of the film. Reads a few bytes from the GPU; exact where that happens every four
   * thousand million rays.
   *
   * @throws {DeviceError} `renderer/device-lost`
   */
  async readRayCount(): Promise<number> {
    this.#check();
    const [now] = new Uint32Array(await readBuffer(this.#device, this.#integrator.buffers.queues, 32)).subarray(
      7,
    ) as unknown as [number];
    // The GPU counts modulo 2^32.
    this.#rays += (now - this.#rays) >>> 0;
    return this.#rays;
  }

  /**
   * Restarts the film.
   *
   * @param options `firstSample`: the number of its first sample, a whole number from 0 to 2,147,483,647; default: the
   * one that it has, at first 0. Edits keep it. Samples have numbers, from which their random numbers follow, so that
   * several tracers can render different samples of one image: one renders 50 samples, another `reset({ firstSample:
   * 50 })` and 50 samples more, and `mergeFilmStates` of `@glanz/renderer/film` adds up what `saveFilm()` returns.
   * `lightReuse`: whether the film takes light samples from the film before, if that has left some, and leaves its own
   * (ReSTIR DI); with {@link setLightReuse} alone. The film is biased then, and consecutive films have similar noise.
   * Default false, and edits begin films without.
   * @throws {RenderError} `renderer/samples` for a number out of range
   */
  reset({
    firstSample,
    lightReuse = false,
  }: { readonly firstSample?: number | undefined; readonly lightReuse?: boolean | undefined } = {}): void {
    this.#check();
    if (firstSample !== undefined) checkFirstSample(firstSample);
    this.#restart('reprojects', firstSample, undefined, lightReuse);
  }

  /**
   * Sets the camera: one of the scene by index or name, or any other. Restarts the film. A camera of another kind
   * (projection, with or without a lens) needs another small kernel; the former view is shown until it is compiled.
   *
   * @returns When the image shows it.
   * @throws {RenderError} `renderer/camera` if there is no such camera, or it is degenerate.
   */
  setCamera(camera: Camera | number | string): Promise<void> {
    return this.#edits.run(() => {
      this.#check();
      const chosen = chooseCamera(this.scene, camera, this.width / this.height);
      cameraUniforms(chosen, this.width, this.height);
      const before = this.#camera;
      return {
        effect: 'reprojects',
        isStale: () => false,
        apply: () => {
          this.#camera = chosen;
          return false;
        },
        undo: () => (this.#camera = before),
      };
    });
  }

  /**
   * Changes the most edges of a path, see `PathTracerOptions.maxDepth`. Restarts the film.
   * @throws {RenderError} `renderer/option`
   */
  setDepth(maxDepth: number): void {
    this.#check();
    this.#options = resolveOptions({ ...this.#options, maxDepth });
    this.#integrator.limits = { ...this.#integrator.limits, maxDepth };
    this.#restart('invalidates');
  }

  /** Shows the environment behind the scene, or leaves the background empty. Restarts the film. */
  setBackground(background: NonNullable<PathTracerOptions['background']>): void {
    this.#check();
    this.#options = resolveOptions({ ...this.#options, background });
    this.#restart('invalidates');
  }

  /**
   * Changes the film's size and restarts it, at a render scale of 1. The old film stays, with its samples, until the
   * GPU has memory for the new one. Of several calls that overlap the last one counts.
   *
   * @returns When the film has its new size.
   * @throws {RenderError} `renderer/size`
   * @throws {DeviceError} `renderer/limit`, `renderer/out-of-memory`: the film is what it was.
   */
  async resize(width: number, height: number): Promise<void> {
    this.#check();
    checkSize(width, height);
    await this.#edits.resize(width, height);
    if (this.renderScale !== 1 && !this.#destroyed) this.setRenderScale(1);
  }

  /** Share of the width and height that is rendered, 1 by default; see {@link setRenderScale}. */
  get renderScale(): number {
    return this.#session.film.scale;
  }

  /**
   * Renders fewer pixels in the film's memory, for previews, and restarts the film. Takes effect at once: nothing is
   * allocated, unlike with {@link resize}.
   *
   * @param scale Factor of the tracer's width and height, above 0 and at most 1.
   * @throws {RenderError} `renderer/size` for a scale out of range, `renderer/destroyed`
   */
  setRenderScale(scale: number): void {
    this.#check();
    checkRenderScale(scale);
    this.#session.renderScale = scale;
    this.#restart('reprojects');
  }

  /** What lies under a pixel (whole or fractional coordinates from the upper left corner), found on the CPU. */
  pick(x: number, y: number): PickResult | undefined {
    this.#check();
    return pickPixel(
      this.scene,
      this.#editor.geometry,
      this.#camera,
      this.width,
      this.height,
      x,
      y,
      this.#options.backFaceCulling !== 'off' ? (material) => this.#gpuScene.culls(material) : undefined,
    );
  }

  /** Frees all GPU memory. Idempotent; a running `render()` ends. */
  destroy(): void {
    if (this.#destroyed) return;
    this.#destroyed = true;
    this.#ignoreLoss();
    this.#session.end();
    this.#memory.destroy();
  }

  /** @internal */
  protected edit(prepare: (editor: SceneEditor) => SceneChange | Promise<SceneChange>): Promise<void> {
    return this.#edits.run(() => {
      this.#check();
      return prepare(this.#editor);
    });
  }

  #restart(effect: EditEffect, firstSample?: number, moves?: readonly Move[], lightReuse = false): void {
    const { flags } = this.#integrator.kernels.features;
    if (Object.entries(viewFlags(this.#camera, this.#options.filter)).every(([name, value]) => flags[name] === value))
      this.#shownCamera = this.#camera;
    this.#session.restart(effect, firstSample, moves, lightReuse);
  }

  #check(): void {
    if (this.#destroyed) throw new RenderError('renderer/destroyed', 'This tracer was destroyed.');
    if (this.#failure) throw this.#failure;
  }
}
