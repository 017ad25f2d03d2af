import type { DenoiseQuality } from '@glanz/denoise/film';
import type { PathTracer } from '@glanz/renderer';
import { CliError } from './errors';

/** Denoises what a tracer has rendered, by one quality. */
export interface ImageDenoiser {
  /** Linear RGBA, stride 4; the tracer's film stays what it is. */
  denoise(tracer: object, signal: AbortSignal): Promise<Float32Array>;
  destroy(): void;
}

/**
 * The denoiser of `@glanz/denoise` with the weights of the optional package `@glanz/denoise-weights`.
 *
 * @throws {CliError} `cli/missing-package`
 * @throws {WeightsError} `denoise-weights/unreadable`
 * @throws {DenoiseError} if the GPU does not compile it.
 */
export async function createImageDenoiser(
  device: GPUDevice,
  quality: DenoiseQuality,
  signal: AbortSignal,
): Promise<ImageDenoiser> {
  const [{ FILM_WEIGHTS, FilmDenoiser }, { readWeights }] = await Promise.all([
    import('@glanz/denoise/film'),
    import('@glanz/denoise-weights/node').catch((cause: unknown) => {
      throw new CliError(
        'cli/missing-package',
        'Denoising needs the package "@glanz/denoise-weights": npm install @glanz/denoise-weights.',
        { cause },
      );
    }),
  ]);
  const names = Object.entries(FILM_WEIGHTS[quality]);
  const weights = Object.fromEntries(
    await Promise.all(names.map(async ([use, name]) => [use, await readWeights(name, { signal })] as const)),
  );
  const denoiser = await FilmDenoiser.create(device, weights as { color: Uint8Array }, { maxSubmitMs: 100, signal });
  return {
    // The tracers of the backend are these.
    denoise: (tracer, aborted) => (tracer as PathTracer).denoised(denoiser, { signal: aborted }),
    destroy: () => denoiser.destroy(),
  };
}
