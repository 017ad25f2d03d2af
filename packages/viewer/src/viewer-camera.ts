import type { PickResult } from '@glanz/renderer';
import { frameCamera, frameCameraSteps, type Camera, type Scene, type SceneBounds } from '@glanz/scene';
import {
  checkedCamera,
  checkedDirection,
  checkedAmount,
  checkedFieldOfView,
  checkedLimits,
  checkedSetting,
} from './checks';
import { controlCamera, type ControlOptions } from './controls';
import type { EngineHost } from './engine';
import { ViewerError } from './errors';
import type { CameraChangeSource } from './events';
import { fitCamera } from './fit-camera';
import type { ViewerOptions } from './options';
import { OrbitRig } from './orbit';
import type { Orbit, OrbitLimits, Vector } from './orbit-state';
import { project, type Projection } from './project';
import { ViewerSettings } from './viewer-settings';

const calm = () => typeof matchMedia === 'function' && matchMedia('(prefers-reduced-motion: reduce)').matches;

/** The camera of a {@link Viewer} and its controls. */
export abstract class ViewerCamera extends ViewerSettings {
  #autoRotateDelay: number;
  #damping: number;
  #controls: boolean | ControlOptions;
  #stopControls: () => void = () => undefined;
  #rig: OrbitRig | undefined;
  #home: Camera | undefined;
  #autoRotate: number;
  #limits: OrbitLimits;
  #rested = 0;
  #cameraSource: CameraChangeSource = 'api';

  /** @internal Use {@link createViewer}. */
  constructor(canvas: HTMLCanvasElement, options: ViewerOptions) {
    super(canvas, options);
    this.#autoRotate = options.autoRotate ?? 0;
    this.#autoRotateDelay = options.autoRotateDelay ?? 3;
    this.#limits = checkedLimits(options.orbitLimits ?? {});
    this.#damping = calm() ? 0 : (options.damping ?? 0.06);
    this.#controls = options.controls ?? true;
    this.#applyControls();
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
    this.#autoRotate = checkedSetting('autoRotate', speed);
    if (this.#rig) this.engine.touch();
  }

  /** See {@link ViewerOptions.autoRotateDelay}. */
  get autoRotateDelay(): number {
    return this.#autoRotateDelay;
  }

  set autoRotateDelay(seconds: number) {
    this.#autoRotateDelay = checkedSetting('autoRotateDelay', seconds);
  }

  /** The camera that the image is, or is being, taken with. `undefined` before there is a scene. */
  get camera(): Camera | undefined {
    return this.#rig && fitCamera(this.#rig.camera(), this.aspect);
  }

  /**
   * Goes to where a camera stands, smoothly unless `immediate`. The user turns about what lies ahead of it.
   * @throws {ViewerError} `viewer/no-scene`; `viewer/camera` for a camera that the scene does not have, or that nothing
   * can be seen with. The view stays as it was then.
   */
  setCamera(camera: Camera | number | string, options: { readonly immediate?: boolean } = {}): void {
    const scene = this.theScene();
    this.#rig?.setCamera(
      typeof camera === 'number' || typeof camera === 'string' ? this.#chooseCamera(scene, camera) : camera,
    );
    this.#moved(options.immediate);
  }

  /** Where the camera goes around what it looks at. `undefined` before there is a scene. */
  get orbit(): Orbit | undefined {
    return this.#rig?.goal;
  }

  /**
   * Goes to an orbit, smoothly unless `immediate`; what is left out stays as it is.
   * @throws {ViewerError} `viewer/no-scene`; `viewer/camera` for NaN, infinities, other types, and a radius that is not
   * above 0. The view stays as it was then.
   */
  setOrbit(orbit: Partial<Orbit>, options: { readonly immediate?: boolean } = {}): void {
    this.theScene();
    this.#rig?.setOrbit(orbit);
    this.#moved(options.immediate);
  }

  /** See {@link ViewerOptions.damping}. */
  get damping(): number {
    return this.#damping;
  }

  set damping(seconds: number) {
    checkedSetting('damping', seconds);
    if (calm()) return;
    this.#damping = seconds;
    if (this.#rig) this.#rig.damping = seconds;
  }

  /** See {@link ViewerOptions.orbitLimits}. */
  get orbitLimits(): OrbitLimits {
    return this.#limits;
  }

  set orbitLimits(limits: OrbitLimits) {
    this.#limits = checkedLimits(limits);
    if (!this.#rig) return;
    this.#rig.limits = this.#limits;
    this.#moved(false);
  }

  /** Vertical field of view, radians; `undefined` for cameras that have none, and before there is a scene. */
  get fieldOfView(): number | undefined {
    return this.#rig?.yfov;
  }

  set fieldOfView(yfov: number | undefined) {
    if (yfov !== undefined) checkedFieldOfView(yfov);
    if (!this.#rig || yfov === undefined) return;
    this.#rig.yfov = yfov;
    this.#moved(true);
  }

  /**
   * Frames the whole model, from where the camera looks or from a direction (from the model towards the camera).
   * @throws {ViewerError} `viewer/no-scene`; `viewer/camera` for a direction without length or of other than finite
   * numbers.
   */
  frame(options: { readonly direction?: Vector; readonly immediate?: boolean } = {}): void {
    const scene = this.theScene();
    const m = (this.#rig as OrbitRig).camera().transform;
    const direction =
      options.direction === undefined
        ? ([m[8], m[9], m[10]] as unknown as Vector)
        : checkedDirection(options.direction, 'direction');
    this.#rig?.setCamera(
      frameCamera(scene, {
        aspect: this.aspect,
        direction,
        ...(this.fieldOfView === undefined ? {} : { yfov: this.fieldOfView }),
      }),
    );
    this.#moved(options.immediate);
  }

  /** Back to the first view. */
  home(options: { readonly immediate?: boolean } = {}): void {
    if (!this.#rig || !this.#home) return;
    this.#rig.setCamera(this.#home);
    this.#moved(options.immediate);
  }

  /** Looks at what lies under a point of the canvas; CSS pixels. @returns What lies there. @throws as {@link pick}. */
  focus(x: number, y: number): PickResult | undefined {
    const hit = this.pick(x, y);
    if (hit) {
      this.#rig?.focus(hit.position);
      this.#moved(false);
    }
    return hit;
  }

  /**
   * What lies under a point of the canvas; CSS pixels from its upper left corner.
   * @throws {ViewerError} `viewer/camera` for what are no finite numbers.
   */
  pick(x: number, y: number): PickResult | undefined {
    checkedAmount(x, 'x');
    checkedAmount(y, 'y');
    const tracer = this.engine.tracer;
    return tracer?.pick(
      (x / Math.max(1, this.canvas.clientWidth)) * tracer.width,
      (y / Math.max(1, this.canvas.clientHeight)) * tracer.height,
    );
  }

  /** Where a point of the world is on the canvas, as the camera is now. `undefined` before there is a scene. */
  project(point: Vector): Projection | undefined {
    const { camera } = this;
    return camera && project(camera, this.aspect, point);
  }

  override destroy(): void {
    this.#stopControls();
    super.destroy();
  }

  /** @internal Looks at another model from its first camera. */
  protected beginAt(camera: Camera, bounds: SceneBounds): void {
    this.#home = camera;
    this.#rig = new OrbitRig(camera, bounds, { damping: this.#damping, limits: this.#limits });
    this.#cameraSource = 'api';
    this.engine.touch();
  }

  /** @internal */
  protected cameraHost(): Pick<EngineHost, 'step' | 'moving' | 'camera'> {
    return {
      step: (seconds) => this.#step(seconds),
      moving: () => (this.#rig?.moving ?? false) || this.#turning,
      camera: (aspect) => fitCamera((this.#rig as OrbitRig).camera(), aspect),
    };
  }

  get #turning(): boolean {
    return this.#autoRotate !== 0 && !calm() && performance.now() - this.#rested > 1000 * this.autoRotateDelay;
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
    if (moved) this.#emitCameraChange();
    return moved;
  }

  #emitCameraChange(): void {
    const { camera, orbit } = this;
    if (camera && orbit)
      this.emit('camera-change', { camera, orbit: (this.#rig as OrbitRig).orbitNow, source: this.#cameraSource });
  }

  #moved(immediate: boolean | undefined, source: CameraChangeSource = 'api'): void {
    this.#cameraSource = source;
    this.#rested = performance.now();
    const rig = this.#rig;
    if (immediate && rig) {
      rig.jump();
      this.#emitCameraChange();
    }
    this.engine.touch();
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
        focus: (x, y) =>
          by((rig) => {
            const hit = this.pick(x, y);
            if (hit) rig.focus(hit.position);
          }),
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
    const steps = this.cameraSteps(scene, camera);
    let step = steps.next();
    while (!step.done) step = steps.next();
    return step.value;
  }

  /** @internal The camera that an option means. */
  protected *cameraSteps(scene: Scene, camera: ViewerOptions['camera'] | 'keep'): Generator<void, Camera> {
    const { aspect } = this;
    if (typeof camera === 'object') return checkedCamera(camera);
    if (typeof camera === 'function') return checkedCamera(camera(scene, aspect));
    if (camera === 'keep' && this.#rig) return this.#rig.camera();
    if (camera === 'frame') return yield* frameCameraSteps(scene, { aspect });
    if (camera === 'auto' || camera === 'keep' || camera === undefined)
      return scene.cameras[0] ?? (yield* frameCameraSteps(scene, { aspect }));
    const found =
      typeof camera === 'number' ? scene.cameras[camera] : scene.cameras.find(({ name }) => name === camera);
    if (!found)
      throw new ViewerError(
        'viewer/camera',
        `The scene has no camera ${JSON.stringify(camera)}; it has: ${scene.cameras.map(({ name }) => name).join(', ') || 'none'}.`,
      );
    return found;
  }
}
