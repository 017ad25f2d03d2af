import type { PathTracer } from '@glanz/renderer';
import type { Camera, SceneAnimation } from '@glanz/scene';
import type { ToneMap } from '@glanz/tonemap';
import type { Denoising } from '../denoise-session';
import type { TracerCopy } from '../engine-host';
import type { Orbit } from '../orbit-state';

/**
 * What a video is recorded from. A `Viewer` is one; an application that drives an `Engine` of `@glanz/viewer/engine`
 * itself passes an object with what it shows.
 */
export interface VideoSource {
  /** Samples per pixel of a frame, where the options have none. */
  readonly samples: number;
  /** Background of the model, where the options have none. */
  readonly background: 'environment' | 'transparent';
  /** EV. */
  readonly exposure: number;
  readonly toneMap: ToneMap;
  /** The camera that the scene is shown with. `undefined` before there is a scene. */
  readonly camera: Camera | undefined;
  /** The orbit of that camera around its target. `undefined` before there is a scene. */
  readonly orbit: Orbit | undefined;
  /** Denoises the frames; `undefined`: they stay as rendered. */
  readonly denoise: Denoising | undefined;
  readonly device: GPUDevice | undefined;
  /** What makes another path tracer of the scene as it is now, e.g. `Engine.copyFor`. @param aspect Width over height. */
  copyFor(aspect: number): TracerCopy | undefined;
  /** The model's animations, for the path `animation()`. @throws {ViewerError} `viewer/animation` where it has none. */
  animation(): Promise<VideoAnimations>;
}

/** Animations of a model, and what poses a path tracer by them. */
export interface VideoAnimations {
  readonly animations: readonly SceneAnimation[];
  /**
   * @param tracer Of the same model. @returns A function that poses the tracer's scene at a time in seconds of the
   * named animation.
   */
  poserFor(tracer: PathTracer): Promise<(name: string | undefined, seconds: number) => Promise<void>>;
}
