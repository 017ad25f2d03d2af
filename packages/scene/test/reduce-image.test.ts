import v8 from 'node:v8';
import vm from 'node:vm';
import { describe, expect, it } from 'vitest';
import { finish, type Image } from '../src/index';
import { droppableBlocks, reduceImageSteps } from '../src/texture-budget';

const decode = (code: number) => (code / 255 <= 0.04045 ? code / 255 / 12.92 : ((code / 255 + 0.055) / 1.055) ** 2.4);
const encode = (value: number) => 255 * (value <= 0.0031308 ? 12.92 * value : 1.055 * value ** (1 / 2.4) - 0.055);

/** Codes in all combinations of bright and dark. */
function noise(width: number, height: number, seed = 7): Uint8Array<ArrayBuffer> {
  let state = seed;
  return Uint8Array.from({ length: 4 * width * height }, () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state >>> 24;
  });
}

/** The area of [a, a + 1) in [b, b + size). */
const overlap = (a: number, b: number, size: number) => Math.max(0, Math.min(a + 1, b + size) - Math.max(a, b));

/** The mean of each channel over the area of each pixel of the result, of every pixel's own overlap with it. */
function boxes(data: ArrayLike<number>, [w, h]: number[], [tw, th]: number[], srgb: boolean, float = false) {
  const out: number[] = [];
  for (let y = 0; y < th!; y++)
    for (let x = 0; x < tw!; x++)
      for (let c = 0; c < 4; c++) {
        let sum = 0;
        for (let sy = 0; sy < h!; sy++)
          for (let sx = 0; sx < w!; sx++) {
            const area = overlap(sx, (x * w!) / tw!, w! / tw!) * overlap(sy, (y * h!) / th!, h! / th!);
            if (area === 0) continue;
            const code = data[4 * (sy * w! + sx) + c]!;
            sum += area * (float ? code : srgb && c < 3 ? decode(code) : code / 255);
          }
        const mean = sum / ((w! / tw!) * (h! / th!));
        out.push(float ? mean : srgb && c < 3 ? encode(mean) : 255 * mean);
      }
  return out;
}

describe('reduceImageSteps', () => {
  it.each([
    [16, 16, 1],
    [16, 16, 2],
    [32, 8, 3],
    [17, 9, 1],
    [23, 31, 2],
    [5, 1, 1],
    [40, 3, 4],
  ])('%i × %i, %i levels: the mean over the area of each pixel, rounded once', (width, height, level) => {
    const data = noise(width, height);
    for (const space of ['srgb', 'linear'] as const) {
      const image = { name: 'noise', width, height, data };
      const reduced = finish(reduceImageSteps(image, level, space));
      const size = [Math.max(1, width >> level), Math.max(1, height >> level)];
      expect([reduced.width, reduced.height]).toEqual(size);
      expect(reduced.data).toBeInstanceOf(Uint8Array);
      const expected = boxes(data, [width, height], size, space === 'srgb');
      expect(reduced.data.length).toBe(expected.length);
      // Half a code of rounding, and what tables of single precision lose of a code.
      expected.forEach((value, i) => expect(Math.abs(reduced.data[i]! - value)).toBeLessThan(0.5 + 1e-3));
      expect(image.data).toBe(data);
    }
  });

  it('floats stay floats, without limits', () => {
    const data = Float32Array.from(noise(6, 6), (code) => code * code - 3000);
    const reduced = finish(reduceImageSteps({ name: 'hdr', width: 6, height: 6, data }, 1, 'linear'));
    const expected = boxes(data, [6, 6], [3, 3], false, true);
    expected.forEach((value, i) => expect(reduced.data[i]).toBeCloseTo(value, 2));
    expect(reduced.data).toBeInstanceOf(Float32Array);
  });

  it('does not keep pixels that were not read before', () => {
    let reads = 0;
    const image = Object.defineProperty({ name: 'lazy', width: 4, height: 4 }, 'data', {
      get(this: object) {
        reads++;
        const value = noise(4, 4);
        Object.defineProperty(this, 'data', { value });
        return value;
      },
      configurable: true,
    }) as unknown as Image;
    finish(reduceImageSteps(image, 1, 'linear'));
    finish(reduceImageSteps(image, 2, 'linear'));
    expect(reads).toBe(2);
  });

  it('what is dropped of a compressed image is not kept for its pixels', async () => {
    let reads = 0;
    const lazy = () => {
      reads++;
      return noise(8, 8);
    };
    const make = () => {
      const levels = [new Uint8Array(64), new Uint8Array(16)];
      const image = Object.defineProperty(
        { name: 'blocks', width: 8, height: 8, compressed: { format: 'bc7-rgba-unorm', levels } },
        'data',
        { get: lazy, configurable: true },
      ) as unknown as Image;
      return { reduced: finish(reduceImageSteps(image, 1, 'srgb', true)), dropped: new WeakRef(levels[0]!) };
    };
    const { reduced, dropped } = make();
    v8.setFlagsFromString('--expose-gc');
    const collect = vm.runInNewContext('gc') as () => void;
    // A WeakRef holds its target until the end of the task.
    await new Promise((resolve) => setTimeout(resolve));
    collect();
    expect(dropped.deref()).toBeUndefined();
    expect([reads, reduced.data.length, reads]).toEqual([0, 4 * 16, 1]);
  });

  it('compressed images lose stored levels, in whole blocks, and stay compressed', () => {
    const levels = [24, 12, 6, 3].map((size) => new Uint8Array(16 * Math.ceil(size / 4) ** 2).fill(size));
    const data = noise(24, 24);
    const image: Image = {
      name: 'blocks',
      width: 24,
      height: 24,
      data,
      compressed: { format: 'bc7-rgba-unorm', levels },
    };
    // 6 × 6 texels are no whole blocks.
    expect(droppableBlocks(image)).toBe(1);
    expect(droppableBlocks({ ...image, compressed: { format: 'bc7-rgba-unorm', levels: levels.slice(0, 1) } })).toBe(0);
    const reduced = finish(reduceImageSteps(image, 1, 'srgb', true));
    expect(reduced.compressed).toEqual({ format: 'bc7-rgba-unorm', levels: levels.slice(1) });
    const plain = finish(reduceImageSteps(image, 1, 'srgb'));
    expect(plain.compressed).toBeUndefined();
    expect(Array.from(reduced.data)).toEqual(Array.from(plain.data));
  });
});
