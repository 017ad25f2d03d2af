import { inErrorScopes } from '../device/error-scopes';
import type { Film } from '../film/film';
import { MAX_THREADS, type Integrator } from '../integrator/integrator';
import type { Kernel, KernelName } from '../integrator/pipelines';
import type { Batch } from '../schedule/scheduler';

/** Samples that the feature layers average at most. */
export const FEATURE_SAMPLES = 64;

/** The pixels of a film in batches that one dispatch covers. */
export function forBands(pixels: number, run: (batch: Batch) => void, sampleOffset = 0): void {
  for (let pixelOffset = 0; pixelOffset < pixels; pixelOffset += MAX_THREADS)
    run({ pixelOffset, pixelCount: Math.min(MAX_THREADS, pixels - pixelOffset), sampleOffset, sampleCount: 1 });
}

/**
 * Renders what a kernel knows of the first surfaces from scratch, with `samples` samples a pixel. Buffers of the film
 * that the kernel binds for the first time are made here; they are freed where the GPU refuses them, so that a later
 * attempt makes them again.
 *
 * @param prepare Writes the frame uniforms, if they have changed.
 * @throws {DeviceError} `renderer/out-of-memory`, `renderer/gpu-error`
 */
export async function renderFeatures(
  device: GPUDevice,
  integrator: Integrator,
  name: KernelName,
  kernel: Kernel,
  film: Film,
  samples: number,
  prepare: () => void,
): Promise<void> {
  const refused = (error: unknown) => {
    film.release(...kernel.resources.filter((resource) => resource.startsWith('feature_')));
    integrator.rebind();
    throw error;
  };
  const checks: Promise<void>[] = [];
  for (let sample = 0; sample < samples; sample++) {
    const run = () => {
      if (sample === 0) prepare();
      forBands(film.pixels, (batch) => integrator.submitPixels(name, kernel, batch), sample);
    };
    checks.push(inErrorScopes(device, `the film's layers (${name})`, run).verified);
    // The first pass makes the buffers: the others are not worth their time without them.
    if (sample === 0) await Promise.all(checks).catch(refused);
    if (sample % 4 === 3) await device.queue.onSubmittedWorkDone();
  }
  await Promise.all(checks).catch(refused);
}
