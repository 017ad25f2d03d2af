import { zlibSync } from 'fflate';
import { concat } from './bytes';
import { checkSize, ImageError } from './error';
import { filterRows, type PngRows } from './png-filter';

/** Input of {@link encodePng}. */
export interface PngSource {
  readonly width: number;
  readonly height: number;
  /** RGBA, stride 4, straight alpha, sRGB codes, top row first: 8-bit or 16-bit decides the depth of the file. */
  readonly data: Uint8Array | Uint8ClampedArray | Uint16Array;
  /** Text for the file's tEXt chunks, e.g. `{ Software: 'glanz' }`; keys of 1–79 and values in Latin-1. */
  readonly text?: Readonly<Record<string, string>>;
  /** Effort of the compression, 0–9; default 6. */
  readonly level?: number;
}

function crcTable(): Uint32Array {
  const table = new Uint32Array(256);
  for (let n = 0; n < 256; n++) {
    let c = n;
    for (let k = 0; k < 8; k++) c = c & 1 ? 0xedb88320 ^ (c >>> 1) : c >>> 1;
    table[n] = c >>> 0;
  }
  return table;
}

function chunk(type: string, data: Uint8Array, table: Uint32Array): Uint8Array {
  const out = new Uint8Array(data.length + 12);
  const view = new DataView(out.buffer);
  view.setUint32(0, data.length);
  for (let i = 0; i < 4; i++) out[4 + i] = type.charCodeAt(i);
  out.set(data, 8);
  let crc = 0xffffffff;
  for (let i = 4; i < data.length + 8; i++) crc = (table[(crc ^ (out[i] as number)) & 255] as number) ^ (crc >>> 8);
  view.setUint32(data.length + 8, (crc ^ 0xffffffff) >>> 0);
  return out;
}

/** The rows of an image, without its alpha channel if it is opaque everywhere. */
function rowsOf({ width, height, data }: PngSource): PngRows {
  checkSize('PNG', width, height, Infinity);
  const count = width * height;
  if (data.length !== count * 4)
    throw new ImageError(
      'image/size',
      `PNG: ${width}×${height} RGBA pixels need ${count * 4} numbers, but ${data.length} were given.`,
    );
  const wide = data instanceof Uint16Array;
  const opaque = wide ? 65535 : 255;
  let channels = 3;
  for (let i = 3; i < data.length && channels === 3; i += 4) if (data[i] !== opaque) channels = 4;
  const sample = wide ? 2 : 1;
  const raw = new Uint8Array(count * channels * sample);
  for (let i = 0, at = 0; i < data.length; i += 4) {
    for (let k = 0; k < channels; k++) {
      const value = data[i + k] as number;
      if (wide) raw[at++] = value >> 8;
      raw[at++] = value & 255;
    }
  }
  const pixelBytes = channels * sample;
  return { raw, rowBytes: width * pixelBytes, pixelBytes };
}

/** The file around its compressed pixels. @param parts Each becomes a chunk. */
function pngOf(
  { width, height, data, text = {} }: PngSource,
  { pixelBytes }: PngRows,
  parts: readonly Uint8Array[],
): Uint8Array<ArrayBuffer> {
  const table = crcTable();
  const sample = data instanceof Uint16Array ? 2 : 1;
  const header = new Uint8Array(13);
  const view = new DataView(header.buffer);
  view.setUint32(0, width);
  view.setUint32(4, height);
  header[8] = sample * 8;
  header[9] = pixelBytes === 4 * sample ? 6 : 2;
  const gamma = new Uint8Array(4);
  // 1/2.2 in hundred-thousandths: for readers that know gAMA but not sRGB, as the specification asks.
  new DataView(gamma.buffer).setUint32(0, 45455);
  const latin1 = (s: string) => Uint8Array.from(s, (c) => Math.min(c.charCodeAt(0), 255));
  return concat([
    Uint8Array.of(0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a),
    chunk('IHDR', header, table),
    chunk('sRGB', Uint8Array.of(0), table),
    chunk('gAMA', gamma, table),
    ...Object.entries(text).map(([key, value]) => chunk('tEXt', latin1(`${key.slice(0, 79)}\0${value}`), table)),
    ...parts.map((part) => chunk('IDAT', part, table)),
    chunk('IEND', new Uint8Array(0), table),
  ]);
}

/**
 * Encodes sRGB codes as PNG, 8 or 16 bits per channel, with an sRGB chunk. An image that is opaque everywhere is
 * written without its alpha channel.
 *
 * @throws {ImageError} `image/size` if the array does not hold width × height RGBA pixels.
 */
export function encodePng(source: PngSource): Uint8Array<ArrayBuffer> {
  const rows = rowsOf(source);
  const filtered = filterRows(rows, 0, source.height);
  return pngOf(source, rows, [zlibSync(filtered, { level: (source.level ?? 6) as 6 })]);
}

/** Bytes that are compressed at once: matches do not reach across, which costs less than 1 % of the size. */
const BAND_BYTES = 2 ** 22;

/** Adler-32 (RFC 1950). @param sum Of the bytes before these. */
function adler32(bytes: Uint8Array, sum: number): number {
  let [a, b] = [sum & 65535, sum >>> 16];
  for (let at = 0; at < bytes.length;) {
    // As many as 32 bits hold.
    for (const end = Math.min(at + 3800, bytes.length); at < end; at++) b += a += bytes[at] as number;
    a %= 65521;
    b %= 65521;
  }
  return ((b << 16) | a) >>> 0;
}

/**
 * {@link encodePng} for large images, whose rows are compressed in bands of 4 MiB by a function that may work on several
 * at the same time, such as zlib on the threads of Node. The bands do not depend on how many those are, so the bytes are
 * the same as long as the function's are.
 *
 * @param deflate Compresses bytes into a raw DEFLATE stream that ends at a whole byte and has no final block, so that
 * another one can follow: what zlib gives with `finishFlush: Z_SYNC_FLUSH`. It must not refer to the bytes before.
 * @throws {ImageError} `image/size` if the array does not hold width × height RGBA pixels; and what `deflate` throws.
 */
export async function encodePngAsync(
  source: Omit<PngSource, 'level'>,
  deflate: (bytes: Uint8Array<ArrayBuffer>) => Promise<Uint8Array>,
): Promise<Uint8Array<ArrayBuffer>> {
  const rows = rowsOf(source);
  const bandRows = Math.max(1, Math.floor(BAND_BYTES / rows.rowBytes));
  const bands: Promise<Uint8Array>[] = [];
  let sum = 1;
  for (let first = 0; first < source.height; first += bandRows) {
    const filtered = filterRows(rows, first, Math.min(first + bandRows, source.height));
    sum = adler32(filtered, sum);
    const band = deflate(filtered);
    // Awaited below; an error before that is not unhandled.
    band.catch(() => undefined);
    bands.push(band);
  }
  // A final block without bytes, and the checksum of all bytes.
  const end = Uint8Array.of(0x03, 0x00, sum >>> 24, sum >>> 16, sum >>> 8, sum);
  return pngOf(source, rows, [Uint8Array.of(0x78, 0x9c), ...(await Promise.all(bands)), end]);
}
