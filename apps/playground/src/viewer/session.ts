import type { AovName, LightGroupMode, PathTracer, PickResult, PrepareProgress } from '@glanz/renderer';
import { RENDER_OPTIONS } from '@glanz/renderer/options';
import type { Camera, CompressedFormat, Scene } from '@glanz/scene';
import type { ToneMapOptions } from '@glanz/tonemap';
import { Engine, type EngineHost, type ViewerState } from '@glanz/viewer/engine';
import type { Layer } from '../output/layers';
import { LayerView } from './layer-view';
import { RayMeter } from './ray-meter';

/** What a session often reports to the page. */
export interface SessionStatus {
  readonly state: ViewerState;
  readonly samples: number;
  readonly target: number;
  readonly samplesPerSecond: number;
  /** Milliseconds that the image still takes. */
  readonly remainingMs: number;
  /**
   * Noise when it was last looked at, and the share of the image that still gets samples; only with a noise target.
   */
  readonly noise?: number | undefined;
  readonly active: number;
  /** Whether the image on the screen is denoised. */
  readonly denoised: boolean;
}

export interface SessionEvents {
  readonly onStatus: (status: SessionStatus) => void;
  readonly onError: (error: unknown, retry?: () => void) => void;
  /** The device was lost and there is a new one; the image has so many samples per pixel again. */
  readonly onRecovered: (samples: number) => void;
  /** An edit is on the screen: milliseconds since it was asked for. */
  readonly onShown?: (ms: number) => void;
}

/** How an image is made, apart from its scene. */
export interface SessionView extends Required<ToneMapOptions> {
  readonly samples: number;
  /** 0: none. */
  readonly noise: number;
  readonly layer: Layer;
}

/** A view, with what is set once. */
export interface FirstView extends SessionView {
  /** Whether frames of a view that moves are filtered where the GPU is fast enough. */
  readonly denoise: boolean;
}

/** What a tracer is made from. */
export interface Shown {
  readonly scene: Scene;
  readonly camera: Camera;
  readonly maxDepth: number;
  readonly background: 'environment' | 'transparent';
  readonly lightGroups: LightGroupMode;
  /** First-hit AOVs that are known to be needed: added later, they need other kernels. */
  readonly aovs: readonly AovName[];
  /** Edits that a new tracer needs before it is shown. */
  readonly ready: (tracer: PathTracer) => Promise<void>;
}

/** Milliseconds that a frame may take while something moves, and after a movement until the image is refined. */
const PREVIEW_MS = 12;
const SETTLE_MS = 180;
/** Maximum number of edges of a path in a preview. */
const PREVIEW_DEPTH = 4;

/** The viewer's engine as the page drives it: its state comes from the store, and what it does goes into one status. */
export class Session {
  readonly #canvas: HTMLCanvasElement;
  readonly #events: SessionEvents;
  readonly #engine: Engine;
  readonly #layers: LayerView;
  readonly #rays = new RayMeter();
  #preparing = 0;
  #film: readonly [number, number] = [0, 0];
  #sampleMs: number | undefined;
  #denoised = false;
  #progress: Omit<SessionStatus, 'state' | 'samples' | 'target' | 'denoised'> = {
    samplesPerSecond: 0,
    remainingMs: Infinity,
    active: 1,
  };
  #askedAt: number | undefined;

  private constructor(
    canvas: HTMLCanvasElement,
    layer: HTMLCanvasElement,
    view: FirstView,
    camera: Pick<EngineHost, 'step' | 'moving' | 'camera'>,
    events: SessionEvents,
  ) {
    this.#canvas = canvas;
    this.#events = events;
    const { samples, noise, exposure, toneMap, denoise } = view;
    this.#engine = new Engine(
      canvas,
      {
        samples,
        noise: noise || undefined,
        exposure,
        toneMap,
        maxDepth: RENDER_OPTIONS.maxDepth.default,
        background: RENDER_OPTIONS.background.default,
        maxSubmitMs: RENDER_OPTIONS.maxSubmitMs.default,
        settleMs: SETTLE_MS,
        previewDepth: PREVIEW_DEPTH,
        previewMode: denoise ? 'auto' : 'raw',
        tracer: {},
        requestDevice: undefined,
      },
      PREVIEW_MS,
      {
        ...camera,
        state: () => this.#emitStatus(),
        sample: ({ samplesPerSecond, remainingMs, noise: left, active }) => {
          this.#progress = { samplesPerSecond, remainingMs, noise: left, active };
          if (samplesPerSecond > 0) this.#sampleMs = 1000 / samplesPerSecond;
          if (this.#engine.tracer) void this.#rays.measure(this.#engine.tracer);
          this.#emitStatus();
        },
        converged: () => this.#emitStatus(),
        drawn: (_preview, _milliseconds, size, denoised) => this.#drawn(size, denoised),
        restarted: () => {
          this.#rays.interrupt();
          this.#layers.restarted();
          this.#canvas.dataset['restarts'] = String(Number(this.#canvas.dataset['restarts'] ?? 0) + 1);
        },
        error: (error, retry) => this.#events.onError(error, retry),
        lost: () => this.#emitStatus(),
        restored: (_milliseconds, { samples }) => this.#events.onRecovered(samples),
      },
    );
    this.#layers = new LayerView(
      {
        tracer: () => this.#engine.tracer,
        fresh: () => this.#engine.fresh,
        report: (error) => this.#report(error),
        shown: (name) => {
          canvas.dataset['layer'] = name;
          if (this.#denoised) this.#emitStatus();
        },
      },
      layer,
      view.layer,
    );
  }

  /**
   * @param camera Moves the camera.
   * @param layer Lies over the image's canvas and shows layers of the film.
   * @throws {DeviceError} without WebGPU.
   */
  static async create(
    canvas: HTMLCanvasElement,
    layer: HTMLCanvasElement,
    view: FirstView,
    camera: Pick<EngineHost, 'step' | 'moving' | 'camera'>,
    events: SessionEvents,
  ): Promise<Session> {
    const session = new Session(canvas, layer, view, camera, events);
    await session.#engine.ready;
    return session;
  }

  get tracer(): PathTracer | undefined {
    return this.#engine.tracer;
  }

  /** What the GPU reads of compressed formats. */
  compressedFormats(): Promise<readonly CompressedFormat[]> {
    return this.#engine.compressedFormats();
  }

  /** What the GPU calls itself. */
  get adapterName(): string {
    const { description, device, architecture, vendor } = this.#engine.device?.adapterInfo ?? {
      description: '',
      device: '',
      architecture: '',
      vendor: '',
    };
    return description || device || [vendor, architecture].filter(Boolean).join(' ') || 'unnamed';
  }

  /** What renders images of other sizes. */
  get engine(): Engine {
    return this.#engine;
  }

  /** Whether the film holds the whole image as it is now, at its full size. */
  get current(): boolean {
    return this.#engine.current;
  }

  get paused(): boolean {
    return this.#engine.paused;
  }

  /** Milliseconds that a sample of the full film takes; undefined where none has been seen. */
  get sampleMs(): number | undefined {
    return this.#sampleMs;
  }

  /** Edges of paths and rays to lights; undefined before they have been counted. */
  get raysPerSecond(): number | undefined {
    return this.#rays.perSecond;
  }

  /** Size of the full film, pixels; while something moves, the tracer's is smaller. */
  get film(): readonly [number, number] {
    return this.#film;
  }

  /**
   * Shows another scene. Until it is ready, and where this fails, the former one stays.
   *
   * @param source Asked whenever a tracer is made, also after a loss of the device, so it gives the scene as edited by
   * then.
   */
  async show(source: () => Shown, onProgress: (progress: PrepareProgress) => void = () => undefined): Promise<void> {
    const take = () => {
      const { scene, camera, maxDepth, background, lightGroups, aovs, ready } = source();
      Object.assign(this.#engine.settings, { maxDepth, background });
      return { scene, camera, options: { lightGroups, aovs }, ready };
    };
    this.#preparing++;
    try {
      await this.#engine.show(take, { onProgress });
      this.#sampleMs = undefined;
    } finally {
      this.#preparing--;
    }
  }

  /** Changes how the image is made without restarting it. */
  async setView({ exposure, toneMap, samples, noise, layer }: SessionView): Promise<void> {
    const { settings } = this.#engine;
    const before = { ...settings };
    settings.samples = samples;
    settings.noise = noise || undefined;
    if (samples !== before.samples || settings.noise !== before.noise) this.#engine.restart();
    this.#layers.choose(layer);
    if (toneMap !== before.toneMap || exposure !== before.exposure) await this.#engine.setView({ toneMap, exposure });
    this.#emitStatus();
  }

  setPaused(paused: boolean): void {
    this.#engine.paused = paused;
  }

  /** Sizes of the film and of the canvas behind it, pixels. */
  resize(film: readonly [number, number], canvas: readonly [number, number]): void {
    if (film[0] !== this.#film[0] || film[1] !== this.#film[1]) this.#sampleMs = undefined;
    this.#film = film;
    this.#engine.resize(film, canvas);
  }

  /** The camera has been moved, or has somewhere to go. */
  look(): void {
    this.#engine.touch();
  }

  /** Maximum number of edges of a path. */
  setDepth(depth: number): void {
    this.#askedAt ??= performance.now();
    this.#engine.settings.maxDepth = depth;
    this.#engine.touch();
  }

  setBackground(background: Shown['background']): void {
    this.#engine.settings.background = background;
    this.edit('background', (tracer) => tracer.setBackground(background));
  }

  /**
   * Applies an edit between two frames: a GPU that is slow skips edits rather than images.
   *
   * @param key Of several edits with one key that wait, the last one counts; the fields of their values add up.
   * @returns When it has taken effect, or has failed and was reported.
   */
  async edit(
    key: string,
    apply: (tracer: PathTracer, merged: object) => void | Promise<void>,
    value: object = {},
  ): Promise<void> {
    // The preparation of a scene includes what was changed meanwhile.
    if (this.#preparing > 0) return;
    this.#askedAt ??= performance.now();
    await this.#engine.edit(key, apply, value).catch(this.#report);
  }

  /** Changes what is computed from the film without restarting it, e.g. the strength of a light group. */
  relight(apply: (tracer: PathTracer) => Promise<void>): void {
    const { tracer } = this.#engine;
    if (tracer) void apply(tracer).then(() => this.#engine.redraw(), this.#report);
  }

  /** What lies at a point of the canvas, in shares of its width and height. */
  pick(x: number, y: number): PickResult | undefined {
    const { tracer } = this.#engine;
    return tracer?.pick(x * tracer.width, y * tracer.height);
  }

  #drawn(size: readonly [number, number], denoised: boolean): void {
    this.#canvas.dataset['film'] = size.join(' ');
    if (denoised !== this.#denoised) {
      this.#denoised = denoised;
      this.#emitStatus();
    }
    const { tracer, waiting } = this.#engine;
    if (tracer) this.#layers.progressed(tracer.samples);
    if (this.#askedAt === undefined || waiting > 0) return;
    this.#events.onShown?.(performance.now() - this.#askedAt);
    this.#askedAt = undefined;
  }

  readonly #report = (error: unknown): void => {
    if (this.#engine.state !== 'recovering') this.#events.onError(error);
  };

  #emitStatus(): void {
    const { state, current, tracer, settings } = this.#engine;
    if (state !== 'rendering') this.#progress = { ...this.#progress, samplesPerSecond: 0, remainingMs: 0 };
    this.#events.onStatus({
      state,
      samples: current ? (tracer?.samples ?? 0) : 0,
      target: settings.samples,
      ...this.#progress,
      // A layer lies over the image.
      denoised: this.#denoised && this.#canvas.dataset['layer'] === 'beauty',
    });
  }
}
