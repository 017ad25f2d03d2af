/** Maximum pixels of the image: beyond, a sample of a large window takes too long to be called interactive. */
const MAX_PIXELS = 4_194_304;
/** More than two image pixels per CSS pixel take time and show no visible gain. */
const MAX_RATIO = 2;

/**
 * Size of the image for an element of so many CSS pixels.
 *
 * @param ratio Image pixels per CSS pixel; default the screen's own, at most 2.
 */
export function imageSize(
  width: number,
  height: number,
  ratio?: number,
  maxPixels = MAX_PIXELS,
): readonly [number, number] {
  const requested = ratio ?? Math.min(MAX_RATIO, devicePixelRatio || 1);
  const factor = Math.min(requested, Math.sqrt(maxPixels / Math.max(1, width * height)));
  return [Math.max(1, Math.round(width * factor)), Math.max(1, Math.round(height * factor))];
}
