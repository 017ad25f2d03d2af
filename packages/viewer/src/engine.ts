import { compressedFormats, PathTracer, type PrepareProgress } from '@glanz/renderer';
import type { CompressedFormat } from '@glanz/scene';
import { checkToneMapOptions, type ToneMapOptions } from '@glanz/tonemap';
import { Connection } from './connection';
import { Edits } from './edits';
import type { EngineHost, EngineSettings, Take, TracerCopy } from './engine-host';
import { isAbort } from './errors';
import type { ViewerState } from './events';
import { FilmFit, sameSize, scaledSize } from './film-fit';
import { FilmKeeper } from './film-keeper';
import { previewShare } from './crossfade';
import { RememberingHierarchies } from './hierarchies';
import { makeTracer } from './make-tracer';
import { Preparation } from './preparation';
import { PreviewController } from './preview';
import { untilAborted } from '@glanz/scene';
import { nextFrame, soon, Visibility } from './visibility';

export type { EngineHost, EngineSettings, Take, TracerCopy } from './engine-host';
export type { ViewerState } from './events';

/** Samples after which a preview that stands still has no more to gain. */
const PREVIEW_SAMPLES = 16;
/** A frame that began so many milliseconds ago was not of this turn of the screen. */
const SCREEN_MS = 15;
/** Milliseconds of one submission of the preview: it shall be one. */
const PREVIEW_SUBMIT_MS = 50;

type Size = readonly [number, number];
/** Gives what a tracer is made from: of a scene as it came, or as it was edited in the tracer whose device was lost. */
type Source = (former: PathTracer | undefined) => Take;

/** Options of {@link Engine.show}. */
export interface ShowOptions {
  /** Ends the wait at once when it aborts. */
  readonly signal?: AbortSignal;
  readonly onProgress?: (progress: PrepareProgress) => void;
  /** Called when the tracer has taken the place of the former one, before its first frame. */
  readonly onTaken?: () => void;
}

/**
 * Device, tracer and canvas: shows a small preview while something moves, refines the image when it rests, sleeps
 * when there is nothing to do or nobody sees it, and comes back after the device was lost.
 */
export class Engine {
  readonly settings: EngineSettings;
  readonly #host: EngineHost;
  readonly #edits = new Edits();
  readonly #connection: Connection;
  readonly #visibility: Visibility;
  readonly #films = new FilmFit();
  readonly #keeper = new FilmKeeper();
  readonly #preparation = new Preparation(() => this.#wake());
  readonly #preview: PreviewController;
  #hierarchies: RememberingHierarchies | undefined;
  #tracer: PathTracer | undefined;
  /** The device that the tracer is on, perhaps a lost one. */
  #tracerDevice: GPUDevice | undefined;
  #source: Source | undefined;
  #film: Size = [1, 1];
  #canvasSize: Size = [1, 1];
  #state: ViewerState = 'empty';
  #failed = false;
  #destroyed = false;
  #paused = false;
  /** Whether the film holds a sample since it was last cleared. */
  #fresh = false;
  /** Samples of the image when its device was lost, and how many of them came back. */
  #lostSamples = 0;
  #keptSamples = 0;
  /** Whether a film that the GPU has no memory for was reported. */
  #smaller = false;
  /** The time has come to try the whole size again. */
  #growing = false;
  #done = false;
  #dirtyCamera = true;
  #settle = 0;
  #changed = 0;
  #lastStep = 0;
  #lastPreview = -Infinity;
  #frame = 0;
  #interrupt = new AbortController();
  #wake: () => void = () => undefined;

  /**
   * @param canvas One that has no context yet, or had an engine before.
   * @param budgetMs Milliseconds that a frame of the preview may take.
   */
  constructor(canvas: HTMLCanvasElement, settings: EngineSettings, budgetMs: number, host: EngineHost) {
    this.settings = settings;
    this.#host = host;
    this.#preview = new PreviewController(budgetMs);
    this.#visibility = new Visibility(canvas, () => this.#stir());
    const { exposure = 0, toneMap = 'neutral' } = settings;
    this.#connection = new Connection(
      canvas,
      { exposure, toneMap },
      {
        missing: (error) => this.#host.missing?.(error),
        lost: (reason) => {
          if (this.current) this.#lostSamples = this.#tracer?.samples ?? 0;
          this.#host.lost(reason);
        },
        recovering: () => {
          this.#fresh = false;
          this.#setState('recovering');
          this.#stir();
        },
        back: () => this.#rebuild(),
        restored: (milliseconds) => {
          const samples = this.#keptSamples;
          const lostSamples = Math.max(0, this.#lostSamples - samples);
          this.#lostSamples = this.#keptSamples = 0;
          this.#host.restored(milliseconds, { samples, lostSamples });
        },
        failed: (error) => this.#fail(error),
        error: (error) => this.#host.error(error),
      },
      settings.requestDevice,
    );
    // All warms up while the first model loads.
    this.#connection.ready.then(
      () => this.device && this.#builder && this.#preparation.warmUp(this.device, this.#builder, settings.warmUp),
      () => undefined,
    );
    void this.#run();
  }

  /** The path tracer of the present scene; another one after each `show()` and each loss of the device. */
  get tracer(): PathTracer | undefined {
    return this.#tracer;
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
    return this.#state;
  }

  /** Whether the film holds a sample of the scene as it is now, in whatever size. */
  get fresh(): boolean {
    return this.#fresh;
  }

  /** Whether the film shows the whole image as it is now. */
  get current(): boolean {
    return (
      this.#fresh &&
      !this.#moving() &&
      !!this.#tracer &&
      sameSize([this.#tracer.width, this.#tracer.height], this.#full)
    );
  }

  /** Pixels of the image in full, as far as the GPU has memory for them. */
  get #full(): Size {
    return this.#films.sizeFor(this.#film);
  }

  /** Pixels of the image in full, as far as the GPU has memory for them. */
  get imageSize(): Size {
    return this.#full;
  }

  /**
   * What makes another tracer of the scene as it is now.
   * @param aspect Width over height of its image, which the camera fits.
   */
  copyFor(aspect: number): TracerCopy | undefined {
    const { device } = this;
    if (!this.#source || !device || !this.#current(this.#tracer)) return undefined;
    const take = this.#source(this.#tracer);
    const { maxDepth, background, tracer } = this.settings;
    const builder = this.#builder;
    const options = {
      ...(builder ? { hierarchies: builder } : {}),
      ...tracer,
      maxDepth,
      background,
      ...take.options,
      camera: this.#host.camera(aspect),
    };
    return { ready: take.ready, create: (more) => PathTracer.create(device, take.scene, { ...options, ...more }) };
  }

  /** Edits that wait for the next frame. */
  get waiting(): number {
    return this.#edits.size;
  }

  /** Adds no samples while it is set, but for one after each change. */
  get paused(): boolean {
    return this.#paused;
  }

  set paused(paused: boolean) {
    this.#paused = paused;
    this.#stir();
  }

  /**
   * Makes sure that there is a device: one that could not be had before, or that was lost too often, is asked for
   * again.
   * @throws {DeviceError} {ViewerError} `viewer/device-lost`, `viewer/destroyed`.
   */
  connect(): Promise<void> {
    return this.#connection.again();
  }

  /**
   * Shows another scene. Until it is ready, and where this fails, the former one stays.
   *
   * @param source Asked whenever a tracer is made: now without one, and after a loss of the device with the one that
   * was lost.
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
      this.#edits.clear(new DOMException('another scene was shown', 'AbortError'));
      return await this.#prepare(() => source(undefined), source, options);
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
    const applied = this.#edits.add(key, (merged) => (this.#tracer ? apply(this.#tracer, merged) : undefined), value);
    this.#tryAgain();
    this.touch();
    return applied;
  }

  /** The camera, or what it looks at, has changed: the preview takes over for a while. */
  touch(): void {
    this.#dirtyCamera = true;
    this.#settle = performance.now() + this.settings.settleMs;
    this.#stir();
  }

  /** Sizes of the image and of the canvas, pixels. */
  resize(film: Size, canvas: Size): void {
    if (sameSize(film, this.#film) && sameSize(canvas, this.#canvasSize)) return;
    if (!sameSize(film, this.#film)) this.#films.forget();
    this.#film = film;
    this.#canvasSize = canvas;
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
    this.redraw();
  }

  /** Starts the present work again, with settings that have changed. */
  restart(): void {
    this.#done = false;
    this.#tryAgain();
    this.#stir();
  }

  /** Draws with the next frame of the screen. */
  redraw(): void {
    cancelAnimationFrame(this.#frame);
    this.#frame = requestAnimationFrame(() => {
      try {
        this.#draw();
      } catch (error) {
        this.#failUnlessLost(error, this.#tracer);
      }
    });
  }

  /** Tries again after a failure. */
  retry(): void {
    if (this.#destroyed) return;
    this.#failed = false;
    if (!this.#connection.retry()) this.#keepFormer(false);
    this.#stir();
  }

  /** Frees everything, the device too. Idempotent. */
  destroy(): void {
    if (this.#destroyed) return;
    this.#destroyed = true;
    this.#stir();
    this.#preparation.destroy();
    this.#edits.clear(new DOMException('the viewer was destroyed', 'AbortError'));
    cancelAnimationFrame(this.#frame);
    this.#visibility.destroy();
    this.#tracer?.destroy();
    this.#connection.destroy();
    this.#hierarchies?.destroy();
    this.#tracer = this.#tracerDevice = undefined;
    this.#setState('destroyed');
  }

  get #builder(): RememberingHierarchies | undefined {
    if (!this.#destroyed) this.#hierarchies ??= new RememberingHierarchies();
    return this.#hierarchies;
  }

  async #prepare(
    make: () => Take,
    source: Source,
    { signal, onProgress, onTaken }: ShowOptions = {},
    recovers = false,
  ): Promise<PathTracer> {
    if (!recovers) this.#films.forget();
    const options = (wanted: AbortSignal) => {
      const [width, height] = this.#full;
      const { maxDepth, background, tracer: more } = this.settings;
      return {
        hierarchies: this.#builder,
        ...more,
        width,
        height,
        maxDepth,
        background,
        signal: wanted,
        onProgress: (progress: PrepareProgress) => void (wanted.aborted || onProgress?.(progress)),
      };
    };
    let restored = false;
    const restoring = (): Take => {
      const take = make();
      const ready = async (tracer: PathTracer) => {
        await take.ready?.(tracer);
        this.#films.adopt(tracer, this.settings.maxDepth);
        restored = recovers && (await this.#restore(tracer));
      };
      return { ...take, ready };
    };
    const prepared = this.#preparation.run(
      (wanted) => makeTracer(this.#connection, restoring, () => options(wanted)),
      ({ tracer, device }) => {
        // Who asks for the canvas's size before the first image is drawn gets the one that it will have.
        if (!this.#tracer) this.#connection.display?.resize(this.#canvasSize);
        this.#tracer?.destroy();
        this.#tracer = tracer;
        this.#tracerDevice = device;
        this.#source = source;
        this.#failed = false;
        if (restored) {
          this.#keptSamples = tracer.samples;
          this.#fresh = true;
          this.#done = false;
          this.redraw();
          return;
        }
        if (!recovers) this.#lostSamples = 0;
        this.#restarted();
        onTaken?.();
        this.touch();
      },
      signal,
    );
    this.#stir();
    return (await prepared).tracer;
  }

  /** The scene as it was edited, on a device that came in place of a lost one. */
  async #rebuild(): Promise<void> {
    const [former, source] = [this.#tracer, this.#source];
    // A scene that is being prepared takes the new device by itself.
    if (former && source && !this.#preparation.running) await this.#prepare(() => source(former), source, {}, true);
  }

  /** Puts the samples that were kept into the film of a new tracer. @returns Whether they are in it. */
  async #restore(tracer: PathTracer): Promise<boolean> {
    const { kept } = this.#keeper;
    // A view or a scene that has changed since is another image.
    if (!kept || this.#moving()) return false;
    try {
      await tracer.restoreFilm(kept);
    } catch {
      return false;
    }
    return !this.#moving() && kept === this.#keeper.kept;
  }

  /** What was to replace the scene did not come: the former one stays, on the device that there is now. */
  #keepFormer(failed: boolean): void {
    const { device, recovery } = this.#connection;
    if (this.#destroyed || !this.#tracer || recovery || this.#preparation.running) return;
    if (!device) this.#failed = true;
    else if (this.#tracerDevice !== device)
      this.#rebuild().catch((error: unknown) => isAbort(error) || this.#fail(error));
    else this.#failed = failed;
    this.#stir();
  }

  /** A failure may have passed with what has changed. One for want of a device has not. */
  #tryAgain(): void {
    if (this.#failed && this.#connection.device && this.#connection.device === this.#tracerDevice) this.#failed = false;
  }

  #fail(error: unknown): void {
    this.#failed = true;
    this.#setState('failed');
    this.#host.error(error, () => this.retry());
    this.#stir();
  }

  /** What happens to a tracer whose device was lost is no failure: another one takes its place. */
  #failUnlessLost(error: unknown, tracer: PathTracer | undefined): void {
    if (this.#current(tracer)) this.#fail(error);
  }

  /** Whether a tracer is the one that is shown, on a device that is alive. */
  #current(tracer: PathTracer | undefined): boolean {
    const { device, recovery } = this.#connection;
    return (
      !this.#destroyed && tracer === this.#tracer && device !== undefined && device === this.#tracerDevice && !recovery
    );
  }

  /** Adds samples until the viewer is destroyed; sleeps where there is nothing to do. */
  async #run(): Promise<void> {
    while (!this.#destroyed) {
      const idle = this.#idleState();
      if (idle || !this.#tracer) {
        // Before the state is emitted: a listener may request work at once.
        const woken = new Promise<void>((resolve) => (this.#wake = resolve));
        this.#setState(idle ?? 'empty');
        const retry =
          idle === 'done' && this.#smaller
            ? setTimeout(() => ((this.#growing = true), this.#stir()), this.#films.retryMs)
            : undefined;
        await woken;
        clearTimeout(retry);
        this.#lastStep = performance.now();
        continue;
      }
      const tracer = this.#tracer;
      this.#interrupt = new AbortController();
      try {
        if (this.#moving()) await this.#previewFrame(tracer);
        else if (this.#growing) await this.#grow(tracer);
        else await this.#refine(tracer);
      } catch (error) {
        // A loss of the device shows in what follows; it is handled where the device reports it.
        await soon();
        await soon();
        this.#failUnlessLost(error, tracer);
      }
    }
  }

  /** Why nothing is to be computed, or undefined. */
  #idleState(): ViewerState | undefined {
    if (this.#failed) return 'failed';
    if (this.#connection.recovery || (this.#tracer && !this.#connection.device)) return 'recovering';
    if (this.#preparation.running) return 'loading';
    if (!this.#tracer) return 'empty';
    if (!this.#visibility.visible) return 'hidden';
    if (this.#moving()) return undefined;
    if (this.#paused && this.current) return 'paused';
    return this.#done && !this.#growing ? 'done' : undefined;
  }

  #moving(): boolean {
    return this.#dirtyCamera || this.#edits.size > 0 || this.#host.moving() || performance.now() < this.#settle;
  }

  /** An image that is as small as it must be to keep up with the controls. */
  async #previewFrame(tracer: PathTracer): Promise<void> {
    // In step with the screen where the GPU keeps up; the first frame, and those of a slow GPU, do not wait for it as
    // well.
    await (performance.now() - this.#lastPreview < SCREEN_MS ? nextFrame() : soon());
    if (tracer !== this.#tracer || this.#destroyed || !this.#visibility.visible) return;
    this.#setState('moving');
    const now = (this.#lastPreview = performance.now());
    const stepped = this.#host.step(Math.max(0, now - this.#lastStep) / 1000);
    this.#lastStep = now;
    const full = this.#full;
    const plan = this.#preview.plan(full[0] * full[1]);
    const changed = stepped || this.#dirtyCamera || this.#edits.size > 0;
    if (stepped || this.#dirtyCamera) {
      // What stands still keeps its size: samples gather.
      await this.#fit(
        tracer,
        full,
        plan.divisor > 1 ? Math.min(this.settings.previewDepth, this.settings.maxDepth) : this.settings.maxDepth,
        1 / plan.divisor,
      );
      if (tracer !== this.#tracer || this.#destroyed) return;
      this.#dirtyCamera = false;
      tracer
        .setCamera(this.#host.camera(this.#film[0] / this.#film[1]))
        .catch((error: unknown) => this.#current(tracer) && this.#host.error(error));
      this.#settle = now + this.settings.settleMs;
    }
    this.#edits.apply(() => this.#edited());
    if (changed) this.#restarted();
    const before = tracer.samples;
    // In its full size it is the image already, and that gets the requested samples.
    const max = sameSize([tracer.width, tracer.height], this.#full) ? this.#goal : Infinity;
    if (before >= Math.min(PREVIEW_SAMPLES, max) && this.#fresh) return;
    const started = performance.now();
    let samples = before;
    for await (const progress of tracer.render({
      samples: Math.min(before + plan.samples, Math.max(max, before)),
      maxSubmitMs: PREVIEW_SUBMIT_MS,
    })) {
      ({ samples } = progress);
      if (!this.#visibility.visible) break;
    }
    // A film that an edit has restarted meanwhile has none.
    if (tracer !== this.#tracer || this.#destroyed || tracer.samples === 0) return;
    const milliseconds = performance.now() - started;
    if (samples > before) this.#preview.measured(tracer.width * tracer.height, samples - before, milliseconds);
    this.#fresh = true;
    this.#draw(milliseconds);
  }

  /** The image in full, until it is done or something moves. */
  async #refine(tracer: PathTracer): Promise<void> {
    const { samples, noise, maxSubmitMs, maxDepth } = this.settings;
    this.#setState('rendering');
    const full = this.#full;
    if (this.#fresh && !sameSize([tracer.width, tracer.height], full))
      void this.#connection.display?.keep(
        { buffer: tracer.beautyBuffer, size: [tracer.width, tracer.height] },
        tracer.samples,
        full,
      );
    if (await this.#fit(tracer, full, maxDepth)) this.#fresh = false;
    // Another size may be wanted by now, or is all that there is memory for.
    if (
      tracer !== this.#tracer ||
      this.#destroyed ||
      this.#moving() ||
      !sameSize([tracer.width, tracer.height], this.#full)
    )
      return;
    const { signal } = this.#interrupt;
    for await (const progress of tracer.render({
      samples: this.#goal,
      signal,
      maxSubmitMs,
      ...(noise === undefined || this.#paused ? {} : { noise }),
    })) {
      if (tracer !== this.#tracer) return;
      this.#fresh = true;
      this.#host.sample({ ...progress, targetSamples: samples });
      if (this.settings.keepSamples !== false) this.#keeper.offer(tracer, false);
      this.redraw();
      if (this.#moving()) return;
    }
    if (tracer !== this.#tracer || signal.aborted || this.#moving() || this.#destroyed || this.#paused) return;
    // Ended by kernels that came late and restarted the film: once more.
    if (!this.#fresh && tracer.samples === 0) return;
    this.#fresh = true;
    this.#done = true;
    if (this.settings.keepSamples !== false) this.#keeper.offer(tracer, true);
    this.#connection.display?.forget();
    this.redraw();
    this.#host.converged(tracer.samples, performance.now() - this.#changed);
  }

  /**
   * Gives the film a size; where the GPU has no memory for it, the film keeps what it has. @returns Whether it was
   * restarted.
   */
  async #fit(tracer: PathTracer, size: Size, depth: number, scale = 1): Promise<boolean> {
    try {
      const restarted = await this.#films.fit(tracer, size, depth, scale);
      if (scale === 1 && sameSize(size, this.#film)) this.#smaller = false;
      return restarted;
    } catch (error) {
      // A lost device refuses nothing: its successor may have memory for all of it.
      if (!this.#current(tracer) || (error as { code?: unknown }).code === 'renderer/device-lost') throw error;
      this.#films.refuse(tracer, scaledSize(size, scale));
      // Once: smaller ones are tried until one fits.
      if (!this.#smaller) this.#host.error(error);
      this.#smaller = true;
      return false;
    }
  }

  /** Tries the whole size again, while an image that had to be smaller is shown. */
  async #grow(tracer: PathTracer): Promise<void> {
    this.#growing = false;
    if (!this.#smaller) return;
    const { display } = this.#connection;
    display?.keep({ buffer: tracer.beautyBuffer, size: [tracer.width, tracer.height] }, tracer.samples, this.#film);
    if (await this.#films.grow(tracer, this.#film)) this.#smaller = this.#fresh = this.#done = false;
    else display?.forget();
  }

  /** Samples of the image in full. */
  get #goal(): number {
    return this.#paused ? 1 : this.settings.samples;
  }

  /** An edit has taken effect, perhaps by kernels that came late and restarted the film. */
  #edited(): void {
    this.#restarted();
    this.#settle = performance.now() + this.settings.settleMs;
    this.#stir();
  }

  #restarted(): void {
    this.#fresh = false;
    this.#done = false;
    this.#keeper.clear();
    this.#changed = performance.now();
    this.#connection.display?.forget();
    this.#host.restarted?.();
  }

  #stir(): void {
    this.#interrupt.abort();
    this.#wake();
  }

  #setState(state: ViewerState): void {
    if (state === this.#state || (this.#destroyed && state !== 'destroyed')) return;
    this.#state = state;
    this.#host.state(state);
  }

  #draw(milliseconds = 0): void {
    const [tracer, { device, display }] = [this.#tracer, this.#connection];
    if (!tracer || !display || !this.#fresh || !device) return;
    const size: Size = [tracer.width, tracer.height];
    const preview = !sameSize(size, this.#full);
    if (preview) display.forget();
    const share = display.kept > 0 ? previewShare(tracer.samples, display.kept, this.settings.samples) : 0;
    if (share === 0 && display.kept > 0) display.forget();
    display.draw({ buffer: tracer.beautyBuffer, size }, this.#canvasSize, share);
    this.#host.drawn(this.#state === 'moving', milliseconds, size);
  }
}
