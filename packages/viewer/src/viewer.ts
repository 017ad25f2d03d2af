import { frameCamera, frameCameraSteps, inSlices, sceneBoundsSteps, type Camera, type Environment, type Material, type Scene } from '@glanz/scene';
import type { PathTracer, PickResult } from '@glanz/renderer';
import type { ToneMap } from '@glanz/tonemap';
import { controlCamera, type ControlOptions } from './controls';
import { Emitter } from './emitter';
import { Engine } from './engine';
import { isAbort, ViewerError } from './errors';
import type { CameraChangeSource, LoadStage, ViewerEvents, ViewerState } from './events';
import { fitCamera } from './fit-camera';
import { loadEnvironment, loadModel, type EnvironmentSource, type ModelSource } from './load';
import type { ViewerOptions } from './options';
import { OrbitRig, type Orbit, type OrbitLimits, type Vector } from './orbit';
import { pictureSize } from './picture-size';
import { project, type Projection } from './project';
import { pictureBlob, type BlobOptions } from './blob';
import { plainScene } from './variants';

/** What {@link Viewer.load} may be told. */
export interface LoadOptions {
  /** Aborts the load; it rejects with the signal's reason, and the former model stays. */
  readonly signal?: AbortSignal;
  /** The first view; default that of {@link ViewerOptions.camera}. `keep` stays where the user is. */
  readonly camera?: ViewerOptions['camera'] | 'keep';
  /** Look of a model that has several. Default: that of {@link ViewerOptions.variant} where the model has it. */
  readonly variant?: string;
}

/** Where the stages of a load begin and end in the whole, as shares; usual ones. */
const STAGES: Readonly<Record<LoadStage, readonly [number, number]>> = { read: [0, 0.3], decode: [0.3, 0.45], images: [0.45, 0.55], bvh: [0.55, 0.75], upload: [0.75, 0.85], compile: [0.85, 1] };
const calm = () => typeof matchMedia === 'function' && matchMedia('(prefers-reduced-motion: reduce)').matches;

/**
 * A path-traced picture on a canvas: loads models, turns them under the user's hands, refines the picture when they rest,
 * sleeps out of sight, and survives the loss of the GPU. Made by {@link createViewer}.
 */
export class Viewer extends Emitter<ViewerEvents> {
  /** The canvas that it draws on. */
  readonly canvas: HTMLCanvasElement;
  /** See {@link ViewerOptions.autoRotateDelay}. */
  autoRotateDelay: number;
  readonly #options: ViewerOptions;
  readonly #engine: Engine;
  readonly #resize: ResizeObserver;
  #damping: number;
  #controls: boolean | ControlOptions;
  #stopControls: () => void = () => undefined;
  #rig: OrbitRig | undefined;
  #home: Camera | undefined;
  #loaded: Scene | undefined;
  #loading: AbortController | undefined;
  #environment: EnvironmentSource;
  #surroundings: Environment | undefined;
  #intensity: number;
  #rotation: number;
  #variant: string | undefined;
  #pixelRatio: number | undefined;
  #autoRotate: number;
  #limits: OrbitLimits;
  #rested = 0;
  #cameraSource: CameraChangeSource = 'api';

  /** @internal Use {@link createViewer}. */
  constructor(canvas: HTMLCanvasElement, options: ViewerOptions) {
    super();
    options.signal?.throwIfAborted();
    this.canvas = canvas;
    this.#options = options;
    this.#environment = options.environment ?? 'scene';
    this.#intensity = options.environmentIntensity ?? 1;
    this.#rotation = options.environmentRotation ?? 0;
    this.#variant = options.variant;
    this.#pixelRatio = options.pixelRatio;
    this.#autoRotate = options.autoRotate ?? 0;
    this.autoRotateDelay = options.autoRotateDelay ?? 3;
    this.#limits = options.orbitLimits ?? {};
    this.#damping = calm() ? 0 : (options.damping ?? 0.06);
    this.#controls = options.controls ?? true;
    const { preview = {} } = options;
    this.#engine = new Engine(
      canvas,
      {
        samples: options.samples ?? 256,
        noise: options.noise,
        maxDepth: options.maxDepth ?? 8,
        background: options.background ?? 'environment',
        exposure: options.exposure ?? 0,
        toneMap: options.toneMap ?? 'neutral',
        maxSubmitMs: options.maxSubmitMs ?? 16,
        settleMs: preview.settleMs ?? 180,
        previewDepth: preview.maxDepth ?? 4,
        tracer: options.tracer ?? {},
        requestDevice: options.requestDevice,
      },
      preview.budgetMs ?? 12,
      {
        step: (seconds) => this.#step(seconds),
        moving: () => (this.#rig?.moving ?? false) || this.#turning,
        camera: (aspect) => fitCamera((this.#rig as OrbitRig).camera(), aspect),
        state: (state) => this.emit('state', { state }),
        sample: ({ samples, targetSamples, samplesPerSecond, remainingMs }) => this.emit('sample', { samples, target: targetSamples, samplesPerSecond, remainingMs }),
        converged: (samples, milliseconds) => this.emit('converged', { samples, milliseconds }),
        drawn: (isPreview, milliseconds, [width, height]) => this.emit('frame', { preview: isPreview, milliseconds, width, height }),
        error: (error, retry) => this.#fail(error, retry),
        lost: (reason) => this.emit('device-lost', { reason }),
        restored: (milliseconds) => this.emit('device-restored', { milliseconds }),
        rescue: ({ scene }) => (this.#loaded ? plainScene(scene, this.#loaded, this.#variant) : scene),
        rescued: (tracer) => void (this.#variant !== undefined && tracer.setVariant(this.#variant).catch((error: unknown) => this.#fail(error))),
      },
    );
    this.#resize = new ResizeObserver(() => this.#resized());
    this.#resize.observe(canvas);
    this.#resized();
    this.#applyControls();
    options.signal?.addEventListener('abort', () => this.destroy(), { once: true });
  }

  /** What it is doing. */
  get state(): ViewerState {
    return this.#engine.state;
  }

  /** The scene as it has been edited; `undefined` before the first one is there. Read only. */
  get scene(): Scene | undefined {
    return this.#engine.tracer?.scene;
  }

  /** The path tracer of the present scene, for what the viewer has no word for. Another one after each load and each loss of the device. */
  get tracer(): PathTracer | undefined {
    return this.#engine.tracer;
  }

  /** The GPU device in use; another one after each loss. */
  get device(): GPUDevice | undefined {
    return this.#engine.device;
  }

  /** Samples per pixel of the picture as it is. */
  get sampleCount(): number {
    return this.#engine.current ? (this.#engine.tracer?.samples ?? 0) : 0;
  }

  /** Names of the looks that the model has. */
  get variants(): readonly string[] {
    return this.scene?.variants ?? [];
  }

  /**
   * Loads a model and shows it. Until it is ready the former one stays, and it stays where this fails. A load that comes
   * later aborts this one.
   *
   * @returns The scene as it was loaded.
   * @throws {GltfError} {FormatError} for files that cannot be read; {ViewerError} `viewer/no-model`, `viewer/destroyed`;
   * {DeviceError} {RenderError} for what the GPU cannot do. The `error` event tells them too.
   * @throws the signal's reason, or an `AbortError`, when aborted.
   * @example
   * await viewer.load('chair.glb');
   * input.onchange = () => viewer.load(input.files);
   */
  async load(source: ModelSource, options: LoadOptions = {}): Promise<Scene> {
    this.#check();
    this.#loading?.abort(new DOMException('another model was asked for', 'AbortError'));
    const loading = (this.#loading = new AbortController());
    const signal = options.signal ? AbortSignal.any([options.signal, loading.signal]) : loading.signal;
    const started = performance.now();
    const progress = ({ stage, done }: { stage: LoadStage; done: number }) => {
      const [from, to] = STAGES[stage];
      if (!signal.aborted) this.emit('progress', { stage, done, total: from + (to - from) * Math.min(1, Math.max(0, done)) });
    };
    try {
      signal.throwIfAborted();
      const { decoders, createWorker } = this.#options;
      const [scene, given] = await Promise.all([loadModel(source, { signal, decoders, createWorker, compressedFormats: () => this.#engine.compressedFormats(), onProgress: progress }), loadEnvironment(this.#environment, signal)]);
      signal.throwIfAborted();
      const surroundings = given ?? (this.#environment === 'scene' ? (scene.environment ?? (await loadEnvironment('studio'))) : undefined);
      const shown = withEnvironment(scene, this.#lit(surroundings));
      // Each goes through all vertices.
      const camera = await inSlices(this.#cameraSteps(scene, options.camera ?? this.#options.camera ?? 'auto'), { signal });
      const bounds = await inSlices(sceneBoundsSteps(scene), { signal });
      const tracer = await this.#engine.show(shown, fitCamera(camera, this.#aspect), signal, progress);
      this.#loaded = scene;
      this.#surroundings = surroundings;
      this.#home = camera;
      this.#rig = new OrbitRig(camera, bounds, { damping: this.#damping, limits: this.#limits });
      const variant = options.variant ?? this.#options.variant;
      this.#variant = variant !== undefined && scene.variants?.includes(variant) ? variant : undefined;
      if (this.#variant !== undefined) void tracer.setVariant(this.#variant).catch((error: unknown) => this.#fail(error));
      this.#cameraSource = 'api';
      this.#engine.touch();
      this.emit('load', { scene, milliseconds: performance.now() - started });
      return scene;
    } catch (error) {
      if (!isAbort(error)) this.#fail(error, () => void this.load(source, options).catch(() => undefined));
      throw error;
    } finally {
      if (this.#loading === loading) this.#loading = undefined;
    }
  }

  /**
   * Other surroundings. They also serve the models that are loaded later.
   * @returns When the picture shows them.
   * @throws {ViewerError} `viewer/environment`; {ImageError} for a picture that cannot be read; the former ones stay.
   */
  async setEnvironment(source: EnvironmentSource, options: { readonly signal?: AbortSignal } = {}): Promise<void> {
    this.#check();
    const given = await loadEnvironment(source, options.signal);
    options.signal?.throwIfAborted();
    this.#environment = source;
    this.#surroundings = given ?? (source === 'scene' ? (this.#loaded?.environment ?? (await loadEnvironment('studio'))) : undefined);
    await this.#relight();
  }

  /** See {@link ViewerOptions.environmentIntensity}. */
  get environmentIntensity(): number {
    return this.#intensity;
  }

  set environmentIntensity(intensity: number) {
    if (!(intensity >= 0 && intensity < Infinity) || intensity === this.#intensity) return;
    this.#intensity = intensity;
    this.#quietly(this.#relight());
  }

  /** See {@link ViewerOptions.environmentRotation}. */
  get environmentRotation(): number {
    return this.#rotation;
  }

  set environmentRotation(rotation: number) {
    if (!Number.isFinite(rotation) || rotation === this.#rotation) return;
    this.#rotation = rotation;
    this.#quietly(this.#relight());
  }

  /** See {@link ViewerOptions.background}. */
  get background(): 'environment' | 'transparent' {
    return this.#engine.settings.background;
  }

  set background(background: 'environment' | 'transparent') {
    if (background === this.#engine.settings.background) return;
    this.#engine.settings.background = background;
    this.#quietly(this.#engine.edit('background', (tracer) => tracer.setBackground(background)));
  }

  /** See {@link ViewerOptions.exposure}. */
  get exposure(): number {
    return this.#engine.settings.exposure ?? 0;
  }

  set exposure(exposure: number) {
    if (Number.isFinite(exposure) && exposure !== this.exposure) this.#quietly(this.#engine.setView({ exposure }));
  }

  /** See {@link ViewerOptions.toneMap}. An unknown one is told by the `error` event. */
  get toneMap(): ToneMap {
    return this.#engine.settings.toneMap ?? 'neutral';
  }

  set toneMap(toneMap: ToneMap) {
    if (toneMap !== this.toneMap) this.#quietly(this.#engine.setView({ toneMap }));
  }

  /** See {@link ViewerOptions.samples}. */
  get samples(): number {
    return this.#engine.settings.samples;
  }

  set samples(samples: number) {
    if (!(samples >= 1) || Math.floor(samples) === this.samples) return;
    this.#engine.settings.samples = Math.floor(samples);
    this.#engine.restart();
  }

  /** See {@link ViewerOptions.noise}. */
  get noise(): number | undefined {
    return this.#engine.settings.noise;
  }

  set noise(noise: number | undefined) {
    const wanted = noise !== undefined && noise > 0 ? noise : undefined;
    if (wanted === this.noise) return;
    this.#engine.settings.noise = wanted;
    this.#engine.restart();
  }

  /** See {@link ViewerOptions.maxDepth}. */
  get maxDepth(): number {
    return this.#engine.settings.maxDepth;
  }

  set maxDepth(depth: number) {
    if (!(Number.isInteger(depth) && depth >= 1 && depth <= 65535) || depth === this.maxDepth) return;
    this.#engine.settings.maxDepth = depth;
    if (this.#rig) this.#engine.touch();
  }

  /** See {@link ViewerOptions.pixelRatio}; `undefined` is the screen's own. */
  get pixelRatio(): number | undefined {
    return this.#pixelRatio;
  }

  set pixelRatio(ratio: number | undefined) {
    this.#pixelRatio = ratio;
    this.#resized();
  }

  /** Adds no samples while it is set, but for one after each change. */
  get paused(): boolean {
    return this.#engine.paused;
  }

  set paused(paused: boolean) {
    this.#engine.paused = paused;
  }

  /** See {@link ViewerOptions.controls}. */
  get controls(): boolean | ControlOptions {
    return this.#controls;
  }

  set controls(controls: boolean | ControlOptions) {
    this.#controls = controls;
    this.#applyControls();
  }

  /** See {@link ViewerOptions.autoRotate}. */
  get autoRotate(): number {
    return this.#autoRotate;
  }

  set autoRotate(speed: number) {
    this.#autoRotate = Number.isFinite(speed) ? speed : 0;
    if (this.#rig) this.#engine.touch();
  }

  /** Name of the look that is on; `undefined` is the model's own. */
  get variant(): string | undefined {
    return this.#variant;
  }

  /**
   * Puts the model into one of its looks, or into its own.
   * @returns When the picture shows it.
   * @throws {RenderError} `renderer/variant` if it has no such look; {ViewerError} `viewer/no-scene`.
   */
  async setVariant(variant: string | undefined): Promise<void> {
    await this.edit((tracer) => tracer.setVariant(variant), { key: 'variant' });
    this.#variant = variant;
  }

  /**
   * Changes parameters of a material; see `PathTracer.setMaterial`. Several calls before the next frame add up.
   * @returns When the picture shows it.
   * @throws {RenderError} `renderer/material`; {ViewerError} `viewer/no-scene`.
   */
  setMaterial(nameOrIndex: string | number, parameters: Material['parameters']): Promise<void> {
    this.#scene();
    return this.#engine.edit(`material ${nameOrIndex}`, (tracer, merged) => tracer.setMaterial(nameOrIndex, merged), parameters);
  }

  /**
   * Changes the scene by any method of the tracer, between two frames, so that a slow GPU skips edits rather than pictures.
   * Edits survive a loss of the device.
   *
   * @param options `key`: of several edits with one key that wait, the last one counts.
   * @returns When the picture shows it.
   * @example
   * await viewer.edit((tracer) => tracer.setVisibility('lid', false), { key: 'lid' });
   */
  edit(change: (tracer: PathTracer) => void | Promise<void>, options: { readonly key?: string } = {}): Promise<void> {
    this.#scene();
    return this.#engine.edit(options.key ?? Symbol('edit'), change);
  }

  /** Draws the picture again as it is, after a change that needs no new samples (`tracer.setLightGroup()`). */
  redraw(): void {
    this.#engine.redraw();
  }

  /** The camera that the picture is, or is being, taken with. `undefined` before there is a scene. */
  get camera(): Camera | undefined {
    return this.#rig && fitCamera(this.#rig.camera(), this.#aspect);
  }

  /** Goes to where a camera stands, smoothly unless `immediate`. The user turns about what lies ahead of it. */
  setCamera(camera: Camera | number | string, options: { readonly immediate?: boolean } = {}): void {
    const scene = this.#scene();
    this.#rig?.setCamera(typeof camera === 'object' ? camera : this.#chooseCamera(scene, camera));
    this.#moved(options.immediate);
  }

  /** Where the camera goes around what it looks at. `undefined` before there is a scene. */
  get orbit(): Orbit | undefined {
    return this.#rig?.goal;
  }

  /** Goes to an orbit, smoothly unless `immediate`; what is left out stays as it is. */
  setOrbit(orbit: Partial<Orbit>, options: { readonly immediate?: boolean } = {}): void {
    this.#scene();
    this.#rig?.setOrbit(orbit);
    this.#moved(options.immediate);
  }

  /** See {@link ViewerOptions.damping}. */
  get damping(): number {
    return this.#damping;
  }

  set damping(seconds: number) {
    if (!(seconds >= 0) || calm()) return;
    this.#damping = seconds;
    if (this.#rig) this.#rig.damping = seconds;
  }

  /** See {@link ViewerOptions.orbitLimits}. */
  get orbitLimits(): OrbitLimits {
    return this.#limits;
  }

  set orbitLimits(limits: OrbitLimits) {
    this.#limits = limits;
    if (!this.#rig) return;
    this.#rig.limits = limits;
    this.#moved(false);
  }

  /** Vertical field of view, radians; `undefined` for cameras that have none, and before there is a scene. */
  get fieldOfView(): number | undefined {
    return this.#rig?.yfov;
  }

  set fieldOfView(yfov: number | undefined) {
    if (!this.#rig || yfov === undefined) return;
    this.#rig.yfov = yfov;
    this.#moved(true);
  }

  /** Frames the whole model, from where the camera looks or from a direction (from the model towards the camera). */
  frame(options: { readonly direction?: Vector; readonly immediate?: boolean } = {}): void {
    const scene = this.#scene();
    const m = (this.#rig as OrbitRig).camera().transform;
    const direction = options.direction ?? ([m[8], m[9], m[10]] as unknown as Vector);
    this.#rig?.setCamera(frameCamera(scene, { aspect: this.#aspect, direction, ...(this.fieldOfView === undefined ? {} : { yfov: this.fieldOfView }) }));
    this.#moved(options.immediate);
  }

  /** Back to the first view. */
  home(options: { readonly immediate?: boolean } = {}): void {
    if (!this.#rig || !this.#home) return;
    this.#rig.setCamera(this.#home);
    this.#moved(options.immediate);
  }

  /** Looks at what lies under a point of the canvas; CSS pixels. @returns What lies there. */
  focus(x: number, y: number): PickResult | undefined {
    const hit = this.pick(x, y);
    if (hit) {
      this.#rig?.focus(hit.position);
      this.#moved(false);
    }
    return hit;
  }

  /** What lies under a point of the canvas; CSS pixels from its upper left corner. */
  pick(x: number, y: number): PickResult | undefined {
    const tracer = this.#engine.tracer;
    return tracer?.pick((x / Math.max(1, this.canvas.clientWidth)) * tracer.width, (y / Math.max(1, this.canvas.clientHeight)) * tracer.height);
  }

  /** Where a point of the world is on the canvas, as the camera is now. `undefined` before there is a scene. */
  project(point: Vector): Projection | undefined {
    const { camera } = this;
    return camera && project(camera, this.#aspect, point);
  }

  /**
   * The picture as a file, as large as the picture is. Waits until it has `samples` samples (default 1) at its full size.
   *
   * @throws {ViewerError} `viewer/no-scene`, `viewer/blob` where the browser cannot write this type.
   * @throws the signal's reason, when aborted.
   */
  async toBlob(options: BlobOptions = {}): Promise<Blob> {
    this.#scene();
    await this.#sampled(Math.min(options.samples ?? 1, this.samples), options.signal);
    const { tracer } = this;
    if (!tracer) throw new ViewerError('viewer/no-scene', 'There is no picture: load a model first.');
    return pictureBlob(tracer, { exposure: this.exposure, toneMap: this.toneMap }, options);
  }

  /** Frees everything, the device too. Idempotent. The canvas can serve another viewer. */
  destroy(): void {
    if (this.state === 'destroyed') return;
    this.#loading?.abort(new DOMException('the viewer was destroyed', 'AbortError'));
    this.#stopControls();
    this.#resize.disconnect();
    this.#engine.destroy();
    this.silence();
  }

  get #aspect(): number {
    return Math.max(1, this.canvas.clientWidth) / Math.max(1, this.canvas.clientHeight);
  }

  get #turning(): boolean {
    return this.#autoRotate !== 0 && !calm() && performance.now() - this.#rested > 1000 * this.autoRotateDelay;
  }

  #check(): void {
    if (this.state === 'destroyed') throw new ViewerError('viewer/destroyed', 'This viewer has been destroyed.');
  }

  #scene(): Scene {
    this.#check();
    if (!this.scene) throw new ViewerError('viewer/no-scene', 'There is no scene yet: await load() first.');
    return this.scene;
  }

  #fail(error: unknown, retry?: () => void): void {
    if (this.state === 'destroyed') return;
    const { message, code } = (typeof error === 'object' && error !== null ? error : { message: String(error) }) as { message?: string; code?: unknown };
    this.emit('error', { error, message: (message ?? 'Something failed.').split('\n')[0] as string, code: typeof code === 'string' ? code : 'unexpected', ...(retry ? { retry } : {}) });
  }

  /** For setters, which cannot throw later. */
  #quietly(done: Promise<void>): void {
    done.catch((error: unknown) => !isAbort(error) && this.#fail(error));
  }

  #step(seconds: number): boolean {
    const rig = this.#rig;
    if (!rig) return false;
    if (this.#turning) {
      this.#cameraSource = 'auto-rotate';
      rig.orbit(this.#autoRotate * Math.min(seconds, 0.1), 0);
      if (rig.damping === 0) rig.jump();
    }
    const moved = rig.step(seconds);
    if (moved) this.#told();
    return moved;
  }

  #told(): void {
    const { camera, orbit } = this;
    if (camera && orbit) this.emit('camera-change', { camera, orbit: (this.#rig as OrbitRig).orbitNow, source: this.#cameraSource });
  }

  #moved(immediate: boolean | undefined, source: CameraChangeSource = 'api'): void {
    this.#cameraSource = source;
    this.#rested = performance.now();
    const rig = this.#rig;
    if (immediate && rig) {
      rig.jump();
      this.#told();
    }
    this.#engine.touch();
  }

  #resized(): void {
    const { canvas } = this;
    const sizes = pictureSize(canvas.clientWidth, canvas.clientHeight, this.#pixelRatio, this.#options.maxPixels);
    this.#engine.resize(sizes, sizes);
  }

  #applyControls(): void {
    this.#stopControls();
    const { canvas } = this;
    if (!this.#controls) return;
    const options = this.#controls === true ? {} : this.#controls;
    const { touchAction } = canvas.style;
    canvas.style.touchAction = 'none';
    const focusable = canvas.hasAttribute('tabindex');
    if (!focusable) canvas.tabIndex = 0;
    const by = (act: (rig: OrbitRig) => void) => {
      if (!this.#rig) return;
      act(this.#rig);
      this.#moved(false, 'user');
    };
    const stop = controlCamera(
      canvas,
      {
        orbit: (yaw, pitch) => by((rig) => rig.orbit(yaw, pitch)),
        pan: (right, up) => by((rig) => rig.pan(right, up)),
        zoom: (factor) => by((rig) => rig.zoom(factor)),
        home: () => by((rig) => this.#home && rig.setCamera(this.#home)),
        focus: (x, y) => by((rig) => { const hit = this.pick(x, y); if (hit) rig.focus(hit.position); }),
        pick: (x, y) => void (this.heard('pick') && this.#rig && this.emit('pick', { hit: this.pick(x, y), x, y })),
      },
      options,
    );
    this.#stopControls = () => {
      stop();
      canvas.style.touchAction = touchAction;
      if (!focusable) canvas.removeAttribute('tabindex');
      this.#stopControls = () => undefined;
    };
  }

  #chooseCamera(scene: Scene, camera: number | string): Camera {
    const steps = this.#cameraSteps(scene, camera);
    let step = steps.next();
    while (!step.done) step = steps.next();
    return step.value;
  }

  *#cameraSteps(scene: Scene, camera: ViewerOptions['camera'] | 'keep'): Generator<void, Camera> {
    const aspect = this.#aspect;
    if (typeof camera === 'object') return camera;
    if (typeof camera === 'function') return camera(scene, aspect);
    if (camera === 'keep' && this.#rig) return this.#rig.camera();
    if (camera === 'frame') return yield* frameCameraSteps(scene, { aspect });
    if (camera === 'auto' || camera === 'keep' || camera === undefined) return scene.cameras[0] ?? (yield* frameCameraSteps(scene, { aspect }));
    const found = typeof camera === 'number' ? scene.cameras[camera] : scene.cameras.find(({ name }) => name === camera);
    if (!found) throw new ViewerError('viewer/camera', `The scene has no camera ${JSON.stringify(camera)}; it has: ${scene.cameras.map(({ name }) => name).join(', ') || 'none'}.`);
    return found;
  }

  #lit(environment: Environment | undefined): Environment | undefined {
    if (!environment) return undefined;
    const [k, turn] = [this.#intensity, this.#rotation];
    if (environment.type === 'constant') return { ...environment, radiance: environment.radiance.map((value) => value * k) as unknown as Vector };
    return { ...environment, intensity: (environment.intensity ?? 1) * k, rotation: (environment.rotation ?? 0) + turn };
  }

  async #relight(): Promise<void> {
    if (!this.scene) return;
    const environment = this.#lit(this.#surroundings);
    await this.#engine.edit('environment', (tracer) => tracer.setEnvironment(environment));
  }

  async #sampled(samples: number, signal: AbortSignal | undefined): Promise<void> {
    signal?.throwIfAborted();
    if (this.#engine.current && (this.tracer?.samples ?? 0) >= samples && this.sampleCount >= samples) return;
    const listening = new AbortController();
    try {
      await new Promise<void>((resolve, reject) => {
        const options = { signal: listening.signal };
        this.on('sample', (progress) => progress.samples >= samples && resolve(), options);
        this.on('converged', () => resolve(), options);
        this.on('state', ({ state }) => {
          if (state === 'failed' || state === 'destroyed') reject(new ViewerError('viewer/no-scene', 'The viewer failed before the picture was there; see its error event.'));
        }, options);
        signal?.addEventListener('abort', () => reject(signal.reason as Error), options);
      });
    } finally {
      listening.abort();
    }
  }
}

/** The scene in other surroundings. */
function withEnvironment(scene: Scene, environment: Environment | undefined): Scene {
  const { environment: _, ...rest } = scene;
  return environment ? { ...rest, environment } : rest;
}

/**
 * Makes a canvas show path-traced models. Returns at once; the GPU is asked for meanwhile, and `load()` waits for it.
 *
 * @param canvas One that has no context yet, or had a viewer before. Its size is that of its CSS box.
 * @throws {ViewerError} through `load()`: `viewer/no-canvas`. {DeviceError} through `load()`: `renderer/no-webgpu`, …
 * @example
 * const viewer = createViewer(document.querySelector('canvas'), { samples: 200 });
 * viewer.on('converged', ({ samples }) => console.log(samples));
 * await viewer.load('chair.glb');
 */
export function createViewer(canvas: HTMLCanvasElement, options: ViewerOptions = {}): Viewer {
  return new Viewer(canvas, options);
}

