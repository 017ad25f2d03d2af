import { FloatType } from 'three';
import { HDRLoader } from 'three/examples/jsm/loaders/HDRLoader.js';
import { describe, expect, it } from 'vitest';
import { decodeHdr, encodeHdr, ImageError } from '../src/index';
import { hasShared, randomNumbers, shared } from './shared';

/** A file from its header lines and pixel bytes. */
const file = (header: string, ...pixels: number[]) => Uint8Array.from([...new TextEncoder().encode(header), ...pixels]);
const HEAD = '#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n';
const codeOf = (run: () => unknown): string => {
  try {
    run();
  } catch (error) {
    if (error instanceof ImageError) return error.code;
    throw error;
  }
  return 'no error';
};

describe('decodeHdr', () => {
  it('a component is mantissa · 2^(e − 136)', () => {
    const { width, height, data } = decodeHdr(
      file(`${HEAD}-Y 1 +X 3\n`, 128, 64, 0, 129, 255, 1, 2, 136, 200, 100, 50, 0),
    );
    expect([width, height]).toEqual([3, 1]);
    expect([...data]).toEqual([1, 0.5, 0, 255, 1, 2, 0, 0, 0]);
  });

  it('reads the old run-length scheme, with counts over several markers', () => {
    const { data } = decodeHdr(
      file(`${HEAD}-Y 1 +X 262\n`, 128, 128, 128, 129, 1, 1, 1, 4, 1, 1, 1, 1, 128, 0, 0, 130),
    );
    expect(data.length).toBe(262 * 3);
    expect([...data.subarray(260 * 3)]).toEqual([1, 1, 1, 2, 0, 0]);
    expect(data.subarray(0, 261 * 3).every((v) => v === 1)).toBe(true);
  });

  it('reads the new scheme: runs and literals per channel', () => {
    const line = [2, 2, 0, 8, 136, 128, 2, 0, 64, 134, 32, 136, 0, 136, 129];
    const { data } = decodeHdr(file(`${HEAD}-Y 1 +X 8\n`, ...line));
    expect([...data.subarray(0, 9)]).toEqual([1, 0, 0, 1, 0.5, 0, 1, 0.25, 0]);
  });

  it('turns all eight orientations upright', () => {
    // A 2×2 image: 1 2 above 3 4, as red mantissas with exponent 136.
    const bytes = (...order: number[]) => order.flatMap((v) => [v, 0, 0, 136]);
    const cases: [string, number[]][] = [
      ['-Y 2 +X 2', [1, 2, 3, 4]],
      ['-Y 2 -X 2', [2, 1, 4, 3]],
      ['+Y 2 +X 2', [3, 4, 1, 2]],
      ['+Y 2 -X 2', [4, 3, 2, 1]],
      ['+X 2 -Y 2', [1, 3, 2, 4]],
      ['-X 2 -Y 2', [2, 4, 1, 3]],
      ['+X 2 +Y 2', [3, 1, 4, 2]],
      ['-X 2 +Y 2', [4, 2, 3, 1]],
    ];
    for (const [resolution, order] of cases) {
      const { data } = decodeHdr(file(`${HEAD}${resolution}\n`, ...bytes(...order)));
      expect([data[0], data[3], data[6], data[9]], resolution).toEqual([1, 2, 3, 4]);
    }
    const tall = decodeHdr(file(`${HEAD}+X 1 -Y 2\n`, ...bytes(1, 2)));
    expect([tall.width, tall.height]).toEqual([1, 2]);
  });

  it('divides by the product of the exposures and warns of impossible ones', () => {
    const { data, warnings } = decodeHdr(
      file('#?RGBE\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=2\nEXPOSURE= 4\nEXPOSURE=nan\n\n-Y 1 +X 1\n', 128, 0, 0, 129),
    );
    expect(data[0]).toBe(1 / 8);
    expect(warnings.map((w) => w.code)).toEqual(['image/exposure']);
  });

  it('divides by the product of the colour corrections', () => {
    const { data, warnings } = decodeHdr(
      file(
        '#?RGBE\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=2\nCOLORCORR= 1 2 4\nCOLORCORR=1 2\n\n-Y 1 +X 1\n',
        128,
        128,
        128,
        129,
      ),
    );
    expect([...data]).toEqual([1 / 2, 1 / 4, 1 / 8]);
    expect(warnings.map(({ message }) => message)).toEqual(['HDR: ignored the impossible colour correction "1 2".']);
  });

  it('warns of colours that are not those of Rec.709', () => {
    const warnings = (primaries: string) =>
      decodeHdr(
        file(`#?RGBE\nFORMAT=32-bit_rle_rgbe\nPRIMARIES=${primaries}\n\n-Y 1 +X 1\n`, 128, 128, 128, 129),
      ).warnings.map(({ code }) => code);
    // Radiance's own, and what Photoshop writes.
    expect(warnings('0.640 0.330 0.290 0.600 0.150 0.060 0.333 0.333')).toEqual([]);
    expect(warnings('0 0 0 0 0 0 0 0')).toEqual([]);
    expect(warnings('none')).toEqual([]);
    // ITU-R BT.2020.
    expect(warnings('0.708 0.292 0.170 0.797 0.131 0.046 0.3127 0.3290')).toEqual(['image/primaries']);
  });

  it.each([
    [256, 8],
    [257, 12],
    [65_536, 12],
    [65_537, 16],
  ])('a line of %d pixels is not shorter than %d bytes', (length, bytes) => {
    // The shortest there is: a pixel, and runs whose counts add up to the rest.
    const line = [9, 9, 9, 129];
    for (let rest = length - 1, run = 1; rest > 0; run *= 256) {
      const count = Math.min(255, Math.ceil((rest % (run * 256)) / run) || 255);
      line.push(1, 1, 1, count);
      rest -= count * run;
    }
    expect(codeOf(() => decodeHdr(file(`${HEAD}-Y 1 +X ${length}\n`, ...line.slice(0, bytes - 1))))).toBe(
      'image/truncated',
    );
    expect(() =>
      decodeHdr(file(`${HEAD}-Y 1000 +X ${length}\n`, ...new Array<number>(1000 * bytes - 1).fill(0))),
    ).toThrow(`take at least ${1000 * bytes} bytes`);
  });

  it('an image for which there is no memory is an error of the decoder', () => {
    const bytes = new Uint8Array(HEAD.length + 20 + 16 * 200_000);
    bytes.set(file(`${HEAD}-Y 200000 +X 200000\n`));
    expect(codeOf(() => decodeHdr(bytes, { maxPixels: Infinity }))).toBe('image/size');
  });

  it('refuses what is not an image, with a code', () => {
    expect(codeOf(() => decodeHdr(new Uint8Array(0)))).toBe('image/format');
    expect(codeOf(() => decodeHdr(Uint8Array.of(0x89, 0x50, 0x4e, 0x47)))).toBe('image/format');
    expect(codeOf(() => decodeHdr(file('#?RADIANCE\nFORMAT=32-bit_rle_rgbe')))).toBe('image/header');
    expect(codeOf(() => decodeHdr(file(`${HEAD}-Y 4 -Y 4\n`)))).toBe('image/header');
    expect(codeOf(() => decodeHdr(file('#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n', 1, 1, 1, 1)))).toBe(
      'image/unsupported',
    );
    expect(codeOf(() => decodeHdr(file(`${HEAD}-Y 0 +X 4\n`)))).toBe('image/size');
    expect(codeOf(() => decodeHdr(file(`${HEAD}-Y 99999 +X 99999\n`, 1, 2, 3, 4)))).toBe('image/size');
    expect(codeOf(() => decodeHdr(file(`${HEAD}-Y 2 +X 2\n`, 1, 2, 3, 4)))).toBe('image/truncated');
    expect(codeOf(() => decodeHdr(file(`${HEAD}-Y 1 +X 8\n`, 2, 2, 0, 9, 136, 1, 136, 1, 136, 1, 136, 1)))).toBe(
      'image/corrupt',
    );
    expect(codeOf(() => decodeHdr(file(`${HEAD}-Y 1 +X 8\n`, 2, 2, 0, 8, 0, 0, 0, 0, 0, 0)))).toBe('image/corrupt');
    expect(codeOf(() => decodeHdr(file(`${HEAD}-Y 1 +X 8\n`, 2, 2, 0, 8, 137, 1, 136, 1)))).toBe('image/corrupt');
    expect(codeOf(() => decodeHdr(file(`${HEAD}-Y 1 +X 2\n`, 1, 1, 1, 1, 1, 1, 1, 1)))).toBe('image/corrupt');
    expect(
      codeOf(() => decodeHdr(file(`${HEAD}-Y 4 +X 4\n`, ...new Array<number>(64).fill(7)), { maxPixels: 15 })),
    ).toBe('image/size');
  });

  it('ends in pixels or an ImageError for every truncation and for 3000 random mutations (seed 4)', () => {
    const random = randomNumbers(4);
    const source = { width: 9, height: 5, data: Float32Array.from({ length: 135 }, () => random() * 4) };
    const good = encodeHdr(source);
    for (let n = 0; n < good.length; n++) expect(codeOf(() => decodeHdr(good.subarray(0, n)))).toMatch(/^image\//);
    for (let n = 0; n < 3000; n++) {
      const bad = good.slice();
      for (let k = 0; k < 1 + random() * 4; k++) bad[Math.floor(random() * bad.length)] = random() * 256;
      codeOf(() => {
        for (const v of decodeHdr(bad, { maxPixels: 1e6 }).data)
          if (!(v >= 0 && v < Infinity)) throw new Error(`mutation ${n}: ${v}`);
      });
    }
  });

  it.skipIf(!hasShared)(
    `${hasShared ? '' : '[skipped: ../shared is absent] '}reads real environments as three.js does, bit for bit`,
    () => {
      for (const name of [
        'studio_small_05_1k',
        'leadenhall_market_1k',
        'aristea_wreck_puresky_1k',
        'royal_esplanade_256',
        'simple-rle',
      ]) {
        const bytes = shared(`assets/env/${name}.hdr`);
        const ours = decodeHdr(bytes);
        const loader = new HDRLoader();
        loader.type = FloatType;
        const theirs = loader.parse(bytes.slice().buffer);
        expect([ours.width, ours.height, ours.warnings], name).toEqual([theirs.width, theirs.height, []]);
        // Theirs is RGBA. It computes in units of 2^(e−128)/255, ours in 2^(e−136): a factor of 256/255.
        let worst = 0;
        for (let i = 0; i < ours.width * ours.height; i++) {
          for (let k = 0; k < 3; k++) {
            const a = ours.data[i * 3 + k] as number;
            const b = (theirs.data![i * 4 + k] as number) * (255 / 256);
            if (a !== b) worst = Math.max(worst, Math.abs(a - b) / Math.max(a, b));
          }
        }
        expect(worst, name).toBeLessThan(1e-6);
      }
    },
  );

  it.skipIf(!hasShared)(
    `${hasShared ? '' : '[skipped: ../shared is absent] '}a studio is brighter above than below and has lights`,
    () => {
      const { width, height, data } = decodeHdr(shared('assets/env/studio_small_05_1k.hdr'));
      expect([width, height]).toEqual([1024, 512]);
      const mean = (from: number, to: number) =>
        data.subarray(from * width * 3, to * width * 3).reduce((a, b) => a + b, 0) / ((to - from) * width * 3);
      expect(mean(0, 256)).toBeGreaterThan(mean(256, 512));
      expect(data.reduce((a, b) => Math.max(a, b), 0)).toBeGreaterThan(10);
    },
  );
});

describe('encodeHdr', () => {
  it.each([
    [1, 7],
    [7, 3],
    [8, 2],
    [300, 5],
  ])('%i×%i comes back within 1/256 of each pixel’s largest component (seed 9)', (width, height) => {
    const random = randomNumbers(9);
    const data = Float32Array.from({ length: width * height * 3 }, () =>
      random() < 0.2 ? 0 : random() * 2 ** (random() * 40 - 20),
    );
    // Equal pixels in a row make runs.
    if (width > 100) data.fill(0.75, 30, 600);
    const back = decodeHdr(encodeHdr({ width, height, data }));
    expect([back.width, back.height, back.warnings]).toEqual([width, height, []]);
    for (let i = 0; i < data.length; i += 3) {
      const peak = Math.max(...data.subarray(i, i + 3));
      for (let k = i; k < i + 3; k++)
        expect(Math.abs((back.data[k] as number) - (data[k] as number))).toBeLessThanOrEqual(peak / 256);
    }
  });

  it('keeps exact what 8 bits of mantissa can hold, at both ends of the range', () => {
    const data = Float32Array.of(1, 0.5, 0.25, 2 ** 126, 0, 0, 2 ** -120, 0, 0, 255, 255, 254);
    expect([...decodeHdr(encodeHdr({ width: 4, height: 1, data })).data]).toEqual([...data]);
  });

  it('drops alpha, and writes NaN and negatives as 0 and infinity as the largest number', () => {
    const back = decodeHdr(encodeHdr({ width: 1, height: 1, data: Float32Array.of(NaN, -4, Infinity, 1) }));
    expect([...back.data]).toEqual([0, 0, 255 * 2 ** 119]);
  });

  it('is read by three.js', () => {
    const width = 16;
    const data = Float32Array.from({ length: width * 2 * 3 }, (_, i) => i / 8);
    const loader = new HDRLoader();
    loader.type = FloatType;
    const theirs = loader.parse(encodeHdr({ width, height: 2, data }).buffer);
    for (let i = 0; i < width * 2; i++) {
      for (let k = 0; k < 3; k++)
        expect(Math.abs((theirs.data![i * 4 + k] as number) - (data[i * 3 + k] as number))).toBeLessThan(
          0.012 * (data[i * 3 + 2] as number) + 1e-9,
        );
    }
  });

  it('refuses an array of the wrong length', () => {
    expect(codeOf(() => encodeHdr({ width: 2, height: 2, data: new Float32Array(11) }))).toBe('image/size');
    expect(codeOf(() => encodeHdr({ width: 0, height: 2, data: new Float32Array(0) }))).toBe('image/size');
  });
});
