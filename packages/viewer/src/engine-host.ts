import type { PathTracer, PathTracerOptions, RenderProgress } from '@glanz/renderer';
import type { Camera, GlanzError, Scene } from '@glanz/scene';
import type { ToneMapOptions } from '@glanz/tonemap';
import type { DenoiseSession } from './denoise-session';
import type { ViewerState } from './events';
import type { PreviewMode } from './preview';

/** What an `Engine` requests from its application, and reports to it. */
export interface EngineHost {
  /** Advances the camera by a time in seconds; returns whether it has moved. */
  readonly step: (seconds: number) => boolean;
  /** Whether the camera is on its way, or about to be. */
  readonly moving: () => boolean;
  /** The camera for an image of this width over height. */
  readonly camera: (aspect: number) => Camera;
  readonly state: (state: ViewerState) => void;
  /** The image has more samples; those of previews are not reported. `denoised`: whether what is shown is denoised. */
  readonly sample: (progress: RenderProgress, denoised: boolean) => void;
  /** The image has all requested samples; `milliseconds` since the last change. */
  readonly converged: (samples: number, milliseconds: number) => void;
  /**
   * An image was drawn to the canvas: a preview or not, the milliseconds that its samples took, its size in pixels,
   * denoised (or filtered over time) or not.
   */
  readonly drawn: (preview: boolean, milliseconds: number, size: readonly [number, number], denoised: boolean) => void;
  /** The film was cleared: what it shows from now on is another image. */
  readonly restarted?: () => void;
  readonly error: (error: unknown, retry?: () => void) => void;
  /** The first request for a device failed; it is repeated for about two seconds before {@link Engine.ready} rejects. */
  readonly missing?: (error: unknown) => void;
  /** The image is approximated, see `PathTracerOptions.onWarning`. */
  readonly warning?: (warning: GlanzError) => void;
  /** The device was lost; another one is requested. */
  readonly lost: (reason: string) => void;
  /** The scene is restored on another device; `milliseconds` since the loss. */
  readonly restored: (milliseconds: number, samples: RestoredSamples) => void;
}

/** What is left of an image after its device was lost. */
export interface RestoredSamples {
  /** Samples per pixel that the image has again. */
  readonly samples: number;
  /** Samples per pixel that it had and that have to be taken again. */
  readonly lostSamples: number;
}

/**
 * Settings of an `Engine`. Fields that are not read-only may change at any time; some need an edit or a restart, as
 * their documentation says.
 */
export interface EngineSettings extends ToneMapOptions {
  /** Samples per pixel of the finished image. After a change, call `restart()`. */
  samples: number;
  /** Stop where this relative noise is reached. After a change, call `restart()`. */
  noise: number | undefined;
  /** Maximum number of edges of a path. After a change, call `touch()`. */
  maxDepth: number;
  /** What is behind the model. After a change, call `PathTracer.setBackground()` as an edit. */
  background: 'environment' | 'transparent';
  /** GPU milliseconds that one submission should take at most while the image is refined. */
  maxSubmitMs: number;
  /** Milliseconds without a movement after which the image is refined. */
  readonly settleMs: number;
  /** Maximum number of edges of a path in previews that are smaller than the image. */
  readonly previewDepth: number;
  /** Default `auto`. May change at any time. */
  previewMode?: PreviewMode | undefined;
  /** More options for the path tracers; those of a {@link TracerSpec} take precedence. */
  readonly tracer: Partial<PathTracerOptions>;
  /** Default: `requestDevice()` of the renderer. */
  readonly requestDevice: (() => Promise<GPUDevice>) | undefined;
  /**
   * Whether copies of the film are kept, so that its samples outlive a lost device. Default true. May change at any
   * time.
   */
  keepSamples?: boolean | undefined;
  /**
   * Denoises images. The engine destroys it with itself. After a change, call `restart()`, and `destroy()` of the
   * former one.
   */
  denoise?: DenoiseSession | undefined;
  /** Whether the first device warms up until there is a scene. Default: unless the adapter is software. */
  readonly warmUp?: boolean | undefined;
}

/** What a path tracer is made from. */
export interface TracerSpec {
  readonly scene: Scene;
  readonly camera: Camera;
  readonly options?: Partial<PathTracerOptions>;
  /** Edits that the tracer needs before its first sample. */
  readonly ready?: (tracer: PathTracer) => Promise<void>;
}

/** Makes another tracer of the scene as it is, see `Engine.copyFor`. */
export interface TracerCopy {
  /** @throws as `PathTracer.create`. */
  readonly create: (
    options: Pick<PathTracerOptions, 'width' | 'height' | 'background' | 'signal'>,
  ) => Promise<PathTracer>;
  readonly ready: TracerSpec['ready'] | undefined;
}
