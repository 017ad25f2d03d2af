import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { decodeExr, fromHalf, ImageError, toHalf, type ExrImage } from '../src/index';
import { hasShared, randomNumbers, shared } from './shared';

// The files were written by the OpenEXR library: see exr/README.md.
const bytesOf = (name: string) => new Uint8Array(readFileSync(new URL(`exr/${name}.exr`, import.meta.url)));
const read = (name: string) => decodeExr(bytesOf(name));
const numbers = (image: ExrImage) =>
  Object.fromEntries([...image.channels].map(([name, { type, data }]) => [name, [type, ...data]]));

/** Distance in steps between neighbouring halves. */
const steps = (a: number, b: number) => {
  const place = (value: number) => (value < 0 ? -(toHalf(value) & 0x7fff) : toHalf(value));
  return Math.abs(place(a) - place(b));
};

const plain = read('zip');

describe('compressions without loss give the same numbers', () => {
  it.each(['rle', 'zips', 'piz', 'tiled-piz', 'parts'])('%s', (name) => {
    const image = read(name);
    expect(image.warnings).toEqual([]);
    expect(numbers(image)).toEqual(numbers(plain));
  });

  it('which are those that the file was made of', () => {
    const { data } = plain.channels.get('id')!;
    for (let i = 0; i < data.length; i++)
      expect(data[i]).toBe(Math.floor((i % 19) / 4) * 70001 + Math.floor(Math.floor(i / 19) / 6));
    expect([...plain.channels.keys()]).toEqual([
      'A',
      'B',
      'G',
      'R',
      'Y',
      'Z',
      'albedo.B',
      'albedo.G',
      'albedo.R',
      'id',
    ]);
  });
});

describe('compressions with loss give what the library gives', () => {
  it.each([
    ['pxr24', 'pxr24'],
    ['b44', 'b44'],
    ['b44a', 'b44'],
  ])('%s, to the bit', (name, reference) => {
    expect(numbers(read(name))).toEqual(numbers(read(`${reference}.decoded`)));
  });

  // The library adds up cosines in another order and in single precision, before it rounds to halves and puts them on a
  // curve whose slope near 1 multiplies a step by 2.2.
  it.each(['dwaa', 'dwab'])('%s, to a few steps of a half', (name) => {
    const image = read(name),
      reference = read(`${name}.decoded`);
    let differing = 0,
      count = 0;
    for (const [channel, { type, data }] of reference.channels) {
      const ours = image.channels.get(channel)!;
      expect(ours.type).toBe(type);
      for (let i = 0; i < data.length; i++) {
        count++;
        if (ours.data[i] === data[i]) continue;
        differing++;
        expect(type, channel).toBe('half');
        // Numbers near 0 are sums that cancel out.
        expect(
          Math.abs(ours.data[i]! - data[i]!) < 1e-3 || steps(ours.data[i]!, data[i]!) <= 4,
          `${channel} ${i}: ${ours.data[i]} for ${data[i]}`,
        ).toBe(true);
      }
    }
    expect(differing / count).toBeLessThan(0.1);
    // And the loss is invisible: the image is still the one that was written.
    const source = plain.channels.get('R')!.data,
      got = image.channels.get('R')!.data;
    for (let i = 0; i < source.length; i++)
      expect(Math.abs(got[i]! - source[i]!)).toBeLessThan(0.15 * source[i]! + 0.02);
  });
});

describe('broken files of every compression', () => {
  it.each(['rle', 'zips', 'zip', 'piz', 'pxr24', 'b44', 'b44a', 'dwaa', 'dwab', 'tiled-piz', 'parts'])(
    '%s: two hundred corrupted copies are images or typed errors',
    (name) => {
      const sound = bytesOf(name);
      const random = randomNumbers(20261121);
      for (let i = 0; i < 200; i++) {
        let bytes = sound.slice();
        for (let k = 0; k < 1 + 4 * random(); k++)
          bytes[Math.floor(random() * bytes.length)] = Math.floor(random() * 256);
        if (random() < 0.2) bytes = bytes.slice(0, Math.floor(random() * bytes.length));
        try {
          decodeExr(bytes, { maxPixels: 2 ** 20 });
        } catch (error) {
          if (!(error instanceof ImageError)) throw error;
        }
      }
    },
  );
});

describe.skipIf(!hasShared)(
  `an image from a lens maker's set${hasShared ? '' : ' (skipped: no ../shared beside the repository)'}`,
  () => {
    it('tiles at several resolutions: the finest is read', () => {
      const image = decodeExr(shared('assets/env/OrientationLatLong.exr'));
      expect([image.width, image.height]).toEqual([1024, 512]);
      const { data } = image.channels.get('R')!;
      expect(data.every(Number.isFinite)).toBe(true);
      expect(new Set(data).size).toBeGreaterThan(10);
      expect(fromHalf(toHalf(data[0]!))).toBe(data[0]);
    });
  },
);
