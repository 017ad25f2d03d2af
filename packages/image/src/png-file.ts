import { concat } from './bytes';
import { checkSize, ImageError } from './error';
import type { PngRows } from './png-filter';

/** What a PNG file says of itself besides its pixels. */
export interface PngHeader {
  /** Pixels. */
  readonly width: number;
  readonly height: number;
  /** Of a channel. */
  readonly bits: 8 | 16;
  /** Whether it is written without its alpha channel. */
  readonly opaque: boolean;
  /** Text for the file's tEXt chunks, e.g. `{ Software: 'glanz' }`; keys of 1–79 and values in Latin-1. */
  readonly text?: Readonly<Record<string, string>>;
}

/** sRGB codes of whole rows: RGBA, stride 4, straight alpha, top row first. */
export type PngCodes = Uint8Array | Uint8ClampedArray | Uint16Array;

/** Input of `encodePng`. */
export interface PngSource {
  readonly width: number;
  readonly height: number;
  /** RGBA, stride 4, straight alpha, sRGB codes, top row first: 8-bit or 16-bit decides the depth of the file. */
  readonly data: PngCodes;
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

/** Bytes of a pixel in the file. */
export const pixelBytesOf = ({ bits, opaque }: Pick<PngHeader, 'bits' | 'opaque'>): number =>
  (opaque ? 3 : 4) * (bits / 8);

/**
 * What decides how the codes of an image are written.
 *
 * @throws {ImageError} `image/size` if the array does not hold width × height RGBA pixels.
 */
export function headerOf(width: number, height: number, data: PngCodes): Omit<PngHeader, 'text'> {
  checkSize('PNG', width, height, Infinity);
  const count = width * height;
  if (data.length !== count * 4)
    throw new ImageError(
      'image/size',
      `PNG: ${width}×${height} RGBA pixels need ${count * 4} numbers, but ${data.length} were given.`,
    );
  const bits = data instanceof Uint16Array ? 16 : 8;
  const full = bits === 16 ? 65535 : 255;
  let opaque = true;
  for (let i = 3; i < data.length && opaque; i += 4) opaque = data[i] === full;
  return { width, height, bits, opaque };
}

/** The bytes of whole rows, not yet filtered. */
export function rowsOf(data: PngCodes, header: Pick<PngHeader, 'width' | 'bits' | 'opaque'>): PngRows {
  const { width, bits, opaque } = header;
  const pixelBytes = pixelBytesOf(header);
  const raw = new Uint8Array((data.length / 4) * pixelBytes);
  if (bits === 16) {
    const channels = opaque ? 3 : 4;
    for (let i = 0, at = 0; i < data.length; i += 4)
      for (let k = 0; k < channels; k++) {
        const value = data[i + k] as number;
        raw[at++] = value >> 8;
        raw[at++] = value & 255;
      }
  } else if (!opaque) raw.set(data);
  // What most images are, without a loop over the channels.
  else
    for (let i = 0, at = 0; i < data.length; i += 4, at += 3) {
      raw[at] = data[i] as number;
      raw[at + 1] = data[i + 1] as number;
      raw[at + 2] = data[i + 2] as number;
    }
  return { raw, rowBytes: width * pixelBytes, pixelBytes };
}

/** The file around its compressed pixels. @param parts Each becomes a chunk. */
export function pngOf(
  { width, height, bits, opaque, text = {} }: PngHeader,
  parts: readonly Uint8Array[],
): Uint8Array<ArrayBuffer> {
  const table = crcTable();
  const header = new Uint8Array(13);
  const view = new DataView(header.buffer);
  view.setUint32(0, width);
  view.setUint32(4, height);
  header[8] = bits;
  header[9] = opaque ? 2 : 6;
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
