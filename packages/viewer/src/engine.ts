import { BvhWorkers } from '@glanz/bvh/workers';
import { compressedFormats, PathTracer, requestDevice, type PathTracerOptions, type PrepareProgress, type RenderProgress } from '@glanz/renderer';
import type { Camera, CompressedFormat, Scene } from '@glanz/scene';
import type { ToneMapOptions } from '@glanz/tonemap';
import { Display } from './display';
import { Edits } from './edits';
import { isAbort, ViewerError } from './errors';
import type { ViewerState } from './events';
import { previewShare } from './handover';
import { Losses } from './losses';
import { PreviewController } from './preview';
import { nextFrame, Visibility } from './visibility';

/** What an engine asks of the viewer around it, and tells it. */
export interface EngineHost {
  /** Lets the camera go on; whether it has moved. */
  readonly step: (seconds: number) => boolean;
  /** Whether the camera is on its way, or about to be. */
  readonly moving: () => boolean;
  /** The camera for a picture of this shape. */
  readonly camera: (aspect: number) => Camera;
  readonly state: (state: ViewerState) => void;
  readonly sample: (progress: RenderProgress) => void;
  readonly converged: (samples: number, milliseconds: number) => void;
  readonly drawn: (preview: boolean, milliseconds: number, size: readonly [number, number]) => void;
  readonly error: (error: unknown, retry?: () => void) => void;
  readonly lost: (reason: string) => void;
  readonly restored: (milliseconds: number) => void;
  /** The scene to prepare again on another device. */
  readonly rescue: (tracer: PathTracer) => Scene;
  /** A tracer was made again from that scene. */
  readonly rescued: (tracer: PathTracer) => void;
}

/** How the engine works; may change at any time. */
export interface EngineSettings extends ToneMapOptions {
  samples: number;
  noise: number | undefined;
  maxDepth: number;
  background: 'environment' | 'transparent';
  maxSubmitMs: number;
  readonly settleMs: number;
  readonly previewDepth: number;
  readonly tracer: Partial<PathTracerOptions>;
  readonly requestDevice: (() => Promise<GPUDevice>) | undefined;
}

/** Samples after which a preview that stands still has no more to gain. */
const PREVIEW_SAMPLES = 16;
/** Milliseconds of one submission of the preview: it shall be one. */
const PREVIEW_SUBMIT_MS = 50;

/** Pauses between attempts to get a device back. */
const RECONNECT_MS = [100, 300, 1000];

type Size = readonly [number, number];
const sameSize = (a: Size, b: Size) => a[0] === b[0] && a[1] === b[1];
const soon = () => new Promise<void>((resolve) => setTimeout(resolve, 0));

/**
 * Device, tracer and canvas: shows a small preview while something moves, refines the picture when it rests, sleeps when
 * there is nothing to do or nobody sees it, and comes back after the device was lost.
 */
export class Engine {
  readonly settings: EngineSettings;
  readonly #canvas: HTMLCanvasElement;
  readonly #host: EngineHost;
  readonly #edits = new Edits();
  readonly #losses = new Losses();
  readonly #visibility: Visibility;
  readonly #preview: PreviewController;
  #ready: Promise<void>;
  #device: GPUDevice | undefined;
  #display: Display | undefined;
  #workers: Promise<BvhWorkers> | undefined;
  #tracer: PathTracer | undefined;
  #film: Size = [1, 1];
  #canvasSize: Size = [1, 1];
  #state: ViewerState = 'empty';
  #preparing: AbortController | undefined;
  #recovery: Promise<void> | undefined;
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
  #frame = 0;
  #interrupt = new AbortController();
  #wake: () => void = () => undefined;

  constructor(canvas: HTMLCanvasElement, settings: EngineSettings, budgetMs: number, host: EngineHost) {
    this.#canvas = canvas;
    this.settings = settings;
    this.#host = host;
    this.#preview = new PreviewController(budgetMs);
    this.#visibility = new Visibility(canvas, () => this.#stir());
    this.#ready = this.#connect();
    // Whoever waits for it is told; a page without a model is not.
    this.#ready.catch(() => undefined);
    void this.#run();
  }

  get tracer(): PathTracer | undefined {
    return this.#tracer;
  }

  get device(): GPUDevice | undefined {
    return this.#device;
  }

  /** What the device reads of compressed formats, once there is one; none where there will be none. */
  async compressedFormats(): Promise<readonly CompressedFormat[]> {
    await this.#ready.catch(() => undefined);
    return this.#device ? compressedFormats(this.#device) : [];
  }

  get state(): ViewerState {
    return this.#state;
  }

  /** Whether the film shows the whole picture as it is now. */
  get current(): boolean {
    return this.#fresh && !this.#moving() && !!this.#tracer && sameSize([this.#tracer.width, this.#tracer.height], this.#film);
  }

  get paused(): boolean {
    return this.#paused;
  }

  set paused(paused: boolean) {
    this.#paused = paused;
    this.#stir();
  }

  /** Shows another scene. Until it is ready the former one stays, and it stays for good where this fails. */
  async show(scene: Scene, camera: Camera, signal: AbortSignal, onProgress: (progress: PrepareProgress) => void): Promise<PathTracer> {
    // One that failed before is asked for again.
    await (this.#ready = this.#ready.catch(() => (this.#destroyed ? Promise.reject(new ViewerError('viewer/destroyed', 'This viewer has been destroyed.')) : this.#connect())));
    this.#edits.clear(new DOMException('another scene was shown', 'AbortError'));
    return this.#prepare(scene, camera, signal, onProgress);
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
    await this.#display?.setView(view);
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
    this.#losses.forgive();
    this.#failed = false;
    if (this.#tracer && !this.#device) this.#recover('retry');
    else this.#stir();
  }

  destroy(): void {
    if (this.#destroyed) return;
    this.#destroyed = true;
    this.#stir();
    this.#preparing?.abort(new DOMException('the viewer was destroyed', 'AbortError'));
    this.#edits.clear(new DOMException('the viewer was destroyed', 'AbortError'));
    cancelAnimationFrame(this.#frame);
    this.#visibility.destroy();
    this.#tracer?.destroy();
    this.#display?.destroy();
    this.#device?.destroy();
    void this.#workers?.then((workers) => workers.destroy());
    this.#tracer = this.#display = this.#device = undefined;
    this.#tell('destroyed');
  }

  async #connect(): Promise<void> {
    const device = await (this.settings.requestDevice ?? requestDevice)();
    try {
      if (this.#destroyed) throw new ViewerError('viewer/destroyed', 'This viewer has been destroyed.');
      const { exposure = 0, toneMap = 'neutral' } = this.settings;
      const display = await Display.create(this.#canvas, device, { exposure, toneMap });
      if (this.#destroyed) {
        display.destroy();
        throw new ViewerError('viewer/destroyed', 'This viewer has been destroyed.');
      }
      this.#display = display;
      // What was changed while it was made.
      await display.setView({ exposure: this.settings.exposure ?? 0, toneMap: this.settings.toneMap ?? 'neutral' });
    } catch (error) {
      device.destroy();
      throw error;
    }
    this.#device = device;
    // They warm up while the first model loads.
    this.#workers ??= BvhWorkers.create({ warmUp: true });
    device.addEventListener('uncapturederror', (event) => {
      event.preventDefault();
      if (device === this.#device) this.#host.error(new ViewerError('viewer/gpu', `The GPU reports: ${event.error.message}`));
    });
    void device.lost.then(({ reason, message }) => {
      if (device !== this.#device || this.#destroyed) return;
      this.#device = undefined;
      this.#host.lost(`${reason}${message ? `: ${message}` : ''}`);
      this.#recover(reason);
    });
  }

  /** After a loss a browser may have no adapter for a while. */
  async #reconnect(): Promise<void> {
    for (const wait of RECONNECT_MS) {
      try {
        return await this.#connect();
      } catch {
        if (this.#destroyed) break;
        await new Promise((resolve) => setTimeout(resolve, wait));
      }
    }
    return this.#connect();
  }

  async #prepare(scene: Scene, camera: Camera, signal: AbortSignal, onProgress: (progress: PrepareProgress) => void): Promise<PathTracer> {
    this.#preparing?.abort(new DOMException('another scene was asked for', 'AbortError'));
    const preparing = (this.#preparing = new AbortController());
    this.#stir();
    try {
      const tracer = await this.#createTracer(scene, camera, AbortSignal.any([signal, preparing.signal]), onProgress);
      if (preparing.signal.aborted || this.#destroyed) {
        tracer.destroy();
        preparing.signal.throwIfAborted();
        throw new ViewerError('viewer/destroyed', 'This viewer has been destroyed.');
      }
      this.#tracer?.destroy();
      this.#tracer = tracer;
      this.#display?.forget();
      this.#failed = false;
      this.#restarted();
      this.touch();
      return tracer;
    } finally {
      if (this.#preparing === preparing) {
        this.#preparing = undefined;
        this.#wake();
      }
    }
  }

  /** Creates a tracer; where the device is lost meanwhile, once more on the next one. */
  async #createTracer(scene: Scene, camera: Camera, signal: AbortSignal, onProgress: (progress: PrepareProgress) => void): Promise<PathTracer> {
    for (let attempt = 0; ; attempt++) {
      await this.#recovery;
      const device = this.#device;
      if (!device) throw new ViewerError('viewer/device-lost', 'The GPU was lost and has not come back.');
      const hierarchies = await this.#workers;
      const [width, height] = this.#film;
      const { maxDepth, background, tracer } = this.settings;
      try {
        return await PathTracer.create(device, scene, { ...tracer, width, height, maxDepth, background, camera, signal, onProgress, ...(hierarchies ? { hierarchies } : {}) });
      } catch (error) {
        // The news of a loss may come later than its consequences.
        await soon();
        if (attempt > 0 || isAbort(error) || device === this.#device) throw error;
      }
    }
  }

  /** A new device in place of a lost one, with the scene as it was edited. */
  #recover(reason: string): void {
    const started = performance.now();
    const attempt = async () => {
      this.#fresh = false;
      this.#display?.destroy();
      this.#display = undefined;
      this.#tell('recovering');
      // A device that somebody destroyed on purpose does not come back by waiting.
      if (reason !== 'retry') await this.#losses.next();
      await this.#reconnect();
      this.#recovery = undefined;
      const former = this.#tracer;
      // A scene that is being prepared takes the new device by itself.
      if (former && !this.#preparing) {
        const { signal } = new AbortController();
        this.#host.rescued(await this.#prepare(this.#host.rescue(former), former.camera, signal, () => undefined));
      }
      if (!this.#destroyed) this.#host.restored(performance.now() - started);
    };
    this.#stir();
    this.#recovery = attempt().catch((error: unknown) => {
      this.#recovery = undefined;
      if (this.#destroyed || isAbort(error)) return;
      this.#failed = true;
      this.#tell('failed');
      this.#host.error(error, () => this.retry());
    });
  }

  /** Adds samples until the viewer is destroyed; sleeps where there is nothing to do. */
  async #run(): Promise<void> {
    while (!this.#destroyed) {
      const idle = this.#idleState();
      if (idle || !this.#tracer) {
        this.#tell(idle ?? 'empty');
        await new Promise<void>((resolve) => (this.#wake = resolve));
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
        if (tracer === this.#tracer && this.#device && !this.#recovery && !this.#destroyed) {
          this.#failed = true;
          this.#host.error(error, () => this.retry());
        }
      }
    }
  }

  /** Why nothing is to be computed, or undefined. */
  #idleState(): ViewerState | undefined {
    if (this.#failed) return 'failed';
    if (this.#recovery || (this.#tracer && !this.#device)) return 'recovering';
    if (this.#preparing) return 'loading';
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
    await nextFrame();
    if (tracer !== this.#tracer || this.#destroyed || !this.#visibility.visible) return;
    this.#tell('moving');
    const now = performance.now();
    const stepped = this.#host.step(Math.max(0, now - this.#lastStep) / 1000);
    this.#lastStep = now;
    const plan = this.#preview.plan(this.#film[0] * this.#film[1]);
    const size = this.#film.map((pixels) => Math.max(1, Math.round(pixels / plan.divisor))) as unknown as Size;
    const changed = stepped || this.#dirtyCamera || this.#edits.size > 0;
    if (stepped || this.#dirtyCamera) {
      // What stands still keeps its size: samples gather.
      this.#fit(tracer, size, plan.divisor > 1 ? Math.min(this.settings.previewDepth, this.settings.maxDepth) : this.settings.maxDepth);
      this.#dirtyCamera = false;
      tracer.setCamera(this.#host.camera(this.#film[0] / this.#film[1])).catch((error: unknown) => this.#host.error(error));
      this.#settle = now + this.settings.settleMs;
    }
    this.#edits.apply(() => this.#edited());
    if (changed) this.#restarted();
    const before = tracer.samples;
    if (before >= PREVIEW_SAMPLES && this.#fresh) return;
    const started = performance.now();
    let samples = before;
    for await (const progress of tracer.render({ samples: before + plan.samples, maxSubmitMs: PREVIEW_SUBMIT_MS })) samples = progress.samples;
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
    if (this.#fresh && !sameSize([tracer.width, tracer.height], this.#film)) this.#display?.keep({ buffer: tracer.beautyBuffer, size: [tracer.width, tracer.height] }, tracer.samples);
    if (this.#fit(tracer, this.#film, maxDepth)) this.#fresh = false;
    const { signal } = this.#interrupt;
    const goal = this.#paused ? 1 : samples;
    for await (const progress of tracer.render({ samples: goal, signal, maxSubmitMs, ...(noise === undefined || this.#paused ? {} : { noise }) })) {
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
    this.#display?.forget();
    this.redraw();
    this.#host.converged(tracer.samples, performance.now() - this.#changed);
  }

  /** Gives the film a size and a depth. @returns Whether it was restarted. */
  #fit(tracer: PathTracer, [width, height]: Size, depth: number): boolean {
    const resized = tracer.width !== width || tracer.height !== height;
    const deeper = this.#depths.get(tracer) !== depth;
    if (resized) tracer.resize(width, height);
    if (deeper) {
      tracer.setDepth(depth);
      this.#depths.set(tracer, depth);
    }
    return resized || deeper;
  }

  /** Depths that tracers have been given. */
  readonly #depths = new WeakMap<PathTracer, number>();

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
    this.#display?.forget();
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
    const [tracer, display] = [this.#tracer, this.#display];
    if (!tracer || !display || !this.#fresh || !this.#device) return;
    const size: Size = [tracer.width, tracer.height];
    const preview = !sameSize(size, this.#film);
    if (preview) display.forget();
    const share = display.kept > 0 ? previewShare(tracer.samples, display.kept, this.settings.samples) : 0;
    if (share === 0) display.forget();
    display.draw({ buffer: tracer.beautyBuffer, size }, this.#canvasSize, share);
    this.#host.drawn(this.#state === 'moving', milliseconds, size);
  }
}
