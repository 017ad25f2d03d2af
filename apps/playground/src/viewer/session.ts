import { BvhWorkers } from '@glanz/bvh/workers';
import { PathTracer, requestDevice, type PickResult, type PrepareProgress } from '@glanz/renderer';
import type { Camera, Environment, Material, Scene } from '@glanz/scene';
import type { ToneMapOptions } from '@glanz/tonemap';
import { isAbort, PlaygroundError } from '../errors';
import { layerPicture, type Layer } from '../output/layers';
import { Display } from './display';
import { Edits } from './edits';
import { movingDivisor } from './film-size';
import { Losses } from './losses';

/** What a session is doing. */
export type SessionState = 'empty' | 'preparing' | 'rendering' | 'paused' | 'done' | 'recovering' | 'failed';

/** What a session tells the page, often. */
export interface SessionStatus {
  readonly state: SessionState;
  readonly samples: number;
  readonly target: number;
  readonly samplesPerSecond: number;
}

export interface SessionEvents {
  readonly onStatus: (status: SessionStatus) => void;
  readonly onError: (error: unknown, retry?: () => void) => void;
  /** The device was lost and there is a new one. */
  readonly onRecovered: () => void;
}

/** How a picture is made, apart from its scene. */
export interface SessionView extends Required<ToneMapOptions> {
  readonly samples: number;
  readonly depth: number;
  readonly background: 'environment' | 'transparent';
  readonly layer: Layer;
}

/** A scene to show. */
export interface Shown {
  readonly scene: Scene;
  readonly camera: Camera;
}

/** After so long without a move the film has its full size again. */
const SETTLE_MS = 220;
/** A layer is read again whenever there are so many times more samples, up to the most that layers average. */
const LAYER_GROWTH = 4;
const LAYER_MOST = 64;

/**
 * A canvas that is path-traced: owns device, tracer and display, adds samples until there are enough, starts anew after
 * edits, and comes back after the device was lost.
 */
export class Session {
  readonly #canvas: HTMLCanvasElement;
  readonly #events: SessionEvents;
  readonly #edits = new Edits();
  readonly #losses = new Losses();
  #view: SessionView;
  #device!: GPUDevice;
  #workers!: Promise<BvhWorkers>;
  #display!: Display;
  #tracer: PathTracer | undefined;
  #film: readonly [number, number] = [1, 1];
  #canvasSize: readonly [number, number] = [1, 1];
  #preparing: AbortController | undefined;
  #recovery: Promise<void> | undefined;
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
  #rate = 0;
  #layerBusy = false;
  #shownLayer: Layer = 'beauty';
  #nextLayerRead = 1;

  private constructor(canvas: HTMLCanvasElement, view: SessionView, events: SessionEvents) {
    this.#canvas = canvas;
    this.#view = view;
    this.#events = events;
  }

  /** @throws {DeviceError} without WebGPU. */
  static async create(canvas: HTMLCanvasElement, view: SessionView, events: SessionEvents): Promise<Session> {
    const session = new Session(canvas, view, events);
    await session.#connect();
    // They warm up while the first model loads.
    session.#workers = BvhWorkers.create({ warmUp: true });
    void session.#run();
    return session;
  }

  get tracer(): PathTracer | undefined {
    return this.#tracer;
  }

  /** What the GPU calls itself. */
  get adapterName(): string {
    const { description, device, architecture, vendor } = this.#device.adapterInfo;
    return description || device || [vendor, architecture].filter(Boolean).join(' ') || 'unnamed';
  }

  get paused(): boolean {
    return this.#paused;
  }

  /** Shows another scene. Until it is ready the former one stays, and it stays for good where this fails. */
  async show({ scene, camera }: Shown, onProgress: (progress: PrepareProgress) => void): Promise<void> {
    await this.#prepare({ scene, camera }, onProgress, (key) => key === 'environment' || key === 'size');
  }

  /** @param keep Which waiting edits are still meant for this scene. */
  async #prepare({ scene, camera }: Shown, onProgress: (progress: PrepareProgress) => void, keep: (edit: string) => boolean): Promise<void> {
    this.#preparing?.abort(new DOMException('another scene was asked for', 'AbortError'));
    const preparing = (this.#preparing = new AbortController());
    this.#stop();
    this.#tell('preparing');
    try {
      const tracer = await this.#createTracer(scene, camera, preparing.signal, onProgress);
      if (preparing.signal.aborted) {
        tracer.destroy();
        throw preparing.signal.reason as Error;
      }
      this.#replaceTracer(tracer, keep);
    } finally {
      if (this.#preparing === preparing) {
        this.#preparing = undefined;
        this.#failed = false;
        this.#wake();
      }
    }
  }

  /** Changes how the picture is made. What needs it restarts the film; the rest shows at once. */
  async setView(change: Partial<SessionView>): Promise<void> {
    const before = this.#view;
    const view = (this.#view = { ...before, ...change });
    if (view.toneMap !== before.toneMap || view.exposure !== before.exposure) {
      await this.#display.setView({ toneMap: view.toneMap, exposure: view.exposure });
      this.#redraw();
    }
    if (view.samples !== before.samples) this.#stop();
    if (view.layer !== before.layer) {
      if (view.layer === 'beauty') {
        this.#display.setLayer(undefined, [1, 1]);
        this.#redraw();
      } else void this.#readLayer();
    }
    // These are fixed when a tracer is made; one that is being made looks for itself.
    const remake = view.depth !== before.depth || view.background !== before.background;
    if (this.#tracer && remake && !this.#preparing) await this.#remake(this.#tracer);
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
    else if (this.#tracer) this.#edit('size', () => this.#tracer?.resize(...film));
  }

  /** Looks from elsewhere. While this is called in a row, the film is as small as it must be to keep up. */
  setCamera(camera: Camera, moving: boolean): void {
    clearTimeout(this.#settle);
    const divisor = moving ? movingDivisor(this.#sampleMs) : 1;
    const size = this.#film.map((pixels) => Math.max(1, Math.round(pixels / divisor))) as unknown as readonly [number, number];
    this.#edit('camera', () => {
      this.#tracer?.resize(...size);
      this.#tracer?.setCamera(camera);
    });
    if (divisor > 1) this.#settle = window.setTimeout(() => this.#edit('size', () => this.#tracer?.resize(...this.#film)), SETTLE_MS);
  }

  setEnvironment(environment: Environment | undefined): void {
    this.#edit('environment', () => this.#tracer?.setEnvironment(environment));
  }

  /** @param index Of the scene's materials. */
  setMaterial(index: number, parameters: Material['parameters']): void {
    this.#edit(`material ${index}`, (merged) => this.#tracer?.setMaterial(index, merged as Material['parameters']), parameters);
  }

  /** What lies at a point of the canvas, in shares of its width and height. */
  pick(x: number, y: number): PickResult | undefined {
    const tracer = this.#tracer;
    return tracer?.pick(x * tracer.width, y * tracer.height);
  }

  async #connect(): Promise<void> {
    const device = await requestDevice();
    try {
      this.#display = await Display.create(this.#canvas, device, { toneMap: this.#view.toneMap, exposure: this.#view.exposure });
    } catch (error) {
      device.destroy();
      throw error;
    }
    this.#device = device;
    device.addEventListener('uncapturederror', (event) => {
      event.preventDefault();
      if (device === this.#device) this.#events.onError(new PlaygroundError('playground/gpu', `The GPU reports: ${event.error.message}`));
    });
    void device.lost.then(() => {
      if (device === this.#device) this.#recover();
    });
  }

  /** Creates a tracer; where the device is lost meanwhile, once more on the next one. */
  async #createTracer(scene: Scene, camera: Camera, signal: AbortSignal, onProgress: (progress: PrepareProgress) => void): Promise<PathTracer> {
    for (let attempt = 0; ; attempt++) {
      const [width, height] = this.#film;
      await this.#recovery;
      const { depth, background } = this.#view;
      const device = this.#device;
      const hierarchies = await this.#workers;
      try {
        const tracer = await PathTracer.create(device, scene, { width, height, maxDepth: depth, background, camera, hierarchies, signal, onProgress });
        if (depth === this.#view.depth && background === this.#view.background) return tracer;
        tracer.destroy();
        attempt = -1;
      } catch (error) {
        // The news of a loss may come later than its consequences.
        await new Promise((resolve) => setTimeout(resolve, 0));
        if (attempt > 0 || isAbort(error) || (device === this.#device && !this.#recovery)) throw error;
      }
    }
  }

  /** The same scene, as edited, in a new tracer. */
  #remake({ scene, camera }: PathTracer): Promise<void> {
    return this.#prepare({ scene, camera }, () => undefined, () => true);
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

  /** A new device in place of a lost one, with the scene as it was edited. */
  #recover(): void {
    const attempt = async () => {
      this.#fresh = false;
      this.#tell('recovering');
      await this.#losses.next();
      await this.#connect();
      this.#recovery = undefined;
      // A scene that is being prepared takes the new device by itself.
      if (this.#tracer && !this.#preparing) await this.#remake(this.#tracer);
      this.#events.onRecovered();
    };
    this.#stop();
    this.#recovery = attempt().catch((error: unknown) => {
      this.#recovery = undefined;
      this.#failed = true;
      this.#tell('failed');
      this.#events.onError(error, () => {
        this.#losses.forgive();
        this.#recover();
      });
    });
  }

  /** Adds samples for ever; sleeps where there is nothing to do. */
  async #run(): Promise<never> {
    for (;;) {
      const tracer = this.#tracer;
      const { samples } = this.#view;
      const idle = this.#idleState();
      if (!tracer || idle) {
        this.#rate = 0;
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
      this.#tell('rendering');
      try {
        for await (const progress of tracer.render({ samples: this.#paused ? 1 : samples, signal: this.#interrupt.signal })) {
          if (tracer !== this.#tracer) break;
          this.#progressed(tracer, progress.samples, progress.samplesPerSecond);
        }
      } catch (error) {
        // Told apart by what follows: a loss is handled where the device announces it.
        await new Promise((resolve) => setTimeout(resolve, 0));
        if (tracer === this.#tracer && !this.#recovery) {
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
    if (this.#recovery) return 'recovering';
    if (this.#preparing) return 'preparing';
    if (!this.#tracer) return 'empty';
    if (this.#paused && this.#tracer.samples > 0) return 'paused';
    return this.#tracer.samples >= this.#view.samples ? 'done' : undefined;
  }

  #progressed(tracer: PathTracer, samples: number, rate: number): void {
    this.#fresh = true;
    this.#rate = rate;
    if (tracer.width === this.#film[0] && tracer.height === this.#film[1] && rate > 0) this.#sampleMs = 1000 / rate;
    if (samples >= this.#nextLayerRead && this.#nextLayerRead <= LAYER_MOST) {
      this.#nextLayerRead = samples * LAYER_GROWTH;
      void this.#readLayer();
    }
    this.#tell('rendering');
    if (this.#edits.size === 0) this.#redraw();
    else {
      // What has been computed is seen before the next edit wipes it.
      this.#draw();
      this.#edits.apply(this.#report);
    }
  }

  /** Applies an edit as soon as the film shows the one before it: a GPU that is slow skips edits rather than pictures. */
  #edit(key: string, apply: (merged: object) => void | Promise<void> | undefined, value: object = {}): void {
    const run = async (merged: object) => {
      this.#restarted();
      await apply(merged);
      // Kernels that came late have restarted the film once more.
      if (this.#tracer?.samples === 0) this.#fresh = false;
      this.#wake();
    };
    this.#edits.add(key, run, value);
    if (this.#state === 'rendering' && this.#fresh) {
      this.#draw();
      this.#edits.apply(this.#report);
    } else this.#wake();
  }

  readonly #report = (error: unknown): void => {
    if (!this.#recovery) this.#events.onError(error);
  };

  #restarted(): void {
    this.#fresh = false;
    this.#nextLayerRead = 1;
    this.#canvas.dataset['restarts'] = String(Number(this.#canvas.dataset['restarts'] ?? 0) + 1);
  }

  /** Ends the present render(), which the loop then starts anew where it is still wanted. */
  #stop(): void {
    this.#interrupt.abort();
  }

  #tell(state: SessionState): void {
    this.#state = state;
    this.#events.onStatus({ state, samples: this.#fresh ? (this.#tracer?.samples ?? 0) : 0, target: this.#view.samples, samplesPerSecond: this.#rate });
  }

  /** Draws with the next frame of the screen. */
  #redraw(): void {
    cancelAnimationFrame(this.#frame);
    this.#frame = requestAnimationFrame(() => this.#draw());
  }

  #draw(): void {
    const tracer = this.#tracer;
    if (!tracer || !this.#fresh || this.#recovery) return;
    this.#display.draw({ buffer: tracer.beautyBuffer, size: [tracer.width, tracer.height] }, ...this.#canvasSize);
    this.#canvas.dataset['layer'] = this.#display.showsLayer ? this.#shownLayer : 'beauty';
  }

  async #readLayer(): Promise<void> {
    const tracer = this.#tracer;
    const { layer } = this.#view;
    if (!tracer || layer === 'beauty' || this.#layerBusy || !this.#fresh) return;
    this.#layerBusy = true;
    try {
      const { width, height } = tracer;
      const picture = layerPicture(layer, await tracer.read(layer));
      if (tracer !== this.#tracer || picture.length !== width * height * 4) return;
      if (layer === this.#view.layer) {
        this.#display.setLayer(picture, [width, height]);
        this.#shownLayer = layer;
        this.#redraw();
      }
    } catch (error) {
      if (tracer === this.#tracer) this.#report(error);
    } finally {
      this.#layerBusy = false;
    }
    // Another one was chosen meanwhile.
    if (layer !== this.#view.layer) void this.#readLayer();
  }
}
