import type { Camera, SceneBounds } from '@glanz/scene';
import type { OrbitView } from '../state/state';

type Vector = readonly [number, number, number];

/** Pitch stays short of the poles, where "up" has no meaning. */
const STEEPEST = (89.5 * Math.PI) / 180;

const add = (a: Vector, b: Vector, scale: number): Vector => [a[0] + b[0] * scale, a[1] + b[1] * scale, a[2] + b[2] * scale];

/** Width over height that a camera without a word about it is taken to be made for. */
const USUAL_ASPECT = 4 / 3;

/** The camera as it fits a film of another shape than its author had in mind: nothing of the view is cut off. */
export function fitCamera(camera: Camera, aspect: number): Camera {
  if (camera.type === 'panorama') return camera;
  if (camera.type === 'orthographic') {
    const { xmag, ymag } = camera;
    return xmag / ymag > aspect ? { ...camera, ymag: xmag / aspect } : { ...camera, xmag: ymag * aspect };
  }
  const { aspect: made = USUAL_ASPECT } = camera;
  return aspect >= made ? camera : { ...camera, yfov: 2 * Math.atan((Math.tan(camera.yfov / 2) * made) / aspect) };
}

/**
 * A camera that turns about a point, +Y up. Starts as any camera (a roll is given up), and gives cameras to render with.
 */
export class OrbitCamera {
  readonly #lens: Camera;
  readonly #radius: number;
  #target: Vector;
  #distance: number;
  #yaw: number;
  #pitch: number;
  /** Magnification of a parallel projection. */
  #zoom = 1;

  /** @param bounds Of the scene: the point to turn about lies beside its centre, and steps suit its size. */
  constructor(camera: Camera, bounds: SceneBounds) {
    const m = camera.transform;
    const eye: Vector = [m[12] as number, m[13] as number, m[14] as number];
    const length = Math.hypot(m[8] as number, m[9] as number, m[10] as number) || 1;
    const back: Vector = [(m[8] as number) / length, (m[9] as number) / length, (m[10] as number) / length];
    const centre = [0, 1, 2].map((k) => ((bounds.min[k] as number) + (bounds.max[k] as number)) / 2) as unknown as Vector;
    this.#radius = Math.max(0.5 * Math.hypot(bounds.max[0] - bounds.min[0], bounds.max[1] - bounds.min[1], bounds.max[2] - bounds.min[2]), 1e-6);
    const ahead = (eye[0] - centre[0]) * back[0] + (eye[1] - centre[1]) * back[1] + (eye[2] - centre[2]) * back[2];
    this.#lens = camera;
    this.#distance = ahead > 0.05 * this.#radius ? ahead : this.#radius;
    this.#target = add(eye, back, -this.#distance);
    this.#yaw = Math.atan2(back[0], back[2]);
    this.#pitch = Math.max(-STEEPEST, Math.min(STEEPEST, Math.asin(Math.max(-1, Math.min(1, back[1])))));
  }

  /** Where it is, to be kept and given to {@link restore}. */
  get view(): OrbitView {
    return { target: this.#target, distance: this.#distance, yaw: this.#yaw, pitch: this.#pitch, zoom: this.#zoom };
  }

  /** Goes back to where it was. */
  restore({ target, distance, yaw, pitch, zoom }: OrbitView): this {
    this.#target = target;
    this.#distance = distance;
    this.#yaw = yaw;
    this.#pitch = Math.max(-STEEPEST, Math.min(STEEPEST, pitch));
    this.#zoom = zoom;
    return this;
  }

  /** Turns about the target; radians, positive to the right and up around the model. */
  orbit(yaw: number, pitch: number): void {
    this.#yaw += yaw;
    this.#pitch = Math.max(-STEEPEST, Math.min(STEEPEST, this.#pitch + pitch));
  }

  /** Moves sideways and up, in heights of the picture at the target's distance. */
  pan(right: number, up: number): void {
    const { x, y } = this.#axes();
    const height = this.#lens.type === 'orthographic' ? (2 * this.#lens.ymag) / this.#zoom : 2 * this.#distance * (this.#lens.type === 'perspective' ? Math.tan(this.#lens.yfov / 2) : 1);
    this.#target = add(add(this.#target, x, right * height), y, up * height);
  }

  /** Comes nearer by a factor: 2 halves the distance. */
  zoom(factor: number): void {
    this.#distance = Math.min(Math.max(this.#distance / factor, this.#radius * 1e-3), this.#radius * 200);
    this.#zoom = Math.min(Math.max(this.#zoom * factor, 1e-3), 1e3);
  }

  /** The camera to render with. */
  camera(): Camera {
    const { x, y, z } = this.#axes();
    const eye = add(this.#target, z, this.#distance);
    const transform = [...x, 0, ...y, 0, ...z, 0, ...eye, 1];
    if (this.#lens.type === 'orthographic') return { ...this.#lens, transform, xmag: this.#lens.xmag / this.#zoom, ymag: this.#lens.ymag / this.#zoom };
    if (this.#lens.type === 'panorama') return { ...this.#lens, transform };
    return { ...this.#lens, transform, focus_distance: this.#distance };
  }

  #axes(): { readonly x: Vector; readonly y: Vector; readonly z: Vector } {
    const [cy, sy, cp, sp] = [Math.cos(this.#yaw), Math.sin(this.#yaw), Math.cos(this.#pitch), Math.sin(this.#pitch)];
    return { x: [cy, 0, -sy], y: [-sy * sp, cp, -cy * sp], z: [sy * cp, sp, cy * cp] };
  }
}
