import type { Scale } from '../state/state';

/** Maximum film pixels: beyond, a sample of a large window takes too long to be called interactive. */
const MAX_PIXELS = 8_294_400;

/** Size of the film for a stage of so many CSS pixels. */
export function filmSize(
  width: number,
  height: number,
  scale: Scale,
  devicePixelRatio: number,
): readonly [number, number] {
  const requested = scale === 'device' ? devicePixelRatio : Number(scale);
  const factor = Math.min(requested, Math.sqrt(MAX_PIXELS / Math.max(1, width * height)));
  return [Math.max(1, Math.round(width * factor)), Math.max(1, Math.round(height * factor))];
}
