import type { PathTracer } from '@glanz/renderer';
import { sceneBounds, type Camera } from '@glanz/scene';
import { ViewerError } from '../errors';
import { fitCamera } from '../fit-camera';
import { OrbitRig } from '../orbit';
import { column, type Orbit, type Vector } from '../orbit-state';
import type { VideoSource } from './source';

/** Scene, camera and tracer of a video. */
export interface VideoStage {
  /** What the video is recorded from: the viewer that was passed. */
  readonly viewer: VideoSource;
  /** The video's own path tracer, of the scene as the viewer has shown it. Its edits change the video alone. */
  readonly tracer: PathTracer;
  /** The camera that the viewer has shown the scene with, in the video's shape. */
  readonly camera: Camera;
  /** The target of that camera. */
  readonly target: Vector;
}

/** What changes in the course of a video. */
export interface VideoMotion {
  /** How long it takes, in seconds. */
  readonly seconds?: number | undefined;
  /** Called before each frame with its time in seconds: for changes that a frame shows as a whole. */
  readonly frame?: (seconds: number) => void | Promise<void>;
  /**
   * Poses the tracer's scene at a time in seconds by edits; resolves when they are done. With an open shutter it is
   * called several times for each frame, perhaps again from the frame's first one.
   */
  readonly at?: (seconds: number) => void | Promise<void>;
}

/** What happens in a video: one of the functions below, or one of your own. */
export type VideoPath = (stage: VideoStage) => VideoMotion | Promise<VideoMotion>;

/** Options for {@link turntable}. */
export interface TurntableOptions {
  /** Default 4. */
  readonly seconds?: number;
  /** Angle by which the camera moves, in degrees; below 0 to the left. Default 360. */
  readonly degrees?: number;
}

/**
 * The camera of the viewer orbits its target at a constant speed.
 * @throws {ViewerError} `viewer/option`
 */
export function turntable({ seconds = 4, degrees = 360 }: TurntableOptions = {}): VideoPath {
  checkSeconds(seconds);
  if (!Number.isFinite(degrees))
    throw new ViewerError('viewer/option', `degrees is ${degrees}; it must be a finite number.`);
  return ({ camera, target, tracer }) => ({
    seconds,
    at: (time) => {
      const angle = (degrees * Math.PI * time) / seconds / 180;
      return tracer.setCamera({ ...camera, transform: turned(camera.transform, angle, target) });
    },
  });
}

/** A transform that is turned about the vertical axis through a point, counter-clockwise seen from above. */
function turned(transform: ArrayLike<number>, angle: number, [x, , z]: Vector): number[] {
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  return [0, 4, 8, 12].flatMap((at) => {
    const [a, b, d] = column(transform, at);
    const [u, v] = at === 12 ? [a - x, d - z] : [a, d];
    const moved = at === 12 ? [x, z, 1] : [0, 0, 0];
    return [c * u + s * v + (moved[0] as number), b, c * v - s * u + (moved[1] as number), moved[2] as number];
  });
}

/** Options for {@link animation}. */
export interface AnimationOptions {
  /** Name of the animation. Default: the model's first. */
  readonly name?: string;
  /** Default: once through the animation. Beyond its end it begins again. */
  readonly seconds?: number;
  /** Seconds of the animation where the video begins. Default 0. */
  readonly from?: number;
  /** Default 1. */
  readonly speed?: number;
}

/**
 * Plays an animation of the model. The video rejects with {ViewerError} `viewer/animation` where there is none.
 * @throws {ViewerError} `viewer/option`
 */
export function animation({ name, seconds, from = 0, speed = 1 }: AnimationOptions = {}): VideoPath {
  if (seconds !== undefined) checkSeconds(seconds);
  if (!(Number.isFinite(from) && from >= 0 && speed > 0 && speed < Infinity))
    throw new ViewerError(
      'viewer/option',
      `from is ${from} and speed ${speed}; from must be at least 0, speed above 0.`,
    );
  return async ({ viewer, tracer }) => {
    const player = await viewer.animation();
    const chosen = player.animations.find((one) => name === undefined || one.name === name);
    if (!chosen)
      throw new ViewerError(
        'viewer/animation',
        `The model has no animation ${JSON.stringify(name)}; it has: ${player.animations.map((one) => one.name).join(', ')}.`,
      );
    const { duration } = chosen;
    const pose = await player.poserFor(tracer);
    return {
      seconds: seconds ?? (duration > from ? (duration - from) / speed : undefined),
      at: (time) => {
        const at = from + speed * time;
        return pose(chosen.name, at > duration && duration > 0 ? at % duration : at);
      },
    };
  };
}

/** A place in a walk, see {@link keyframes}. */
export interface VideoKeyframe {
  /** Seconds from the video's start, in ascending order. */
  readonly time: number;
  /** Where the camera is then; `viewer.orbit` gives the present one. What is left out is as at the key before. */
  readonly orbit?: Partial<Orbit>;
  /** A change that is made before the first frame from this time on: a variant, a colour, a part. */
  readonly edit?: (tracer: PathTracer) => void | Promise<void>;
}

/**
 * A walk: the camera moves smoothly from one orbit to the next, and the model changes at the keys.
 *
 * @throws {ViewerError} `viewer/option` without keys, and for times that do not ascend
 * @example
 * const red = (tracer) => tracer.setMaterial('paint', { base_color: [0.8, 0, 0] });
 * keyframes([
 *   { time: 0, orbit: { theta: 0 } },
 *   { time: 2, orbit: { theta: 1, radius: 2 }, edit: red },
 *   { time: 4, orbit: { theta: 0 } },
 * ]);
 */
export function keyframes(keys: readonly VideoKeyframe[]): VideoPath {
  if (keys.length === 0 || keys.some(({ time }, i) => !(time >= (keys[i - 1]?.time ?? 0) && time < Infinity)))
    throw new ViewerError('viewer/option', 'keyframes() needs keys whose times ascend from 0 or later.');
  return ({ viewer, tracer, camera }) => {
    const aspect = tracer.width / tracer.height;
    let last = viewer.orbit as Orbit;
    const orbits = keys.map(({ orbit }) => (last = { ...last, ...orbit }));
    const moves = keys.some(({ orbit }) => orbit);
    const rig = new OrbitRig(viewer.camera ?? camera, sceneBounds(tracer.scene), { damping: 0 });
    let made = 0;
    return {
      seconds: keys.at(-1)?.time || undefined,
      async frame(time) {
        for (; made < keys.length && (keys[made] as VideoKeyframe).time <= time + 1e-9; made++)
          await keys[made]?.edit?.(tracer);
      },
      async at(time) {
        if (!moves) return;
        rig.setOrbit(orbitAt(keys, orbits, time));
        rig.jump();
        await tracer.setCamera(fitCamera(rig.camera(), aspect));
      },
    };
  };
}

/** Between two keys, with a speed of 0 at both. */
function orbitAt(keys: readonly VideoKeyframe[], orbits: readonly Orbit[], time: number): Orbit {
  const next = keys.findIndex((key) => key.time > time);
  if (next <= 0) return orbits.at(next) as Orbit;
  const [a, b] = [orbits[next - 1] as Orbit, orbits[next] as Orbit];
  const [from, to] = [keys[next - 1] as VideoKeyframe, keys[next] as VideoKeyframe];
  const f = (time - from.time) / (to.time - from.time);
  const share = f * f * (3 - 2 * f);
  const mix = (x: number, y: number) => x + (y - x) * share;
  return {
    theta: mix(a.theta, b.theta),
    phi: mix(a.phi, b.phi),
    // By its ratio: coming nearer looks as fast from afar as from close by.
    radius: a.radius * (b.radius / a.radius) ** share,
    target: a.target.map((value, k) => mix(value, b.target[k] as number)) as unknown as Vector,
    ...(a.zoom === undefined || b.zoom === undefined ? {} : { zoom: a.zoom * (b.zoom / a.zoom) ** share }),
  };
}

/** @throws {ViewerError} `viewer/option` */
export function checkSeconds(seconds: number): void {
  if (!(seconds > 0 && seconds <= 86_400))
    throw new ViewerError('viewer/option', `seconds is ${seconds}; it must be above 0 and at most 86400.`);
}
