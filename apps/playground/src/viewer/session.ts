import { PathTracer, type HierarchyBuilder, type LightGroupMode, type PickResult, type PrepareProgress } from '@glanz/renderer';
import type { Camera, Scene } from '@glanz/scene';
import type { ToneMapOptions } from '@glanz/tonemap';
import { isAbort } from '../errors';
import type { Layer } from '../output/layers';
import { Connection } from './connection';
import { Edits } from './edits';
import { movingDivisor } from './film-size';
import { rememberingHierarchies } from './hierarchies';
import { LayerView } from './layer-view';

/** What a session is doing. */
export type SessionState = 'empty' | 'preparing' | 'rendering' | 'paused' | 'done' | 'recovering' | 'failed';

/** What a session tells the page, often. */
export interface SessionStatus {
  readonly state: SessionState;
  readonly samples: number;
  readonly target: number;
  readonly samplesPerSecond: number;
  /** Milliseconds that the picture still takes. */
  readonly remainingMs: number;
  /** Noise when it was last looked at, and the share of the picture that still gets samples; only with a noise target. */
  readonly noise?: number | undefined;
  readonly active: number;
}

export interface SessionEvents {
  readonly onStatus: (status: SessionStatus) => void;
  readonly onError: (error: unknown, retry?: () => void) => void;
  /** The device was lost and there is a new one. */
  readonly onRecovered: () => void;
  /** An edit is on the screen: milliseconds since it was asked for. */
  readonly onShown?: (ms: number) => void;
}

/** How a picture is made, apart from its scene. */
export interface SessionView extends Required<ToneMapOptions> {
  readonly samples: number;
  /** 0: none. */
  readonly noise: number;
  readonly layer: Layer;
}

/** What a tracer is made from. */
export interface Shown {
  readonly scene: Scene;
  readonly camera: Camera;
  readonly depth: number;
  readonly background: 'environment' | 'transparent';
  readonly lightGroups: LightGroupMode;
  /** Edits that a new tracer needs before it is shown. */
  readonly ready?: (tracer: PathTracer) => Promise<void>;
}

/** After so long without a move the film has its full size again. */
const SETTLE_MS = 220;

/**
 * A canvas that is path-traced: owns device, tracer and display, adds samples until there are enough, starts anew after
 * edits, and comes back after the device was lost.
 */
export class Session {
  readonly #canvas: HTMLCanvasElement;
  readonly #events: SessionEvents;
  readonly #edits = new Edits();
  readonly #hierarchies: HierarchyBuilder;
  #layers!: LayerView;
  #view: SessionView;
  #connection!: Connection;
  #source: (() => Shown) | undefined;
  #tracer: PathTracer | undefined;
  #film: readonly [number, number] = [1, 1];
  #canvasSize: readonly [number, number] = [1, 1];
  #preparing: AbortController | undefined;
  #state: SessionState = 'empty';
  #paused = false;
  #failed = false;
  /** Whether the film holds a sample since it was last cleared. */
  #fresh = false;
  #interrupt = new AbortController();
  #wake: () => void = () => undefined;
  #frame = 0;
  #settle = 0;
  #sampleMs: number | undefined;
  #progress = { rate: 0, remainingMs: Infinity, noise: undefined as number | undefined, active: 1 };
  /** Whether the noise target has been reached with the film as it is. */
  #quiet = false;
  #askedAt: number | undefined;

  private constructor(canvas: HTMLCanvasElement, view: SessionView, events: SessionEvents) {
    this.#canvas = canvas;
    this.#view = view;
    this.#events = events;
    this.#hierarchies = rememberingHierarchies();
  }

  /** @throws {DeviceError} without WebGPU. */
  static async create(canvas: HTMLCanvasElement, view: SessionView, events: SessionEvents): Promise<Session> {
    const session = new Session(canvas, view, events);
    await session.#connect();
    void session.#run();
    return session;
  }

  get tracer(): PathTracer | undefined {
    return this.#tracer;
  }

  get adapterName(): string {
    return this.#connection.adapterName;
  }

  get paused(): boolean {
    return this.#paused;
  }

  /** Milliseconds that a sample of the full film takes; undefined where none has been seen. */
  get sampleMs(): number | undefined {
    return this.#sampleMs;
  }

  /**
   * Shows another scene. Until it is ready the former one stays, and it stays for good where this fails.
   *
   * @param source Asked whenever a tracer is made, also after a loss of the device, so it gives the scene as edited by then.
   */
  async show(source: () => Shown, onProgress: (progress: PrepareProgress) => void = () => undefined): Promise<void> {
    await this.#prepare(source, onProgress, (key) => key === 'size');
  }

  async #prepare(source: () => Shown, onProgress: (progress: PrepareProgress) => void, keep: (edit: string) => boolean): Promise<void> {
    this.#preparing?.abort(new DOMException('another scene was asked for', 'AbortError'));
    const preparing = (this.#preparing = new AbortController());
    this.#stop();
    this.#tell('preparing');
    try {
      const tracer = await this.#createTracer(source, preparing.signal, onProgress);
      if (preparing.signal.aborted) {
        tracer.destroy();
        throw preparing.signal.reason as Error;
      }
      this.#source = source;
      this.#replaceTracer(tracer, keep);
    } finally {
      if (this.#preparing === preparing) {
        this.#preparing = undefined;
        this.#failed = false;
        this.#wake();
      }
    }
  }

  /** Changes how the picture is made without restarting it. */
  async setView(change: Partial<SessionView>): Promise<void> {
    const before = this.#view;
    const view = (this.#view = { ...before, ...change });
    if (view.toneMap !== before.toneMap || view.exposure !== before.exposure) {
      await this.#connection.setView({ toneMap: view.toneMap, exposure: view.exposure });
      this.#redraw();
    }
    if (view.samples !== before.samples || view.noise !== before.noise) {
      this.#quiet = false;
      this.#stop();
    }
    if (view.layer !== before.layer) this.#layers.choose(view.layer);
    this.#wake();
  }

  setPaused(paused: boolean): void {
    this.#paused = paused;
    this.#stop();
    this.#wake();
  }

  /** Sizes of the film and of the canvas behind it, pixels. */
  resize(film: readonly [number, number], canvas: readonly [number, number]): void {
    const same = film[0] === this.#film[0] && film[1] === this.#film[1];
    this.#film = film;
    this.#canvasSize = canvas;
    this.#sampleMs = same ? this.#sampleMs : undefined;
    if (same) this.#redraw();
    else if (this.#tracer) this.edit('size', (tracer) => tracer.resize(...film));
  }

  /** Looks from elsewhere. While this is called in a row, the film is as small as it must be to keep up. */
  setCamera(camera: Camera, moving: boolean): void {
    clearTimeout(this.#settle);
    const divisor = moving ? movingDivisor(this.#sampleMs) : 1;
    const size = this.#film.map((pixels) => Math.max(1, Math.round(pixels / divisor))) as unknown as readonly [number, number];
    this.edit('camera', (tracer) => {
      tracer.resize(...size);
      return tracer.setCamera(camera);
    });
    if (divisor > 1) this.#settle = window.setTimeout(() => this.edit('size', (tracer) => tracer.resize(...this.#film)), SETTLE_MS);
  }

  /**
   * Applies an edit as soon as the film shows the one before it: a GPU that is slow skips edits rather than pictures.
   *
   * @param key Of several edits with one key that wait, the last one counts; the fields of their values add up.
   */
  edit(key: string, apply: (tracer: PathTracer, merged: object) => void | Promise<void>, value: object = {}): void {
    this.#askedAt ??= performance.now();
    const run = async (merged: object) => {
      const tracer = this.#tracer;
      if (!tracer) return;
      this.#restarted();
      await apply(tracer, merged);
      // Kernels that came late have restarted the film once more.
      if (tracer.samples === 0) this.#fresh = false;
      this.#wake();
    };
    this.#edits.add(key, run, value);
    if (this.#state === 'rendering' && this.#fresh) {
      this.#draw();
      this.#edits.apply(this.#report);
    } else this.#wake();
  }

  /** Changes what is computed from the film without restarting it, e.g. the strength of a light group. */
  relight(apply: (tracer: PathTracer) => Promise<void>): void {
    const tracer = this.#tracer;
    if (tracer) void apply(tracer).then(() => this.#redraw(), this.#report);
  }

  /** What lies at a point of the canvas, in shares of its width and height. */
  pick(x: number, y: number): PickResult | undefined {
    const tracer = this.#tracer;
    return tracer?.pick(x * tracer.width, y * tracer.height);
  }

  async #connect(): Promise<void> {
    this.#connection = await Connection.create(this.#canvas, { toneMap: this.#view.toneMap, exposure: this.#view.exposure }, {
      onLost: () => {
        this.#fresh = false;
        this.#stop();
        this.#tell('recovering');
      },
      onBack: async () => {
        // A scene that is being prepared takes the new device by itself.
        if (this.#source && !this.#preparing) await this.#prepare(this.#source, () => undefined, () => true);
        this.#events.onRecovered();
      },
      onGivenUp: (error, retry) => {
        this.#failed = true;
        this.#tell('failed');
        this.#events.onError(error, retry);
      },
      onError: (error) => this.#events.onError(error),
    });
    this.#layers = new LayerView(
      {
        tracer: () => this.#tracer,
        display: () => this.#connection.display,
        fresh: () => this.#fresh,
        redraw: () => this.#redraw(),
        report: (error) => this.#report(error),
      },
      this.#view.layer,
    );
  }

  /** Creates a tracer; where the device is lost meanwhile, once more on the next one. */
  async #createTracer(source: () => Shown, signal: AbortSignal, onProgress: (progress: PrepareProgress) => void): Promise<PathTracer> {
    for (let attempt = 0; ; attempt++) {
      const [width, height] = this.#film;
      await this.#connection.recovery;
      const { device } = this.#connection;
      const { scene, camera, depth, background, lightGroups, ready } = source();
      try {
        const tracer = await PathTracer.create(device, scene, { width, height, maxDepth: depth, background, camera, lightGroups, hierarchies: this.#hierarchies, signal, onProgress });
        await ready?.(tracer);
        return tracer;
      } catch (error) {
        // The news of a loss may come later than its consequences.
        await new Promise((resolve) => setTimeout(resolve, 0));
        if (attempt > 0 || isAbort(error) || (device === this.#connection.device && !this.#connection.recovery)) throw error;
      }
    }
  }

  #replaceTracer(tracer: PathTracer, keep: (edit: string) => boolean): void {
    this.#edits.clear(keep);
    clearTimeout(this.#settle);
    this.#tracer?.destroy();
    this.#tracer = tracer;
    this.#sampleMs = undefined;
    this.#restarted();
    if (tracer.width !== this.#film[0] || tracer.height !== this.#film[1]) tracer.resize(...this.#film);
  }

  /** Adds samples for ever; sleeps where there is nothing to do. */
  async #run(): Promise<never> {
    for (;;) {
      const tracer = this.#tracer;
      const { samples, noise } = this.#view;
      const idle = this.#idleState();
      if (!tracer || idle) {
        this.#progress = { ...this.#progress, rate: 0, remainingMs: 0 };
        if (idle === 'done' || idle === 'paused') {
          if (this.#edits.apply(this.#report)) continue;
          // The last samples may have come without being told of.
          this.#fresh = true;
          cancelAnimationFrame(this.#frame);
          this.#draw();
        }
        this.#tell(idle ?? 'empty');
        await new Promise<void>((resolve) => (this.#wake = resolve));
        continue;
      }
      this.#interrupt = new AbortController();
      const { signal } = this.#interrupt;
      this.#tell('rendering');
      try {
        const adaptive = noise > 0 && !this.#paused;
        for await (const progress of tracer.render({ samples: this.#paused ? 1 : samples, signal, ...(adaptive ? { noise } : {}) })) {
          if (tracer !== this.#tracer) break;
          this.#progress = { rate: progress.samplesPerSecond, remainingMs: progress.remainingMs, noise: progress.noise, active: progress.active };
          if (adaptive && progress.noise !== undefined && progress.noise <= noise) this.#quiet = true;
          this.#progressed(tracer, progress.samples, progress.samplesPerSecond);
        }
        // A render that ended by itself has all that it was asked for.
        if (adaptive && !signal.aborted && tracer === this.#tracer && tracer.samples > 0 && this.#edits.size === 0) this.#quiet = true;
      } catch (error) {
        // Told apart by what follows: a loss is handled where the device announces it.
        await new Promise((resolve) => setTimeout(resolve, 0));
        if (tracer === this.#tracer && !this.#connection.recovery) {
          this.#failed = true;
          this.#events.onError(error, () => {
            this.#failed = false;
            this.#wake();
          });
        }
      }
    }
  }

  /** Why no samples are to be added, or undefined. A paused picture gets one after each edit, to show it. */
  #idleState(): SessionState | undefined {
    if (this.#failed) return 'failed';
    if (this.#connection.recovery) return 'recovering';
    if (this.#preparing) return 'preparing';
    if (!this.#tracer) return 'empty';
    if (this.#paused && this.#tracer.samples > 0) return 'paused';
    return this.#tracer.samples >= this.#view.samples || this.#quiet ? 'done' : undefined;
  }

  #progressed(tracer: PathTracer, samples: number, rate: number): void {
    this.#fresh = true;
    if (tracer.width === this.#film[0] && tracer.height === this.#film[1] && rate > 0) this.#sampleMs = 1000 / rate;
    this.#layers.progressed(samples);
    this.#tell('rendering');
    if (this.#edits.size === 0) this.#redraw();
    else {
      // What has been computed is seen before the next edit wipes it.
      this.#draw();
      this.#edits.apply(this.#report);
    }
  }

  readonly #report = (error: unknown): void => {
    if (!this.#connection.recovery) this.#events.onError(error);
  };

  #restarted(): void {
    this.#fresh = false;
    this.#quiet = false;
    this.#layers.restarted();
    this.#canvas.dataset['restarts'] = String(Number(this.#canvas.dataset['restarts'] ?? 0) + 1);
  }

  /** Ends the present render(), which the loop then starts anew where it is still wanted. */
  #stop(): void {
    this.#interrupt.abort();
  }

  #tell(state: SessionState): void {
    this.#state = state;
    const { rate, ...progress } = this.#progress;
    this.#events.onStatus({ state, samples: this.#fresh ? (this.#tracer?.samples ?? 0) : 0, target: this.#view.samples, samplesPerSecond: rate, ...progress });
  }

  /** Draws with the next frame of the screen. */
  #redraw(): void {
    cancelAnimationFrame(this.#frame);
    this.#frame = requestAnimationFrame(() => this.#draw());
  }

  #draw(): void {
    const tracer = this.#tracer;
    if (!tracer || !this.#fresh || this.#connection.recovery) return;
    this.#connection.display.draw({ buffer: tracer.beautyBuffer, size: [tracer.width, tracer.height] }, ...this.#canvasSize);
    this.#canvas.dataset['layer'] = this.#layers.shown;
    if (this.#askedAt === undefined || this.#edits.size > 0) return;
    this.#events.onShown?.(performance.now() - this.#askedAt);
    this.#askedAt = undefined;
  }
}
