import type { PathTracer } from '@glanz/renderer';
import type { Engine } from './engine';
import type { ViewerError } from './errors';

/** Progress of the rendering of an image. */
export interface ImageProgress {
  /** Samples per pixel so far. */
  readonly samples: number;
  /** Samples per pixel at which the image is finished at the latest. */
  readonly target: number;
  /** Estimated milliseconds to the end; `Infinity` before the first sample. */
  readonly remainingMs: number;
  /** Share of the work that is done, 0..1. */
  readonly share: number;
}

/** Options of `renderImage`. */
export interface RenderImageOptions {
  /** Pixels, whole numbers from 1. */
  readonly width: number;
  readonly height: number;
  /** Samples per pixel; with `noise`, the maximum. */
  readonly samples: number;
  /** Stop where this relative noise is reached; see `RenderOptions.noise` of the renderer. Default: none. */
  readonly noise?: number | undefined;
  /** What is behind the model. Default: as on the screen. */
  readonly background?: 'environment' | 'transparent' | undefined;
  readonly onProgress?: ((progress: ImageProgress) => void) | undefined;
  readonly signal?: AbortSignal | undefined;
}

/** Progress of a render that runs until a number of samples or a noise target. */
export const imageProgress = (
  samples: number,
  target: number,
  elapsedMs: number,
  remainingMs: number,
  noise: boolean,
): ImageProgress => {
  const share = noise ? elapsedMs / (elapsedMs + remainingMs || 1) : samples / target;
  return { samples, target, remainingMs, share: Number.isFinite(remainingMs) ? Math.min(1, share) : 0 };
};

/**
 * See `renderImage` of `render-image.ts`.
 *
 * @param Failure `ViewerError`, passed in: imported, it would be a chunk of its own in every page.
 */
export async function renderCopy(
  engine: Engine,
  options: RenderImageOptions,
  Failure: typeof ViewerError,
): Promise<PathTracer> {
  const { width, height, samples, noise, background, onProgress, signal } = options;
  signal?.throwIfAborted();
  const copy = engine.copyFor(width / height);
  if (!copy && engine.state === 'recovering')
    throw new Failure('viewer/device-lost', 'The GPU was lost. Render the image again when another one is in use.');
  if (!copy) throw new Failure('viewer/no-scene', 'There is no scene to render: await load() first.');
  const tracer = await copy.create({
    width,
    height,
    ...(background ? { background } : {}),
    ...(signal ? { signal } : {}),
  });
  try {
    await copy.ready?.(tracer);
    for await (const progress of tracer.render({
      samples,
      ...(noise === undefined ? {} : { noise }),
      ...(signal ? { signal } : {}),
    })) {
      onProgress?.(
        imageProgress(progress.samples, samples, progress.elapsedMs, progress.remainingMs, noise !== undefined),
      );
    }
    signal?.throwIfAborted();
    return tracer;
  } catch (error) {
    tracer.destroy();
    throw error;
  }
}
