/** The nearest of left, above and above left to their plane; in this order where they are as near. */
function paeth(a: number, b: number, c: number): number {
  const pa = Math.abs(b - c);
  const pb = Math.abs(a - c);
  const pc = Math.abs(a + b - 2 * c);
  return pa <= pb && pa <= pc ? a : pb <= pc ? b : c;
}

/** Distance of a byte from 0, which lies between 255 and 1. */
const size = (byte: number) => Math.abs((byte << 24) >> 24);

/**
 * Writes what a filter of PNG leaves of a row: the bytes without what it predicts, which is nothing, the byte at the
 * left, the one above, their mean, or the nearest of left, above and above left. A loop for each filter: large images
 * have hundreds of millions of bytes.
 *
 * @param row Behind as many zeros as a pixel has bytes, as `above`.
 * @param out Gets the bytes from `at` on.
 */
function writeFiltered(
  filter: number,
  row: Uint8Array,
  above: Uint8Array,
  left: number,
  out: Uint8Array,
  at: number,
): void {
  const bytes = row.length - left;
  if (filter === 0) out.set(row.subarray(left), at);
  else if (filter === 1) for (let i = 0; i < bytes; i++) out[at + i] = (row[i + left] as number) - (row[i] as number);
  else if (filter === 2)
    for (let i = 0; i < bytes; i++) out[at + i] = (row[i + left] as number) - (above[i + left] as number);
  else if (filter === 3)
    for (let i = 0; i < bytes; i++)
      out[at + i] = (row[i + left] as number) - (((row[i] as number) + (above[i + left] as number)) >> 1);
  else
    for (let i = 0; i < bytes; i++)
      out[at + i] = (row[i + left] as number) - paeth(row[i] as number, above[i + left] as number, above[i] as number);
}

/** The filter with the smallest sum of absolute differences; the first of several. */
function bestFilter(row: Uint8Array, above: Uint8Array, left: number): number {
  let [none, sub, up, average, path] = [0, 0, 0, 0, 0];
  for (let i = 0, end = row.length - left; i < end; i++) {
    const value = row[i + left] as number;
    const a = row[i] as number;
    const b = above[i + left] as number;
    none += size(value);
    sub += size(value - a);
    up += size(value - b);
    average += size(value - ((a + b) >> 1));
    path += size(value - paeth(a, b, above[i] as number));
  }
  const sums = [none, sub, up, average, path];
  return sums.indexOf(Math.min(...sums));
}

/** Rows of bytes as PNG stores them, from `first` to before `end`. */
export interface PngRows {
  /** All rows of the image. */
  readonly raw: Uint8Array;
  readonly rowBytes: number;
  readonly pixelBytes: number;
}

/**
 * Filters rows with the filter of the smallest sum of absolute differences, the heuristic of the PNG specification.
 *
 * @param first The first of them, of all rows of the image.
 * @param end One after the last.
 * @returns Each row behind the number of its filter.
 */
export function filterRows(
  { raw, rowBytes, pixelBytes }: PngRows,
  first: number,
  end: number,
): Uint8Array<ArrayBuffer> {
  const out = new Uint8Array((rowBytes + 1) * (end - first));
  let row = new Uint8Array(pixelBytes + rowBytes);
  let above = new Uint8Array(pixelBytes + rowBytes);
  if (first > 0) above.set(raw.subarray((first - 1) * rowBytes, first * rowBytes), pixelBytes);
  for (let y = first, at = 0; y < end; y++, at += rowBytes + 1) {
    row.set(raw.subarray(y * rowBytes, (y + 1) * rowBytes), pixelBytes);
    const best = bestFilter(row, above, pixelBytes);
    out[at] = best;
    writeFiltered(best, row, above, pixelBytes, out, at + 1);
    [row, above] = [above, row];
  }
  return out;
}
