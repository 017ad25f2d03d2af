import { compressedBytes, createScene } from '@glanz/scene';
import { describe, expect, it } from 'vitest';
import { planTextures, resizePixels } from '../../src/materials/textures';
import { toHalf } from '../../src/materials/texture-upload';

const limits = { maxTextureDimension2D: 8192, maxTextureArrayLayers: 256 };

function sceneWith(sizes: readonly (readonly [number, number, 'srgb' | 'linear'])[]) {
  const scene = createScene();
  sizes.forEach(([width, height, color_space], index) => {
    scene.images.push({ name: `${index}`, width, height, data: new Uint8Array(width * height * 4) });
    scene.textures.push({ image: index, color_space });
  });
  return scene;
}

describe('planTextures', () => {
  it('puts images of one size and colour space into one array', () => {
    const plan = planTextures(
      sceneWith([
        [8, 8, 'srgb'],
        [8, 8, 'srgb'],
        [8, 8, 'linear'],
        [4, 8, 'srgb'],
      ]),
      [0, 1, 2, 3],
      12,
      limits,
    );
    expect(plan.arrays.map((a) => [a.width, a.height, a.format, a.layers])).toEqual([
      [8, 8, 'rgba8unorm-srgb', [0, 1]],
      [8, 8, 'rgba8unorm', [2]],
      [4, 8, 'rgba8unorm-srgb', [3]],
    ]);
    expect(plan.placements.get(1)).toMatchObject({ layer: 1, width: 8, height: 8 });
  });

  it('merges sizes when there are more than slots, never shrinking an image', () => {
    const sizes = Array.from({ length: 30 }, (_, i) => [8 + i, 8 + ((i * 7) % 13), i % 2 ? 'srgb' : 'linear'] as const);
    const scene = sceneWith(sizes);
    const plan = planTextures(scene, sizes.keys(), 5, limits);
    expect(plan.arrays.length).toBeLessThanOrEqual(5);
    sizes.forEach(([width, height, space], index) => {
      const placed = plan.placements.get(index);
      const [array] = plan.samplings[placed?.sampling ?? -1] ?? [-1];
      const target = plan.arrays[array];
      expect(target?.layers[placed?.layer ?? -1]).toBe(index);
      expect(target?.width).toBeGreaterThanOrEqual(width);
      expect(target?.height).toBeGreaterThanOrEqual(height);
      expect(target?.format).toBe(space === 'srgb' ? 'rgba8unorm-srgb' : 'rgba8unorm');
    });
  });

  it('leaves images in blocks where the device reads them, all or none', () => {
    const scene = sceneWith([
      [8, 8, 'srgb'],
      [8, 8, 'linear'],
      [8, 4, 'srgb'],
      [6, 8, 'linear'],
      [16, 4, 'srgb'],
    ]);
    for (const index of [0, 1, 3]) {
      const { width, height } = scene.images[index]!;
      scene.images[index]!.compressed = {
        format: 'bc7-rgba-unorm',
        levels: [new Uint8Array(compressedBytes(width, height))],
      };
    }
    const formats = (...given: Parameters<typeof planTextures>) =>
      planTextures(...given).arrays.map(({ format, levels }) => [format, levels]);
    // 6 texels are no whole blocks.
    const packed = [
      ['bc7-rgba-unorm-srgb', 1],
      ['bc7-rgba-unorm', 1],
      ['rgba8unorm-srgb', undefined],
      ['rgba8unorm', undefined],
      ['rgba8unorm-srgb', undefined],
    ];
    const unpacked = ['rgba8unorm-srgb', 'rgba8unorm', 'rgba8unorm-srgb', 'rgba8unorm', 'rgba8unorm-srgb'].map(
      (format) => [format, undefined],
    );
    expect(formats(scene, [0, 1, 2, 3, 4], 12, limits, ['astc-4x4-unorm', 'bc7-rgba-unorm'])).toEqual(packed);
    expect(formats(scene, [0, 1, 2, 3, 4], 12, limits, ['astc-4x4-unorm'])).toEqual(unpacked);
    expect(
      formats(scene, [0, 1, 2, 3, 4], 3, limits, ['bc7-rgba-unorm']).every(([, levels]) => levels === undefined),
    ).toBe(true);
    expect(formats(scene, [0], 12, { ...limits, maxTextureDimension2D: 4 }, ['bc7-rgba-unorm'])).toEqual([
      ['rgba8unorm-srgb', undefined],
    ]);
  });

  it('keeps images within the device limits', () => {
    const plan = planTextures(sceneWith([[64, 16, 'srgb']]), [0], 12, { ...limits, maxTextureDimension2D: 32 });
    expect(plan.arrays[0]).toMatchObject({ width: 32, height: 8 });
  });
});

describe('resizePixels', () => {
  it('keeps a constant image constant and a ramp linear', () => {
    expect([...new Set(resizePixels(new Uint8Array(4 * 4 * 4).fill(77), 4, 4, 7, 3))]).toEqual([77]);
    const ramp = Float32Array.from({ length: 8 * 4 }, (_, i) => Math.floor(i / 4));
    const doubled = resizePixels(ramp, 8, 1, 16, 1);
    for (let x = 1; x < 15; x++) expect(doubled[4 * x]).toBeCloseTo((x + 0.5) / 2 - 0.5, 5);
  });
});

describe('toHalf', () => {
  const fromHalf = (h: number) => {
    const sign = h & 0x8000 ? -1 : 1;
    const exponent = (h >> 10) & 31;
    const mantissa = h & 1023;
    return sign * (exponent === 0 ? mantissa * 2 ** -24 : (1 + mantissa / 1024) * 2 ** (exponent - 15));
  };
  it('is exact for every finite half and rounds to the nearest', () => {
    for (let h = 0; h < 0x7c00; h++) expect(toHalf(fromHalf(h))).toBe(h);
    for (const x of [0.1, 1 / 3, 1e-5, 3e-7, 1234.5, 2049, 65519]) {
      const h = toHalf(x);
      const error = Math.abs(fromHalf(h) - x);
      for (const other of [h - 1, h + 1])
        if (other < 0x7c00) expect(error).toBeLessThanOrEqual(Math.abs(fromHalf(other) - x));
    }
    expect(fromHalf(toHalf(1e9))).toBe(65504);
    expect(toHalf(-2)).toBe(0xc000);
    expect(toHalf(Number.NaN)).toBe(0);
  });
});
