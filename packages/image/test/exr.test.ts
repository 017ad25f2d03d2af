import { inflateSync } from 'node:zlib';
import { FloatType } from 'three';
import { EXRLoader } from 'three/examples/jsm/loaders/EXRLoader.js';
import { describe, expect, it } from 'vitest';
import { decodeExr, encodeExr, fromHalf, ImageError, toHalf, type ExrLayer } from '../src/index';
import { randomNumbers } from './shared';

const plane = (n: number, seed: number, scale = 1) => {
  const random = randomNumbers(seed);
  return Float32Array.from({ length: n }, (_, i) => (i % 50 < 20 ? 0.25 : random()) * scale);
};
const codeOf = (run: () => unknown): string => {
  try {
    run();
  } catch (error) {
    if (error instanceof ImageError) return error.code;
    throw error;
  }
  return 'no error';
};
const layers = (n: number): ExrLayer[] => [
  { name: '', channels: { R: plane(n, 1, 8), G: plane(n, 2), B: plane(n, 3, 100), A: plane(n, 4) } },
  { name: 'albedo', channels: { R: plane(n, 5), G: plane(n, 6), B: plane(n, 7) } },
  { name: 'depth', type: 'float', channels: { Z: plane(n, 8, 1e4) } },
  { name: 'objectId', channels: { id: Uint32Array.from({ length: n }, (_, i) => (i % 3 ? i : 0xffffffff)) } },
];

describe.each(['zip', 'none'] as const)('compression %s', (compression) => {
  it.each([
    [1, 1],
    [5, 16],
    [33, 37],
  ])('%i×%i: all layers come back, halves as rounded and the rest exactly', (width, height) => {
    const n = width * height;
    const source = layers(n);
    const image = decodeExr(
      encodeExr({
        width,
        height,
        layers: source,
        compression,
        attributes: { software: 'glanz', 'glanz:settingWithALongNameOfMoreThan31': 'é' },
      }),
    );
    expect([image.width, image.height, image.warnings]).toEqual([width, height, []]);
    expect([...image.channels.keys()]).toEqual([
      'A',
      'B',
      'G',
      'R',
      'albedo.B',
      'albedo.G',
      'albedo.R',
      'depth.Z',
      'objectId.id',
    ]);
    expect(image.attributes.get('glanz:settingWithALongNameOfMoreThan31')).toBe('é');
    for (const layer of source) {
      for (const [key, expected] of Object.entries(layer.channels)) {
        const channel = image.channels.get(layer.name ? `${layer.name}.${key}` : key);
        const half = channel?.type === 'half';
        expect(channel?.data.length).toBe(n);
        for (let i = 0; i < n; i++) {
          const value = expected[i] as number;
          expect(channel?.data[i]).toBe(half ? fromHalf(toHalf(value)) : value);
        }
      }
    }
  });

  it.each(['half', 'float'] as const)('three.js reads the same RGBA %s', (type) => {
    const [width, height] = [21, 35];
    const n = width * height;
    const channels = { R: plane(n, 1, 8), G: plane(n, 2), B: plane(n, 3, 100), A: plane(n, 4) };
    const loader = new EXRLoader();
    loader.type = FloatType;
    const theirs = loader.parse(
      encodeExr({ width, height, layers: [{ name: '', type, channels }], compression }).buffer,
    );
    expect([theirs.width, theirs.height]).toEqual([width, height]);
    for (let y = 0; y < height; y++) {
      for (let x = 0; x < width; x++) {
        for (const [k, key] of (['R', 'G', 'B', 'A'] as const).entries()) {
          const value = channels[key][y * width + x] as number;
          // Its rows go from the bottom up.
          expect(theirs.data![((height - 1 - y) * width + x) * 4 + k]).toBe(
            type === 'half' ? fromHalf(toHalf(value)) : value,
          );
        }
      }
    }
  });
});

describe('the bytes of the file', () => {
  const [width, height] = [6, 20];
  const R = plane(width * height, 1);
  const bytes = encodeExr({ width, height, layers: [{ name: '', type: 'float', channels: { R } }] });
  const view = new DataView(bytes.buffer);
  const find = (name: string, type: string) => {
    const expected = new TextEncoder().encode(`${name}\0${type}\0`);
    const at = bytes.findIndex((_, i) => expected.every((b, k) => bytes[i + k] === b));
    expect(at, name).toBeGreaterThan(0);
    return { size: view.getInt32(at + expected.length, true), at: at + expected.length + 4 };
  };

  it('begin with magic number and version, and hold every required attribute with its size', () => {
    expect([...bytes.subarray(0, 8)]).toEqual([0x76, 0x2f, 0x31, 0x01, 2, 0, 0, 0]);
    const channels = find('channels', 'chlist');
    expect(channels.size).toBe(2 + 16 + 1);
    expect([...bytes.subarray(channels.at, channels.at + 19)]).toEqual([
      0x52, 0, 2, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0,
    ]);
    expect(bytes[find('compression', 'compression').at]).toBe(3);
    for (const name of ['dataWindow', 'displayWindow']) {
      const { at, size } = find(name, 'box2i');
      expect([size, ...[0, 4, 8, 12].map((k) => view.getInt32(at + k, true))]).toEqual([
        16,
        0,
        0,
        width - 1,
        height - 1,
      ]);
    }
    expect(bytes[find('lineOrder', 'lineOrder').at]).toBe(0);
    expect(view.getFloat32(find('pixelAspectRatio', 'float').at, true)).toBe(1);
    expect(find('screenWindowCenter', 'v2f').size).toBe(8);
    expect(view.getFloat32(find('screenWindowWidth', 'float').at, true)).toBe(1);
  });

  it('offsets point at blocks of 16 lines, packed as the format says (unpacked by the test)', () => {
    const chromaticities = find('chromaticities', 'chromaticities');
    const table = chromaticities.at + chromaticities.size + 1;
    for (const [i, first] of [0, 16].entries()) {
      const at = Number(view.getBigUint64(table + i * 8, true));
      expect(view.getInt32(at, true)).toBe(first);
      const size = view.getInt32(at + 4, true);
      const lines = Math.min(16, height - first);
      const packed = bytes.subarray(at + 8, at + 8 + size);
      expect(size).toBeLessThan(lines * width * 4);
      const t = inflateSync(packed);
      for (let k = 1; k < t.length; k++) t[k] = (t[k - 1] as number) + (t[k] as number) - 128;
      const middle = Math.floor((t.length + 1) / 2);
      const raw = new Uint8Array(t.length);
      for (let k = 0; k < t.length; k++) raw[k] = t[k % 2 === 0 ? k / 2 : middle + (k - 1) / 2] as number;
      expect([...new Float32Array(raw.buffer)]).toEqual([...R.subarray(first * width, (first + lines) * width)]);
    }
  });
});

describe('errors', () => {
  const good = { width: 2, height: 2, layers: [{ name: '', channels: { R: new Float32Array(4) } }] };
  it('the encoder refuses wrong lengths and names', () => {
    expect(codeOf(() => encodeExr({ ...good, layers: [] }))).toBe('image/channels');
    expect(codeOf(() => encodeExr({ ...good, layers: [...good.layers, ...good.layers] }))).toBe('image/channels');
    expect(codeOf(() => encodeExr({ ...good, layers: [{ name: 'ü', channels: { R: new Float32Array(4) } }] }))).toBe(
      'image/channels',
    );
    expect(codeOf(() => encodeExr({ ...good, width: 3 }))).toBe('image/size');
    expect(codeOf(() => encodeExr({ ...good, height: 0 }))).toBe('image/size');
  });
  it('the decoder ends in numbers or an ImageError for every truncation and for 3000 random mutations (seed 6)', () => {
    const random = randomNumbers(6);
    const [width, height] = [7, 18];
    for (const compression of ['zip', 'none'] as const) {
      const bytes = encodeExr({ width, height, compression, layers: layers(width * height) });
      for (let n = 0; n < bytes.length; n += 3)
        expect(codeOf(() => decodeExr(bytes.subarray(0, n)))).toMatch(/^image\//);
      for (let n = 0; n < 1500; n++) {
        const bad = bytes.slice();
        for (let k = 0; k < 1 + random() * 4; k++)
          bad[Math.floor(random() * (n % 2 ? 700 : bad.length))] = random() * 256;
        codeOf(() => decodeExr(bad, { maxPixels: 1e6 }));
      }
    }
  });
  it('an image far larger than its bytes is refused before it is allocated', () => {
    const bytes = encodeExr(good);
    const view = new DataView(bytes.buffer);
    const at = String.fromCharCode(...bytes).indexOf('dataWindow\0box2i\0') + 17 + 4;
    view.setInt32(at + 8, 8000, true);
    view.setInt32(at + 12, 8000, true);
    expect(codeOf(() => decodeExr(bytes))).toBe('image/truncated');
    view.setInt32(at + 8, 2 ** 31 - 1, true);
    expect(codeOf(() => decodeExr(bytes))).toBe('image/size');
    view.setInt32(at + 8, -5, true);
    expect(codeOf(() => decodeExr(bytes))).toBe('image/size');
  });
});
