import { Scene, Vector2, type Camera } from 'three';
import type { PathTracerOptions } from '@glanz/renderer';
import type { SceneWarning } from '@glanz/scene';
import { ThreePathTracer } from '../three-path-tracer';
import type { ThreeCamera, ThreeObject } from '../types';
import { FilmCopy, type FilmTarget } from './film-target';
import { FullScreenQuad, type CompatRenderer } from './quad';
import { checkNumber, depthOf, Reports } from './settings';

/** Options of `setScene`. */
export interface SetSceneOptions {
  /** Called with the progress of the preparation, 0..1. */
  readonly onProgress?: (progress: number) => void;
}

/** Samples between the numbers of two films that are to have other noise. */
const NOISE_STRIDE = 4096;
/** Films until their noise repeats. */
const NOISES = 1024;

/**
 * A drop-in replacement for three-gpu-pathtracer's class of the same name: the same members, rendered by Glanz on
 * WebGPU and drawn by the renderer that is passed, `WebGLRenderer` or `WebGPURenderer`.
 *
 * Work that takes time is asynchronous: {@link setScene} returns at once, {@link isCompiling} is `true` until the scene
 * is prepared, and {@link renderSample} rasterises until then. A call of `renderSample` begins at most one sample; it
 * appears in a later call.
 *
 * @example
 * import { WebGLPathTracer } from '@glanz/three/compat';
 *
 * const pathTracer = new WebGLPathTracer(renderer);
 * pathTracer.setScene(scene, camera);
 * renderer.setAnimationLoop(() => pathTracer.renderSample());
 */
export class WebGLPathTracer {
  /** Milliseconds after a reset before path tracing begins. Default 100. */
  renderDelay = 100;
  /** Samples before the path-traced image is shown. Default 5. */
  minSamples = 5;
  /** Milliseconds over which it fades in. Default 500; 0 shows it at once. */
  fadeDuration = 500;
  /** `false`: only {@link rasterizeSceneCallback} is drawn, without sampling. Default `true`. */
  enablePathTracing = true;
  /** `true`: no samples are added; the image stays. Default `false`. */
  pausePathTracing = false;
  /** Shows a path-traced image of few pixels after a reset, in place of a rasterised one. Default `false`. */
  dynamicLowRes = false;
  /** Its width and height, as a share of the film's. Above 0, at most 1. Default 0.25. */
  lowResScale = 0.25;
  /** Width and height of the film, as a share of the drawing buffer's. Above 0. Default 1. */
  renderScale = 1;
  /** The film's size follows the renderer's drawing buffer and {@link renderScale}. Default `true`. */
  synchronizeRenderSize = true;
  /** Draws the rasterised scene while there is no path-traced image. Default `true`. */
  rasterizeScene = true;
  /** `false`: does not draw to the canvas; read {@link target}. Default `true`. */
  renderToCanvas = true;
  /** No effect: lights are always sampled by multiple importance sampling. Default `true`. */
  multipleImportanceSampling = true;
  /** No effect: samples are cut into submissions by the time they take. Default 3 × 3. */
  readonly tiles = new Vector2(3, 3);
  /** No effect: each texture keeps its own size. Default 1024 × 1024. */
  readonly textureSize = new Vector2(1024, 1024);
  /** The same noise after each reset; otherwise other random numbers. Default `false`. */
  stableNoise = false;
  /** Draws the rasterised scene. */
  rasterizeSceneCallback = (scene: Scene, camera: Camera): void => void this.renderer.render(scene, camera);
  /** Draws the path-traced image: `quad` is ready to be rendered with it. */
  renderToCanvasCallback = (target: FilmTarget, renderer: CompatRenderer, quad: FullScreenQuad): void => {
    void target;
    const { autoClear } = renderer;
    renderer.autoClear = false;
    quad.render(renderer);
    renderer.autoClear = autoClear;
  };
  /** The scene that is rendered. */
  scene: Scene | null = null;
  /** The camera that is looked through; see {@link setCamera}. */
  camera: Camera | null = null;

  /** @internal */
  protected readonly renderer: CompatRenderer;
  readonly #reports = new Reports();
  readonly #quad = new FullScreenQuad();
  readonly #backdrop = new Scene();
  readonly #film = new FilmCopy();
  readonly #lowFilm = new FilmCopy();
  #tracer: ThreePathTracer | undefined;
  #preparing: { readonly scene: Scene; readonly done: Promise<void>; readonly abort: AbortController } | undefined;
  /** Changes were announced that the preparation under way may have missed. */
  #stale = false;
  #editing = 0;
  #sampling = false;
  #size: readonly [number, number] = [0, 0];
  #resets = 0;
  #queueReset = true;
  #resetAt = 0;
  #drawnAt = 0;
  #opacity = 0;
  /** The image of few pixels is being made, or there. */
  #low: 'none' | 'making' | 'made' = 'none';
  #bounces = 10;
  #transmissiveBounces = 10;
  #filterGlossyFactor = 0;
  /** What the tracer has. */
  #depth = 0;
  #error: unknown;
  #disposed = false;

  /** @param renderer A `WebGLRenderer` or `WebGPURenderer`. */
  constructor(renderer: CompatRenderer) {
    this.renderer = renderer;
  }

  /**
   * Surfaces that a path meets at most, the first one counted. A whole number from 1. Default 10.
   * @throws {ThreeError} `three/option`
   */
  get bounces(): number {
    return this.#bounces;
  }

  set bounces(value: number) {
    this.#bounces = checkNumber('bounces', value, 1);
    this.#setDepth();
  }

  /**
   * Surfaces more where a material of the scene transmits light. A whole number from 0. Default 10.
   * @throws {ThreeError} `three/option`
   */
  get transmissiveBounces(): number {
    return this.#transmissiveBounces;
  }

  set transmissiveBounces(value: number) {
    this.#transmissiveBounces = checkNumber('transmissiveBounces', value, 0);
    this.#setDepth();
  }

  /**
   * How much sharp lobes are widened after wide ones, against fireflies: `PathTracerOptions.regularization`, where 1 is
   * the most. Default 0. Another value prepares the scene again.
   * @throws {ThreeError} `three/option`
   */
  get filterGlossyFactor(): number {
    return this.#filterGlossyFactor;
  }

  set filterGlossyFactor(value: number) {
    const before = this.#filterGlossyFactor;
    this.#filterGlossyFactor = checkNumber('filterGlossyFactor', value, 0);
    if (before !== value && this.scene && this.camera) this.#run(this.#prepare(this.scene, {}));
  }

  /** Samples per pixel that {@link target} shows. Whole numbers. */
  get samples(): number {
    return this.#film.samples;
  }

  /** What is rendered so far. Its texture is the same object throughout. */
  get target(): FilmTarget {
    return this.#film;
  }

  /** Whether the scene is being prepared or changed; no samples are added in this time. */
  get isCompiling(): boolean {
    return this.#preparing !== undefined || this.#editing > 0;
  }

  /** The last error, such as missing WebGPU; `undefined` without one. Errors are written to the console too. */
  get error(): unknown {
    return this.#error;
  }

  /** What of the scene is not supported; written to the console too. */
  get warnings(): readonly SceneWarning[] {
    return this.#tracer?.warnings ?? [];
  }

  /** The tracer beneath, once the scene is prepared: for what this class has no member for. */
  get threePathTracer(): ThreePathTracer | undefined {
    return this.#tracer;
  }

  /** @internal Milliseconds of the fade that have passed, as a share. */
  protected get opacity(): number {
    return this.#opacity;
  }

  /** @internal Size of the film, in pixels, where it does not follow the renderer. */
  protected set size(size: readonly [number, number]) {
    this.#resize(size);
  }

  /** No effect: hierarchies are built on the GPU, or in slices of this thread. */
  setBVHWorker(worker: unknown): void {
    void worker;
  }

  /**
   * Renders another scene, or the same one with its changes, at the cost that `ThreePathTracer` lists for each kind of
   * change. Returns at once; errors are in {@link error} and on the console.
   */
  setScene(scene: Scene, camera: Camera, options: SetSceneOptions = {}): void {
    this.#run(this.#setScene(scene, camera, options));
  }

  /**
   * As {@link setScene}, with a promise.
   *
   * @returns When the scene is prepared and sampling can begin.
   * @throws {ThreeError} and what `ThreePathTracer.create` throws; an error with the name `AbortError` where another
   * scene was set, or {@link dispose} called, meanwhile.
   */
  async setSceneAsync(scene: Scene, camera: Camera, options: SetSceneOptions = {}): Promise<void> {
    try {
      await this.#setScene(scene, camera, options);
    } catch (error) {
      this.#error = error;
      throw error;
    }
  }

  /** Looks through another camera. */
  setCamera(camera: Camera): void {
    this.camera = camera;
    this.updateCamera();
  }

  /** To be called when the camera has moved or changed. */
  updateCamera(): void {
    this.camera?.updateMatrixWorld();
    this.#edit((tracer) => tracer.updateCamera());
  }

  /** To be called when materials have changed. */
  updateMaterials(): void {
    this.#edit((tracer) => tracer.update());
  }

  /** To be called when lights have changed. */
  updateLights(): void {
    this.#edit((tracer) => tracer.update());
  }

  /** To be called when `scene.environment` or `scene.background` have changed. */
  updateEnvironment(): void {
    this.#edit((tracer) => tracer.update());
  }

  /** Begins the image again. */
  reset(): void {
    this.#film.clear();
    this.#lowFilm.clear();
    this.#low = 'none';
    this.#queueReset = true;
    this.#resets++;
    const tracer = this.#tracer;
    if (!tracer || tracer.destroyed) return;
    if (tracer.tracer.renderScale !== 1) tracer.tracer.setRenderScale(1);
    tracer.tracer.reset({ firstSample: this.stableNoise ? 0 : (this.#resets % NOISES) * NOISE_STRIDE });
  }

  /** Begins a sample, unless one is under way, and draws the samples so far. To be called for each frame. */
  renderSample(): void {
    if (this.#disposed) return;
    // A renderer that is being initialised draws nothing yet.
    if ((this.renderer as { readonly _initialized?: boolean })._initialized === false) return;
    const now = performance.now();
    if (this.synchronizeRenderSize) this.#synchronize();
    if (this.#queueReset) {
      this.#queueReset = false;
      this.#opacity = 0;
      this.#resetAt = this.#drawnAt = now;
    }
    const delta = now - this.#drawnAt;
    this.#drawnAt = now;
    const due = now - this.#resetAt >= this.renderDelay;
    if (this.enablePathTracing && !this.pausePathTracing && !this.isCompiling) this.#sample(due);
    if (!this.renderToCanvas || !this.scene || !this.camera) return;
    if (due && this.samples >= this.minSamples && this.samples > 0)
      this.#opacity = this.fadeDuration > 0 ? Math.min(1, this.#opacity + delta / this.fadeDuration) : 1;
    this.#draw(this.scene, this.camera);
  }

  /** Milliseconds since the last reset. */
  getRenderTime(): number {
    return this.#queueReset ? 0 : performance.now() - this.#resetAt;
  }

  /** Frees all memory of the GPU. Idempotent. */
  dispose(): void {
    this.#disposed = true;
    this.#preparing?.abort.abort();
    this.#tracer?.destroy();
    this.#tracer = undefined;
    this.#film.destroy();
    this.#lowFilm.destroy();
    this.#quad.dispose();
  }

  #draw(scene: Scene, camera: Camera): void {
    const { renderer } = this;
    const quad = this.#quad;
    const opacity = this.enablePathTracing ? this.#opacity : 0;
    const low = this.dynamicLowRes && this.#lowFilm.samples > 0;
    if (opacity < 1) {
      if (this.dynamicLowRes ? !low : this.rasterizeScene) this.rasterizeSceneCallback(scene, camera);
      else this.#drawBackdrop(scene, camera);
      if (low && this.enablePathTracing) {
        const { autoClear } = renderer;
        renderer.autoClear = false;
        quad.set(this.#lowFilm.texture, 1).render(renderer);
        renderer.autoClear = autoClear;
      }
    } else this.#drawBackdrop(scene, camera);
    if (opacity > 0) this.renderToCanvasCallback(this.#film, renderer, quad.set(this.#film.texture, opacity));
  }

  /** The film is transparent where the camera sees no surface: the background is three's own. */
  #drawBackdrop(scene: Scene, camera: Camera): void {
    const backdrop = this.#backdrop;
    const { background, backgroundBlurriness, backgroundIntensity, backgroundRotation } = scene;
    Object.assign(backdrop, { background, backgroundBlurriness, backgroundIntensity });
    if (backgroundRotation) backdrop.backgroundRotation.copy(backgroundRotation);
    this.renderer.render(backdrop, camera);
  }

  #sample(due: boolean): void {
    const tracer = this.#tracer;
    if (!tracer || this.#sampling) return;
    const small = this.dynamicLowRes && this.#low !== 'made';
    if (!small && !due) return;
    this.#sampling = true;
    const resets = this.#resets;
    const film = small ? this.#lowFilm : this.#film;
    if (small) {
      this.#low = 'making';
      tracer.tracer.setRenderScale(checkNumber('lowResScale', this.lowResScale, 1e-6, 1));
    } else if (tracer.tracer.renderScale !== 1) tracer.tracer.setRenderScale(1);
    const work = tracer.sample().then(async () => {
      if (resets !== this.#resets || tracer.samples === 0) return;
      const read = film.read(tracer);
      if (!small) return void this.#run(read);
      // The film gets its size back when the small image is there.
      await read;
      if (resets === this.#resets) this.#low = 'made';
    });
    this.#run(work.finally(() => void (this.#sampling = false)));
  }

  #synchronize(): void {
    const { x, y } = this.renderer.getDrawingBufferSize(new Vector2());
    this.#resize([Math.floor(this.renderScale * x), Math.floor(this.renderScale * y)]);
  }

  #resize([x, y]: readonly [number, number]): void {
    const size = [Math.max(1, Math.floor(x)), Math.max(1, Math.floor(y))] as const;
    if (size[0] === this.#size[0] && size[1] === this.#size[1]) return;
    this.#size = size;
    this.#edit((tracer) => tracer.resize(...size));
  }

  async #setScene(scene: Scene, camera: Camera, options: SetSceneOptions): Promise<void> {
    const same = scene === this.scene;
    this.scene = scene;
    this.camera = camera;
    scene.updateMatrixWorld(true);
    camera.updateMatrixWorld();
    if (same && this.#preparing) {
      this.#stale = true;
      return this.#preparing.done;
    }
    if (same && this.#tracer) return this.#change(this.#tracer, (tracer) => tracer.update());
    return this.#prepare(scene, options);
  }

  #prepare(scene: Scene, options: SetSceneOptions): Promise<void> {
    this.#preparing?.abort.abort();
    this.#tracer?.destroy();
    this.#tracer = undefined;
    this.reset();
    if (this.synchronizeRenderSize || this.#size[0] === 0) this.#synchronize();
    const abort = new AbortController();
    const done = this.#create(scene, options, abort.signal).finally(() => {
      if (this.#preparing?.abort === abort) this.#preparing = undefined;
    });
    this.#preparing = { scene, done, abort };
    return done;
  }

  async #create(scene: Scene, { onProgress }: SetSceneOptions, signal: AbortSignal): Promise<void> {
    if (this.#disposed) throw new DOMException('This path tracer was disposed of.', 'AbortError');
    this.#stale = false;
    const size = this.#size;
    // Stages run side by side.
    const stages = { bvh: 0, upload: 0, compile: 0 };
    let reported = 0;
    const settings: Omit<PathTracerOptions, 'width' | 'height'> = {
      maxDepth: (this.#depth = depthOf(this.#bounces, this.#transmissiveBounces, true)),
      regularization: Math.min(1, this.#filterGlossyFactor),
      ...(onProgress
        ? {
            onProgress: ({ stage, done }) => {
              stages[stage] = done;
              const share = (stages.bvh + stages.upload + stages.compile) / 3;
              if (share > reported && share < 1) onProgress((reported = share));
            },
          }
        : {}),
    };
    const tracer = await ThreePathTracer.create(scene as unknown as ThreeObject, this.#threeCamera(), {
      width: size[0],
      height: size[1],
      tracer: settings,
      signal,
    });
    if (signal.aborted) {
      tracer.destroy();
      signal.throwIfAborted();
    }
    this.#tracer = tracer;
    this.#error = undefined;
    void tracer.device.lost.then(({ reason }) => {
      // The scene is there: another device takes its place.
      if (reason !== 'destroyed' && this.#tracer === tracer && this.scene) this.#run(this.#prepare(this.scene, {}));
    });
    // What was changed meanwhile.
    tracer.camera = this.#threeCamera();
    if (this.#stale) await tracer.update();
    else await tracer.updateCamera();
    if (this.#size !== size) await tracer.resize(...this.#size);
    this.#settled(tracer);
    onProgress?.(1);
  }

  #threeCamera(): ThreeCamera {
    return this.camera as unknown as ThreeCamera;
  }

  /** Begins an edit of the tracer, and the image again. */
  #edit(change: (tracer: ThreePathTracer) => Promise<unknown>): void {
    this.#stale = true;
    const tracer = this.#tracer;
    if (tracer && !this.#preparing) this.#run(this.#change(tracer, change));
    else this.reset();
  }

  async #change(tracer: ThreePathTracer, change: (tracer: ThreePathTracer) => Promise<unknown>): Promise<void> {
    this.#editing++;
    try {
      tracer.camera = this.#threeCamera();
      const before = tracer.tracer;
      const changing = change(tracer);
      this.reset();
      await changing;
      if (tracer === this.#tracer) {
        // A tracer that was prepared again has the depth of the first one.
        if (tracer.tracer !== before) this.#depth = 0;
        this.#settled(tracer);
      }
    } finally {
      this.#editing--;
    }
  }

  /** The tracer shows the scene as it is. */
  #settled(tracer: ThreePathTracer): void {
    for (const { message } of tracer.warnings) this.#reports.warn(message);
    this.#setDepth();
  }

  #setDepth(): void {
    const tracer = this.#tracer?.tracer;
    if (!tracer) return;
    const transmits = tracer.scene.materials.some(({ parameters }) => Number(parameters.transmission_weight ?? 0) > 0);
    const depth = depthOf(this.#bounces, this.#transmissiveBounces, transmits);
    if (depth === this.#depth) return;
    this.#depth = depth;
    tracer.setDepth(depth);
    this.reset();
  }

  /** Reports what goes wrong in work that nobody waits for. */
  #run(work: Promise<unknown>): void {
    work.catch((error: unknown) => {
      if (this.#disposed || (error as Error)?.name === 'AbortError' || isOver(error)) return;
      this.#error = error;
      this.#reports.error(error);
    });
  }
}

/** Whether an error says that a tracer was destroyed, which a scene that is replaced does to its own. */
const isOver = (error: unknown): boolean =>
  ['three/destroyed', 'renderer/destroyed'].includes(String((error as { readonly code?: unknown })?.code));
