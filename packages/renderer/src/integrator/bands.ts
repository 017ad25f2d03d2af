import type { Batch } from '../schedule/scheduler';
import { MAX_THREADS } from './path-memory';

/** The pixels of a film in batches that one dispatch covers. */
export function forBands(pixels: number, run: (batch: Batch) => void): void {
  for (let pixelOffset = 0; pixelOffset < pixels; pixelOffset += MAX_THREADS)
    run({ pixelOffset, pixelCount: Math.min(MAX_THREADS, pixels - pixelOffset), sampleOffset: 0, sampleCount: 1 });
}
