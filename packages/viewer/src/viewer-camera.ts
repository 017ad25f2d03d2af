import type { PickResult } from '@glanz/renderer';
import { finish, frameCamera, frameCameraSteps, type Camera, type Scene, type SceneBounds } from '@glanz/scene';
import {
  checkedAmount,
  checkedCamera,
  checkedDirection,
  checkedFieldOfView,
  checkedLimits,
  checkedSetting,
  sceneOf,
} from './checks';
import { controlCamera, type ControlOptions } from './controls';
import type { Emitter } from './emitter';
import type { Engine } from './engine';
import { ViewerError } from './errors';
import type { CameraChangeSource, ViewerEvents } from './events';
import { fitCamera } from './fit-camera';
import { withoutGround } from './ground';
import type { ViewerOptions } from './options';
import { OrbitRig } from './orbit';
import { column, type Orbit, type OrbitLimits, type Vector } from './orbit-state';

const prefersReducedMotion = () => matchMedia('(prefers-reduced-motion: reduce)').matches;

/** How the camera moves: at once or, by default, smoothly. */
interface Move {
  readonly immediate?: boolean;
}

/** The camera of a viewer: where it is and goes, and the controls that move it. */
export class ViewerCamera {
  readonly #canvas: HTMLCanvasElement;
  readonly #events: Emitter<ViewerEvents>;
  readonly #engine: Engine;
  /** See `ViewerOptions.autoRotate`. */
  autoRotate: number;
  /** See `ViewerOptions.autoRotateDelay`. */
  autoRotateDelay: number;
  #damping: number;
  #limits: OrbitLimits;
  #controls: boolean | ControlOptions;
  #stopControls: () => void = () => undefined;
  #rig: OrbitRig | undefined;
  #home: Camera | undefined;
  #lastMove = 0;
  #source: CameraChangeSource = 'api';

  constructor(canvas: HTMLCanvasElement, options: ViewerOptions, events: Emitter<ViewerEvents>, engine: Engine) {
    this.#canvas = canvas;
    this.#events = events;
    this.#engine = engine;
    this.autoRotate = options.autoRotate ?? 0;
    this.autoRotateDelay = options.autoRotateDelay ?? 3;
    this.#limits = checkedLimits(options.orbitLimits ?? {});
    this.#damping = prefersReducedMotion() ? 0 : (options.damping ?? 0.06);
    this.#controls = options.controls ?? true;
    this.#applyControls();
  }

  get controls(): boolean | ControlOptions {
    return this.#controls;
  }

  set controls(controls: boolean | ControlOptions) {
    this.#controls = controls;
    this.#applyControls();
  }

  get damping(): number {
    return this.#damping;
  }

  set damping(seconds: number) {
    checkedSetting('damping', seconds);
    if (prefersReducedMotion()) return;
    this.#damping = seconds;
    if (this.#rig) this.#rig.damping = seconds;
  }

  get limits(): OrbitLimits {
    return this.#limits;
  }

  set limits(limits: OrbitLimits) {
    this.#limits = checkedLimits(limits);
    if (!this.#rig) return;
    this.#rig.limits = this.#limits;
    this.#moved();
  }

  /** Width over height of the canvas. */
  get aspect(): number {
    return Math.max(1, this.#canvas.clientWidth) / Math.max(1, this.#canvas.clientHeight);
  }

  /** The camera of an image, by default one of the canvas's shape. `undefined` before there is a scene. */
  camera(aspect = this.aspect): Camera | undefined {
    return this.#rig && fitCamera(this.#rig.camera(), aspect);
  }

  /** See `Viewer.setCamera`. */
  setCamera(camera: Camera | number | string, move?: Move): void {
    const scene = withoutGround(sceneOf(this.#engine));
    this.#rig?.setCamera(finish(this.choose(scene, camera)));
    this.#moved(move);
  }

  get orbit(): Orbit | undefined {
    return this.#rig?.goal;
  }

  /** See `Viewer.setOrbit`. */
  setOrbit(orbit: Partial<Orbit>, move?: Move): void {
    sceneOf(this.#engine);
    this.#rig?.setOrbit(orbit);
    this.#moved(move);
  }

  get fieldOfView(): number | undefined {
    return this.#rig?.yfov;
  }

  set fieldOfView(yfov: number | undefined) {
    if (yfov !== undefined) checkedFieldOfView(yfov);
    if (!this.#rig || yfov === undefined) return;
    this.#rig.yfov = yfov;
    this.#moved({ immediate: true });
  }

  /** See `Viewer.frame`. */
  frame(move?: Move & { readonly direction?: Vector }): void {
    const scene = withoutGround(sceneOf(this.#engine));
    const rig = this.#rig as OrbitRig;
    const direction =
      move?.direction === undefined ? column(rig.camera().transform, 8) : checkedDirection(move.direction, 'direction');
    const { yfov } = rig;
    rig.setCamera(frameCamera(scene, { aspect: this.aspect, direction, ...(yfov === undefined ? {} : { yfov }) }));
    this.#moved(move);
  }

  /** See `Viewer.home`. */
  home(move?: Move): void {
    if (!this.#rig || !this.#home) return;
    this.#rig.setCamera(this.#home);
    this.#moved(move);
  }

  /** See `Viewer.focus`. */
  focus(x: number, y: number): PickResult | undefined {
    const hit = this.pick(x, y);
    if (hit) {
      this.#rig?.focus(hit.position);
      this.#moved();
    }
    return hit;
  }

  /** See `Viewer.pick`. */
  pick(x: number, y: number): PickResult | undefined {
    checkedAmount(x, 'x');
    checkedAmount(y, 'y');
    const { tracer } = this.#engine;
    return tracer?.pick(
      (x / Math.max(1, this.#canvas.clientWidth)) * tracer.width,
      (y / Math.max(1, this.#canvas.clientHeight)) * tracer.height,
    );
  }

  /** Looks at another model from its first camera. */
  begin(camera: Camera, bounds: SceneBounds): void {
    this.#home = camera;
    this.#rig = new OrbitRig(camera, bounds, { damping: this.#damping, limits: this.#limits });
    this.#source = 'api';
    this.#engine.touch();
  }

  /** The camera that an option means, in steps. */
  *choose(scene: Scene, camera: ViewerOptions['camera'] | 'keep'): Generator<void, Camera> {
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

  /** Whether the camera moves, or is about to. */
  get moving(): boolean {
    return (this.#rig?.moving ?? false) || this.#turning;
  }

  /** Advances the camera by so many seconds. @returns Whether it has moved. */
  step(seconds: number): boolean {
    const rig = this.#rig;
    if (!rig) return false;
    if (this.#turning) {
      this.#source = 'auto-rotate';
      rig.orbit(this.autoRotate * Math.min(seconds, 0.1), 0);
      if (rig.damping === 0) rig.jump();
    }
    const moved = rig.step(seconds);
    if (moved) this.#report(rig);
    return moved;
  }

  /** Removes the controls. */
  destroy(): void {
    this.#stopControls();
  }

  /** Whether the view rotates by itself now. */
  get #turning(): boolean {
    return (
      this.autoRotate !== 0 &&
      !prefersReducedMotion() &&
      performance.now() - this.#lastMove > 1000 * this.autoRotateDelay
    );
  }

  #report(rig: OrbitRig): void {
    this.#events.emit('camera-change', {
      camera: this.camera() as Camera,
      orbit: rig.orbitNow,
      source: this.#source,
    });
  }

  #moved(move?: Move, source: CameraChangeSource = 'api'): void {
    this.#source = source;
    this.#lastMove = performance.now();
    const rig = this.#rig;
    if (rig && move?.immediate) {
      rig.jump();
      this.#report(rig);
    }
    this.#engine.touch();
  }

  #applyControls(): void {
    this.#stopControls();
    const canvas = this.#canvas;
    if (!this.#controls) return;
    const options = this.#controls === true ? {} : this.#controls;
    const { touchAction } = canvas.style;
    canvas.style.touchAction = 'none';
    const focusable = canvas.hasAttribute('tabindex');
    if (!focusable) canvas.tabIndex = 0;
    const by = (act: (rig: OrbitRig) => void) => {
      if (!this.#rig) return;
      act(this.#rig);
      this.#moved(undefined, 'user');
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
        pick: (x, y) =>
          void (this.#events.has('pick') && this.#rig && this.#events.emit('pick', { hit: this.pick(x, y), x, y })),
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
}
