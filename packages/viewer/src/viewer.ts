import type { PathTracer, PickResult } from '@glanz/renderer';
import type { Camera, Scene } from '@glanz/scene';
import { checkToneMapOptions, type ToneMap } from '@glanz/tonemap';
import { checkAlive, checkedMode, checkedOption, checkedSetting, checkedStage, checkSettings, sceneOf } from './checks';
import type { AnimationPlayer } from './animation-player';
import type { ControlOptions } from './controls';
import { isAbort } from './aborts';
import type { Denoising } from './denoise-session';
import { Emitter, type ListenOptions } from './emitter';
import { Engine, type TracerCopy } from './engine';
import { engineSettings, previewOptions } from './engine-settings';
import { ViewerError, loadPart } from './errors';
import type { ViewerEvents, ViewerState } from './events';
import { imageSize } from './image-size';
import type { GroundOptions } from './ground';
import type { EnvironmentSource, ModelSource } from './load';
import type { MaterialEdit } from './material-colors';
import type { BlobOptions, LoadOptions, ViewerOptions } from './options';
import type { Orbit, OrbitLimits, Vector } from './orbit-state';
import type { PreviewMode } from './preview';
import { project, type Projection } from './project';
import { ViewerCamera } from './viewer-camera';
import { ViewerEnvironment } from './viewer-environment';
import { ViewerModel } from './viewer-model';
import { engineReports, reportError, reportWarning } from './viewer-reports';

/** @throws {ViewerError} `viewer/no-canvas`, `viewer/option`, `viewer/camera`; {ToneMapError} `tonemap/unknown`. */
function checkArguments(canvas: HTMLCanvasElement, options: ViewerOptions): void {
  if (typeof (canvas as HTMLCanvasElement | null)?.getContext !== 'function')
    throw new ViewerError('viewer/no-canvas', 'The first argument must be a canvas element.');
  checkSettings(options);
  checkToneMapOptions(options);
}

/**
 * A path-traced image on a canvas: loads models, moves the camera by pointer and keys, refines the image while the view
 * does not move, suspends while not visible, and recovers from a loss of the GPU. Made by {@link createViewer}.
 *
 * Its properties can be set at any time. Setting one to a value that it cannot have (NaN, an infinity, another type, a
 * number outside of its range) throws a {@link ViewerError} `viewer/option` and changes nothing.
 */
export class Viewer {
  /** The canvas that it draws on. */
  readonly canvas: HTMLCanvasElement;
  readonly #events = new Emitter<ViewerEvents>();
  readonly #engine: Engine;
  readonly #camera: ViewerCamera;
  readonly #environment: ViewerEnvironment;
  readonly #model: ViewerModel;
  readonly #resize: ResizeObserver;
  readonly #maxPixels: number | undefined;
  #pixelRatio: number | undefined;

  /** @internal Use {@link createViewer}. */
  constructor(canvas: HTMLCanvasElement, options: ViewerOptions) {
    options.signal?.throwIfAborted();
    checkArguments(canvas, options);
    this.canvas = canvas;
    this.#maxPixels = options.maxPixels;
    this.#pixelRatio = options.pixelRatio;
    const events = this.#events;
    const engine = (this.#engine = new Engine(canvas, engineSettings(options), previewOptions(options).budgetMs ?? 12, {
      ...engineReports(events),
      step: (seconds) => {
        const moved = this.#camera.step(seconds);
        return this.#model.player?.step(seconds) || moved;
      },
      moving: () => this.#camera.moving || this.#animates,
      camera: (aspect) => this.#camera.camera(aspect) as Camera,
    }));
    this.denoise = options.denoise;
    this.#camera = new ViewerCamera(canvas, options, events, engine);
    this.#environment = new ViewerEnvironment(engine, options);
    this.#model = new ViewerModel(options, events, engine, this.#camera, this.#environment);
    this.#resize = new ResizeObserver(() => this.#resized());
    this.#resize.observe(canvas);
    this.#resized();
    options.signal?.addEventListener('abort', () => this.destroy(), { once: true });
  }

  /**
   * Adds a listener for an event. Where one throws, the others are still called, and its error is an uncaught
   * error of the page.
   *
   * @returns A function that removes the listener.
   * @example
   * viewer.on('converged', ({ samples }) => console.log(samples));
   */
  on<K extends keyof ViewerEvents>(
    type: K,
    listener: (detail: ViewerEvents[K]) => void,
    options?: ListenOptions,
  ): () => void {
    return this.#events.on(type, listener, options);
  }

  /** What it is doing. */
  get state(): ViewerState {
    return this.#engine.state;
  }

  /** The scene as it has been edited; `undefined` before the first one is loaded. Read only. */
  get scene(): Scene | undefined {
    return this.tracer?.scene;
  }

  /**
   * The path tracer of the present scene, for what the viewer has no method for. Another one after each load and each
   * loss of the device.
   */
  get tracer(): PathTracer | undefined {
    return this.#engine.tracer;
  }

  /** The GPU device in use; another one after each loss. */
  get device(): GPUDevice | undefined {
    return this.#engine.device;
  }

  /** Samples per pixel of the image as it is. */
  get sampleCount(): number {
    return this.#engine.current ? (this.tracer?.samples ?? 0) : 0;
  }

  /**
   * Loads a model and shows it. Until it is ready, and where this fails, the former model is shown. A later load aborts
   * this one. An environment that cannot be fetched or read does not fail the load: the studio lights the model, and
   * the `warning` event says why.
   *
   * @returns The scene as it was loaded.
   * @throws {GltfError} {FormatError} for files that cannot be read; {ViewerError} `viewer/no-model`,
   * `viewer/destroyed`; {DeviceError} {RenderError} for what the GPU cannot do. The `error` event has them too.
   * @throws the signal's reason, or an `AbortError`, when aborted.
   * @example
   * await viewer.load('chair.glb');
   * input.onchange = () => viewer.load(input.files);
   */
  async load(source: ModelSource, options: LoadOptions = {}): Promise<Scene> {
    checkAlive(this.#engine);
    return this.#model.load(source, options);
  }

  /** Names of the model's variants. */
  get variants(): readonly string[] {
    return this.scene?.variants ?? [];
  }

  /** Name of the variant that is shown; `undefined`: the model's own materials. */
  get variant(): string | undefined {
    return this.#model.variant;
  }

  /**
   * Shows one of the model's variants, or its own materials.
   * @returns When the image shows it.
   * @throws {RenderError} `renderer/variant` if it has no such variant; {ViewerError} `viewer/no-scene`.
   */
  setVariant(variant: string | undefined): Promise<void> {
    return this.#model.setVariant(variant);
  }

  /**
   * The player of the model's animations, which `scene.animations` lists. Its code is fetched at the first call; each
   * model has its own player. Frames are previews while one plays; where it rests, the image of that pose is refined to
   * its end.
   *
   * @throws {ViewerError} `viewer/animation` where there is no model with animations; {GltfError} where the file cannot
   * be read again; an `AbortError` where another model was shown meanwhile.
   * @example
   * const animation = await viewer.animation();
   * animation.name = 'open';
   * animation.play({ repetitions: 1 });
   */
  async animation(): Promise<AnimationPlayer> {
    sceneOf(this.#engine);
    return this.#model.animation();
  }

  /**
   * Changes parameters of a material; see `PathTracer.setMaterial`. Several calls before the next frame add up. Colours
   * are linear Rec.709, or CSS colours as text, which are converted from sRGB: a name, `#rgb`, `#rrggbb`, `rgb()` or
   * `hsl()`. A call that throws changes nothing.
   * @returns When the image shows it.
   * @throws {RenderError} `renderer/material`; {ToneMapError} `tonemap/color` for what is not a CSS colour; {ViewerError}
   * `viewer/no-scene`.
   * @example
   * await viewer.setMaterial('seat', { base_color: 'rebeccapurple', specular_roughness: 0.2 });
   */
  setMaterial(nameOrIndex: string | number, parameters: MaterialEdit): Promise<void> {
    return this.#model.setMaterial(nameOrIndex, parameters);
  }

  /**
   * Shows or hides all parts with a name, or the part with an index in `scene.instances`. Of several calls for one part
   * before the next frame, the last one applies.
   * @returns When the image shows it.
   * @throws {RenderError} `renderer/instance`, `renderer/no-triangles` if no part would be visible; {ViewerError}
   * `viewer/no-scene`.
   */
  setVisibility(nameOrIndex: string | number, visible: boolean): Promise<void> {
    return this.edit((tracer) => tracer.setVisibility(nameOrIndex, visible), { key: `visibility ${nameOrIndex}` });
  }

  /**
   * Puts another material of the scene on the parts of a name, or on the one of an index.
   * @returns When the image shows it.
   * @throws {RenderError} `renderer/instance`, `renderer/material`; {ViewerError} `viewer/no-scene`.
   * @example
   * await viewer.setPartMaterial('seat', 'oak');
   */
  setPartMaterial(nameOrIndex: string | number, material: string | number): Promise<void> {
    return this.edit((tracer) => tracer.setInstanceMaterial(nameOrIndex, material), { key: `part ${nameOrIndex}` });
  }

  /**
   * Changes the scene by any method of the tracer, between two frames, so that a slow GPU skips edits rather than
   * images. Edits survive a loss of the device.
   *
   * @param options `key`: of several edits with one key that wait, the last one counts.
   * @returns When the image shows it.
   * @example
   * await viewer.edit((tracer) => tracer.setCatcher('floor', true), { key: 'floor' });
   */
  edit(change: (tracer: PathTracer) => void | Promise<void>, options: { readonly key?: string } = {}): Promise<void> {
    sceneOf(this.#engine);
    return this.#engine.edit(options.key ?? Symbol('edit'), change);
  }

  /** Draws the image again as it is, after a change that needs no new samples (`tracer.setLightGroup()`). */
  redraw(): void {
    this.#engine.redraw();
  }

  /**
   * The image as a file, at the screen's size or any other, with the viewer's target samples unless others are
   * requested. Where the image on the screen is or will be the requested one, it is used; otherwise the scene and the
   * view at the time of the call are rendered separately, on a path tracer of their own, and the screen's image keeps
   * its samples.
   *
   * @throws {ViewerError} `viewer/no-scene`, `viewer/option`, `viewer/blob` where the browser cannot write this type or
   * size.
   * @throws {DeviceError} `renderer/limit`, `renderer/out-of-memory` for a size that the GPU cannot hold;
   * `renderer/device-lost`
   * @throws the signal's reason, when aborted; an `AbortError` when the viewer is destroyed.
   * @example
   * const blob = await viewer.toBlob({ width: 3840, height: 2160, samples: 1024, onProgress: ({ share }) => (bar.value
   * = share) });
   */
  async toBlob(options: BlobOptions = {}): Promise<Blob> {
    sceneOf(this.#engine);
    const { imageBlob } = await loadPart('save-image', import('./save-image'));
    checkAlive(this.#engine);
    const animates = () => this.#animates;
    return imageBlob(this, this.#engine, options, { checkedOption, checkedSetting, ViewerError, animates });
  }

  /**
   * Another environment. It also serves the models that are loaded later. A later call aborts an earlier one.
   * @returns When the image shows it.
   * @throws {ViewerError} `viewer/environment`; {ImageError} for an image that cannot be read; {SceneError} for data
   * that is no environment; {DeviceError} where the GPU has no memory for it. The former one stays.
   * @throws the signal's reason, or an `AbortError`, when aborted.
   */
  async setEnvironment(source: EnvironmentSource, options: { readonly signal?: AbortSignal } = {}): Promise<void> {
    checkAlive(this.#engine);
    return this.#environment.change(source, this.#model.loaded, options.signal);
  }

  /** See {@link ViewerOptions.environmentIntensity}. */
  get environmentIntensity(): number {
    return this.#environment.intensity;
  }

  set environmentIntensity(intensity: number) {
    if (checkedSetting('environmentIntensity', intensity) !== this.environmentIntensity)
      this.#inBackground(this.#environment.set({ intensity }));
  }

  /** See {@link ViewerOptions.environmentRotation}. */
  get environmentRotation(): number {
    return this.#environment.rotation;
  }

  set environmentRotation(rotation: number) {
    if (checkedSetting('environmentRotation', rotation) !== this.environmentRotation)
      this.#inBackground(this.#environment.set({ rotation }));
  }

  /** See {@link ViewerOptions.background}. */
  get background(): 'environment' | 'transparent' {
    return this.#engine.settings.background;
  }

  set background(background: 'environment' | 'transparent') {
    if (checkedOption('background', background) === this.#engine.settings.background) return;
    this.#engine.settings.background = background;
    this.#inBackground(this.#engine.edit('background', (tracer) => tracer.setBackground(background)));
  }

  /** See {@link ViewerOptions.modelTransform}. */
  get modelTransform(): ArrayLike<number> | undefined {
    return this.#model.stage.transform;
  }

  set modelTransform(modelTransform: ArrayLike<number> | undefined) {
    this.#inBackground(this.#model.setStage({ transform: checkedStage({ modelTransform }).transform }));
  }

  /** See {@link ViewerOptions.ground}. */
  get ground(): GroundOptions | undefined {
    return this.#model.stage.ground;
  }

  set ground(ground: GroundOptions | undefined) {
    this.#inBackground(this.#model.setStage({ ground: checkedStage({ ground }).ground }));
  }

  /** See {@link ViewerOptions.credentials}. */
  get credentials(): RequestCredentials | undefined {
    return this.#model.credentials;
  }

  set credentials(credentials: RequestCredentials | undefined) {
    this.#model.credentials = this.#environment.credentials = credentials;
  }

  /** See {@link ViewerOptions.exposure}. */
  get exposure(): number {
    return this.#engine.settings.exposure as number;
  }

  set exposure(exposure: number) {
    if (checkedSetting('exposure', exposure) !== this.exposure) this.#inBackground(this.#engine.setView({ exposure }));
  }

  /** See {@link ViewerOptions.toneMap}. Setting an unknown one throws {ToneMapError} `tonemap/unknown`. */
  get toneMap(): ToneMap {
    return this.#engine.settings.toneMap as ToneMap;
  }

  set toneMap(toneMap: ToneMap) {
    checkToneMapOptions({ toneMap });
    if (toneMap !== this.toneMap) this.#inBackground(this.#engine.setView({ toneMap }));
  }

  /** What is shown while something moves, see {@link PreviewMode}. */
  get previewMode(): PreviewMode {
    return this.#engine.settings.previewMode ?? 'auto';
  }

  set previewMode(mode: PreviewMode) {
    this.#engine.settings.previewMode = checkedMode(mode);
  }

  /** See {@link ViewerOptions.denoise}. */
  get denoise(): Denoising | undefined {
    return this.#engine.settings.denoise?.source;
  }

  set denoise(denoise: Denoising | undefined) {
    checkSettings({ denoise });
    if (denoise === this.denoise) return;
    const { settings } = this.#engine;
    settings.denoise?.destroy();
    settings.denoise = denoise?.(
      (error) => reportWarning(this.#events, error),
      () => this.device,
    );
    this.#engine.redraw();
  }

  /** See {@link ViewerOptions.samples}. */
  get samples(): number {
    return this.#engine.settings.samples;
  }

  set samples(samples: number) {
    if (checkedOption('samples', samples) === this.samples) return;
    this.#engine.settings.samples = samples;
    this.#engine.restart();
  }

  /** See {@link ViewerOptions.noise}. */
  get noise(): number | undefined {
    return this.#engine.settings.noise;
  }

  set noise(noise: number | undefined) {
    const target = noise === undefined ? undefined : checkedOption('noise', noise) || undefined;
    if (target === this.noise) return;
    this.#engine.settings.noise = target;
    this.#engine.restart();
  }

  /** See {@link ViewerOptions.maxDepth}. */
  get maxDepth(): number {
    return this.#engine.settings.maxDepth;
  }

  set maxDepth(depth: number) {
    if (checkedOption('maxDepth', depth) === this.maxDepth) return;
    this.#engine.settings.maxDepth = depth;
    this.#engine.touch();
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
    return this.#engine.paused;
  }

  set paused(paused: boolean) {
    this.#engine.paused = paused;
  }

  /** See {@link ViewerOptions.controls}. */
  get controls(): boolean | ControlOptions {
    return this.#camera.controls;
  }

  set controls(controls: boolean | ControlOptions) {
    this.#camera.controls = controls;
  }

  /** See {@link ViewerOptions.autoRotate}. */
  get autoRotate(): number {
    return this.#camera.autoRotate;
  }

  set autoRotate(speed: number) {
    this.#camera.autoRotate = checkedSetting('autoRotate', speed);
    this.#engine.touch();
  }

  /** See {@link ViewerOptions.autoRotateDelay}. */
  get autoRotateDelay(): number {
    return this.#camera.autoRotateDelay;
  }

  set autoRotateDelay(seconds: number) {
    this.#camera.autoRotateDelay = checkedSetting('autoRotateDelay', seconds);
  }

  /** See {@link ViewerOptions.damping}. */
  get damping(): number {
    return this.#camera.damping;
  }

  set damping(seconds: number) {
    this.#camera.damping = seconds;
  }

  /** See {@link ViewerOptions.orbitLimits}. */
  get orbitLimits(): OrbitLimits {
    return this.#camera.limits;
  }

  set orbitLimits(limits: OrbitLimits) {
    this.#camera.limits = limits;
  }

  /** The camera that the image is, or is being, taken with. `undefined` before there is a scene. */
  get camera(): Camera | undefined {
    return this.#camera.camera();
  }

  /**
   * Moves to a camera, smoothly unless `immediate`. The target of the controls is the point in front of it.
   * @throws {ViewerError} `viewer/no-scene`; `viewer/camera` for a camera that the scene does not have, or that is not
   * valid. The view does not change then.
   */
  setCamera(camera: Camera | number | string, options?: { readonly immediate?: boolean }): void {
    this.#camera.setCamera(camera, options);
  }

  /** The orbit of the camera around its target. `undefined` before a scene is loaded. */
  get orbit(): Orbit | undefined {
    return this.#camera.orbit;
  }

  /**
   * Moves to an orbit, smoothly unless `immediate`; omitted fields do not change.
   * @throws {ViewerError} `viewer/no-scene`; `viewer/camera` for NaN, infinities, other types, and a radius that is not
   * above 0. The view does not change then.
   */
  setOrbit(orbit: Partial<Orbit>, options?: { readonly immediate?: boolean }): void {
    this.#camera.setOrbit(orbit, options);
  }

  /** Vertical field of view, radians; `undefined` for cameras without one, and before a scene is loaded. */
  get fieldOfView(): number | undefined {
    return this.#camera.fieldOfView;
  }

  set fieldOfView(yfov: number | undefined) {
    this.#camera.fieldOfView = yfov;
  }

  /**
   * Frames the whole model, from the camera's direction or from another one (from the model towards the camera).
   * @throws {ViewerError} `viewer/no-scene`; `viewer/camera` for a direction without length or of other than finite
   * numbers.
   */
  frame(options?: { readonly direction?: Vector; readonly immediate?: boolean }): void {
    this.#camera.frame(options);
  }

  /** Back to the first view. */
  home(options?: { readonly immediate?: boolean }): void {
    this.#camera.home(options);
  }

  /**
   * Makes the surface at a point of the canvas the camera's target; CSS pixels. @returns The surface there. @throws as
   * {@link pick}.
   */
  focus(x: number, y: number): PickResult | undefined {
    return this.#camera.focus(x, y);
  }

  /**
   * What lies under a point of the canvas; CSS pixels from its upper left corner.
   * @throws {ViewerError} `viewer/camera` for what are no finite numbers.
   */
  pick(x: number, y: number): PickResult | undefined {
    return this.#camera.pick(x, y);
  }

  /** Where a point of the world is on the canvas, as the camera is now. `undefined` before there is a scene. */
  project(point: Vector): Projection | undefined {
    const { camera } = this;
    return camera && project(camera, this.#camera.aspect, point);
  }

  /** @internal What makes another tracer of the scene as it is, for `@glanz/viewer/record`. */
  copyFor(aspect: number): TracerCopy | undefined {
    return this.#engine.copyFor(aspect);
  }

  /** Frees everything, the device too. Idempotent. The canvas can serve another viewer. */
  destroy(): void {
    if (this.state === 'destroyed') return;
    this.#model.destroy();
    this.#environment.destroy();
    this.#camera.destroy();
    this.#resize.disconnect();
    this.#engine.destroy();
    this.#events.close();
  }

  /** Whether an animation plays. */
  get #animates(): boolean {
    return this.#model.player?.paused === false;
  }

  /** Emits an error of work that a setter has started. */
  #inBackground(work: Promise<void>): void {
    work.catch((error: unknown) => isAbort(error) || reportError(this.#events, error));
  }

  #resized(): void {
    const { clientWidth, clientHeight } = this.canvas;
    const size = imageSize(clientWidth, clientHeight, this.#pixelRatio, this.#maxPixels);
    this.#engine.resize(size, size);
  }
}

/**
 * Creates a viewer, which shows path-traced models on a canvas. Returns at once: the GPU is requested asynchronously,
 * and `load()` waits for it.
 *
 * @param canvas A canvas without a context, or one that had a viewer before. Its size is that of its CSS box.
 * @throws {ViewerError} `viewer/option` for options out of their ranges, `viewer/no-canvas` for what is no canvas;
 * through `load()`: `viewer/no-canvas` for one that has another context. {ToneMapError} `tonemap/unknown`.
 * {DeviceError} through `load()`: `renderer/no-webgpu`, …
 * @example
 * const viewer = createViewer(document.querySelector('canvas'), { samples: 200 });
 * viewer.on('converged', ({ samples }) => console.log(samples));
 * await viewer.load('chair.glb');
 */
export function createViewer(canvas: HTMLCanvasElement, options: ViewerOptions = {}): Viewer {
  return new Viewer(canvas, options);
}
