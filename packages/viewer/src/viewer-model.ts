import { loadPart } from './errors';
import type { PathTracer } from '@glanz/renderer';
import type { AnimationPlayer } from './animation-player';
import { inSlices, sceneBoundsSteps, untilAborted, type Camera, type Scene } from '@glanz/scene';
import { checkedStage, sceneOf } from './checks';
import type { Emitter } from './emitter';
import type { Engine, TracerSpec } from './engine';
import { isAbort } from './aborts';
import type { LoadStage, ViewerEvents } from './events';
import { fitCamera } from './fit-camera';
import { LatestTask } from './latest-task';
import { loadModel, type ModelSource } from './load';
import type { linearColors, MaterialEdit } from './material-colors';
import type { LoadOptions, ViewerOptions } from './options';
import type { Stage } from './stage';
import { plainScene } from './variants';
import type { ViewerCamera } from './viewer-camera';
import { withEnvironment, type ViewerEnvironment } from './viewer-environment';
import { reportError, reportWarning } from './viewer-reports';

/** Where the stages of a load begin and end, as parts of the whole; usual ones. */
const STAGES: Readonly<Record<LoadStage, readonly [number, number]>> = {
  read: [0, 0.3],
  decode: [0.3, 0.45],
  images: [0.45, 0.55],
  bvh: [0.55, 0.75],
  upload: [0.75, 0.85],
  compile: [0.85, 1],
};

/** Few pages need it. */
const loadStage = () => loadPart('stage', import('./stage'));

/** The model of a viewer: how it is loaded, its variants and its materials. */
export class ViewerModel {
  readonly #options: ViewerOptions;
  readonly #events: Emitter<ViewerEvents>;
  readonly #engine: Engine;
  readonly #camera: ViewerCamera;
  readonly #environment: ViewerEnvironment;
  readonly #loading = new LatestTask();
  #colors: Promise<{ readonly linearColors: typeof linearColors }> | undefined;
  /** The scene as it was loaded. */
  loaded: Scene | undefined;
  /** Name of the variant that is shown. */
  variant: string | undefined;
  /** What {@link loaded} was loaded from. */
  #source: ModelSource | undefined;
  #opening: Promise<AnimationPlayer> | undefined;
  /** Where models are placed, and where the one in the tracer is. */
  stage: Stage;
  #staged: Stage = {};
  /** Of the requests for models. */
  credentials: RequestCredentials | undefined;
  /** Plays the animations of {@link loaded}, once that was asked for. */
  player: AnimationPlayer | undefined;

  constructor(
    options: ViewerOptions,
    events: Emitter<ViewerEvents>,
    engine: Engine,
    camera: ViewerCamera,
    environment: ViewerEnvironment,
  ) {
    this.#options = options;
    this.#events = events;
    this.#engine = engine;
    this.#camera = camera;
    this.#environment = environment;
    this.variant = options.variant;
    this.credentials = options.credentials;
    this.stage = checkedStage(options);
  }

  /** See `Viewer.load`. */
  async load(source: ModelSource, options: LoadOptions): Promise<Scene> {
    const started = performance.now();
    try {
      return await this.#loading.run('another model was requested', options.signal, async (signal) => {
        const onProgress = ({ stage, done }: { stage: LoadStage; done: number }) => {
          const [from, to] = STAGES[stage];
          if (!signal.aborted)
            this.#events.emit('progress', {
              stage,
              done,
              total: from + (to - from) * Math.min(1, Math.max(0, done)),
            });
        };
        signal.throwIfAborted();
        const scene = await untilAborted(this.#prepare(source, options, signal, onProgress), signal);
        this.#events.emit('load', { scene, milliseconds: performance.now() - started });
        return scene;
      });
    } catch (error) {
      if (!isAbort(error))
        reportError(this.#events, error, () => void this.load(source, options).catch(() => undefined));
      throw error;
    }
  }

  /** See `Viewer.setVariant`. */
  async setVariant(variant: string | undefined): Promise<void> {
    sceneOf(this.#engine);
    await this.#engine.edit('variant', (tracer) => tracer.setVariant(variant));
    this.variant = variant;
  }

  /** See `Viewer.setMaterial`. */
  setMaterial(nameOrIndex: string | number, parameters: MaterialEdit): Promise<void> {
    sceneOf(this.#engine);
    if (Object.values(parameters).some((value) => typeof value === 'string'))
      this.#colors ??= loadPart('material-colors', import('./material-colors'));
    const colors = this.#colors;
    // Once the module has been asked for, all edits wait for it, so that they stay in their order.
    const set = (tracer: PathTracer, edit: object) =>
      colors
        ? colors.then((module) => tracer.setMaterial(nameOrIndex, module.linearColors(nameOrIndex, edit)))
        : tracer.setMaterial(nameOrIndex, edit);
    return this.#engine.edit(`material ${nameOrIndex}`, set, parameters);
  }

  /** Places the model, or puts a ground beneath it. Resolves when the image shows it. */
  async setStage(change: Stage): Promise<void> {
    this.stage = { ...this.stage, ...change };
    if (this.loaded) await this.#restage();
  }

  async #restage(): Promise<void> {
    const { loaded } = this;
    const { restage } = await loadStage();
    await restage(this.#engine, {
      from: () => this.#staged,
      to: () => (this.#staged = this.stage),
      // Only another tracer has a further instance.
      specify: (former) =>
        this.#specify(former, {
          scene: loaded as Scene,
          shown: former.scene,
          camera: former.camera,
          variant: undefined,
        }),
    });
  }

  /** See `Viewer.animation`. */
  animation(): Promise<AnimationPlayer> {
    const opening = (this.#opening ??= this.#open());
    // What has failed is tried again by the next call.
    opening.catch(() => this.#opening === opening && (this.#opening = undefined));
    return opening;
  }

  async #open(): Promise<AnimationPlayer> {
    const scene = this.loaded;
    const { openPlayer } = await loadPart('animation-player', import('./animation-player'));
    return (this.player = await openPlayer({
      source: this.#source,
      scene,
      decoders: this.#options.decoders,
      credentials: this.credentials,
      engine: this.#engine,
      events: this.#events,
      isShown: () => scene === this.loaded,
      place: () => this.#staged.transform,
      failed: (error) => reportError(this.#events, error),
    }));
  }

  /** Aborts a load. */
  destroy(): void {
    this.#loading.abort();
    this.player?.destroy();
  }

  /** Reads a model and has the engine show it. */
  async #prepare(
    source: ModelSource,
    options: LoadOptions,
    signal: AbortSignal,
    onProgress: (progress: { stage: LoadStage; done: number }) => void,
  ): Promise<Scene> {
    const engine = this.#engine;
    const { decoders, createWorker, camera: firstView = 'auto', variant: firstVariant } = this.#options;
    const reading = loadModel(source, {
      signal,
      decoders,
      createWorker,
      credentials: this.credentials,
      compressedFormats: () => engine.compressedFormats(),
      onProgress,
    });
    const [raw, prepare] = await Promise.all([reading, this.#environment.fetch(signal), engine.connect()]);
    signal.throwIfAborted();
    const { stage } = this;
    const isStaged = stage.transform || stage.ground;
    const { model: scene, shown } = isStaged ? (await loadStage()).staged(raw, stage) : { model: raw, shown: raw };
    const { lit, warning, adopt } = await prepare(scene);
    // Each iterates over all vertices.
    const camera = await inSlices(this.#camera.choose(scene, options.camera ?? firstView), { signal });
    const bounds = await inSlices(sceneBoundsSteps(scene), { signal });
    const requested = options.variant ?? firstVariant;
    const variant = requested !== undefined && scene.variants?.includes(requested) ? requested : undefined;
    const first = {
      scene: raw,
      shown: withEnvironment(shown, lit),
      camera: fitCamera(camera, this.#camera.aspect),
      variant,
    };
    await engine.show((former) => this.#specify(former, first), {
      signal,
      onProgress,
      onTaken: () => {
        this.player?.destroy();
        this.player = this.#opening = undefined;
        this.#source = source;
        this.loaded = raw;
        this.#staged = stage;
        this.variant = variant;
        adopt();
        if (warning) reportWarning(this.#events, warning);
        this.#camera.begin(camera, bounds);
      },
    });
    if (this.stage !== stage) await this.#restage();
    return scene;
  }

  /** A scene as it was loaded, or as it was edited until its tracer was lost; its variant is applied on top. */
  #specify(
    former: PathTracer | undefined,
    first: {
      readonly scene: Scene;
      readonly shown: Scene;
      readonly camera: Camera;
      readonly variant: string | undefined;
    },
  ): TracerSpec {
    const variant = former ? this.variant : first.variant;
    const groups = former?.lightGroups ?? [];
    return {
      scene: former ? plainScene(former.scene, first.scene, variant) : first.shown,
      camera: former?.camera ?? first.camera,
      ready: async (tracer) => {
        if (variant !== undefined) await tracer.setVariant(variant);
        for (const { name, intensity, color } of groups) {
          if (intensity !== 1 || color.some((value) => value !== 1))
            await tracer.setLightGroup(name, { intensity, color });
        }
      },
    };
  }
}
