import { ImageError } from './error';
import { ISO_GAIN_MAP, readIsoGainMap, type Channels } from './gain-map-iso';

/** The gain map of a JPEG, and how its codes become gains. */
export interface GainMap {
  /** The JPEG file of the map itself, a view of the bytes that were given. */
  readonly jpeg: Uint8Array<ArrayBuffer>;
  /** Base-2 logarithms of the gains that the codes 0 and 255 stand for. */
  readonly min: Channels;
  readonly max: Channels;
  /** Exponent of the codes' encoding. */
  readonly gamma: Channels;
  /** What is added before the gain, and taken off after it. */
  readonly offsetSdr: Channels;
  readonly offsetHdr: Channels;
  /**
   * Base-2 logarithms of how much brighter than white a display must be: up to the first it shows the first image as it
   * is, from the second on it applies the map at full strength.
   */
  readonly baseHeadroom: number;
  readonly alternateHeadroom: number;
  /** Whether gains are for the primaries of the first image, or for those of the other rendition. */
  readonly isInBaseColourSpace: boolean;
}

/** Pixels of a gain map: RGBA, stride 4, codes as the file has them, top row first. */
export interface GainMapPixels {
  readonly width: number;
  readonly height: number;
  readonly data: Uint8Array | Uint8ClampedArray;
}

const XMP = 'http://ns.adobe.com/xap/1.0/\0';
const NAMESPACE = 'http://ns.adobe.com/hdr-gain-map/1.0/';
/** Images in one file that are looked at. */
const MAX_IMAGES = 8;

interface JpegImage {
  /** Position after its last byte. */
  readonly end: number;
  readonly xmp: string;
  /** Payload of the segment of ISO 21496-1, and its place in the file. */
  readonly iso: { readonly payload: Uint8Array; readonly start: number } | undefined;
}

/** Walks the segments of the JPEG that begins at a position; `undefined` if it is none, or cut off. */
function jpegAt(bytes: Uint8Array, start: number): JpegImage | undefined {
  let xmp = '';
  let iso: JpegImage['iso'];
  const begins = (at: number, id: string) => String.fromCharCode(...bytes.subarray(at, at + id.length)) === id;
  for (let at = start + 2; at + 3 < bytes.length + 2;) {
    if (bytes[at] !== 0xff) return undefined;
    const marker = bytes[at + 1] as number;
    if (marker === 0xd9) return { end: at + 2, xmp, iso };
    if (marker === 0xff) {
      at++;
      continue;
    }
    const length = ((bytes[at + 2] as number) << 8) | (bytes[at + 3] as number);
    const next = at + 2 + length;
    if (!(length >= 2) || next > bytes.length) return undefined;
    if (marker === 0xe1 && begins(at + 4, XMP))
      xmp += new TextDecoder().decode(bytes.subarray(at + 4 + XMP.length, next));
    const payload = at + 4 + ISO_GAIN_MAP.length;
    if (marker === 0xe2 && next >= payload && begins(at + 4, ISO_GAIN_MAP))
      iso ??= { payload: bytes.subarray(payload, next), start: payload };
    at = next;
    if (marker !== 0xda) continue;
    // Coded data until a marker that is no restart and no stuffed zero.
    while (at + 1 < bytes.length) {
      const code = bytes[at + 1] as number;
      if (bytes[at] === 0xff && code !== 0 && !(code >= 0xd0 && code <= 0xd7)) break;
      at++;
    }
  }
  return undefined;
}

/** A property of the metadata, an attribute or an element; one number, or one for each channel. */
function channels(xmp: string, name: string, fallback: number | undefined): Channels | undefined {
  const element = xmp.indexOf(`<${name}>`);
  const text = new RegExp(`\\s${name}\\s*=\\s*["']([^"']*)["']`).exec(xmp)?.[1];
  const values =
    text === undefined && element >= 0
      ? xmp
          .slice(element, xmp.indexOf(`</${name}>`, element))
          .replace(/<[^>]*>/g, ' ')
          .trim()
          .split(/\s+/)
          .map(Number)
      : [text === undefined ? (fallback ?? NaN) : Number(text)];
  const [r, g = r, b = r] = values as [number, number?, number?];
  return [r, g, b].every((value) => Number.isFinite(value)) ? [r, g as number, b as number] : undefined;
}

type Description = Omit<GainMap, 'jpeg'>;

/** What XMP says of a gain map; `base` if the first image is the one of high dynamic range. */
function describedByXmp(xmp: string): Description | 'base' | undefined {
  const prefix = new RegExp(`xmlns:([\\w-]+)\\s*=\\s*["']${NAMESPACE}["']`).exec(xmp)?.[1];
  if (prefix === undefined) return undefined;
  if (new RegExp(`${prefix}:BaseRenditionIsHDR\\s*=\\s*["']True`, 'i').test(xmp)) return 'base';
  const read = (name: string, fallback?: number) => channels(xmp, `${prefix}:${name}`, fallback);
  const max = read('GainMapMax');
  const min = read('GainMapMin', 0);
  const gamma = read('Gamma', 1);
  const offsetSdr = read('OffsetSDR', 1 / 64);
  const offsetHdr = read('OffsetHDR', 1 / 64);
  if (!(min && max && gamma?.every((value) => value > 0) && offsetSdr && offsetHdr)) return undefined;
  const baseHeadroom = read('HDRCapacityMin', 0)?.[0] ?? 0;
  const alternateHeadroom = read('HDRCapacityMax', Math.max(...max))?.[0] ?? Math.max(...max);
  return { min, max, gamma, offsetSdr, offsetHdr, baseHeadroom, alternateHeadroom, isInBaseColourSpace: true };
}

/**
 * What a file says of its gain map, by ISO 21496-1 before XMP; `base` if the first image is the one of high dynamic
 * range.
 */
function describedBy({ iso, xmp }: JpegImage): Description | 'base' | undefined {
  const metadata = iso && readIsoGainMap(iso.payload, iso.start);
  if (!metadata) {
    const description = describedByXmp(xmp);
    if (iso && !description)
      throw new ImageError(
        'image/unsupported',
        'ISO 21496-1 gain map: only a later version than 0 describes it; write it with minimum_version 0.',
        { location: { byteOffset: iso.start } },
      );
    return description;
  }
  const { baseOffset: offsetSdr, alternateOffset: offsetHdr, isBackward, ...rest } = metadata;
  return isBackward || rest.alternateHeadroom <= rest.baseHeadroom ? 'base' : { ...rest, offsetSdr, offsetHdr };
}

/**
 * Finds the gain map of an Ultra HDR JPEG: of the JPEG files that follow the first one, the one that describes it by the
 * segment of ISO 21496-1 or, where there is none, by XMP (Ultra HDR Image Format 1.1; the properties of "Gain map 1.0",
 * adobe.com). Where both do, ISO 21496-1 counts. The platform decodes both files.
 *
 * @returns `undefined` if the file has none: it is an ordinary JPEG, something else, damaged, or its first image is the
 * one of high dynamic range (by the direction or by the headrooms).
 * @throws {ImageError} for the segment of ISO 21496-1: `image/truncated`, `image/corrupt`; `image/unsupported` for a
 * later version, where no XMP describes the map too.
 */
export function findGainMap(bytes: Uint8Array<ArrayBuffer>): GainMap | undefined {
  if (bytes[0] !== 0xff || bytes[1] !== 0xd8) return undefined;
  let image = jpegAt(bytes, 0);
  for (let i = 0; image && i < MAX_IMAGES; i++) {
    let start = image.end;
    while (start + 2 < bytes.length && !(bytes[start] === 0xff && bytes[start + 1] === 0xd8)) start++;
    image = start + 2 < bytes.length ? jpegAt(bytes, start) : undefined;
    const description = image && describedBy(image);
    if (image && description && description !== 'base')
      return { jpeg: bytes.subarray(start, image.end), ...description };
  }
  return undefined;
}

/**
 * Applies a gain map at full strength: what the image is on a display of enough brightness, and what light it is of.
 * Gains of three channels belong to the primaries that the map names; they are applied to the channels as given.
 *
 * @param rgb The first image, linear RGB, stride 3, 1 is white; becomes the result. Values are at least 0.
 * @param pixels Of the map, of any size: it is interpolated.
 */
export function applyGainMap(
  rgb: Float32Array,
  width: number,
  height: number,
  { min, max, gamma, offsetSdr, offsetHdr }: GainMap,
  pixels: GainMapPixels,
): void {
  const tables = [0, 1, 2].map((k) => {
    const [low, high, power] = [min[k] as number, max[k] as number, gamma[k] as number];
    return Float32Array.from({ length: 256 }, (_, code) => low + (high - low) * (code / 255) ** (1 / power));
  });
  const place = (i: number, size: number, of: number) => {
    const at = Math.min(Math.max(((i + 0.5) / size) * of - 0.5, 0), of - 1);
    const first = Math.floor(at);
    return { first, next: Math.min(first + 1, of - 1), t: at - first };
  };
  const columns = Array.from({ length: width }, (_, x) => place(x, width, pixels.width));
  for (let y = 0; y < height; y++) {
    const row = place(y, height, pixels.height);
    for (let x = 0; x < width; x++) {
      const { first, next, t } = columns[x] as (typeof columns)[number];
      for (let k = 0; k < 3; k++) {
        const table = tables[k] as Float32Array;
        const gain = (line: number, column: number) =>
          table[pixels.data[4 * (line * pixels.width + column) + k] as number] as number;
        const above = gain(row.first, first) * (1 - t) + gain(row.first, next) * t;
        const below = gain(row.next, first) * (1 - t) + gain(row.next, next) * t;
        const i = 3 * (y * width + x) + k;
        const boost = 2 ** (above * (1 - row.t) + below * row.t);
        rgb[i] = Math.max(0, ((rgb[i] as number) + (offsetSdr[k] as number)) * boost - (offsetHdr[k] as number));
      }
    }
  }
}
