/** Samples of the large image after which nothing of the small one is left in it. */
const GONE_AFTER = 32;
/** More of the small image's samples do not count: it is blurred, however many there are. */
const MAX_WORTH = 4;

/**
 * Weight of the preview in what is shown while the large image gathers samples: as its samples weigh among all of
 * them, fading to nothing, so that neither the change of resolution nor its end can be seen as a jump.
 *
 * @param samples Of the large image.
 * @param previewSamples Of the small one.
 * @param target Samples that the large image will have; the preview is gone by half of them.
 */
export function previewWeight(samples: number, previewSamples: number, target: number): number {
  if (samples <= 0) return 1;
  const worth = Math.min(previewSamples, MAX_WORTH);
  const goneAfter = Math.min(GONE_AFTER, Math.max(1, target / 2));
  return (worth / (samples + worth)) * Math.max(0, 1 - samples / goneAfter);
}
