import { compressedFormats, PathTracer, type PathTracerOptions, type PrepareProgress } from '@glanz/renderer';
import { untilAborted, type CompressedFormat } from '@glanz/scene';
import { checkToneMapOptions, type ToneMapOptions } from '@glanz/tonemap';
import { Connection } from './connection';
import type { EngineHost, EngineSettings, TracerSpec, TracerCopy } from './engine-host';
import { abortError, isAbort } from './aborts';
import type { ViewerState } from './events';
import { RememberingHierarchies, type RefitHierarchy } from './hierarchies';
import { makeTracer } from './make-tracer';
import { Preparation } from './preparation';
import { RenderLoop, type Size } from './render-loop';

export type { EngineHost, EngineSettings, TracerSpec, TracerCopy } from './engine-host';
export type { ViewerState } from './events';

/** Gives what a tracer is made from: of a scene as it came, or as it was edited in the tracer whose device was lost. */
type Source = (former: PathTracer | undefined) => TracerSpec;

/** Options of {@link Engine.show}. */
export interface ShowOptions {
  /** Ends the wait at once when it aborts. */
  readonly signal?: AbortSignal;
  readonly onProgress?: (progress: PrepareProgress) => void;
  /** Called when the tracer has taken the place of the former one, before its first frame. */
  readonly onTaken?: () => void;
}

/**
 * Device, tracer and canvas: prepares scenes, renders them in a loop (a low-resolution preview while something moves,
 * the full image when it does not, and no samples when it is done or not visible), and continues after the device was
 * lost.
 */
export class Engine {
  readonly settings: EngineSettings;
  readonly #host: EngineHost;
  readonly #loop: RenderLoop;
  readonly #connection: Connection;
  readonly #preparation = new Preparation(() => this.#loop.stir());
  #hierarchies: RememberingHierarchies | undefined;
  /** The device that the tracer is on, perhaps a lost one. */
  #tracerDevice: GPUDevice | undefined;
  #source: Source | undefined;
  #failed = false;
  #destroyed = false;
  /** Samples of the image when its device was lost, and how many of them came back. */
  #lostSamples = 0;
  #keptSamples = 0;
  /** Settles when the last rebuild after a loss has ended. */
  #rebuilding: Promise<unknown> | undefined;

  /**
   * @param canvas One that has no context yet, or had an engine before.
   * @param budgetMs Milliseconds that a frame of the preview may take.
   */
  constructor(canvas: HTMLCanvasElement, settings: EngineSettings, budgetMs: number, host: EngineHost) {
    this.settings = settings;
    this.#host = host;
    this.#loop = new RenderLoop(canvas, settings, budgetMs, host, {
      display: () => this.#connection.display,
      blocked: () => this.#blocked(),
      isCurrent: (tracer) => this.#current(tracer),
      failed: (error) => this.#fail(error),
      device: () => this.#tracerDevice,
    });
    const { exposure = 0, toneMap = 'neutral' } = settings;
    this.#connection = new Connection(
      canvas,
      { exposure, toneMap },
      {
        missing: host.missing,
        lost: (reason) => {
          if (this.current) this.#lostSamples = this.tracer?.samples ?? 0;
          this.#host.lost(reason);
        },
        recovering: () => this.#loop.lose(),
        back: (lostAt) => void this.#restore(lostAt),
        failed: (error) => this.#fail(error),
        error: host.error,
      },
      settings.requestDevice,
    );
    // All warms up while the first model loads.
    this.#connection.ready.then(
      () => this.device && this.#preparation.warmUp(this.device, this.#builder, settings.warmUp),
      () => undefined,
    );
    void this.#loop.run();
  }

  /** The path tracer of the present scene; another one after each `show()` and each loss of the device. */
  get tracer(): PathTracer | undefined {
    return this.#loop.tracer;
  }

  /** The device in use; another one after each loss. */
  get device(): GPUDevice | undefined {
    return this.#connection.device;
  }

  /** When there was a first device. Rejects with the `DeviceError` or `ViewerError` that kept it from coming. */
  get ready(): Promise<void> {
    return this.#connection.ready;
  }

  /** What the device reads of compressed formats, once there is one; none where there will be none. */
  async compressedFormats(): Promise<readonly CompressedFormat[]> {
    await this.#connection.ready.catch(() => undefined);
    return this.device ? compressedFormats(this.device) : [];
  }

  get state(): ViewerState {
    return this.#loop.state;
  }

  /** Whether the film holds a sample of the scene as it is now, in whatever size. */
  get fresh(): boolean {
    return this.#loop.fresh;
  }

  /** Whether the film shows the whole image as it is now. */
  get current(): boolean {
    return this.#loop.current;
  }

  /** Pixels of the image in full, as far as the GPU has memory for them. */
  get imageSize(): Size {
    return this.#loop.imageSize;
  }

  /**
   * What makes another tracer of the scene as it is now.
   * @param aspect Width over height of its image, which the camera fits.
   */
  copyFor(aspect: number): TracerCopy | undefined {
    const { device, tracer: shown } = this;
    if (!this.#source || !device || !this.#current(shown)) return undefined;
    const spec = this.#source(shown);
    const options = { ...this.#tracerOptions(), ...spec.options, camera: this.#host.camera(aspect) };
    return { ready: spec.ready, create: (more) => PathTracer.create(device, spec.scene, { ...options, ...more }) };
  }

  /** Edits that wait for the next frame. */
  get waiting(): number {
    return this.#loop.edits.size;
  }

  /** Sets what gives deformed meshes their hierarchies. */
  refit(refit: RefitHierarchy | undefined): void {
    this.#builder.refit = refit;
  }

  /** Adds no samples while it is set, but for one after each change. */
  get paused(): boolean {
    return this.#loop.paused;
  }

  set paused(paused: boolean) {
    this.#loop.paused = paused;
  }

  /**
   * Ensures that there is a device: requests one again where an earlier request failed, or where it was lost too often.
   * @throws {DeviceError} {ViewerError} `viewer/device-lost`, `viewer/destroyed`.
   */
  connect(): Promise<void> {
    return this.#connection.again();
  }

  /**
   * Shows another scene. Until it is ready, and where this fails, the former scene is shown.
   *
   * @param source Called whenever a tracer is created: first without an argument, and after a loss of the device with
   * the tracer that was lost.
   * @throws {DeviceError} {RenderError} {SceneError} of the renderer; {ViewerError} `viewer/destroyed`,
   * `viewer/device-lost`.
   * @throws an `AbortError` where another scene is asked for meanwhile, and the signal's reason.
   */
  async show(source: Source, options: ShowOptions = {}): Promise<PathTracer> {
    const { signal } = options;
    signal?.throwIfAborted();
    const failed = this.#failed;
    this.#failed = false;
    try {
      await untilAborted(this.connect(), signal);
      this.#loop.edits.clear(abortError('another scene was shown'));
      return await this.#prepare(source, options);
    } catch (error) {
      this.#keepFormer(failed);
      throw error;
    }
  }

  /** Changes the tracer between two frames; see `Viewer.edit`. */
  edit(
    key: unknown,
    apply: (tracer: PathTracer, merged: object) => void | Promise<void>,
    value: object = {},
  ): Promise<void> {
    const applied = this.#loop.edit(key, apply, value);
    this.#tryAgain();
    this.touch();
    return applied;
  }

  /** Reports that the camera or the scene has changed: the preview is shown for a while. */
  touch(): void {
    this.#loop.touch();
  }

  /** Sizes of the image and of the canvas, pixels. */
  resize(film: Size, canvas: Size): void {
    if (!this.#loop.resize(film, canvas)) return;
    this.#tryAgain();
    this.touch();
  }

  /**
   * Exposure and tone map, on the image as it is.
   * @throws {ToneMapError} for what cannot be set; the settings stay as they were then.
   */
  async setView(view: ToneMapOptions): Promise<void> {
    checkToneMapOptions(view);
    Object.assign(this.settings, view);
    try {
      await this.#connection.setView(view);
    } catch (error) {
      Object.assign(this.settings, this.#connection.view);
      throw error;
    }
    this.#loop.redraw();
  }

  /** Has the loop look again at what is to be done. */
  wake(): void {
    this.#loop.stir();
  }

  /** Starts the present work again, with settings that have changed. */
  restart(): void {
    this.#tryAgain();
    this.#loop.restart();
  }

  /** Draws the film with the next frame of the screen, as it is now. */
  redraw(): void {
    const { denoise } = this.settings;
    if (denoise) {
      denoise.forget();
      this.restart();
    }
    this.#loop.redraw();
  }

  /** Tries again after a failure. */
  retry(): void {
    if (this.#destroyed) return;
    this.#failed = false;
    if (!this.#connection.retry()) this.#keepFormer(false);
    this.#loop.stir();
  }

  /** Frees everything, the device too. Idempotent. */
  destroy(): void {
    if (this.#destroyed) return;
    this.#destroyed = true;
    this.#preparation.destroy();
    this.#loop.destroy();
    this.settings.denoise?.destroy();
    this.#connection.destroy();
    this.#hierarchies?.destroy();
    this.#tracerDevice = undefined;
    this.#loop.state = 'destroyed';
  }

  /** Options of each tracer. */
  #tracerOptions(): Partial<PathTracerOptions> {
    const { maxDepth, background, tracer, denoise } = this.settings;
    return {
      hierarchies: this.#builder,
      ...tracer,
      ...(denoise ? { aovs: denoise.aovs(tracer.aovs) } : {}),
      maxDepth,
      background,
    };
  }

  /** Asked for only while there is a device: its workers are ended with that. */
  get #builder(): RememberingHierarchies {
    return (this.#hierarchies ??= new RememberingHierarchies());
  }

  /** @param former The tracer whose device was lost, and whose samples were kept. */
  async #prepare(
    source: Source,
    { signal, onProgress, onTaken }: ShowOptions,
    former?: PathTracer,
  ): Promise<PathTracer> {
    if (!former) this.#loop.films.forget();
    const options = (either: AbortSignal) => {
      const [width, height] = this.imageSize;
      return {
        ...this.#tracerOptions(),
        width,
        height,
        signal: either,
        onProgress: (progress: PrepareProgress) => void (either.aborted || onProgress?.(progress)),
        onWarning: this.#host.warning,
      };
    };
    let restored = false;
    const restoring = (): TracerSpec => {
      const spec = source(former);
      const ready = async (tracer: PathTracer) => {
        await spec.ready?.(tracer);
        this.#loop.films.adopt(tracer, this.settings.maxDepth);
        restored = !!former && (await this.#loop.restore(tracer));
      };
      return { ...spec, ready };
    };
    const prepared = this.#preparation.run(
      (either) => makeTracer(this.#connection, restoring, () => options(either)),
      ({ tracer, device }) => {
        this.#tracerDevice = device;
        this.#source = source;
        this.#failed = false;
        if (restored) this.#keptSamples = tracer.samples;
        else if (!former) this.#lostSamples = 0;
        this.#loop.show(tracer, restored);
        if (restored) return;
        onTaken?.();
        this.touch();
      },
      signal,
    );
    this.#loop.stir();
    return (await prepared).tracer;
  }

  /** Makes what was lost with a device again on the one that there is now. */
  async #restore(lostAt: number): Promise<void> {
    const { device } = this;
    await this.#rebuild();
    if (this.#failed || device !== this.device) return;
    const samples = this.#keptSamples;
    const lostSamples = Math.max(0, this.#lostSamples - samples);
    this.#lostSamples = this.#keptSamples = 0;
    this.#host.restored(performance.now() - lostAt, { samples, lostSamples });
  }

  /** Makes the scene as it was edited on another device than before, and reports where that fails. */
  #rebuild(): Promise<unknown> | undefined {
    const { tracer: former } = this;
    const source = this.#source;
    // What is being prepared takes the new device by itself where its own was lost.
    if (former && source && !this.#preparation.running)
      // Without a device the connection has given up, and has reported it.
      this.#rebuilding = this.#prepare(source, {}, former).catch(
        (error: unknown) => isAbort(error) || !this.device || this.#fail(error),
      );
    return this.#rebuilding;
  }

  /** What was to replace the scene did not come: the former one stays, on the device that there is now. */
  #keepFormer(failed: boolean): void {
    const { device, recovery } = this.#connection;
    if (this.#destroyed || !this.tracer || recovery || this.#preparation.running) return;
    if (!device) this.#failed = true;
    else if (this.#tracerDevice !== device) void this.#rebuild();
    else this.#failed = failed;
    this.#loop.stir();
  }

  /** A change may have removed the cause of a failure, unless that is a missing device. */
  #tryAgain(): void {
    if (this.device && this.device === this.#tracerDevice) this.#failed = false;
  }

  #fail(error: unknown): void {
    this.#failed = true;
    this.#loop.state = 'failed';
    this.#host.error(error, () => this.retry());
    this.#loop.stir();
  }

  /** Whether a tracer is the one that is shown, on a device that is not lost. */
  #current(tracer: PathTracer | undefined): boolean {
    const { device, recovery } = this.#connection;
    return tracer !== undefined && tracer === this.tracer && !!device && device === this.#tracerDevice && !recovery;
  }

  /** Why nothing can be rendered at present, or undefined. */
  #blocked(): ViewerState | undefined {
    if (this.#failed) return 'failed';
    if (this.#connection.recovery || (this.tracer && !this.device)) return 'recovering';
    if (this.#preparation.running) return 'loading';
    return this.tracer ? undefined : 'empty';
  }
}
