import { filterRows } from './png-filter';
import { headerOf, pixelBytesOf, pngOf, rowsOf, type PngCodes, type PngHeader, type PngSource } from './png-file';

/** Bytes that are compressed at once: matches do not reach across, which costs less than 1 % of the size. */
const BAND_BYTES = 2 ** 22;

/**
 * Compresses bytes into a raw DEFLATE stream that ends at a whole byte and has no final block, so that another one can
 * follow: what zlib gives with `finishFlush: Z_SYNC_FLUSH`. It must not refer to bytes of other calls.
 */
export type PngDeflate = (bytes: Uint8Array<ArrayBuffer>) => Uint8Array | Promise<Uint8Array>;

/** Some rows of an image, filtered and compressed. */
export interface PngBand {
  /** A raw DEFLATE stream without a final block. */
  readonly bytes: Uint8Array;
  /** Bytes before compression. */
  readonly length: number;
  /** Adler-32 of these (RFC 1950). */
  readonly adler: number;
}

/** Input of {@link encodePngBand}. */
export interface PngBandSource {
  /** Pixels of a row. */
  readonly width: number;
  /** Codes as in `PngSource`: of the row above the band, if it has one, and of the band's rows. */
  readonly data: PngCodes;
  /** Whether the first row of `data` is the one above the band: so for all bands but the topmost. */
  readonly above: boolean;
  /** Whether the file has no alpha channel, as those of images without transparency. The same for all bands. */
  readonly opaque: boolean;
}

/** Rows of a band; the last one has what is left. They depend on what the file holds alone. */
export const pngBandRows = ({ width, bits, opaque }: Pick<PngHeader, 'width' | 'bits' | 'opaque'>): number =>
  Math.max(1, Math.floor(BAND_BYTES / (width * pixelBytesOf({ bits, opaque }))));

/** Adler-32 (RFC 1950). */
function adler32(bytes: Uint8Array): number {
  let [a, b] = [1, 0];
  for (let at = 0; at < bytes.length;) {
    // As many as 32 bits hold.
    for (const end = Math.min(at + 3800, bytes.length); at < end; at++) b += a += bytes[at] as number;
    a %= 65521;
    b %= 65521;
  }
  return ((b << 16) | a) >>> 0;
}

/** Adler-32 of bytes followed by those of a band, of which the sums are known. */
function adlerOf(before: number, { adler, length }: PngBand): number {
  const a = before & 65535;
  const b = before >>> 16;
  const sum = (a + (adler & 65535) + 65520) % 65521;
  // Each byte of the band adds what the first sum was before it. Below 2³², so exact.
  const rest = ((length % 65521) * ((a + 65520) % 65521)) % 65521;
  return (((b + (adler >>> 16) + rest) % 65521) * 65536 + sum) >>> 0;
}

/**
 * Filters and compresses some rows of an image, of those that {@link joinPngBands} makes a file of. Bands do not depend
 * on one another, so that threads can make them.
 *
 * @throws What `deflate` throws.
 */
export async function encodePngBand(
  { width, data, above, opaque }: PngBandSource,
  deflate: PngDeflate,
): Promise<PngBand> {
  const bits = data instanceof Uint16Array ? 16 : 8;
  const filtered = filterRows(rowsOf(data, { width, bits, opaque }), above ? 1 : 0, data.length / 4 / width);
  return { bytes: await deflate(filtered), length: filtered.length, adler: adler32(filtered) };
}

/** The file whose rows are those of all bands, in their order. */
export function joinPngBands(header: PngHeader, bands: readonly PngBand[]): Uint8Array<ArrayBuffer> {
  const sum = bands.reduce(adlerOf, 1);
  // A final block without bytes, and the checksum of all bytes.
  const end = Uint8Array.of(0x03, 0x00, sum >>> 24, sum >>> 16, sum >>> 8, sum);
  return pngOf(header, [Uint8Array.of(0x78, 0x9c), ...bands.map(({ bytes }) => bytes), end]);
}

/**
 * `encodePng` for large images, whose rows are compressed in bands of 4 MiB by a function that may work on several at
 * the same time, such as zlib on the threads of Node. The bands do not depend on how many those are, so the bytes are
 * the same as long as the function's are.
 *
 * @throws {ImageError} `image/size` if the array does not hold width × height RGBA pixels; and what `deflate` throws.
 */
export async function encodePngAsync(
  { width, height, data, text = {} }: Omit<PngSource, 'level'>,
  deflate: PngDeflate,
): Promise<Uint8Array<ArrayBuffer>> {
  const header = headerOf(width, height, data);
  const rows = pngBandRows(header);
  const bands: Promise<PngBand>[] = [];
  for (let first = 0; first < height; first += rows) {
    const above = first > 0;
    const codes = data.subarray(4 * width * (above ? first - 1 : 0), 4 * width * (first + rows));
    const band = encodePngBand({ width, data: codes, above, opaque: header.opaque }, deflate);
    // Awaited below; an error before that is not unhandled.
    band.catch(() => undefined);
    bands.push(band);
  }
  return joinPngBands({ ...header, text }, await Promise.all(bands));
}
