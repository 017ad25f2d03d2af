import { allocateFloats, checkSize, ImageError, type DecodeOptions, type ImageWarning } from './error';
import { primariesWarning } from './primaries';

/** A decoded linear image. */
export interface HdrImage {
  readonly width: number;
  readonly height: number;
  /** RGB interleaved, stride 3, linear, top row first; finite and not negative. */
  readonly data: Float32Array<ArrayBuffer>;
  /** Faults that were worked around. */
  readonly warnings: readonly ImageWarning[];
}

interface Header {
  readonly width: number;
  readonly height: number;
  /** Lines of pixels run along x (the common case) or along y. */
  readonly rowMajor: boolean;
  readonly flipX: boolean;
  readonly flipY: boolean;
  /** Product of all EXPOSURE and COLORCORR lines, of red, green and blue. */
  readonly exposure: readonly [number, number, number];
  readonly warnings: ImageWarning[];
  /** Where the pixels start. */
  readonly offset: number;
}

const HEADER_LIMIT = 65536;
const MAX_FLOAT = 3.4028234663852886e38;

function readHeader(bytes: Uint8Array): Header {
  if (bytes[0] !== 0x23 || bytes[1] !== 0x3f) {
    throw new ImageError('image/format', 'HDR: the file does not start with "#?", so it is not a Radiance image.', {
      location: { byteOffset: 0 },
    });
  }
  let offset = 0;
  const line = (): string => {
    const limit = Math.min(bytes.length, HEADER_LIMIT);
    let end = offset;
    while (end < limit && bytes[end] !== 0x0a) end++;
    if (end >= limit)
      throw new ImageError('image/header', 'HDR: the header does not end.', { location: { byteOffset: offset } });
    const text = String.fromCharCode(...bytes.subarray(offset, Math.min(end, offset + 512))).replace(/\r$/, '');
    offset = end + 1;
    return text;
  };
  const warnings: ImageWarning[] = [];
  let format: string | undefined;
  let primaries: readonly number[] | undefined;
  const exposure: [number, number, number] = [1, 1, 1];
  const usable = (factor: number) => factor > 1e-18 && factor < 1e18;
  line();
  for (let text = line(); text !== ''; text = line()) {
    const [, key, value] = /^([A-Z]+)\s*=\s*(.*?)\s*$/.exec(text) ?? [];
    if (key === 'FORMAT') format = value;
    else if (key === 'EXPOSURE') {
      const factor = Number(value);
      if (usable(factor)) for (let k = 0; k < 3; k++) (exposure[k] as number) *= factor;
      else warnings.push({ code: 'image/exposure', message: `HDR: ignored the impossible exposure "${value}".` });
    } else if (key === 'COLORCORR') {
      const factors = value?.split(/\s+/).map(Number) ?? [];
      if (factors.length === 3 && factors.every(usable))
        factors.forEach((factor, k) => ((exposure[k] as number) *= factor));
      else
        warnings.push({ code: 'image/exposure', message: `HDR: ignored the impossible colour correction "${value}".` });
    } else if (key === 'PRIMARIES') primaries = value?.split(/\s+/).map(Number);
  }
  warnings.push(...primariesWarning('HDR', primaries));
  if (format === undefined)
    warnings.push({ code: 'image/no-format', message: 'HDR: the header names no format; taken as 32-bit_rle_rgbe.' });
  else if (format !== '32-bit_rle_rgbe') {
    throw new ImageError(
      'image/unsupported',
      `HDR: format "${format.slice(0, 40)}" is not supported, only 32-bit_rle_rgbe; convert the image.`,
    );
  }
  const at = offset;
  const match = /^([-+])([XY])\s+(\d{1,9})\s+([-+])([XY])\s+(\d{1,9})$/.exec(line().trim());
  if (!match || match[2] === match[5])
    throw new ImageError('image/header', 'HDR: the resolution line is missing or not like "-Y 512 +X 1024".', {
      location: { byteOffset: at },
    });
  const [, sign1, axis1, size1, sign2, , size2] = match;
  const rowMajor = axis1 === 'Y';
  const [signY, signX] = rowMajor ? [sign1, sign2] : [sign2, sign1];
  const [height, width] = rowMajor ? [Number(size1), Number(size2)] : [Number(size2), Number(size1)];
  return { width, height, rowMajor, flipX: signX === '-', flipY: signY === '+', exposure, warnings, offset };
}

/** Reads one line of `length` pixels into `line` (RGBE interleaved) and returns the offset after it. */
function readLine(bytes: Uint8Array, start: number, length: number, line: Uint8Array, index: number): number {
  const fail = (code: string, what: string, byteOffset: number) =>
    new ImageError(code, `HDR: ${what} in line ${index} at byte ${byteOffset}.`, { location: { byteOffset } });
  const truncated = () => fail('image/truncated', 'the data ends', bytes.length);
  let at = start;
  if (at + 4 > bytes.length) throw truncated();
  const [b0, b1, b2, b3] = [bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]] as [number, number, number, number];
  if (length >= 8 && length < 32768 && b0 === 2 && b1 === 2 && b2 < 128) {
    if (((b2 << 8) | b3) !== length)
      throw fail('image/corrupt', `a line of ${(b2 << 8) | b3} instead of ${length} pixels`, at);
    at += 4;
    for (let channel = 0; channel < 4; channel++) {
      for (let x = 0; x < length;) {
        if (at + 2 > bytes.length) throw truncated();
        const code = bytes[at++] as number;
        const count = code > 128 ? code - 128 : code;
        if (count === 0 || x + count > length)
          throw fail('image/corrupt', count === 0 ? 'an empty run' : 'a run beyond the end of the line', at - 1);
        if (code > 128) {
          const value = bytes[at++] as number;
          for (const end = x + count; x < end; x++) line[x * 4 + channel] = value;
        } else {
          if (at + count > bytes.length) throw truncated();
          for (const end = x + count; x < end; x++) line[x * 4 + channel] = bytes[at++] as number;
        }
      }
    }
    return at;
  }
  // Flat pixels, or the older run-length scheme: (1, 1, 1, n) repeats the last pixel n times, and markers in a row
  // give the higher bytes of the count.
  let shift = 0;
  for (let x = 0; x < length; at += 4) {
    if (at + 4 > bytes.length) throw truncated();
    if (bytes[at] === 1 && bytes[at + 1] === 1 && bytes[at + 2] === 1) {
      const count = (bytes[at + 3] as number) * 2 ** shift;
      if (x === 0 || shift > 16 || x + count > length) throw fail('image/corrupt', 'an impossible run', at);
      line.copyWithin(x * 4, (x - 1) * 4, x * 4);
      for (const end = x + count; x < end; x++) line.copyWithin(x * 4, (x - 1) * 4, x * 4);
      shift += 8;
    } else {
      line.set(bytes.subarray(at, at + 4), x * 4);
      x++;
      shift = 0;
    }
  }
  return at;
}

/**
 * Minimum bytes of a line: one pixel, and markers of the older run-length scheme, the first of which repeats
 * it up to 255 times and each one more 256 times as often. The newer scheme takes more.
 */
function shortestLine(length: number): number {
  let bytes = 4;
  for (let reached = 1, run = 255; reached < length; reached += run, run *= 256) bytes += 4;
  return bytes;
}

/**
 * Decodes a Radiance HDR (RGBE) image: flat pixels, old and new run-length coding, all eight orientations.
 * A component is mantissa · 2^(exponent − 136), divided by the header's EXPOSURE and COLORCORR if there are any, which
 * restores the original radiance.
 *
 * @throws {ImageError} `image/format`, `image/header`, `image/size`, `image/truncated`, `image/corrupt`, or
 * `image/unsupported` for XYZE colours.
 * @example
 * const { width, height, data } = decodeHdr(new Uint8Array(await (await fetch('studio.hdr')).arrayBuffer()));
 */
export function decodeHdr(bytes: Uint8Array, options: DecodeOptions = {}): HdrImage {
  const { width, height, rowMajor, flipX, flipY, exposure, warnings, offset } = readHeader(bytes);
  checkSize('HDR', width, height, options.maxPixels);
  const [lines, length] = rowMajor ? [height, width] : [width, height];
  const minBytes = lines * shortestLine(length);
  if (bytes.length - offset < minBytes) {
    throw new ImageError(
      'image/truncated',
      `HDR: ${width}×${height} pixels take at least ${minBytes} bytes, but the file has ${bytes.length - offset}.`,
      { location: { byteOffset: offset } },
    );
  }
  const scales = exposure.map((factor) =>
    Float64Array.from({ length: 256 }, (_, e) => (e === 0 ? 0 : 2 ** (e - 136) / factor)),
  );
  const data = allocateFloats('HDR', width, height, 3);
  const line = new Uint8Array(length * 4);
  let at = offset;
  for (let i = 0; i < lines; i++) {
    at = readLine(bytes, at, length, line, i);
    for (let j = 0; j < length; j++) {
      const [column, row] = rowMajor ? [j, i] : [i, j];
      const pixel = ((flipY ? height - 1 - row : row) * width + (flipX ? width - 1 - column : column)) * 3;
      const exponent = line[j * 4 + 3] as number;
      for (let k = 0; k < 3; k++)
        data[pixel + k] = Math.min(
          (line[j * 4 + k] as number) * ((scales[k] as Float64Array)[exponent] as number),
          MAX_FLOAT,
        );
    }
  }
  return { width, height, data, warnings };
}
