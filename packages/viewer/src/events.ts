import type { PickResult } from '@glanz/renderer';
import type { Camera, GlanzError, Scene } from '@glanz/scene';
import type { Orbit } from './orbit-state';

/**
 * State of a viewer. `empty`: no scene. `loading`: a model is loaded or prepared. `moving`: the preview is shown.
 * `rendering`: samples are added. `done`: the image has all requested samples. `paused`; `hidden`: not visible,
 * rendering is suspended; `recovering`: the GPU was lost and a device is requested; `failed`: see the `error` event;
 * `destroyed`.
 */
export type ViewerState =
  | 'empty'
  | 'loading'
  | 'moving'
  | 'rendering'
  | 'done'
  | 'paused'
  | 'hidden'
  | 'recovering'
  | 'failed'
  | 'destroyed';

/** Stages of a load, in their order. */
export type LoadStage = 'read' | 'decode' | 'images' | 'bvh' | 'upload' | 'compile';

/** Events of a {@link Viewer}, by name. */
export interface ViewerEvents {
  /** A model is ready to be shown. */
  load: { readonly scene: Scene; /** Since `load()` was called. */ readonly milliseconds: number };
  /** A load progresses. `done`: share of the stage; `total`: estimated share of the whole; both 0..1. */
  progress: { readonly stage: LoadStage; readonly done: number; readonly total: number };
  /**
   * An operation failed. `code` is that of a `GlanzError`, or `unexpected`. `retry` is defined where another attempt
   * may succeed.
   */
  error: { readonly error: unknown; readonly message: string; readonly code: string; readonly retry?: () => void };
  /**
   * The viewer continues with a fallback: an environment cannot be fetched or read, and a studio lights the model
   * (`viewer/environment`; `error.cause` is what went wrong); the image cannot be denoised and is shown with its noise
   * (`viewer/denoise`, likewise); textures lack their largest levels, because they exceed a budget or what the GPU holds
   * (`renderer/textures-reduced`); or there is no GPU (`renderer/no-adapter`, `renderer/no-device`), and the viewer asks
   * for it again for about two seconds before `load()` fails.
   */
  warning: { readonly error: GlanzError; readonly message: string; readonly code: string };
  /**
   * The image has more samples. `remainingMs` is an estimate, `Infinity` where there is none. `denoised`: whether the
   * image on the canvas is denoised.
   */
  sample: {
    readonly samples: number;
    readonly target: number;
    readonly samplesPerSecond: number;
    readonly remainingMs: number;
    readonly denoised: boolean;
  };
  /** The image, with all edits, has all samples, or has reached the noise target. */
  converged: {
    readonly samples: number;
    /** Since the view or the scene last changed. */ readonly milliseconds: number;
  };
  /** The view has moved. `source`: by the user, by a call, or by `autoRotate`. */
  'camera-change': { readonly camera: Camera; readonly orbit: Orbit; readonly source: CameraChangeSource };
  /** The GPU was lost; the viewer requests a new device. */
  'device-lost': { readonly reason: string };
  /**
   * There is a GPU again, and the scene is back as it was edited. `samples`: samples per pixel that were kept and are
   * back; `lostSamples`: those that have to be taken again.
   */
  'device-restored': { readonly milliseconds: number; readonly samples: number; readonly lostSamples: number };
  /** The state has changed. */
  state: { readonly state: ViewerState };
  /**
   * An image was drawn to the canvas. `preview`: a low-resolution image of a moving view; `milliseconds`: the time that
   * its samples took; `denoised`: the film is shown denoised.
   */
  frame: {
    readonly preview: boolean;
    readonly milliseconds: number;
    readonly width: number;
    readonly height: number;
    readonly denoised: boolean;
  };
  /** An animation plays from now on, by its name. */
  play: { readonly name: string };
  /** The animation has been paused. */
  pause: { readonly name: string };
  /** The animation begins again; `count`: how often it has played. */
  loop: { readonly name: string; readonly count: number };
  /** The animation has played as often as it was asked to. */
  finished: { readonly name: string };
  /** A click or tap without a drag, and what lies there. CSS pixels from the canvas's upper left corner. */
  pick: { readonly hit: PickResult | undefined; readonly x: number; readonly y: number };
}

/** Who moved the camera. */
export type CameraChangeSource = 'user' | 'api' | 'auto-rotate';
