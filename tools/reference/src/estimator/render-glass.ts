import { PathTracer } from '@glanz/renderer';
import type { Estimate } from './estimate';
import type { GlassScene } from './glass-scenes';

/**
 * Renders a glass scene, with the standard errors of its pixels from the film's variance. The samples are independent,
 * so that those of different pixels are.
 *
 * @param samples Per pixel, at least 128: the variance is that of means of 16 samples.
 */
export async function renderGlass(
  device: GPUDevice,
  { scene, ...options }: GlassScene,
  { samples, seed = 0 }: { readonly samples: number; readonly seed?: number },
): Promise<Estimate> {
  const tracer = await PathTracer.create(device, scene, { ...options, seed, sampler: 'independent' });
  try {
    for await (const progress of tracer.render({ samples })) void progress;
    const rgb = (pixels: Float32Array) => Float64Array.from(pixels.filter((_, i) => i % 4 < 3));
    const mean = rgb((await tracer.read('beauty')) as Float32Array);
    const standardError = rgb((await tracer.read('variance')) as Float32Array).map(Math.sqrt);
    return { mean, standardError };
  } finally {
    tracer.destroy();
  }
}
