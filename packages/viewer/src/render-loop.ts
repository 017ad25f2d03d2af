import type { PathTracer } from '@glanz/renderer';
import { watchBattery } from './battery';
import { previewWeight } from './crossfade';
import type { Display, GpuImage } from './display';
import { Edits } from './edits';
import type { EngineHost, EngineSettings } from './engine-host';
import { abortError, isLoss } from './aborts';
import type { ViewerState } from './events';
import { FilmFit, sameSize, scaledSize } from './film-fit';
import { FilmKeeper } from './film-keeper';
import { PreviewController } from './preview';
import { PreviewReuse } from './preview-reuse';
import { nextFrame, soon, Visibility } from './visibility';

/** Samples after which a preview that does not move is as good as it can be. */
const PREVIEW_SAMPLES = 16;
/** A frame that began so many milliseconds ago was not of this frame of the screen. */
const SCREEN_MS = 15;
/** Milliseconds of one submission of the preview: it shall be one. */
const PREVIEW_SUBMIT_MS = 50;

/** Width and height, pixels. */
export type Size = readonly [number, number];

/** What a {@link RenderLoop} requests from its engine, and reports to it. */
export interface LoopEngine {
  /** The display of the canvas, while there is a device. */
  readonly display: () => Display | undefined;
  /** Why nothing can be rendered at present, or undefined. */
  readonly blocked: () => ViewerState | undefined;
  /** Whether a tracer is the one that is shown, on a device that is not lost. */
  readonly isCurrent: (tracer: PathTracer | undefined) => boolean;
  readonly failed: (error: unknown) => void;
  /** The device of the tracer. */
  readonly device: () => GPUDevice | undefined;
}

const sizeOf = (tracer: PathTracer): Size => [tracer.width, tracer.height];
const imageOf = (tracer: PathTracer): GpuImage => ({ buffer: tracer.beautyBuffer, size: sizeOf(tracer) });

/**
 * Renders a tracer's film to a canvas: a small preview while something moves, then the image until it is done. Sleeps
 * when there is nothing to do or the canvas is out of sight.
 */
export class RenderLoop {
  /** Those that wait for the next frame. */
  readonly edits = new Edits();
  /** Sizes of the films of tracers. */
  readonly films = new FilmFit();
  readonly #settings: EngineSettings;
  readonly #host: EngineHost;
  readonly #engine: LoopEngine;
  readonly #visibility: Visibility;
  readonly #keeper = new FilmKeeper();
  readonly #preview: PreviewController;
  readonly #saving = watchBattery();
  readonly #reuse: PreviewReuse;
  #tracer: PathTracer | undefined;
  #state: ViewerState = 'empty';
  #film: Size = [1, 1];
  #canvasSize: Size = [1, 1];
  #paused = false;
  /** Whether the film holds a sample since it was last cleared. */
  #fresh = false;
  #done = false;
  /** Whether a film that the GPU has no memory for was reported. */
  #smaller = false;
  /** The time has come to try the whole size again. */
  #growing = false;
  #dirtyCamera = true;
  /** When the preview ends, if nothing moves until then. */
  #settle = 0;
  #changed = 0;
  #lastStep = 0;
  #lastPreview = -Infinity;
  #frame = 0;
  /** Effects of edits and cameras that wait for their kernels: until then, the film shows what was there before. */
  readonly #late = new Set<Promise<unknown>>();
  #interrupt = new AbortController();
  #wake: () => void = () => undefined;

  constructor(
    canvas: HTMLCanvasElement,
    settings: EngineSettings,
    budgetMs: number,
    host: EngineHost,
    engine: LoopEngine,
  ) {
    this.#settings = settings;
    this.#host = host;
    this.#engine = engine;
    this.#preview = new PreviewController(budgetMs);
    this.#reuse = new PreviewReuse(() => settings.previewMode ?? 'auto', engine.device);
    this.#visibility = new Visibility(canvas, () => this.stir());
  }

  /** The tracer that is shown. */
  get tracer(): PathTracer | undefined {
    return this.#tracer;
  }

  get state(): ViewerState {
    return this.#state;
  }

  set state(state: ViewerState) {
    if (state === this.#state || this.#state === 'destroyed') return;
    this.#state = state;
    this.#host.state(state);
  }

  /** See `Engine.fresh`. */
  get fresh(): boolean {
    return this.#fresh;
  }

  /** See `Engine.current`. */
  get current(): boolean {
    return this.#fresh && !this.#moving && this.#whole;
  }

  /** Whether the film is one of the image in full. */
  get #whole(): boolean {
    return !!this.#tracer && !this.#reuse.shifted && sameSize(sizeOf(this.#tracer), this.imageSize);
  }

  /** Pixels of the image in full, as far as the GPU has memory for them. */
  get imageSize(): Size {
    return this.films.sizeFor(this.#film);
  }

  get paused(): boolean {
    return this.#paused;
  }

  set paused(paused: boolean) {
    this.#paused = paused;
    this.stir();
  }

  /** Adds samples until the viewer is destroyed; sleeps where there is nothing to do. */
  async run(): Promise<void> {
    while (this.#state !== 'destroyed') {
      const idle = this.#idleState();
      const tracer = this.#tracer;
      if (idle || !tracer) {
        await this.#sleep(idle ?? 'empty');
        continue;
      }
      this.#interrupt = new AbortController();
      try {
        if (this.#moving) await this.#previewFrame(tracer);
        else if (this.#growing) await this.#grow(tracer);
        else await this.#refine(tracer);
      } catch (error) {
        // A loss of the device shows in what follows; it is handled where the device reports it.
        await soon();
        await soon();
        this.#fail(error, tracer);
      }
    }
  }

  /** Shows another tracer. @param restored Whether its film holds the samples of the image already. */
  show(tracer: PathTracer, restored: boolean): void {
    // Code that reads the canvas's size before the first image is drawn gets its final size.
    if (!this.#tracer) this.#engine.display()?.resize(this.#canvasSize);
    this.#reuse.drop();
    this.#tracer?.destroy();
    this.#tracer = tracer;
    this.#late.clear();
    if (restored) {
      this.#fresh = true;
      this.#done = false;
      this.redraw();
    } else this.#restarted();
  }

  /** Puts the samples that were kept into the film of a new tracer. @returns Whether they are in it. */
  async restore(tracer: PathTracer): Promise<boolean> {
    const { kept } = this.#keeper;
    // A view or a scene that has changed since is another image.
    if (!kept || this.#moving) return false;
    try {
      await tracer.restoreFilm(kept);
    } catch {
      return false;
    }
    return !this.#moving && kept === this.#keeper.kept;
  }

  /** The device is gone, and the film with it. */
  lose(): void {
    this.#reuse.drop();
    this.#fresh = false;
    this.state = 'recovering';
    this.stir();
  }

  /** See `Engine.edit`. */
  edit(
    key: unknown,
    apply: (tracer: PathTracer, merged: object) => void | Promise<void>,
    value: object,
  ): Promise<void> {
    return this.edits.add(key, (merged) => (this.#tracer ? apply(this.#tracer, merged) : undefined), value);
  }

  /** See `Engine.touch`. */
  touch(): void {
    this.#dirtyCamera = true;
    this.#settle = performance.now() + this.#settings.settleMs;
    this.stir();
  }

  /** See `Engine.resize`. @returns Whether a size is another one. */
  resize(film: Size, canvas: Size): boolean {
    const sameFilm = sameSize(film, this.#film);
    if (sameFilm && sameSize(canvas, this.#canvasSize)) return false;
    if (!sameFilm) this.films.forget();
    this.#film = film;
    this.#canvasSize = canvas;
    return true;
  }

  /** See `Engine.restart`. */
  restart(): void {
    this.#done = false;
    this.stir();
  }

  /** See `Engine.redraw`. */
  redraw(): void {
    cancelAnimationFrame(this.#frame);
    this.#frame = requestAnimationFrame(() => {
      try {
        this.#draw();
      } catch (error) {
        this.#fail(error, this.#tracer);
      }
    });
  }

  /** Interrupts what is being rendered, or the sleep: something has changed. */
  stir(): void {
    this.#interrupt.abort();
    this.#wake();
  }

  /** Ends the loop and frees the tracer. */
  destroy(): void {
    this.stir();
    this.edits.clear(abortError());
    cancelAnimationFrame(this.#frame);
    this.#visibility.destroy();
    this.#reuse.drop();
    this.#tracer?.destroy();
    this.#tracer = undefined;
  }

  /** What happens to a tracer whose device was lost is no failure: another one takes its place. */
  #fail(error: unknown, tracer: PathTracer | undefined): void {
    if (this.#engine.isCurrent(tracer)) this.#engine.failed(error);
  }

  /** Waits until something changes. */
  async #sleep(state: ViewerState): Promise<void> {
    // Before the state is emitted: a listener may request work at once.
    const woken = new Promise<void>((resolve) => (this.#wake = resolve));
    this.state = state;
    const grow = () => {
      this.#growing = true;
      this.stir();
    };
    const retry = state === 'done' && this.#smaller ? setTimeout(grow, this.films.retryMs) : undefined;
    await woken;
    clearTimeout(retry);
    this.#lastStep = performance.now();
  }

  /** Why nothing is to be computed, or undefined. */
  #idleState(): ViewerState | undefined {
    const blocked = this.#engine.blocked();
    if (blocked) return blocked;
    if (!this.#visibility.visible) return 'hidden';
    if (this.#moving) return undefined;
    if (this.#paused && this.current) return 'paused';
    return this.#done && !this.#growing ? 'done' : undefined;
  }

  get #moving(): boolean {
    return this.#dirtyCamera || this.edits.size > 0 || this.#host.moving() || performance.now() < this.#settle;
  }

  /** An image that is as small as it must be to keep up with the controls. */
  async #previewFrame(tracer: PathTracer): Promise<void> {
    // In step with the screen where the GPU keeps up; the first frame, and those of a slow GPU, do not wait for it as
    // well.
    await (performance.now() - this.#lastPreview < SCREEN_MS ? nextFrame() : soon());
    if (tracer !== this.#tracer || !this.#visibility.visible) return;
    this.state = 'moving';
    const { settleMs, previewDepth, maxDepth } = this.#settings;
    const now = (this.#lastPreview = performance.now());
    const stepped = this.#host.step(Math.max(0, now - this.#lastStep) / 1000);
    this.#lastStep = now;
    const full = this.imageSize;
    const plan = this.#preview.plan(full[0] * full[1], this.#saving());
    const turned = stepped || this.#dirtyCamera;
    const edited = this.edits.size > 0;
    const changed = turned || edited;
    if (turned) {
      this.#reuse.begin(tracer);
      // A preview that does not move keeps its size: samples gather.
      const depth = plan.divisor > 1 ? Math.min(previewDepth, maxDepth) : maxDepth;
      await this.#fit(tracer, full, depth, 1 / plan.divisor);
      if (tracer !== this.#tracer) return;
      this.#dirtyCamera = false;
      this.#follow(
        tracer.setCamera(this.#host.camera(this.#film[0] / this.#film[1])).then(
          // Kernels of another kind of camera came late and cleared the film.
          () => this.#fresh && this.#tracer?.samples === 0 && this.#edited(),
          (error: unknown) => this.#engine.isCurrent(tracer) && this.#host.error(error),
        ),
      );
      this.#settle = now + settleMs;
    }
    this.edits.apply((effect) => this.#follow(effect.then(() => this.#edited())));
    if (changed) this.#restarted();
    const before = tracer.samples;
    if (edited && before === 0) this.#reuse.begin(tracer);
    // In its full size it is the image already, and that gets the requested samples.
    const max = this.#whole ? this.#goal : Infinity;
    if (before >= Math.min(PREVIEW_SAMPLES, max) && this.#fresh) return;
    const started = performance.now();
    let samples = before;
    let milliseconds = 0;
    const options = {
      samples: Math.min(before + plan.samples, Math.max(max, before)),
      maxSubmitMs: PREVIEW_SUBMIT_MS,
    };
    for await (const progress of this.#reuse.render(tracer, options, edited)) {
      ({ samples } = progress);
      milliseconds = performance.now() - started;
      if (!this.#visibility.visible) break;
    }
    // A film that an edit has restarted meanwhile has none.
    if (tracer !== this.#tracer || tracer.samples === 0) return;
    if (samples > before) this.#preview.measured(tracer.width * tracer.height, samples - before, milliseconds);
    this.#fresh = true;
    this.#draw(milliseconds);
  }

  /** The image in full, until it is done or something moves. */
  async #refine(tracer: PathTracer): Promise<void> {
    const { samples, noise, maxSubmitMs, maxDepth, keepSamples } = this.#settings;
    this.state = 'rendering';
    const full = this.imageSize;
    const { image } = this.#reuse;
    if (this.#fresh && (image || !sameSize(sizeOf(tracer), full)))
      void this.#engine.display()?.keep(image ?? imageOf(tracer), image ? Infinity : tracer.samples, full);
    this.#reuse.forget();
    if (this.#reuse.shifted) {
      this.#reuse.rest();
      this.#fresh = false;
    }
    if (await this.#fit(tracer, full, maxDepth)) this.#fresh = false;
    // Another size may be wanted by now, or is all that there is memory for.
    if (tracer !== this.#tracer || this.#moving || !sameSize(sizeOf(tracer), this.imageSize)) return;
    const { signal } = this.#interrupt;
    for await (const progress of tracer.render({
      samples: this.#goal,
      signal,
      maxSubmitMs,
      ...(noise === undefined || this.#paused ? {} : { noise }),
    })) {
      if (tracer !== this.#tracer) return;
      this.#fresh = true;
      this.#host.sample({ ...progress, targetSamples: samples }, !!this.#settings.denoise?.image(tracer));
      if (keepSamples !== false) this.#keeper.offer(tracer, false);
      this.redraw();
      await this.#denoise(tracer, signal);
      if (this.#moving) return;
    }
    await this.#denoise(tracer, signal, true);
    if (tracer !== this.#tracer || signal.aborted || this.#moving) return;
    // Ended by kernels that came late and restarted the film: once more.
    if (tracer.samples === 0) return;
    // Samples that were on their way when an earlier run was interrupted were not reported.
    this.#fresh = true;
    if (this.#paused) return this.redraw();
    // It shows what was there before an edit; the edit's kernels wake the loop.
    if (this.#late.size) return this.#sleep(this.state);
    this.#done = true;
    if (keepSamples !== false) this.#keeper.offer(tracer, true);
    this.#engine.display()?.forget();
    this.#reuse.release();
    this.redraw();
    this.#host.converged(tracer.samples, performance.now() - this.#changed);
  }

  /**
   * Gives the film a size; where the GPU has no memory for it, the film keeps what it has. @returns Whether it was
   * restarted.
   */
  async #fit(tracer: PathTracer, size: Size, depth: number, scale = 1): Promise<boolean> {
    try {
      const restarted = await this.films.fit(tracer, size, depth, scale);
      if (scale === 1 && sameSize(size, this.#film)) this.#smaller = false;
      return restarted;
    } catch (error) {
      // A lost device refuses nothing: its successor may have memory for all of it.
      if (!this.#engine.isCurrent(tracer) || isLoss(error)) throw error;
      this.films.refuse(tracer, scaledSize(size, scale));
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
    const display = this.#engine.display();
    void display?.keep(imageOf(tracer), tracer.samples, this.#film);
    if (await this.films.grow(tracer, this.#film)) this.#smaller = this.#fresh = this.#done = false;
    else display?.forget();
  }

  /** Shows the film denoised, where that is asked for and due. */
  async #denoise(tracer: PathTracer, signal: AbortSignal, last?: boolean): Promise<void> {
    if (await this.#settings.denoise?.offer(tracer, signal, last)) this.redraw();
  }

  /** Samples of the image in full. */
  get #goal(): number {
    return this.#paused ? 1 : this.#settings.samples;
  }

  /** Keeps the image from being done until something has taken effect. */
  #follow(effect: Promise<unknown>): void {
    this.#late.add(effect);
    void effect.finally(() => this.#late.delete(effect) && this.#wake());
  }

  /** An edit has taken effect, perhaps by kernels that came late and restarted the film. */
  #edited(): void {
    this.#restarted();
    this.#settle = performance.now() + this.#settings.settleMs;
    this.stir();
  }

  #restarted(): void {
    this.#fresh = false;
    this.#done = false;
    this.#keeper.clear();
    this.#changed = performance.now();
    this.#engine.display()?.forget();
    this.#reuse.forget();
    this.#settings.denoise?.forget();
    this.#host.restarted?.();
  }

  #draw(milliseconds = 0): void {
    const tracer = this.#tracer;
    const display = this.#engine.display();
    if (!tracer || !display || !this.#fresh) return;
    const denoised = this.#settings.denoise?.image(tracer);
    const image = denoised ?? this.#reuse.image ?? imageOf(tracer);
    if (denoised || !sameSize(image.size, this.imageSize)) display.forget();
    const weight = display.kept > 0 ? previewWeight(tracer.samples, display.kept, this.#settings.samples) : 0;
    if (weight === 0 && display.kept > 0) display.forget();
    display.draw(image, this.#canvasSize, weight);
    this.#host.drawn(this.#state === 'moving', milliseconds, image.size, !!(denoised ?? this.#reuse.image));
  }
}
