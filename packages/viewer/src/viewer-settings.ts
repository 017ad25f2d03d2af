import type { PathTracer } from '@glanz/renderer';
import { RENDER_OPTIONS } from '@glanz/renderer/options';
import { GlanzError, untilAborted, type Scene } from '@glanz/scene';
import { checkToneMapOptions, type ToneMap } from '@glanz/tonemap';
import { checkedOption, checkedSetting, checkSettings } from './checks';
import { Emitter } from './emitter';
import { Engine, type EngineHost } from './engine';
import { isAbort, ViewerError } from './errors';
import type { ViewerEvents, ViewerState } from './events';
import type { EnvironmentSource } from './load';
import type { ViewerOptions } from './options';
import { imageSize } from './image-size';
import { ViewerEnvironment } from './viewer-environment';

/** @throws {ViewerError} `viewer/no-canvas`, `viewer/option`; {ToneMapError} `tonemap/unknown`. */
function checkOptions(canvas: HTMLCanvasElement, options: ViewerOptions): void {
  if (typeof (canvas as HTMLCanvasElement | null)?.getContext !== 'function')
    throw new ViewerError('viewer/no-canvas', 'A viewer draws on a canvas element: pass one as the first argument.');
  checkSettings(options);
  if (options.toneMap !== undefined) checkToneMapOptions({ toneMap: options.toneMap });
}

/**
 * What of a {@link Viewer} can be set at any time: light, finishing, quality. Setting a property to what it cannot be
 * (NaN, an infinity, another type, a number outside of its range) throws a {@link ViewerError} `viewer/option` and
 * changes nothing.
 */
export abstract class ViewerSettings extends Emitter<ViewerEvents> {
  /** The canvas that it draws on. */
  readonly canvas: HTMLCanvasElement;
  /** @internal */
  protected readonly engine: Engine;
  /** @internal */
  protected readonly options: ViewerOptions;
  /** @internal */
  protected readonly environment: ViewerEnvironment;
  /** @internal As the model came. */
  protected loaded: Scene | undefined;
  readonly #resize: ResizeObserver;
  #pixelRatio: number | undefined;
  #lighting: AbortController | undefined;

  /** @internal Use {@link createViewer}. */
  constructor(canvas: HTMLCanvasElement, options: ViewerOptions) {
    super();
    options.signal?.throwIfAborted();
    checkOptions(canvas, options);
    this.canvas = canvas;
    this.options = options;
    this.environment = new ViewerEnvironment(
      options.environment,
      options.environmentIntensity,
      options.environmentRotation,
    );
    this.#pixelRatio = options.pixelRatio;
    const { preview = {} } = options;
    this.engine = new Engine(
      canvas,
      {
        samples: options.samples ?? RENDER_OPTIONS.samples.default,
        noise: options.noise || undefined,
        maxDepth: options.maxDepth ?? RENDER_OPTIONS.maxDepth.default,
        background: options.background ?? RENDER_OPTIONS.background.default,
        exposure: options.exposure ?? 0,
        toneMap: options.toneMap ?? 'neutral',
        maxSubmitMs: options.maxSubmitMs ?? RENDER_OPTIONS.maxSubmitMs.default,
        settleMs: preview.settleMs ?? 180,
        previewDepth: preview.maxDepth ?? 4,
        tracer: options.tracer ?? {},
        requestDevice: options.requestDevice,
        warmUp: options.warmUp,
        keepSamples: options.keepSamples,
      },
      preview.budgetMs ?? 12,
      {
        ...this.cameraHost(),
        state: (state) => this.emit('state', { state }),
        sample: ({ samples, targetSamples, samplesPerSecond, remainingMs }) =>
          this.emit('sample', { samples, target: targetSamples, samplesPerSecond, remainingMs }),
        converged: (samples, milliseconds) => this.emit('converged', { samples, milliseconds }),
        drawn: (preview, milliseconds, [width, height]) => this.emit('frame', { preview, milliseconds, width, height }),
        error: (error, retry) => this.fail(error, retry),
        missing: (error) =>
          this.warn(
            error instanceof GlanzError
              ? error
              : new ViewerError('viewer/gpu', `There is no GPU: ${String(error)}`, { cause: error }),
          ),
        lost: (reason) => this.emit('device-lost', { reason }),
        restored: (milliseconds, samples) => this.emit('device-restored', { milliseconds, ...samples }),
      },
    );
    this.#resize = new ResizeObserver(() => this.#resized());
    this.#resize.observe(canvas);
    this.#resized();
  }

  /** @internal What moves the camera. */
  protected abstract cameraHost(): Pick<EngineHost, 'step' | 'moving' | 'camera'>;

  /** What it is doing. */
  get state(): ViewerState {
    return this.engine.state;
  }

  /** The scene as it has been edited; `undefined` before the first one is there. Read only. */
  get scene(): Scene | undefined {
    return this.engine.tracer?.scene;
  }

  /**
   * The path tracer of the present scene, for what the viewer has no word for. Another one after each load and each
   * loss of the device.
   */
  get tracer(): PathTracer | undefined {
    return this.engine.tracer;
  }

  /** The GPU device in use; another one after each loss. */
  get device(): GPUDevice | undefined {
    return this.engine.device;
  }

  /** Samples per pixel of the image as it is. */
  get sampleCount(): number {
    return this.engine.current ? (this.engine.tracer?.samples ?? 0) : 0;
  }

  /**
   * Another environment. It also serves the models that are loaded later. A later call aborts an earlier one.
   * @returns When the image shows it.
   * @throws {ViewerError} `viewer/environment`; {ImageError} for an image that cannot be read; {SceneError} for data
   * that is no environment; {DeviceError} where the GPU has no memory for it. The former one stays.
   * @throws the signal's reason, or an `AbortError`, when aborted.
   */
  async setEnvironment(source: EnvironmentSource, options: { readonly signal?: AbortSignal } = {}): Promise<void> {
    this.check();
    this.#lighting?.abort(new DOMException('another environment was asked for', 'AbortError'));
    const lighting = (this.#lighting = new AbortController());
    const signal = options.signal ? AbortSignal.any([options.signal, lighting.signal]) : lighting.signal;
    try {
      await untilAborted(this.environment.change(source, this.loaded, signal), signal);
    } finally {
      if (this.#lighting === lighting) this.#lighting = undefined;
    }
    await this.#relight();
  }

  /** See {@link ViewerOptions.environmentIntensity}. */
  get environmentIntensity(): number {
    return this.environment.intensity;
  }

  set environmentIntensity(intensity: number) {
    if (checkedSetting('environmentIntensity', intensity) === this.environment.intensity) return;
    this.environment.adjust({ intensity }, this.scene !== undefined);
    this.#quietly(this.#relight());
  }

  /** See {@link ViewerOptions.environmentRotation}. */
  get environmentRotation(): number {
    return this.environment.rotation;
  }

  set environmentRotation(rotation: number) {
    if (checkedSetting('environmentRotation', rotation) === this.environment.rotation) return;
    this.environment.adjust({ rotation }, this.scene !== undefined);
    this.#quietly(this.#relight());
  }

  /** See {@link ViewerOptions.background}. */
  get background(): 'environment' | 'transparent' {
    return this.engine.settings.background;
  }

  set background(background: 'environment' | 'transparent') {
    if (checkedOption('background', background) === this.engine.settings.background) return;
    this.engine.settings.background = background;
    this.#quietly(this.engine.edit('background', (tracer) => tracer.setBackground(background)));
  }

  /** See {@link ViewerOptions.exposure}. */
  get exposure(): number {
    return this.engine.settings.exposure ?? 0;
  }

  set exposure(exposure: number) {
    if (checkedSetting('exposure', exposure) !== this.exposure) this.#quietly(this.engine.setView({ exposure }));
  }

  /** See {@link ViewerOptions.toneMap}. Setting an unknown one throws {ToneMapError} `tonemap/unknown`. */
  get toneMap(): ToneMap {
    return this.engine.settings.toneMap ?? 'neutral';
  }

  set toneMap(toneMap: ToneMap) {
    checkToneMapOptions({ toneMap });
    if (toneMap !== this.toneMap) this.#quietly(this.engine.setView({ toneMap }));
  }

  /** See {@link ViewerOptions.samples}. */
  get samples(): number {
    return this.engine.settings.samples;
  }

  set samples(samples: number) {
    if (checkedOption('samples', samples) === this.samples) return;
    this.engine.settings.samples = samples;
    this.engine.restart();
  }

  /** See {@link ViewerOptions.noise}. */
  get noise(): number | undefined {
    return this.engine.settings.noise;
  }

  set noise(noise: number | undefined) {
    const wanted = noise === undefined ? undefined : checkedOption('noise', noise) || undefined;
    if (wanted === this.noise) return;
    this.engine.settings.noise = wanted;
    this.engine.restart();
  }

  /** See {@link ViewerOptions.maxDepth}. */
  get maxDepth(): number {
    return this.engine.settings.maxDepth;
  }

  set maxDepth(depth: number) {
    if (checkedOption('maxDepth', depth) === this.maxDepth) return;
    this.engine.settings.maxDepth = depth;
    if (this.scene) this.engine.touch();
  }

  /** See {@link ViewerOptions.pixelRatio}; `undefined` is the screen's own. */
  get pixelRatio(): number | undefined {
    return this.#pixelRatio;
  }

  set pixelRatio(ratio: number | undefined) {
    this.#pixelRatio = ratio === undefined ? undefined : checkedSetting('pixelRatio', ratio);
    this.#resized();
  }

  /** Adds no samples while it is set, but for one after each change. */
  get paused(): boolean {
    return this.engine.paused;
  }

  set paused(paused: boolean) {
    this.engine.paused = paused;
  }

  /** Frees everything, the device too. Idempotent. The canvas can serve another viewer. */
  destroy(): void {
    if (this.state === 'destroyed') return;
    this.#resize.disconnect();
    this.#lighting?.abort(new DOMException('the viewer was destroyed', 'AbortError'));
    this.engine.destroy();
    this.silence();
  }

  /** @internal Width over height of the canvas. */
  protected get aspect(): number {
    return Math.max(1, this.canvas.clientWidth) / Math.max(1, this.canvas.clientHeight);
  }

  /** @internal */
  protected check(): void {
    if (this.state === 'destroyed') throw new ViewerError('viewer/destroyed', 'This viewer has been destroyed.');
  }

  /** @internal */
  protected theScene(): Scene {
    this.check();
    if (!this.scene) throw new ViewerError('viewer/no-scene', 'There is no scene yet: await load() first.');
    return this.scene;
  }

  /** @internal Emits what failed. */
  protected fail(error: unknown, retry?: () => void): void {
    if (this.state === 'destroyed') return;
    const { message, code } = (typeof error === 'object' && error !== null ? error : { message: String(error) }) as {
      message?: string;
      code?: unknown;
    };
    this.emit('error', {
      error,
      message: (message ?? 'Something failed.').split('\n')[0] as string,
      code: typeof code === 'string' ? code : 'unexpected',
      ...(retry ? { retry } : {}),
    });
  }

  /** @internal Emits what is replaced or waited for. */
  protected warn(error: GlanzError): void {
    this.emit('warning', { error, message: error.message.split('\n')[0] as string, code: error.code });
  }

  /** For setters, which cannot throw later. */
  #quietly(done: Promise<void>): void {
    done.catch((error: unknown) => !isAbort(error) && this.fail(error));
  }

  #resized(): void {
    const { canvas } = this;
    const size = imageSize(canvas.clientWidth, canvas.clientHeight, this.#pixelRatio, this.options.maxPixels);
    this.engine.resize(size, size);
  }

  async #relight(): Promise<void> {
    if (!this.scene) return;
    await this.engine.edit('environment', (tracer) => this.environment.apply(tracer));
  }
}
