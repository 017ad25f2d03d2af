import { zlibSync } from 'fflate';
import { concat } from './bytes';
import { checkSize, ImageError } from './error';

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

/** The nearest of left, above and above left to their plane; in this order where they are as near. */
function paeth(a: number, b: number, c: number): number {
  const pa = Math.abs(b - c);
  const pb = Math.abs(a - c);
  const pc = Math.abs(a + b - 2 * c);
  return pa <= pb && pa <= pc ? a : pb <= pc ? b : c;
}

/**
 * The five filters of PNG, each in a loop of its own: images have tens of millions of bytes. Rows lie behind `left`
 * zeros, the bytes of a pixel.
 */
const FILTERS: readonly ((out: Uint8Array, row: Uint8Array, above: Uint8Array, left: number) => void)[] = [
  (out, row, _, left) => out.set(row.subarray(left)),
  (out, row, _, left) => {
    for (let i = 0; i < out.length; i++) out[i] = (row[i + left] as number) - (row[i] as number);
  },
  (out, row, above, left) => {
    for (let i = 0; i < out.length; i++) out[i] = (row[i + left] as number) - (above[i + left] as number);
  },
  (out, row, above, left) => {
    for (let i = 0; i < out.length; i++)
      out[i] = (row[i + left] as number) - (((row[i] as number) + (above[i + left] as number)) >> 1);
  },
  (out, row, above, left) => {
    for (let i = 0; i < out.length; i++)
      out[i] = (row[i + left] as number) - paeth(row[i] as number, above[i + left] as number, above[i] as number);
  },
];

/**
 * Filters every row with the filter of the smallest sum of absolute differences, the heuristic of the PNG
 * specification.
 */
function filterRows(raw: Uint8Array, height: number, rowBytes: number, pixelBytes: number): Uint8Array {
  const out = new Uint8Array((rowBytes + 1) * height);
  const trial = new Uint8Array(rowBytes);
  let row = new Uint8Array(pixelBytes + rowBytes);
  let above = new Uint8Array(pixelBytes + rowBytes);
  for (let y = 0; y < height; y++) {
    row.set(raw.subarray(y * rowBytes, (y + 1) * rowBytes), pixelBytes);
    let best = Infinity;
    for (const [filter, apply] of FILTERS.entries()) {
      apply(trial, row, above, pixelBytes);
      let sum = 0;
      for (let i = 0; i < rowBytes; i++) {
        const v = trial[i] as number;
        sum += v < 128 ? v : 256 - v;
      }
      if (sum < best) {
        best = sum;
        out[y * (rowBytes + 1)] = filter;
        out.set(trial, y * (rowBytes + 1) + 1);
      }
    }
    [row, above] = [above, row];
  }
  return out;
}

/**
 * Encodes sRGB codes as PNG, 8 or 16 bits per channel, with an sRGB chunk. An image that is opaque everywhere is
 * written without its alpha channel.
 *
 * @throws {ImageError} `image/size` if the array does not hold width × height RGBA pixels.
 */
export function encodePng({ width, height, data, text = {}, level = 6 }: PngSource): Uint8Array<ArrayBuffer> {
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
  const pixels = zlibSync(filterRows(raw, height, width * pixelBytes, pixelBytes), { level: level as 6 });

  const table = crcTable();
  const header = new Uint8Array(13);
  const view = new DataView(header.buffer);
  view.setUint32(0, width);
  view.setUint32(4, height);
  header[8] = sample * 8;
  header[9] = channels === 4 ? 6 : 2;
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
    chunk('IDAT', pixels, table),
    chunk('IEND', new Uint8Array(0), table),
  ]);
}
