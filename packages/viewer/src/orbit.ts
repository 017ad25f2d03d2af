import type { Camera, SceneBounds } from '@glanz/scene';
import { distance, dot, lerp, scaleAndAdd, subtract } from 'gl-matrix/esm/vec3.js';
import {
  checkedAmount,
  checkedCamera,
  checkedFieldOfView,
  checkedLimits,
  checkedOrbit,
  checkedPoint,
  checkedSetting,
  checkedZoom,
} from './checks';
import { column, unit, type Orbit, type OrbitLimits, type Vector } from './orbit-state';

export type { Orbit, OrbitLimits, Vector } from './orbit-state';

/** Options for {@link OrbitRig}. */
export interface OrbitRigOptions {
  /** Seconds in which 63 % of a movement is done; 0 moves at once. Default 0.06. */
  readonly damping?: number;
  /** Default: none. */
  readonly limits?: OrbitLimits;
}

interface Pose {
  yaw: number;
  pitch: number;
  distance: number;
  target: Vector;
  /** Magnification of a parallel projection. */
  zoom: number;
}

/** Pitch stays short of the poles, where "up" has no meaning. */
const STEEPEST = (89.5 * Math.PI) / 180;
/** What is left of a movement when it is called over: of a radian, of the distance. */
const REST = 2e-4;

const clamp = (value: number, low: number, high: number) => Math.min(Math.max(value, low), high);

/**
 * A camera that orbits a point, +Y up, and moves smoothly to where it is set. Starts as any camera (a roll is given
 * up) and gives cameras to render with. No DOM.
 *
 * @example
 * const rig = new OrbitRig(camera, sceneBounds(scene));
 * rig.orbit(0.1, 0);
 * while (rig.step(1 / 60)) draw(rig.camera());
 */
export class OrbitRig {
  #lens: Camera;
  readonly #radius: number;
  readonly #center: Vector;
  /** Where the lens's own camera stands. */
  #stand: Pose;
  #goal: Pose;
  #now: Pose;
  #damping: number;
  #limits: OrbitLimits;

  /**
   * @param bounds Bounds of the scene: the target is chosen near its centre, and steps are relative to its size.
   * @throws {ViewerError} `viewer/camera` for a camera or limits that nothing can be seen with; `viewer/option` for the
   * damping.
   */
  constructor(camera: Camera, bounds: SceneBounds, options: OrbitRigOptions = {}) {
    const finite = bounds.min[0] <= bounds.max[0];
    this.#center = finite ? lerp([0, 0, 0], bounds.min, bounds.max, 0.5) : [0, 0, 0];
    this.#radius = finite ? Math.max(0.5 * distance(bounds.min, bounds.max), 1e-6) : 1;
    this.#lens = checkedCamera(camera);
    this.#damping = checkedSetting('damping', options.damping ?? 0.06);
    this.#limits = checkedLimits(options.limits ?? {});
    this.#stand = this.#poseOf(camera);
    this.#goal = { ...this.#stand };
    this.#limit();
    this.#now = { ...this.#goal };
  }

  /**
   * Seconds, see {@link OrbitRigOptions.damping}. Setting it throws {ViewerError} `viewer/option` for what is no such
   * time.
   */
  get damping(): number {
    return this.#damping;
  }

  set damping(seconds: number) {
    this.#damping = checkedSetting('damping', seconds);
  }

  /**
   * Limits of the camera; a camera beyond them moves back. Setting it throws {ViewerError} `viewer/camera` for an
   * invalid range.
   */
  get limits(): OrbitLimits {
    return this.#limits;
  }

  set limits(limits: OrbitLimits) {
    this.#limits = checkedLimits(limits);
    this.#limit();
  }

  /** Radius of the sphere around the scene, metres. */
  get sceneRadius(): number {
    return this.#radius;
  }

  /** Middle of the scene's box. */
  get sceneCenter(): Vector {
    return this.#center;
  }

  /** Whether the camera is still on its way. */
  get moving(): boolean {
    return !samePose(this.#now, this.#goal);
  }

  /** Where the camera is going. */
  get goal(): Orbit {
    return this.#orbitOf(this.#goal);
  }

  /** Where the camera is. */
  get orbitNow(): Orbit {
    return this.#orbitOf(this.#now);
  }

  /**
   * Orbits the target; radians, positive to the right and up around the model.
   * @throws {ViewerError} `viewer/camera` for values that are not finite.
   */
  orbit(yaw: number, pitch: number): void {
    checkedAmount(yaw, 'yaw');
    checkedAmount(pitch, 'pitch');
    this.#goal.yaw += yaw;
    this.#goal.pitch = clamp(this.#goal.pitch + pitch, -STEEPEST, STEEPEST);
    this.#limit();
  }

  /**
   * Moves sideways and up, in heights of the image at the target's distance.
   * @throws {ViewerError} `viewer/camera` for values that are not finite, or move too far.
   */
  pan(right: number, up: number): void {
    checkedAmount(right, 'right');
    checkedAmount(up, 'up');
    const { x, y } = axesOf(this.#goal);
    const height =
      this.#lens.type === 'orthographic'
        ? (2 * this.#lens.ymag) / this.#goal.zoom
        : 2 * this.#goal.distance * (this.#lens.type === 'perspective' ? Math.tan(this.#lens.yfov / 2) : 1);
    this.#goal.target = checkedPoint(
      scaleAndAdd([0, 0, 0], scaleAndAdd([0, 0, 0], this.#goal.target, x, right * height), y, up * height),
      'target',
    );
  }

  /**
   * Moves closer by a factor: 2 halves the distance.
   * @throws {ViewerError} `viewer/camera` unless the factor is a number from 1e-6 to 1e6.
   */
  zoom(factor: number): void {
    checkedZoom(factor);
    this.#goal.distance = clamp(this.#goal.distance / factor, this.#radius * 1e-3, this.#radius * 200);
    this.#goal.zoom = clamp(this.#goal.zoom * factor, 1e-3, 1e3);
    this.#limit();
  }

  /**
   * Moves to an orbit; omitted fields do not change, except the zoom, which follows the radius. `phi` stops half a
   * degree short of the poles.
   *
   * @throws {ViewerError} `viewer/camera` for NaN, infinities, other types, a radius or zoom that is not above 0, and
   * numbers beyond the limits of the controls. The view does not change then.
   */
  setOrbit(orbit: Partial<Orbit>): void {
    const { theta, phi, radius, target, zoom } = checkedOrbit(orbit);
    if (theta !== undefined) {
      // The short way round.
      const turn = Math.PI * 2;
      const from = this.#goal.yaw;
      this.#goal.yaw = from + ((((theta - from + Math.PI) % turn) + turn) % turn) - Math.PI;
    }
    if (phi !== undefined) this.#goal.pitch = clamp(Math.PI / 2 - phi, -STEEPEST, STEEPEST);
    if (radius !== undefined) {
      this.#goal.zoom *= this.#goal.distance / radius;
      this.#goal.distance = radius;
    }
    if (target !== undefined) this.#goal.target = target;
    if (zoom !== undefined) this.#goal.zoom = zoom;
    this.#limit();
  }

  /**
   * Makes a point the target, from the same direction and distance.
   * @throws {ViewerError} `viewer/camera` unless it is three finite numbers.
   */
  focus(target: Vector): void {
    this.#goal.target = checkedPoint(target, 'target');
  }

  /**
   * Moves to a camera. Its lens and projection apply at once.
   * @throws {ViewerError} `viewer/camera` for an invalid camera. The view does not change then.
   */
  setCamera(camera: Camera): void {
    this.#lens = checkedCamera(camera);
    this.#stand = this.#poseOf(camera);
    this.#goal = { ...this.#stand };
    this.#limit();
  }

  /**
   * Vertical field of view of a perspective camera, radians in (0, π); `undefined` for others, where setting it changes
   * nothing. Setting it throws {ViewerError} `viewer/camera` for other values.
   */
  get yfov(): number | undefined {
    return this.#lens.type === 'perspective' ? this.#lens.yfov : undefined;
  }

  set yfov(yfov: number | undefined) {
    if (yfov !== undefined) checkedFieldOfView(yfov);
    if (this.#lens.type === 'perspective' && yfov !== undefined) this.#lens = { ...this.#lens, yfov };
  }

  /** Is where it was going. */
  jump(): void {
    this.#now = { ...this.#goal };
  }

  /**
   * Lets time pass.
   *
   * @param seconds Since the last step; at most a tenth counts, so that a page that slept does not leap.
   * @returns Whether the camera moved.
   */
  step(seconds: number): boolean {
    if (!this.moving) return false;
    const [now, goal] = [this.#now, this.#goal];
    const passed = seconds > 0 ? Math.min(seconds, 0.1) : 0;
    const share = this.#damping > 0 ? 1 - Math.exp(-passed / this.#damping) : 1;
    const near = Math.max(goal.distance, 1e-9);
    const left = Math.max(
      Math.abs(goal.yaw - now.yaw),
      Math.abs(goal.pitch - now.pitch),
      Math.abs(Math.log(goal.distance / now.distance)),
      Math.abs(Math.log(goal.zoom / now.zoom)),
      distance(goal.target, now.target) / near,
    );
    if (share >= 1 || left * (1 - share) < REST) {
      this.jump();
      return true;
    }
    const mix = (a: number, b: number) => a + (b - a) * share;
    this.#now = {
      yaw: mix(now.yaw, goal.yaw),
      pitch: mix(now.pitch, goal.pitch),
      // Distances are interpolated by their ratio: coming nearer looks as fast from afar as from close by.
      distance: now.distance * (goal.distance / now.distance) ** share,
      zoom: now.zoom * (goal.zoom / now.zoom) ** share,
      target: lerp([0, 0, 0], now.target, goal.target, share),
    };
    return true;
  }

  /**
   * The camera to render with, where it is now. Until the first movement after `setCamera()` it is exactly that camera,
   * with its roll, its focus and a vertical view; the first movement removes these.
   */
  camera(): Camera {
    const pose = this.#now;
    if (samePose(pose, this.#stand)) return this.#lens;
    const { x, y, z } = axesOf(pose);
    const transform = [...x, 0, ...y, 0, ...z, 0, ...scaleAndAdd([0, 0, 0], pose.target, z, pose.distance), 1];
    if (this.#lens.type === 'orthographic')
      return { ...this.#lens, transform, xmag: this.#lens.xmag / pose.zoom, ymag: this.#lens.ymag / pose.zoom };
    if (this.#lens.type === 'panorama') return { ...this.#lens, transform };
    return { ...this.#lens, transform, focus_distance: pose.distance };
  }

  #limit(): void {
    const { theta, phi, radius } = this.#limits;
    const goal = this.#goal;
    if (theta) goal.yaw = clamp(goal.yaw, ...theta);
    if (phi)
      goal.pitch = clamp(
        goal.pitch,
        Math.max(-STEEPEST, Math.PI / 2 - phi[1]),
        Math.min(STEEPEST, Math.PI / 2 - phi[0]),
      );
    if (radius) goal.distance = clamp(goal.distance, ...radius);
  }

  #orbitOf({ yaw, pitch, distance, target, zoom }: Pose): Orbit {
    return {
      theta: yaw,
      phi: Math.PI / 2 - pitch,
      radius: distance,
      target,
      ...(this.#lens.type === 'orthographic' ? { zoom } : {}),
    };
  }

  #poseOf(camera: Camera): Pose {
    const m = camera.transform;
    const eye = column(m, 12);
    const back = unit(column(m, 8));
    const ahead = dot(subtract([0, 0, 0], eye, this.#center), back);
    const away = ahead > 0.05 * this.#radius ? ahead : this.#radius;
    return {
      yaw: Math.atan2(back[0], back[2]),
      pitch: clamp(Math.asin(clamp(back[1], -1, 1)), -STEEPEST, STEEPEST),
      distance: away,
      target: scaleAndAdd([0, 0, 0], eye, back, -away),
      zoom: 1,
    };
  }
}

const samePose = (a: Pose, b: Pose) =>
  a.yaw === b.yaw &&
  a.pitch === b.pitch &&
  a.distance === b.distance &&
  a.zoom === b.zoom &&
  a.target.every((value, k) => value === b.target[k]);

function axesOf({ yaw, pitch }: Pose): { readonly x: Vector; readonly y: Vector; readonly z: Vector } {
  const [cy, sy, cp, sp] = [Math.cos(yaw), Math.sin(yaw), Math.cos(pitch), Math.sin(pitch)];
  return { x: [cy, 0, -sy], y: [-sy * sp, cp, -cy * sp], z: [sy * cp, sp, cy * cp] };
}
