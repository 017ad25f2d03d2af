import { expect } from 'vitest';
import type { PathTracer } from '../src/index';

export const mean = (values: readonly number[]) => values.reduce((a, b) => a + b, 0) / values.length;
const variance = (values: readonly number[]) =>
  values.reduce((sum, value) => sum + (value - mean(values)) ** 2, 0) / (values.length - 1);

/** Renders a tracer's film and destroys it. RGBA, stride 4, linear. */
export async function finishedFilm(tracer: PathTracer, samples: number): Promise<Float32Array> {
  for await (const _ of tracer.render({ samples }));
  const image = await tracer.read('beauty');
  expect(tracer.statistics.badSamples).toBe(0);
  tracer.destroy();
  return image;
}

const SEEDS = 8;

/** The image's mean over films of eight seeds, its standard error, and the mean variance of a film's red values. */
export async function filmStatistics(film: (seed: number) => Promise<Float32Array>) {
  const images: Float32Array[] = [];
  for (let seed = 1; seed <= SEEDS; seed++) images.push(await film(seed));
  const totals = images.map((image) => mean([...image].filter((_, i) => i % 4 < 3)));
  const pixels = Array.from({ length: images[0]!.length / 4 }, (_, i) => images.map((image) => image[4 * i]!));
  return { mean: mean(totals), error: Math.sqrt(variance(totals) / SEEDS), noise: mean(pixels.map(variance)) };
}
