import { compressedFormats, type PathTracer, type PrepareProgress } from '@glanz/renderer';
import type { CompressedFormat } from '@glanz/scene';
import type { ToneMapOptions } from '@glanz/tonemap';
import { Connection } from './connection';
import { Edits } from './edits';
import type { EngineHost, EngineSettings, Take } from './engine-host';
import type { ViewerState } from './events';
import { FilmFit } from './film-fit';
import { previewShare } from './handover';
import { RememberingHierarchies } from './hierarchies';
import { makeTracer } from './make-tracer';
import { Preparation } from './preparation';
import { PreviewController } from './preview';
import { nextFrame, soon, Visibility } from './visibility';

export type { EngineHost, EngineSettings, Take } from './engine-host';
export type { ViewerState } from './events';

/** Samples after which a preview that stands still has no more to gain. */
const PREVIEW_SAMPLES = 16;
/** A frame that began so many milliseconds ago was not of this turn of the screen. */
const SCREEN_MS = 15;
/** Milliseconds of one submission of the preview: it shall be one. */
const PREVIEW_SUBMIT_MS = 50;

type Size = readonly [number, number];
const sameSize = (a: Size, b: Size) => a[0] === b[0] && a[1] === b[1];

/**
 * Device, tracer and canvas: shows a small preview while something moves, refines the picture when it rests, sleeps when
 * there is nothing to do or nobody sees it, and comes back after the device was lost.
 */
export class Engine {
  readonly settings: EngineSettings;
  readonly #host: EngineHost;
  readonly #edits = new Edits();
  readonly #connection: Connection;
  readonly #visibility: Visibility;
  readonly #films = new FilmFit();
  readonly #preparation = new Preparation(() => this.#wake());
  readonly #preview: PreviewController;
  #hierarchies: RememberingHierarchies | undefined;
  #tracer: PathTracer | undefined;
  #source: ((former: PathTracer | undefined) => Take) | undefined;
  #film: Size = [1, 1];
  #canvasSize: Size = [1, 1];
  #state: ViewerState = 'empty';
  #failed = false;
  #destroyed = false;
  #paused = false;
  /** Whether the film holds a sample since it was last cleared. */
  #fresh = false;
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
    this.#connection = new Connection(canvas, { exposure, toneMap }, {
      lost: (reason) => this.#host.lost(reason),
      recovering: () => {
        this.#fresh = false;
        this.#tell('recovering');
        this.#stir();
      },
      back: () => this.#rebuild(),
      restored: (milliseconds) => this.#host.restored(milliseconds),
      failed: (error) => this.#fail(error),
      error: (error) => this.#host.error(error),
    }, settings.requestDevice);
    // All warms up while the first model loads.
    this.#connection.ready.then(() => this.device && this.#builder && this.#preparation.warmUp(this.device, this.#builder, settings.warmUp), () => undefined);
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

  /** Whether the film shows the whole picture as it is now. */
  get current(): boolean {
    return this.#fresh && !this.#moving() && !!this.#tracer && sameSize([this.#tracer.width, this.#tracer.height], this.#film);
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
   * Shows another scene. Until it is ready the former one stays, and it stays for good where this fails.
   *
   * @param source Asked whenever a tracer is made: now without one, and after a loss of the device with the one that was lost.
   * @throws {DeviceError} {RenderError} {SceneError} of the renderer; {ViewerError} `viewer/destroyed`, `viewer/device-lost`.
   * @throws an `AbortError` where another scene is asked for meanwhile, and the signal's reason.
   */
  async show(source: (former: PathTracer | undefined) => Take, options: { readonly signal?: AbortSignal; readonly onProgress?: (progress: PrepareProgress) => void } = {}): Promise<PathTracer> {
    // One that failed before is asked for again.
    await this.#connection.again();
    this.#edits.clear(new DOMException('another scene was shown', 'AbortError'));
    const tracer = await this.#prepare(() => source(undefined), options.signal, options.onProgress);
    this.#source = source;
    return tracer;
  }

  /** Changes the tracer between two frames; see `Viewer.edit`. */
  edit(key: unknown, apply: (tracer: PathTracer, merged: object) => void | Promise<void>, value: object = {}): Promise<void> {
    const applied = this.#edits.add(key, (merged) => (this.#tracer ? apply(this.#tracer, merged) : undefined), value);
    this.touch();
    return applied;
  }

  /** The camera, or what it looks at, has changed: the preview takes over for a while. */
  touch(): void {
    this.#dirtyCamera = true;
    this.#settle = performance.now() + this.settings.settleMs;
    this.#stir();
  }

  /** Sizes of the picture and of the canvas, pixels. */
  resize(film: Size, canvas: Size): void {
    if (sameSize(film, this.#film) && sameSize(canvas, this.#canvasSize)) return;
    this.#film = film;
    this.#canvasSize = canvas;
    this.touch();
  }

  /** Exposure and tone map, on the picture as it is. */
  async setView(view: ToneMapOptions): Promise<void> {
    Object.assign(this.settings, view);
    await this.#connection.setView(view);
    this.redraw();
  }

  /** Starts the present work anew, with settings that have changed. */
  restart(): void {
    this.#done = false;
    this.#stir();
  }

  /** Draws with the next frame of the screen. */
  redraw(): void {
    cancelAnimationFrame(this.#frame);
    this.#frame = requestAnimationFrame(() => this.#draw());
  }

  /** Tries again after a failure. */
  retry(): void {
    this.#failed = false;
    if (!this.#tracer || !this.#connection.retry()) this.#stir();
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
    this.#tracer = undefined;
    this.#tell('destroyed');
  }

  get #builder(): RememberingHierarchies | undefined {
    if (!this.#destroyed) this.#hierarchies ??= new RememberingHierarchies();
    return this.#hierarchies;
  }

  #prepare(source: () => Take, signal: AbortSignal | undefined, onProgress: (progress: PrepareProgress) => void = () => undefined): Promise<PathTracer> {
    const options = (wanted: AbortSignal) => {
      const [width, height] = this.#film;
      const { maxDepth, background, tracer: more } = this.settings;
      return { hierarchies: this.#builder, ...more, width, height, maxDepth, background, signal: signal ? AbortSignal.any([signal, wanted]) : wanted, onProgress };
    };
    const prepared = this.#preparation.run((wanted) => makeTracer(this.#connection, source, () => options(wanted)), (tracer) => {
      this.#tracer?.destroy();
      this.#tracer = tracer;
      this.#failed = false;
      this.#restarted();
      this.touch();
    });
    this.#stir();
    return prepared;
  }

  /** The scene as it was edited, on a device that came in place of a lost one. */
  async #rebuild(): Promise<void> {
    const [former, source] = [this.#tracer, this.#source];
    // A scene that is being prepared takes the new device by itself.
    if (former && source && !this.#preparation.running) await this.#prepare(() => source(former), undefined);
  }

  #fail(error: unknown): void {
    this.#failed = true;
    this.#tell('failed');
    this.#host.error(error, () => this.retry());
    this.#stir();
  }

  /** Adds samples until the viewer is destroyed; sleeps where there is nothing to do. */
  async #run(): Promise<void> {
    while (!this.#destroyed) {
      const idle = this.#idleState();
      if (idle || !this.#tracer) {
        // Before the state is told: who hears it may have work at once.
        const woken = new Promise<void>((resolve) => (this.#wake = resolve));
        this.#tell(idle ?? 'empty');
        await woken;
        this.#lastStep = performance.now();
        continue;
      }
      const tracer = this.#tracer;
      this.#interrupt = new AbortController();
      try {
        if (this.#moving()) await this.#previewFrame(tracer);
        else await this.#refine(tracer);
      } catch (error) {
        // Told apart by what follows: a loss is handled where the device announces it.
        await soon();
        await soon();
        if (tracer === this.#tracer && this.#connection.device && !this.#connection.recovery && !this.#destroyed) this.#fail(error);
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
    return this.#done ? 'done' : undefined;
  }

  #moving(): boolean {
    return this.#dirtyCamera || this.#edits.size > 0 || this.#host.moving() || performance.now() < this.#settle;
  }

  /** A picture that is as small as it must be to keep up with hands. */
  async #previewFrame(tracer: PathTracer): Promise<void> {
    // In step with the screen where the GPU keeps up; the first frame, and those of a slow GPU, do not wait for it as well.
    await (performance.now() - this.#lastPreview < SCREEN_MS ? nextFrame() : soon());
    if (tracer !== this.#tracer || this.#destroyed || !this.#visibility.visible) return;
    this.#tell('moving');
    const now = (this.#lastPreview = performance.now());
    const stepped = this.#host.step(Math.max(0, now - this.#lastStep) / 1000);
    this.#lastStep = now;
    const plan = this.#preview.plan(this.#film[0] * this.#film[1]);
    const size = this.#film.map((pixels) => Math.max(1, Math.round(pixels / plan.divisor))) as unknown as Size;
    const changed = stepped || this.#dirtyCamera || this.#edits.size > 0;
    if (stepped || this.#dirtyCamera) {
      // What stands still keeps its size: samples gather.
      this.#films.fit(tracer, size, plan.divisor > 1 ? Math.min(this.settings.previewDepth, this.settings.maxDepth) : this.settings.maxDepth);
      this.#dirtyCamera = false;
      tracer.setCamera(this.#host.camera(this.#film[0] / this.#film[1])).catch((error: unknown) => this.#host.error(error));
      this.#settle = now + this.settings.settleMs;
    }
    this.#edits.apply(() => this.#edited());
    if (changed) this.#restarted();
    const before = tracer.samples;
    // In its full size it is the picture already, and that gets as many samples as were asked for.
    const most = sameSize([tracer.width, tracer.height], this.#film) ? this.#goal : Infinity;
    if (before >= Math.min(PREVIEW_SAMPLES, most) && this.#fresh) return;
    const started = performance.now();
    let samples = before;
    for await (const progress of tracer.render({ samples: Math.min(before + plan.samples, Math.max(most, before)), maxSubmitMs: PREVIEW_SUBMIT_MS })) samples = progress.samples;
    // A film that an edit has restarted meanwhile has none.
    if (tracer !== this.#tracer || this.#destroyed || tracer.samples === 0) return;
    const milliseconds = performance.now() - started;
    if (samples > before) this.#preview.measured(tracer.width * tracer.height, samples - before, milliseconds);
    this.#fresh = true;
    this.#draw(milliseconds);
  }

  /** The picture in full, until it is done or something moves. */
  async #refine(tracer: PathTracer): Promise<void> {
    const { samples, noise, maxSubmitMs, maxDepth } = this.settings;
    this.#tell('rendering');
    if (this.#fresh && !sameSize([tracer.width, tracer.height], this.#film)) this.#connection.display?.keep({ buffer: tracer.beautyBuffer, size: [tracer.width, tracer.height] }, tracer.samples);
    if (this.#films.fit(tracer, this.#film, maxDepth)) this.#fresh = false;
    const { signal } = this.#interrupt;
    for await (const progress of tracer.render({ samples: this.#goal, signal, maxSubmitMs, ...(noise === undefined || this.#paused ? {} : { noise }) })) {
      if (tracer !== this.#tracer) return;
      this.#fresh = true;
      this.#host.sample({ ...progress, targetSamples: samples });
      this.redraw();
      if (this.#moving()) return;
    }
    if (tracer !== this.#tracer || signal.aborted || this.#moving() || this.#destroyed || this.#paused) return;
    // Ended by kernels that came late and restarted the film: once more.
    if (!this.#fresh && tracer.samples === 0) return;
    this.#fresh = true;
    this.#done = true;
    this.#connection.display?.forget();
    this.redraw();
    this.#host.converged(tracer.samples, performance.now() - this.#changed);
  }

  /** Samples of the picture in full. */
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
    this.#changed = performance.now();
    this.#connection.display?.forget();
    this.#host.restarted?.();
  }

  #stir(): void {
    this.#interrupt.abort();
    this.#wake();
  }

  #tell(state: ViewerState): void {
    if (state === this.#state || (this.#destroyed && state !== 'destroyed')) return;
    this.#state = state;
    this.#host.state(state);
  }

  #draw(milliseconds = 0): void {
    const [tracer, { device, display }] = [this.#tracer, this.#connection];
    if (!tracer || !display || !this.#fresh || !device) return;
    const size: Size = [tracer.width, tracer.height];
    const preview = !sameSize(size, this.#film);
    if (preview) display.forget();
    const share = display.kept > 0 ? previewShare(tracer.samples, display.kept, this.settings.samples) : 0;
    if (share === 0) display.forget();
    display.draw({ buffer: tracer.beautyBuffer, size }, this.#canvasSize, share);
    this.#host.drawn(this.#state === 'moving', milliseconds, size);
  }
}
