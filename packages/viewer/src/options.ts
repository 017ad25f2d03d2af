import type { GltfDecoders } from '@glanz/gltf';
import type { PathTracerOptions } from '@glanz/renderer';
import type { RenderOptionName } from '@glanz/renderer/options';
import type { Camera, Scene } from '@glanz/scene';
import type { ToneMap } from '@glanz/tonemap';
import type { ControlOptions } from './controls';
import type { Denoising } from './denoise-session';
import type { GroundOptions } from './ground';
import type { EnvironmentSource } from './load';
import type { OrbitLimits } from './orbit-state';
import type { PreviewMode } from './preview';
import { type ImageProgress } from './render-copy';

/** Options of `Viewer.toBlob`. */
export interface BlobOptions {
  /** `image/png` (default), `image/jpeg`, `image/webp`, or `image/x-exr`: linear, as half floats. */
  readonly type?: string;
  /** 0..1, for types that lose something. */
  readonly quality?: number;
  /** Pixels, 1..65536. Default: the size on the screen; of one side alone, the other in the shape of the canvas. */
  readonly width?: number;
  readonly height?: number;
  /** Samples per pixel. Default: the viewer's `samples` and `noise`; 65,536 at most where `noise` is given. */
  readonly samples?: number;
  /** Stop where this relative noise is reached; see `RenderOptions.noise` of the renderer. */
  readonly noise?: number;
  /** What is behind the model; `transparent` gives an alpha channel. Default: as on the screen. */
  readonly background?: 'environment' | 'transparent';
  /** Called after each sample, or group of samples. */
  readonly onProgress?: (progress: ImageProgress) => void;
  /** Ends the rendering. */
  readonly signal?: AbortSignal;
}

/**
 * Options for `createViewer`. All have a default; those that are marked can be changed later by the viewer's property of
 * the same name.
 */
export interface ViewerOptions {
  /** Samples per pixel of the finished image, a whole number. Default 256. Changeable. */
  readonly samples?: number;
  /**
   * Stop earlier, where this relative noise is reached; see `RenderOptions.noise` of the renderer. Default: none.
   * Changeable.
   */
  readonly noise?: number;
  /** Maximum number of edges of a path. Default 8. Changeable. */
  readonly maxDepth?: number;
  /** Image pixels per CSS pixel. Default: the screen's own, at most 2. Changeable. */
  readonly pixelRatio?: number;
  /** Maximum number of pixels of the image; beyond, it is enlarged. Default 4,194,304. */
  readonly maxPixels?: number;
  /**
   * Environment. Default `scene`: that of the model, or else a studio. Changed by `setEnvironment()`. Where it cannot
   * be fetched or read, a studio lights the model, and the `warning` event says why.
   */
  readonly environment?: EnvironmentSource;
  /** Multiplies the environment. Default 1. Changeable. */
  readonly environmentIntensity?: number;
  /** Rotates the environment about +Y, radians. Default 0. Changeable. */
  readonly environmentRotation?: number;
  /** What is seen behind the model: the environment, or the page. Default `environment`. Changeable. */
  readonly background?: 'environment' | 'transparent';
  /** Stops (EV). Default 0. Changeable. */
  readonly exposure?: number;
  /** Default `neutral`. Changeable. */
  readonly toneMap?: ToneMap;
  /**
   * Denoises images while they have few samples: `denoising()` of `@glanz/viewer/denoise` makes it. `toBlob()` gives
   * denoised images too; EXR files hold the film as it is. Default: none. Changeable.
   */
  readonly denoise?: Denoising | undefined;
  /** Variant of the model, by name. Default: its own materials. Changed by `setVariant()`. */
  readonly variant?: string;
  /**
   * The first view of a model: `auto` (default): its own first camera, or a view that frames it; `frame`: the latter
   * always; an index or a name of its cameras; a camera; or a function that gives one for the scene and the image's
   * width over height.
   */
  readonly camera?: 'auto' | 'frame' | number | Camera | ((scene: Scene, aspect: number) => Camera) | (string & {});
  /** How far users and calls may move the camera. Default: no limits. Changeable. */
  readonly orbitLimits?: OrbitLimits;
  /** Controls on the canvas: all, none, or some. Default true. Changeable. */
  readonly controls?: boolean | ControlOptions;
  /**
   * Time constant of movements, in seconds: after this time 63 % of a movement is done. Default 0.06; 0 where the user
   * prefers reduced motion.
   */
  readonly damping?: number;
  /** Speed at which the camera orbits without input, radians per second. Default 0. Changeable. */
  readonly autoRotate?: number;
  /** Seconds after the last other movement before it does. Default 3. Changeable. */
  readonly autoRotateDelay?: number;
  /**
   * How the preview of a moving view is made; a mode stands for options of that mode alone. Default `auto`. The mode is
   * changeable by `previewMode`.
   */
  readonly preview?: PreviewMode | PreviewOptions;
  /** GPU milliseconds that one submission should take at most while the image is refined. Default 16. */
  readonly maxSubmitMs?: number;
  /**
   * Where the model is placed: an affine matrix with an inverse, 16 numbers, column-major. Default: where its file
   * places it. Changeable; a change moves the model and not the camera.
   */
  readonly modelTransform?: ArrayLike<number> | undefined;
  /**
   * Ground beneath the model that catches its shadows and, on request, its reflection; it is invisible otherwise, and
   * takes light from below as a floor does. Default: none. Changeable.
   */
  readonly ground?: GroundOptions | undefined;
  /**
   * Whether requests for models and environments send cookies and other credentials to other origins too. Default:
   * `same-origin`. Changeable.
   */
  readonly credentials?: RequestCredentials | undefined;
  /** Decoders of compressed meshes and images; that of meshopt is included. */
  readonly decoders?: GltfDecoders;
  /** Starts the worker that reads glTF, see `LoadModelOptions.createWorker`. */
  readonly createWorker?: () => Worker;
  /** Requests the device, again after a loss. Default: `requestDevice()` of the renderer. The viewer destroys it. */
  readonly requestDevice?: () => Promise<GPUDevice>;
  /**
   * Whether copies of the image's samples are kept in CPU memory, so that the image continues from them when the GPU
   * was lost: at doubling numbers of samples, at least three seconds apart, and when it is done; never while something
   * moves. A copy takes 64 bytes a pixel, and 32 more for each further light group; films of more than 128 MiB are not
   * copied. Default true.
   */
  readonly keepSamples?: boolean;
  /**
   * Whether the device and the JavaScript engine do ahead, while the first model loads, what its first image would
   * wait for: about a tenth of a second of the page's thread, in slices. Default: unless the adapter is software.
   */
  readonly warmUp?: boolean;
  /** The other options of the path tracer: filter, light groups, biased options, back-face culling and more. */
  readonly tracer?: Pick<PathTracerOptions, Exclude<RenderOptionName & keyof PathTracerOptions, keyof ViewerOptions>>;
  /** Destroys the viewer when it aborts. */
  readonly signal?: AbortSignal;
}

/** Options for `Viewer.load`. */
export interface LoadOptions {
  /** Aborts the load; it rejects with the signal's reason, and the former model stays. */
  readonly signal?: AbortSignal;
  /** The first view; default that of {@link ViewerOptions.camera}. `keep` stays where the user is. */
  readonly camera?: ViewerOptions['camera'] | 'keep';
  /** Look of a model that has several. Default: that of {@link ViewerOptions.variant} where the model has it. */
  readonly variant?: string;
}

/** See {@link ViewerOptions.preview}. */
export interface PreviewOptions {
  /** Default `auto`. */
  readonly mode?: PreviewMode;
  /**
   * Milliseconds that a frame of it may take; half of them on a battery that is below 20 % and not charging, where the
   * browser tells. Default 12, which leaves room at 60 frames a second.
   */
  readonly budgetMs?: number;
  /** Maximum number of edges of a path, where the preview is smaller than the image. Default 4. */
  readonly maxDepth?: number;
  /** Milliseconds without a movement after which the image is refined. Default 180. */
  readonly settleMs?: number;
}
