import type { AovName, PathTracer } from '@glanz/renderer';
import type { GlanzError } from '@glanz/scene';
import type { GpuImage } from './display';

/** Denoises the images of one viewer, on its current device. Only `still()` can reject. */
export interface DenoiseSession {
  /** What has made it. */
  readonly source: Denoising;
  /** The AOVs that tracers need. @param requested AOVs that are requested by other options. */
  aovs(requested?: readonly AovName[]): readonly AovName[];
  /**
   * Denoises the film of a tracer, if the next image is due.
   *
   * @param last Whether these are the last samples: then the film is denoised in any case.
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
  /** A copy of the PNG file with metadata that say that the image is denoised. */
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
