import type { Film } from './film';
import { MAX_THREADS, type Integrator } from '../integrator';
import type { Kernel, KernelName } from '../kernels/pipelines';
import type { Batch } from '../scheduler';

/** Samples that the feature layers average at most. */
export const FEATURE_SAMPLES = 64;

/** The pixels of a film in batches that one dispatch covers. */
export function forBands(pixels: number, run: (batch: Batch) => void, sampleOffset = 0): void {
  for (let pixelOffset = 0; pixelOffset < pixels; pixelOffset += MAX_THREADS) run({ pixelOffset, pixelCount: Math.min(MAX_THREADS, pixels - pixelOffset), sampleOffset, sampleCount: 1 });
}

/** Renders what a kernel knows of the first surfaces anew, with `samples` samples a pixel. */
export async function renderFeatures(device: GPUDevice, integrator: Integrator, name: KernelName, kernel: Kernel, film: Film, samples: number): Promise<void> {
  for (let sample = 0; sample < samples; sample++) {
    forBands(film.pixels, (batch) => integrator.submitPixels(name, kernel, batch), sample);
    if (sample % 4 === 3) await device.queue.onSubmittedWorkDone();
  }
}
