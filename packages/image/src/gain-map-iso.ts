import { ImageError } from './error';

/** Three numbers, one for each of red, green and blue. */
export type Channels = readonly [number, number, number];

/** Identifier of the APP2 segments of ISO 21496-1 in JPEG files, with the zero that ends it. */
export const ISO_GAIN_MAP = 'urn:iso:std:iso:ts:21496:-1\0';

/** What the metadata of ISO 21496-1 says of a gain map, all of it. Gains and headrooms are base-2 logarithms. */
export interface IsoGainMap {
  readonly min: Channels;
  readonly max: Channels;
  readonly gamma: Channels;
  readonly baseOffset: Channels;
  readonly alternateOffset: Channels;
  readonly baseHeadroom: number;
  readonly alternateHeadroom: number;
  /** Whether gains are for the primaries of the first image, not for those of the other rendition. */
  readonly isInBaseColourSpace: boolean;
  /** Whether the first image is the rendition of the higher dynamic range. */
  readonly isBackward: boolean;
}

const MULTICHANNEL = 128;
const BASE_COLOUR_SPACE = 64;
/** Two bits of the standard's drafts, which files in circulation have: libultrahdr writes both. */
const COMMON_DENOMINATOR = 8;
const BACKWARD = 4;

const fault = (code: string, text: string, byteOffset: number) =>
  new ImageError(code, `ISO 21496-1 gain map: ${text}`, { location: { byteOffset } });

/**
 * Reads the binary metadata of ISO 21496-1: big-endian, rational numbers, for one channel or three.
 *
 * @param payload What follows the identifier in the segment.
 * @param start Its place in the file, for errors.
 * @returns `undefined` if only readers of a later version may read it.
 * @throws {ImageError} `image/truncated` if it ends too early; `image/corrupt` for a denominator or gamma of zero, or a
 * maximum below its minimum.
 */
export function readIsoGainMap(payload: Uint8Array, start = 0): IsoGainMap | undefined {
  const view = new DataView(payload.buffer, payload.byteOffset, payload.length);
  let at = 0;
  const take = (size: number): number => {
    if (at + size > payload.length)
      throw fault(
        'image/truncated',
        `its metadata has ${payload.length} bytes and ends within a number; write the file again.`,
        start + at,
      );
    at += size;
    return at - size;
  };
  const minVersion = view.getUint16(take(2));
  if (minVersion > 0) return undefined;
  take(2);
  const flags = view.getUint8(take(1));
  const unsigned = () => view.getUint32(take(4));
  const signed = () => view.getInt32(take(4));
  const denominator = (): number => {
    const value = unsigned();
    if (value === 0) throw fault('image/corrupt', 'a denominator is 0; write the file again.', start + at - 4);
    return value;
  };
  const common = flags & COMMON_DENOMINATOR ? denominator() : undefined;
  const ratio = (read: () => number) => {
    const numerator = read();
    return numerator / (common ?? denominator());
  };
  const baseHeadroom = ratio(unsigned);
  const alternateHeadroom = ratio(unsigned);
  const channels = Array.from({ length: flags & MULTICHANNEL ? 3 : 1 }, () => {
    const place = start + at;
    const channel = {
      min: ratio(signed),
      max: ratio(signed),
      gamma: ratio(unsigned),
      baseOffset: ratio(signed),
      alternateOffset: ratio(signed),
    };
    if (channel.max < channel.min)
      throw fault('image/corrupt', `its maximum ${channel.max} is below its minimum ${channel.min}.`, place);
    if (channel.gamma === 0) throw fault('image/corrupt', 'its gamma is 0; it must be positive.', place);
    return channel;
  });
  type Channel = (typeof channels)[number];
  const [r, g = r, b = r] = channels as [Channel, Channel?, Channel?];
  const of = (key: keyof Channel): Channels => [r[key], (g as Channel)[key], (b as Channel)[key]];
  return {
    min: of('min'),
    max: of('max'),
    gamma: of('gamma'),
    baseOffset: of('baseOffset'),
    alternateOffset: of('alternateOffset'),
    baseHeadroom,
    alternateHeadroom,
    isInBaseColourSpace: (flags & BASE_COLOUR_SPACE) !== 0,
    isBackward: (flags & BACKWARD) !== 0,
  };
}
