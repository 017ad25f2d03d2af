/** A part of an image that the network computes at once. */
export interface Tile {
  /** Its first pixel in the image. */
  readonly x: number;
  readonly y: number;
  /** The part whose result counts, in the image: `[from, to)`. */
  readonly innerX: readonly [from: number, to: number];
  readonly innerY: readonly [from: number, to: number];
}

/** Tiles of one size that cover an image. */
export interface Tiling {
  /** Pixels of each tile, multiples of 16. */
  readonly width: number;
  readonly height: number;
  readonly tiles: readonly Tile[];
}

/** Networks halve the resolution four times. */
export const pad16 = (size: number): number => Math.ceil(size / 16) * 16;

/** Cuts one side into `count` parts: size of a tile, and for each its first pixel and what of it counts. */
function cut(size: number, count: number, overlap: number) {
  const padded = pad16(size);
  const step = pad16(padded / count);
  const tile = Math.min(padded, step + (count > 1 ? 2 * overlap : 0));
  const parts: { from: number; inner: [number, number] }[] = [];
  for (let inner = 0; inner < size; inner += step) {
    const from = Math.max(0, Math.min(inner - overlap, padded - tile));
    parts.push({ from, inner: [inner, Math.min(inner + step, size)] });
  }
  return { tile, parts };
}

/**
 * Cuts an image into the fewest tiles that fit. Tiles overlap by `overlap` pixels on either side of a cut, and all cuts
 * are at multiples of 16: then no pixel that counts depends on where the cuts are.
 *
 * @param fits Whether there is memory for a tile of so many pixels.
 * @returns `undefined` where even tiles of the smallest size do not fit.
 */
export function tileImage(
  width: number,
  height: number,
  overlap: number,
  fits: (width: number, height: number) => boolean,
): Tiling | undefined {
  for (let columns = 1, rows = 1; ;) {
    const x = cut(width, columns, overlap);
    const y = cut(height, rows, overlap);
    if (fits(x.tile, y.tile))
      return {
        width: x.tile,
        height: y.tile,
        tiles: y.parts.flatMap((row) =>
          x.parts.map((column) => ({ x: column.from, y: row.from, innerX: column.inner, innerY: row.inner })),
        ),
      };
    // Cut the longer side once more, until what counts of a tile is 64 pixels.
    const across = width / columns >= height / rows;
    if ((across ? width / columns : height / rows) <= 64) return undefined;
    if (across) columns++;
    else rows++;
  }
}
