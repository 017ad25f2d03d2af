import sharp from 'sharp';
import { describe, expect, it } from 'vitest';
import { applyGainMap, findGainMap } from '../src/gain-map';
import { randomNumbers } from './shared';

const [WIDTH, HEIGHT] = [64, 32];
const OFFSET = 1 / 64;
/** Radiance: a gradient of coloured sky, and a sun of 40. */
const radiance = (x: number, y: number, k: number) =>
  x >= 24 && x < 40 && y >= 8 && y < 24 ? 40 : ([0.1, 0.2, 0.4][k] as number) * (1 + y / HEIGHT);
const encode = (v: number) => (v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055);
const decode = (v: number) => (v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4);

/** A JPEG file as sharp writes it, with a packet of XMP. */
async function jpegOf(
  width: number,
  height: number,
  channels: 1 | 3,
  value: (x: number, y: number, k: number) => number,
  xmp: string,
): Promise<Buffer> {
  const data = Buffer.alloc(width * height * channels);
  for (let i = 0; i < data.length; i++) {
    const pixel = Math.floor(i / channels);
    data[i] = Math.round(255 * value(pixel % width, Math.floor(pixel / width), i % channels));
  }
  const file = await sharp(data, { raw: { width, height, channels } })
    .toColourspace(channels === 1 ? 'b-w' : 'srgb')
    .jpeg({ quality: 100, chromaSubsampling: '4:4:4' })
    .toBuffer();
  const packet = Buffer.from(`http://ns.adobe.com/xap/1.0/\0${xmp}`);
  const head = Buffer.from([0xff, 0xe1, (packet.length + 2) >> 8, (packet.length + 2) & 255]);
  return Buffer.concat([file.subarray(0, 2), head, packet, file.subarray(2)]);
}

const packet = (prefix: string, attributes: string, elements = '') =>
  `<x:xmpmeta xmlns:x="adobe:ns:meta/"><rdf:RDF xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#">` +
  `<rdf:Description xmlns:${prefix}="http://ns.adobe.com/hdr-gain-map/1.0/" ${prefix}:Version="1.0" ${attributes}>` +
  `${elements}</rdf:Description></rdf:RDF></x:xmpmeta>`;

const base = () => jpegOf(WIDTH, HEIGHT, 3, (x, y, k) => encode(Math.min(1, radiance(x, y, k))), '<x/>');
const gainOf = (x: number, y: number, k: number) => {
  const value = radiance(x, y, k);
  return Math.log2((value + OFFSET) / (Math.min(1, value) + OFFSET));
};
const bytesOf = (...parts: Uint8Array[]) => new Uint8Array(Buffer.concat(parts));

/** The image that a file stands for, decoded by sharp. */
async function decoded(file: Uint8Array<ArrayBuffer>): Promise<Float32Array> {
  const map = findGainMap(file);
  if (!map) throw new Error('no gain map');
  const first = await sharp(file).raw().toBuffer();
  const rgb = Float32Array.from(first, (code) => decode(code / 255));
  const { data, info } = await sharp(map.jpeg)
    .toColourspace('srgb')
    .ensureAlpha()
    .raw()
    .toBuffer({ resolveWithObject: true });
  applyGainMap(rgb, WIDTH, HEIGHT, map, { width: info.width, height: info.height, data });
  return rgb;
}

/** Maximum relative difference, away from the edge of the sun, where the map is interpolated. */
function difference(rgb: Float32Array): number {
  let max = 0;
  for (let y = 0; y < HEIGHT; y++)
    for (let x = 0; x < WIDTH; x++) {
      const near = (v: number, a: number, b: number) => Math.min(Math.abs(v - a), Math.abs(v - b)) <= 9;
      const isEdge =
        x > 15 && x < 49 && y < 32 && (near(x, 24, 39) || near(y, 8, 23)) && !(x > 29 && x < 34 && y > 13 && y < 18);
      if (isEdge) continue;
      for (let k = 0; k < 3; k++)
        max = Math.max(max, Math.abs((rgb[3 * (y * WIDTH + x) + k] as number) / radiance(x, y, k) - 1));
    }
  return max;
}

const TOP = Math.log2(41);

describe('gain maps of Ultra HDR JPEG', () => {
  it('one channel at half the size, attributes: the radiance that the file was made of', async () => {
    const map = await jpegOf(
      WIDTH / 2,
      HEIGHT / 2,
      1,
      (x, y) => (gainOf(2 * x, 2 * y, 0) / TOP) ** 0.5,
      packet(
        'hdrgm',
        `hdrgm:GainMapMax="${TOP}" hdrgm:Gamma="0.5" hdrgm:OffsetSDR="${OFFSET}" hdrgm:OffsetHDR='${OFFSET}'`,
      ),
    );
    const file = bytesOf(await base(), map);
    const rgb = await decoded(file);
    // A code near the top is 2 · 5.36 / 255 of a stop, 3 %, and one of the darkest sky 2.6 %; JPEG is off by one at most.
    expect(difference(rgb)).toBeLessThan(0.05);
    expect(rgb[3 * (16 * WIDTH + 32)]).toBeGreaterThan(38);
  });

  it('three channels with other bounds, elements, another prefix, and bytes between the files', async () => {
    const [low, high] = [
      [-1, -2, -3],
      [6, 7, 8],
    ] as const;
    const list = (name: string, values: readonly number[]) =>
      `<g:${name}><rdf:Seq>${values.map((value) => `<rdf:li>${value}</rdf:li>`).join('\n')}</rdf:Seq></g:${name}>`;
    const map = await jpegOf(
      WIDTH,
      HEIGHT,
      3,
      (x, y, k) => (gainOf(x, y, k) - (low[k] as number)) / ((high[k] as number) - (low[k] as number)),
      packet('g', '', list('GainMapMin', low) + list('GainMapMax', high)),
    );
    // A code of the last channel is 11 / 255 of a stop, 3 %.
    expect(difference(await decoded(bytesOf(await base(), Buffer.alloc(17), map)))).toBeLessThan(0.07);
  });

  it('files without one that applies', async () => {
    const first = await base();
    expect(findGainMap(bytesOf(first))).toBeUndefined();
    expect(findGainMap(bytesOf(first, first))).toBeUndefined();
    expect(findGainMap(new Uint8Array(await sharp(first).png().toBuffer()))).toBeUndefined();
    const withXmp = async (xmp: string) => findGainMap(bytesOf(first, await jpegOf(8, 8, 1, () => 0.5, xmp)));
    expect(await withXmp(packet('hdrgm', 'hdrgm:GainMapMax="3"'))).toMatchObject({ min: [0, 0, 0], max: [3, 3, 3] });
    expect(await withXmp(packet('hdrgm', 'hdrgm:GainMapMax="3" hdrgm:BaseRenditionIsHDR="True"'))).toBeUndefined();
    expect(await withXmp(packet('hdrgm', 'hdrgm:GainMapMax="many"'))).toBeUndefined();
    expect(await withXmp(packet('hdrgm', 'hdrgm:GainMapMax="3" hdrgm:Gamma="0"'))).toBeUndefined();
    expect(await withXmp(packet('hdrgm', ''))).toBeUndefined();
  });

  it('cut off or damaged anywhere: a map or none, and never an error', async () => {
    const whole = bytesOf(await base(), await jpegOf(8, 8, 1, () => 0.5, packet('hdrgm', 'hdrgm:GainMapMax="3"')));
    expect(findGainMap(whole)?.max).toEqual([3, 3, 3]);
    for (let length = 0; length < whole.length; length += 7)
      expect(findGainMap(whole.slice(0, length))).toBeUndefined();
    const random = randomNumbers(5);
    for (let i = 0; i < 300; i++) {
      const damaged = whole.slice();
      for (let k = 0; k < 4; k++) damaged[Math.floor(random() * damaged.length)] = random() * 256;
      const map = findGainMap(damaged);
      expect(map === undefined || map.jpeg.length > 0).toBe(true);
    }
  });
});
