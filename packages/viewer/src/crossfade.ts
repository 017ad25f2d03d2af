/** Samples of the large image after which nothing of the small one is left in it, and of one filtered over time. */
const [GONE_AFTER, FILTERED_GONE_AFTER] = [32, 64];
/** More of the small image's samples do not count: it is blurred, however many there are. */
const MAX_WORTH = 4;

/**
 * Weight of the preview in what is shown while the large image gathers samples: as its samples weigh among all of
 * them, fading to nothing, so that neither the change of resolution nor its end can be seen as a jump. Of a filtered
 * preview, the largest weight: that of each pixel follows from its errors, see blend.wesl.
 *
 * @param samples Of the large image.
 * @param previewSamples Of the small one; infinity: it is filtered.
 * @param target Samples that the large image will have; the preview is gone by half of them.
 */
export function previewWeight(samples: number, previewSamples: number, target: number): number {
  if (samples <= 0) return 1;
  const worth = Math.min(previewSamples, MAX_WORTH);
  const filtered = previewSamples === Infinity;
  const goneAfter = Math.min(filtered ? FILTERED_GONE_AFTER : GONE_AFTER, Math.max(1, target / 2));
  return (filtered ? 1 : worth / (samples + worth)) * Math.max(0, 1 - samples / goneAfter);
}
