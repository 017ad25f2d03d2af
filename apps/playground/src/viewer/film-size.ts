import type { Scale } from '../state/state';

/** Film pixels at most: beyond, a sample of a large window takes too long to be called interactive. */
const MAX_PIXELS = 8_294_400;

/** Size of the film for a stage of so many CSS pixels. */
export function filmSize(width: number, height: number, scale: Scale, devicePixelRatio: number): readonly [number, number] {
  const wanted = scale === 'device' ? devicePixelRatio : Number(scale);
  const factor = Math.min(wanted, Math.sqrt(MAX_PIXELS / Math.max(1, width * height)));
  return [Math.max(1, Math.round(width * factor)), Math.max(1, Math.round(height * factor))];
}

/** Milliseconds that a sample may take while the camera moves. */
const MOVING_BUDGET_MS = 50;

/**
 * By how much to shrink the film, in each direction, while the camera moves: 1, 2, 3 … 8.
 *
 * @param sampleMs Milliseconds that a sample of the full film takes; undefined where none has been seen.
 */
export function movingDivisor(sampleMs: number | undefined): number {
  if (sampleMs === undefined) return 1;
  return Math.min(8, Math.max(1, Math.ceil(Math.sqrt(sampleMs / MOVING_BUDGET_MS))));
}
