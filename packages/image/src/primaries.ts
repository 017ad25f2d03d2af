import type { ImageWarning } from './error';

/** Rec.709's red, green, blue and white, x and y of each (ITU-R BT.709, item 1.3 and 1.4). */
const REC709 = [0.64, 0.33, 0.3, 0.6, 0.15, 0.06, 0.3127, 0.329];

/** Radiance's own primaries, with equal energy as white, differ by less than this, and so does rounding. */
const TOLERANCE = 0.025;

/**
 * A warning if a file's primaries are not Rec.709's, as which its colours are read.
 * @param chromaticities x and y of red, green, blue and white. What describes no colours (zeros, as some programs
 * write) counts as none.
 */
export function primariesWarning(what: string, chromaticities: readonly number[] | undefined): ImageWarning[] {
  if (chromaticities?.length !== 8 || !chromaticities.every((x, i) => Number.isFinite(x) && (i % 2 === 0 || x !== 0)))
    return [];
  if (chromaticities.every((x, i) => Math.abs(x - (REC709[i] as number)) < TOLERANCE)) return [];
  const digits = chromaticities.map((x) => Number(x.toFixed(4))).join(' ');
  return [
    {
      code: 'image/primaries',
      message: `${what}: its colours have the primaries and white ${digits}, but are taken as those of Rec.709; convert the image.`,
    },
  ];
}
