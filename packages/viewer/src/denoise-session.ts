import type { AovName, PathTracer } from '@glanz/renderer';
import type { GlanzError } from '@glanz/scene';
import type { GpuImage } from './display';

/** Denoises the images of one viewer, on each of its devices in turn. Nothing here rejects but `still()`. */
export interface DenoiseSession {
  /** What has made it. */
  readonly source: Denoising;
  /** The AOVs that tracers need. @param requested Those that are requested anyway. */
  aovs(requested?: readonly AovName[]): readonly AovName[];
  /**
   * Denoises what a tracer has rendered, if it is time to.
   *
   * @param last Whether no more samples are to come: what the film has is denoised in any case.
   * @returns Whether there is another image to show.
   */
  offer(tracer: PathTracer, signal: AbortSignal, last?: boolean): Promise<boolean>;
  /** The denoised image of a tracer's film, while it can be shown. */
  image(tracer: PathTracer): GpuImage | undefined;
  /** The film shows something else from now on. */
  forget(): void;
  /**
   * The denoised film of any tracer: linear RGBA, stride 4. `undefined` where it cannot be denoised, which is reported.
   * @throws the signal's reason, when aborted.
   */
  still(tracer: PathTracer, signal: AbortSignal): Promise<Float32Array | undefined>;
  /** A PNG file whose metadata say that the image is denoised. */
  mark(png: Blob): Promise<Blob>;
  destroy(): void;
}

/**
 * Makes a viewer denoise its images: what `denoising()` of `@glanz/viewer/denoise` returns. It can serve several viewers.
 *
 * @param warn Reports what keeps images from being denoised.
 * @param device The viewer's device at present.
 */
export type Denoising = (warn: (error: GlanzError) => void, device: () => GPUDevice | undefined) => DenoiseSession;
