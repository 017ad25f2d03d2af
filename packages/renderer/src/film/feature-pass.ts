import type { Film } from './film';
import { MAX_THREADS, type Integrator } from '../integrator';
import type { Kernel } from '../kernels/pipelines';

/** Samples that the feature layers average at most. */
export const FEATURE_SAMPLES = 64;

/** Renders the first-hit layers anew, with `samples` samples a pixel. */
export async function renderFeatures(device: GPUDevice, integrator: Integrator, kernel: Kernel, film: Film, samples: number): Promise<void> {
  const band = Math.min(film.pixels, MAX_THREADS);
  for (let sample = 0; sample < samples; sample++) {
    for (let pixel = 0; pixel < film.pixels; pixel += band) {
      integrator.submitPixels('features', kernel, { pixelOffset: pixel, pixelCount: Math.min(band, film.pixels - pixel), sampleOffset: sample, sampleCount: 1 });
    }
    if (sample % 4 === 3) await device.queue.onSubmittedWorkDone();
  }
}
