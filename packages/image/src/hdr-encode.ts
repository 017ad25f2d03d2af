import { concat } from './bytes';
import { checkSize, ImageError } from './error';

/** Input of {@link encodeHdr}. */
export interface HdrSource {
  readonly width: number;
  readonly height: number;
  /** Linear RGB (stride 3) or RGBA (stride 4, alpha is dropped), top row first. */
  readonly data: Float32Array;
}

/** Writes one pixel as RGBE: three mantissas of 8 bits with the exponent of the largest. */
function packPixel(r: number, g: number, b: number, out: Uint8Array, at: number): void {
  // A shared exponent has no infinity: 255 · 2^(255 − 136) is the top. NaN and negatives become 0.
  const top = 255 * 2 ** 119;
  const clean = (v: number) => (v > 0 ? Math.min(v, top) : 0);
  const [x, y, z] = [clean(r), clean(g), clean(b)];
  const peak = Math.max(x, y, z);
  if (peak < 2 ** -128) return void out.fill(0, at, at + 4);
  let exponent = Math.floor(Math.log2(peak)) + 1;
  // log2 may be off by one ulp at powers of two, and a mantissa may round up to 256.
  if (Math.round(peak * 2 ** (8 - exponent)) > 255) exponent++;
  const scale = 2 ** (8 - exponent);
  out[at] = Math.round(x * scale);
  out[at + 1] = Math.round(y * scale);
  out[at + 2] = Math.round(z * scale);
  out[at + 3] = exponent + 128;
}

/** New-style run-length coding of one channel of a line: runs from 4 equal bytes on, the rest literal. */
function packChannel(line: Uint8Array, channel: number, length: number, out: number[]): void {
  let literal = 0;
  const flush = (end: number) => {
    while (literal < end) {
      const count = Math.min(128, end - literal);
      out.push(count);
      for (let i = 0; i < count; i++) out.push(line[(literal + i) * 4 + channel] as number);
      literal += count;
    }
  };
  for (let x = 0; x < length;) {
    const value = line[x * 4 + channel] as number;
    let run = 1;
    while (run < 127 && x + run < length && line[(x + run) * 4 + channel] === value) run++;
    if (run >= 4) {
      flush(x);
      out.push(128 + run, value);
      literal = x + run;
    }
    x += run;
  }
  flush(length);
}

/**
 * Encodes a linear image as Radiance HDR (RGBE, run-length coded). The error of a component is at most 1/256 of the
 * pixel's largest one. Negative values and NaN are written as 0.
 *
 * @throws {ImageError} `image/size` if the array does not hold width × height RGB or RGBA pixels.
 */
export function encodeHdr({ width, height, data }: HdrSource): Uint8Array<ArrayBuffer> {
  checkSize('HDR', width, height, Infinity);
  const stride = data.length / (width * height);
  if (stride !== 3 && stride !== 4)
    throw new ImageError(
      'image/size',
      `HDR: ${width}×${height} pixels need ${width * height} × 3 or 4 floats, but ${data.length} were given.`,
    );
  const header = new TextEncoder().encode(`#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y ${height} +X ${width}\n`);
  const packed = width >= 8 && width < 32768;
  const parts: Uint8Array[] = [header];
  const line = new Uint8Array(width * 4);
  for (let y = 0; y < height; y++) {
    for (let x = 0; x < width; x++) {
      const at = (y * width + x) * stride;
      packPixel(data[at] as number, data[at + 1] as number, data[at + 2] as number, line, x * 4);
    }
    if (!packed) parts.push(line.slice());
    else {
      const out = [2, 2, width >> 8, width & 255];
      for (let channel = 0; channel < 4; channel++) packChannel(line, channel, width, out);
      parts.push(Uint8Array.from(out));
    }
  }
  return concat(parts);
}
