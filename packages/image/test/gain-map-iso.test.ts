import sharp from 'sharp';
import { describe, expect, it } from 'vitest';
import { ImageError } from '../src/error';
import { applyGainMap, findGainMap } from '../src/gain-map';
import { readIsoGainMap } from '../src/gain-map-iso';
import { randomNumbers } from './shared';

type Ratio = readonly [numerator: number, denominator: number];

/** The numbers of ISO 21496-1 in their order in the file, of a channel. */
interface Channel {
  readonly min: Ratio;
  readonly max: Ratio;
  readonly gamma: Ratio;
  readonly base: Ratio;
  readonly alternate: Ratio;
}

interface Metadata {
  readonly minVersion?: number;
  readonly flags?: number;
  readonly common?: number;
  readonly baseHeadroom: Ratio;
  readonly alternateHeadroom: Ratio;
  readonly channels: readonly Channel[];
}

/** An encoder, written from the table of the standard. */
function encoded({ minVersion = 0, flags = 64, common, ...rest }: Metadata): Buffer {
  const { baseHeadroom, alternateHeadroom, channels } = rest;
  const bytes: number[] = [0, minVersion, 0, 0];
  const word = (value: number) => bytes.push(...[24, 16, 8, 0].map((shift) => (value >> shift) & 255));
  const ratio = ([numerator, denominator]: Ratio) => {
    word(numerator);
    if (common === undefined) word(denominator);
  };
  bytes.push(flags | (channels.length === 3 ? 128 : 0) | (common === undefined ? 0 : 8));
  if (common !== undefined) word(common);
  for (const value of [baseHeadroom, alternateHeadroom]) ratio(value);
  for (const { min, max, gamma, base, alternate } of channels) [min, max, gamma, base, alternate].forEach(ratio);
  return Buffer.from(bytes);
}

const segment = (marker: number, id: string, payload: Uint8Array) => {
  const content = Buffer.concat([Buffer.from(`${id}\0`), payload]);
  return Buffer.concat([Buffer.from([0xff, marker, (content.length + 2) >> 8, (content.length + 2) & 255]), content]);
};
const iso = (payload: Uint8Array) => segment(0xe2, 'urn:iso:std:iso:ts:21496:-1', payload);
const xmp = (max: number) =>
  segment(
    0xe1,
    'http://ns.adobe.com/xap/1.0/',
    Buffer.from(
      `<rdf:Description xmlns:hdrgm="http://ns.adobe.com/hdr-gain-map/1.0/" hdrgm:GainMapMax="${max}" hdrgm:HDRCapacityMax="${max}"/>`,
    ),
  );

const [WIDTH, HEIGHT] = [32, 16];

/** A JPEG file as sharp writes it, of RGB codes, with segments at its beginning. */
async function jpegOf(code: (x: number, y: number, k: number) => number, ...segments: Uint8Array[]): Promise<Buffer> {
  const data = Buffer.alloc(WIDTH * HEIGHT * 3);
  for (let i = 0; i < data.length; i++) {
    const pixel = Math.floor(i / 3);
    data[i] = Math.round(code(pixel % WIDTH, Math.floor(pixel / WIDTH), i % 3));
  }
  const file = await sharp(data, { raw: { width: WIDTH, height: HEIGHT, channels: 3 } })
    .jpeg({ quality: 100, chromaSubsampling: '4:4:4' })
    .toBuffer();
  return Buffer.concat([file.subarray(0, 2), ...segments, file.subarray(2)]);
}
const bytesOf = (...parts: Uint8Array[]) => new Uint8Array(Buffer.concat(parts));
/** As encoders write it: the first image has the version alone. */
const base = () => jpegOf(() => 188, iso(Buffer.alloc(4)));

const CHANNELS: readonly Channel[] = [
  { min: [-1, 3], max: [5, 2], gamma: [1, 2], base: [1, 64], alternate: [-1, 32] },
  { min: [-2, 1], max: [7, 2], gamma: [3, 2], base: [1, 128], alternate: [1, 100] },
  { min: [0, 7], max: [9, 4], gamma: [1, 1], base: [0, 5], alternate: [3, 1000] },
];
const META: Metadata = { baseHeadroom: [1, 4], alternateHeadroom: [4_000_000_000, 1_000_000_000], channels: CHANNELS };
const PLAIN: Channel = { min: [0, 1], max: [4, 1], gamma: [1, 1], base: [0, 1], alternate: [0, 1] };
const ONE: Metadata = { baseHeadroom: [0, 1], alternateHeadroom: [4, 1], channels: [PLAIN] };

/** The error that something throws. */
function errorOf(run: () => unknown): { code: string; byteOffset: number | undefined } {
  try {
    run();
  } catch (error) {
    if (error instanceof ImageError) return { code: error.code, byteOffset: error.location?.byteOffset };
    throw error;
  }
  throw new Error('nothing was thrown');
}

describe('gain maps of ISO 21496-1', () => {
  it('reads all fields, of three channels', () => {
    const value = ([numerator, denominator]: Ratio) => numerator / denominator;
    const of = (key: keyof Channel) => CHANNELS.map((channel) => value(channel[key]));
    const expected = {
      min: of('min'),
      max: of('max'),
      gamma: of('gamma'),
      baseOffset: of('base'),
      alternateOffset: of('alternate'),
      baseHeadroom: 0.25,
      alternateHeadroom: 4,
      isInBaseColourSpace: true,
      isBackward: false,
    };
    expect(readIsoGainMap(encoded(META))).toEqual(expected);
    expect(readIsoGainMap(encoded({ ...META, flags: 4 }))).toEqual({
      ...expected,
      isInBaseColourSpace: false,
      isBackward: true,
    });
    // Later writers may add to the end.
    expect(readIsoGainMap(Buffer.concat([encoded(META), Buffer.alloc(9)]))).toEqual(expected);
  });

  it('one channel stands for three, and a denominator for all', () => {
    const channel: Channel = { min: [-100, 0], max: [250, 0], gamma: [50, 0], base: [2, 0], alternate: [-3, 0] };
    const common: Metadata = { common: 100, baseHeadroom: [10, 0], alternateHeadroom: [300, 0], channels: [channel] };
    expect(encoded(common)).toHaveLength(37);
    expect(readIsoGainMap(encoded(common))).toEqual({
      min: [-1, -1, -1],
      max: [2.5, 2.5, 2.5],
      gamma: [0.5, 0.5, 0.5],
      baseOffset: [0.02, 0.02, 0.02],
      alternateOffset: [-0.03, -0.03, -0.03],
      baseHeadroom: 0.1,
      alternateHeadroom: 3,
      isInBaseColourSpace: true,
      isBackward: false,
    });
  });

  it('the radiance that the standard’s formula gives, code by code', async () => {
    const code = (x: number, _: number, k: number) => 8 * x + (k === 1 ? 3 : 0);
    const file = bytesOf(await base(), await jpegOf(code, iso(encoded(META))));
    const map = findGainMap(file)!;
    expect([map.baseHeadroom, map.alternateHeadroom, map.isInBaseColourSpace]).toEqual([0.25, 4, true]);
    const { data } = await sharp(map.jpeg).ensureAlpha().raw().toBuffer({ resolveWithObject: true });
    expect(data[4 * 20 + 1]).toBeGreaterThan(150);
    const rgb = new Float32Array(WIDTH * HEIGHT * 3).fill(0.5);
    applyGainMap(rgb, WIDTH, HEIGHT, map, { width: WIDTH, height: HEIGHT, data });
    for (let pixel = 0; pixel < WIDTH * HEIGHT; pixel++)
      CHANNELS.forEach(({ min, max, gamma, base: b, alternate: a }, k) => {
        const encodedGain = (data[4 * pixel + k] as number) / 255;
        const recovered = encodedGain ** (gamma[1] / gamma[0]);
        const log2 = (min[0] / min[1]) * (1 - recovered) + (max[0] / max[1]) * recovered;
        const expected = Math.max(0, (0.5 + b[0] / b[1]) * 2 ** log2 - a[0] / a[1]);
        expect(Math.abs((rgb[3 * pixel + k] as number) - expected)).toBeLessThan(1e-5 * (1 + expected));
      });
  });

  it('counts before XMP in the same image, and XMP counts where a later version alone reads it', async () => {
    const max = async (...segments: Uint8Array[]) =>
      findGainMap(bytesOf(await base(), await jpegOf(() => 128, ...segments)))?.max;
    expect(await max(xmp(2))).toEqual([2, 2, 2]);
    expect(await max(iso(encoded(ONE)))).toEqual([4, 4, 4]);
    expect(await max(xmp(2), iso(encoded(ONE)))).toEqual([4, 4, 4]);
    expect(await max(iso(encoded(ONE)), xmp(2))).toEqual([4, 4, 4]);
    expect(await max(iso(encoded({ ...ONE, minVersion: 1 })), xmp(2))).toEqual([2, 2, 2]);
    // Other segments of APP2, such as a profile, are none of it.
    expect(await max(segment(0xe2, 'ICC_PROFILE', Buffer.alloc(40)))).toBeUndefined();
    expect(findGainMap(bytesOf(await base()))).toBeUndefined();
  });

  it('leaves a first image alone that is the one of high dynamic range', async () => {
    const of = async (metadata: Metadata) =>
      findGainMap(bytesOf(await base(), await jpegOf(() => 128, iso(encoded(metadata)), xmp(2))));
    expect(await of({ ...ONE, flags: 68 })).toBeUndefined();
    expect(await of({ ...ONE, baseHeadroom: [4, 1], alternateHeadroom: [0, 1] })).toBeUndefined();
    expect(await of({ ...ONE, baseHeadroom: [4, 1] })).toBeUndefined();
    expect((await of({ ...ONE, flags: 0 }))?.isInBaseColourSpace).toBe(false);
  });

  it('damaged metadata: an error with its code and the place in the file', async () => {
    const first = await base();
    const errorFor = async (payload: Uint8Array) => {
      const second = await jpegOf(() => 128, iso(payload));
      return errorOf(() => findGainMap(bytesOf(first, second)));
    };
    // After the first file: the marker of the second, its segment's marker and length, the identifier.
    const start = first.length + 2 + 4 + 28;
    const payload = encoded(ONE);
    for (let length = 0; length < payload.length; length++)
      expect(errorOf(() => readIsoGainMap(payload.subarray(0, length))).code, `${length}`).toBe('image/truncated');
    expect(await errorFor(payload.subarray(0, 20))).toEqual({ code: 'image/truncated', byteOffset: start + 17 });
    expect(await errorFor(encoded({ ...ONE, alternateHeadroom: [4, 0] }))).toEqual({
      code: 'image/corrupt',
      byteOffset: start + 17,
    });
    const broken = (channel: Partial<Channel>) => errorFor(encoded({ ...ONE, channels: [{ ...PLAIN, ...channel }] }));
    expect(await broken({ gamma: [0, 1] })).toEqual({ code: 'image/corrupt', byteOffset: start + 21 });
    expect(await broken({ min: [9, 2] })).toEqual({ code: 'image/corrupt', byteOffset: start + 21 });
    expect(await broken({ alternate: [1, 0] })).toMatchObject({ code: 'image/corrupt', byteOffset: start + 57 });
    expect(await errorFor(encoded({ ...ONE, common: 0 }))).toMatchObject({ code: 'image/corrupt' });
    expect(await errorFor(encoded({ ...ONE, minVersion: 1 }))).toEqual({
      code: 'image/unsupported',
      byteOffset: start,
    });
  });

  it('random metadata: finite numbers, none, or an ImageError', () => {
    const random = randomNumbers(7);
    const seen = new Set<string>();
    for (let i = 0; i < 2000; i++) {
      const payload = Uint8Array.from(encoded(i % 2 ? META : ONE));
      for (let k = 0; k < 3; k++) payload[Math.floor(random() * payload.length)] = random() * 256;
      try {
        const map = readIsoGainMap(payload);
        seen.add(map ? 'map' : 'none');
        if (map)
          expect(
            Object.values(map)
              .flat()
              .every((value) => Number.isFinite(Number(value))),
          ).toBe(true);
      } catch (error) {
        expect(error).toBeInstanceOf(ImageError);
        seen.add((error as ImageError).code);
      }
    }
    expect([...seen].sort()).toEqual(['image/corrupt', 'image/truncated', 'map', 'none']);
  });
});
