import type { CompressedFormat } from '@glanz/scene';
import sharp from 'sharp';
import { beforeAll, describe, expect, it } from 'vitest';
import type { DecodedImage, ImageDecoder } from '../src/decoded-image';
import { buildScene, type GltfOptions } from '../src/load';
import { decodeImage } from '../src/node';
import { glb, triangle } from './build';

const MIB = 2 ** 20;

/** A triangle for each image, with a material that shows it in a slot. */
function document(
  files: readonly Uint8Array[],
  slot: 'baseColorTexture' | 'metallicRoughnessTexture' = 'baseColorTexture',
  mimeType = 'image/png',
  more: Readonly<Record<string, unknown>> = {},
): Uint8Array<ArrayBuffer> {
  const { json, binary } = triangle();
  const views: { buffer: number; byteOffset: number; byteLength: number }[] = [];
  const length = files.reduce((sum, file) => sum + Math.ceil(file.length / 4) * 4, binary.length);
  const data = new Uint8Array(length);
  data.set(binary);
  let at = binary.length;
  for (const file of files) {
    data.set(file, at);
    views.push({ buffer: 0, byteOffset: at, byteLength: file.length });
    at += Math.ceil(file.length / 4) * 4;
  }
  const given = json as unknown as {
    bufferViews: object[];
    meshes: { primitives: object[] }[];
  };
  const [primitive] = given.meshes[0]!.primitives;
  return glb(
    {
      ...json,
      buffers: [{ byteLength: length }],
      bufferViews: [...given.bufferViews, ...views],
      images: files.map((_, i) => ({ bufferView: given.bufferViews.length + i, mimeType, name: `image ${i}` })),
      textures: files.map((_, i) =>
        mimeType === 'image/ktx2' ? { extensions: { KHR_texture_basisu: { source: i } } } : { source: i },
      ),
      materials: files.map((_, i) => ({ pbrMetallicRoughness: { [slot]: { index: i } } })),
      meshes: [{ primitives: files.map((_, material) => ({ ...primitive, material })) }],
      ...(mimeType === 'image/ktx2' ? { extensionsUsed: ['KHR_texture_basisu'] } : {}),
      ...more,
    },
    data,
  );
}

const load = (bytes: Uint8Array<ArrayBuffer>, options: GltfOptions & { decodeImage?: ImageDecoder } = {}) =>
  buildScene(
    { name: 'test.glb', bytes, read: () => Promise.reject(new Error('no files')) },
    { decodeImage, ...options },
  );

/** Codes in all combinations, and their file. */
async function noise(size: number, seed: number) {
  let state = seed + 1;
  const data = Uint8Array.from({ length: 4 * size * size }, (_, i) => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return i % 4 === 3 ? 255 : state >>> 24;
  });
  const file = await sharp(data, { raw: { width: size, height: size, channels: 4 } })
    .png({ compressionLevel: 0 })
    .toBuffer();
  return { data, file: new Uint8Array(file) };
}

const decode = (c: number) => (c / 255 <= 0.04045 ? c / 255 / 12.92 : ((c / 255 + 0.055) / 1.055) ** 2.4);
const encode = (v: number) => 255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055);

/** The means of boxes of n × n pixels. */
function boxes(data: ArrayLike<number>, size: number, n: number, srgb: boolean): number[] {
  const small = size / n;
  return Array.from({ length: 4 * small * small }, (_, i) => {
    const [c, x, y] = [i % 4, Math.floor(i / 4) % small, Math.floor(i / 4 / small)];
    let sum = 0;
    for (let v = 0; v < n; v++)
      for (let u = 0; u < n; u++) {
        const code = data[4 * ((n * y + v) * size + n * x + u) + c]!;
        sum += srgb && c < 3 ? decode(code) : code / 255;
      }
    const mean = sum / n ** 2;
    return srgb && c < 3 ? encode(mean) : 255 * mean;
  });
}

describe('imageBudgetMiB', () => {
  let images: Awaited<ReturnType<typeof noise>>[];
  beforeAll(async () => {
    images = await Promise.all(Array.from({ length: 60 }, (_, i) => noise(256, i)));
  });

  it.each([
    ['baseColorTexture', true],
    ['metallicRoughnessTexture', false],
  ] as const)('60 images of 256² in 4 MiB, as %s: means of boxes, in one warning', async (slot, srgb) => {
    const scene = await load(
      document(
        images.map(({ file }) => file),
        slot,
      ),
      { imageBudgetMiB: 4 },
    );
    expect(scene.images.length).toBe(60);
    const bytes = scene.images.reduce((sum, { data }) => sum + data.length, 0);
    expect(bytes).toBeLessThanOrEqual(4 * MIB);
    const sizes = scene.images.map(({ width }) => width);
    // All were equal: they differ by a level at max, and no other level fits.
    expect(Math.max(...sizes)).toBeLessThanOrEqual(2 * Math.min(...sizes));
    expect(4 * MIB - bytes).toBeLessThan(3 * 4 * Math.min(...sizes) ** 2);
    scene.images.forEach(({ name, width, height, data }, i) => {
      expect([name, height]).toEqual([`image ${i}`, width]);
      const levels = Math.log2(256 / width);
      const expected = boxes(images[i]!.data, 256, 256 / width, srgb);
      // Rounded once for each level: half a code, of which sRGB lets dark ones weigh more.
      expect(data.length).toBe(expected.length);
      const error = expected.reduce((worst, value, k) => Math.max(worst, Math.abs(data[k]! - value)), 0);
      expect(error).toBeLessThanOrEqual(0.5 * levels + 0.5);
    });
    const warnings = scene.warnings.filter(({ code }) => code === 'gltf/image-budget');
    expect(warnings.length).toBe(1);
    expect(warnings[0]!.message).toMatch(/59 images .*256 × 256 pixels.*4\.0 MiB/);
  });

  it('large enough, or not given: every pixel, and no warning', async () => {
    const file = document(images.slice(0, 4).map(({ file }) => file));
    for (const options of [{}, { imageBudgetMiB: 1 }]) {
      const scene = await load(file, options);
      scene.images.forEach(({ data }, i) =>
        expect(Buffer.compare(Buffer.from(data), Buffer.from(images[i]!.data))).toBe(0),
      );
      expect(scene.warnings).toEqual([]);
    }
  });

  it('never decodes more than 512 MiB at a time, nor holds more than the budget beside that', async () => {
    // The header alone says how large an image is.
    const huge = new Uint8Array(
      await sharp({ create: { width: 8192, height: 8192, channels: 3, background: '#844' } })
        .png({ compressionLevel: 1 })
        .toBuffer(),
    );
    let [now, max] = [0, 0];
    const counted: ImageDecoder = async () => {
      max = Math.max(max, ++now);
      // Long enough for all that may begin beside it, also on a busy machine.
      await new Promise((resolve) => setTimeout(resolve, 50));
      now--;
      return { width: 16, height: 16, data: new Uint8Array(4 * 256) };
    };
    await load(document(Array.from({ length: 20 }, () => huge)), { decodeImage: counted });
    expect(max).toBe(2);
    const small = images[0]!.file;
    await load(document(Array.from({ length: 40 }, () => small)), { decodeImage: counted });
    expect(max).toBe(16);
    expect(now).toBe(0);
  });

  it('closes bitmaps whose pixels were reduced, and keeps the others', async () => {
    const closed: number[] = [];
    let made = 0;
    const bitmaps: ImageDecoder = async () => {
      const index = made++;
      const bitmap = { width: 512, height: 512, close: () => closed.push(index) } as unknown as ImageBitmap;
      return { width: 512, height: 512, bitmap, data: new Uint8Array(4 * 512 * 512).fill(index) };
    };
    const scene = await load(document(images.slice(0, 3).map(({ file }) => file)), {
      decodeImage: bitmaps,
      imageBudgetMiB: 2,
    });
    expect(closed.length).toBe(scene.images.filter(({ width }) => width < 512).length);
    expect(closed.length).toBeGreaterThan(0);
    for (const { width, bitmap } of scene.images) expect(bitmap === undefined).toBe(width < 512);
  });

  it('images computed from others never read a bitmap that was closed', async () => {
    const used: string[] = [];
    let made = 0;
    const bitmaps: ImageDecoder = async () => {
      const index = made++;
      let closed = false;
      const bitmap = { width: 512, height: 512, close: () => (closed = true) } as unknown as ImageBitmap;
      // The second is late: meanwhile the third exceeds the budget, and the first is reduced.
      await new Promise((resolve) => setTimeout(resolve, index === 1 ? 100 : 0));
      return Object.defineProperty({ width: 512, height: 512, bitmap }, 'data', {
        get: () => {
          used.push(`${index} ${closed ? 'closed' : 'open'}`);
          if (closed) throw new Error('closed');
          return new Uint8Array(4 * 512 * 512).fill(100 + index);
        },
        configurable: true,
        enumerable: true,
      }) as unknown as DecodedImage;
    };
    const materials = [
      {
        pbrMetallicRoughness: { metallicRoughnessTexture: { index: 0 } },
        extensions: {
          KHR_materials_anisotropy: { anisotropyStrength: 0.5, anisotropyTexture: { index: 1 } },
        },
      },
      ...[2, 3].map((index) => ({ pbrMetallicRoughness: { baseColorTexture: { index } } })),
      {},
    ];
    const file = document(
      images.slice(0, 4).map(({ file }) => file),
      'baseColorTexture',
      'image/png',
      { materials, extensionsUsed: ['KHR_materials_anisotropy'] },
    );
    const scene = await load(file, { decodeImage: bitmaps, imageBudgetMiB: 1 });
    expect(used.filter((use) => use.endsWith('closed'))).toEqual([]);
    expect(scene.images.some(({ name }) => name === 'image 0 + image 1')).toBe(true);
  });

  it.each([NaN, -1, 0, 'much' as unknown as number])('%s is an error', async (imageBudgetMiB) => {
    await expect(load(document([]), { imageBudgetMiB })).rejects.toMatchObject({
      code: 'gltf/option',
      message: expect.stringContaining(`imageBudgetMiB is ${imageBudgetMiB}`) as string,
    });
  });

  const KTX2 = [0xab, 0x4b, 0x54, 0x58, 0x20, 0x32, 0x30, 0xbb, 0x0d, 0x0a, 0x1a, 0x0a];
  const blocks =
    (levels: number): ((bytes: Uint8Array) => Promise<DecodedImage>) =>
    async () => ({
      width: 1024,
      height: 1024,
      compressed: {
        format: 'bc7-rgba-unorm' as CompressedFormat,
        levels: Array.from({ length: levels }, (_, i) => new Uint8Array(1 << (20 - 2 * i)).fill(i)),
      },
      get data(): Uint8Array<ArrayBuffer> {
        throw new Error('unpacked');
      },
    });
  const packed = () =>
    document(
      Array.from({ length: 3 }, () => Uint8Array.from({ length: 200 }, (_, i) => KTX2[i] ?? 0)),
      'baseColorTexture',
      'image/ktx2',
    );

  it('compressed images lose stored levels, and stay compressed', async () => {
    const scene = await load(packed(), { imageBudgetMiB: 3, decoders: { ktx2: blocks(4) } });
    const levels = scene.images.map(({ width, compressed }) => [width, compressed?.levels[0]?.[0]]);
    // Four thirds of a MiB each, rounded up: with one reduced they are two bytes above 3 MiB.
    expect(levels.filter(([width, level]) => width === 1024 && level === 0).length).toBe(1);
    expect(levels.filter(([width, level]) => width === 512 && level === 1).length).toBe(2);
  });

  it('compressed images without smaller levels cannot be reduced: an error with the numbers', async () => {
    await expect(load(packed(), { imageBudgetMiB: 2, decoders: { ktx2: blocks(1) } })).rejects.toMatchObject({
      code: 'gltf/too-large',
      message: expect.stringMatching(/3 images take 3\.0 MiB.*budget is 2\.0 MiB/) as string,
    });
  });

  it('an abort while images are reduced ends the load with its reason', async () => {
    const abort = new AbortController();
    const reason = new Error('enough');
    let reads = 0;
    const decoder: ImageDecoder = async () =>
      Object.defineProperty({ width: 2048, height: 2048 }, 'data', {
        get: () => {
          reads++;
          abort.abort(reason);
          return new Uint8Array(4 * 2048 * 2048);
        },
        configurable: true,
      }) as unknown as DecodedImage;
    const loading = load(document(images.slice(0, 3).map(({ file }) => file)), {
      decodeImage: decoder,
      imageBudgetMiB: 1,
      signal: abort.signal,
    });
    await expect(loading).rejects.toBe(reason);
    expect(reads).toBe(1);
  });
});

describe.runIf(process.env['GLANZ_FULL'] !== undefined)('in full size', () => {
  it('60 images of 8192² load in 3 GiB', async () => {
    const tile = await noise(512, 3);
    const jpeg = await sharp(tile.data, { raw: { width: 512, height: 512, channels: 4 } })
      .resize(8192, 8192, { kernel: 'nearest' })
      .jpeg({ quality: 60 })
      .toBuffer();
    const file = document(
      Array.from({ length: 60 }, () => new Uint8Array(jpeg)),
      'baseColorTexture',
      'image/jpeg',
    );
    const before = process.memoryUsage().rss;
    let peak = 0;
    const timer = setInterval(() => (peak = Math.max(peak, process.memoryUsage().rss)), 20);
    const scene = await load(file, { imageBudgetMiB: 1024 });
    clearInterval(timer);
    const gib = (peak - before) / 2 ** 30;
    expect(scene.images.length).toBe(60);
    const bytes = scene.images.reduce((sum, { data }) => sum + data.length, 0);
    expect(bytes).toBeLessThanOrEqual(1024 * MIB);
    expect(bytes).toBeGreaterThan(900 * MIB);
    // The budget; two images of 256 MiB that are decoded, each also in the decoder; what is not collected yet.
    expect(gib).toBeLessThan(3);
  }, 1_200_000);
});
