import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import type { GlanzError } from '@glanz/wgsl';
import type { CompressedFormat, Image, Scene } from '@glanz/scene';
import sharp from 'sharp';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { PathTracer, type PathTracerOptions } from '../../src/index';
import { addQuad, camera, createScene } from '../scenes';

let device: GPUDevice;
beforeAll(async () => {
  device = await testDevice();
});
afterAll(() => expectNoGpuErrors());

const MIB = 2 ** 20;
const SIZE = 64;

/** Smooth colours with an edge here and there, different in each image. */
function pattern(size: number, seed: number): Image {
  const data = new Uint8Array(4 * size * size);
  for (let y = 0; y < size; y++)
    for (let x = 0; x < size; x++) {
      const [u, v] = [x / size, y / size];
      const wave = (f: number, phase: number) => 0.5 + 0.5 * Math.sin(2 * Math.PI * (f * u + phase) + 4 * v);
      const shade = (u + v + 0.1 * seed) % 0.5 < 0.25 ? 1 : 0.4;
      data.set(
        [wave(1, 0.1 * seed), wave(2, 0.3), wave(1, 0.7 * seed)].map((c) => Math.round(255 * c * shade)).concat(255),
        4 * (y * size + x),
      );
    }
  return { name: `pattern ${seed}`, width: size, height: size, data };
}

/** A wall of tiles, lit from everywhere: each shows an image of its own. */
function wall(images: readonly Image[], columns = Math.ceil(Math.sqrt(images.length))): Scene {
  const scene = createScene();
  const width = 2 / columns;
  images.forEach((image, i) => {
    scene.images.push(image);
    scene.textures.push({ image: i, color_space: 'srgb' });
    const [x, y] = [-1 + width * ((i % columns) + 0.5), 1 - width * (Math.floor(i / columns) + 0.5)];
    addQuad(
      scene,
      width / 2,
      0,
      {
        name: `tile ${i}`,
        parameters: { base_color: [1, 1, 1], specular_weight: 0 },
        textures: { base_color: { texture: i, channels: 'rgb' } },
      },
      { transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, y, 0, 1] },
    );
  });
  scene.environment = { type: 'constant', radiance: [1, 1, 1] };
  return scene;
}

async function rendered(scene: Scene, more: Partial<PathTracerOptions> = {}, on: GPUDevice = device) {
  const warnings: GlanzError[] = [];
  const tracer = await PathTracer.create(on, scene, {
    width: SIZE,
    height: SIZE,
    camera,
    maxDepth: 2,
    pathsInFlight: 1 << 12,
    onWarning: (warning) => warnings.push(warning),
    ...more,
  });
  for await (const progress of tracer.render({ samples: 16 })) void progress;
  const pixels = await tracer.read('beauty');
  const { memory } = tracer.statistics;
  tracer.destroy();
  return { pixels, memory, warnings };
}

/** Mean of the absolute difference of all numbers. */
const difference = (a: Float32Array, b: Float32Array) =>
  a.reduce((sum, x, i) => sum + Math.abs(x - b[i]!), 0) / a.length;

/** A device of which members are replaced. */
const altered = (members: Record<string, unknown>) =>
  new Proxy(device, {
    get(target, name) {
      if (Object.hasOwn(members, name)) return members[name as string];
      const value = Reflect.get(target, name) as unknown;
      return typeof value === 'function' ? (value as () => unknown).bind(target) : value;
    },
  });
const withLimits = (limits: Record<string, number>) =>
  altered({
    limits: new Proxy(device.limits, { get: (all, name) => limits[name as string] ?? Reflect.get(all, name) }),
  });

describe('a budget for textures', () => {
  it('60 textures of 256² in 4 MiB: each is shown, and what was dropped is reported once', async () => {
    const scene = wall(Array.from({ length: 60 }, (_, i) => pattern(256, i)));
    const before = [...scene.images];
    const full = await rendered(scene);
    expect(full.warnings).toEqual([]);
    expect([full.memory.fullTextures, full.memory.reducedTextures]).toEqual([full.memory.textures, []]);
    expect(full.memory.textures).toBe((60 * 256 * 256 * 4 * 4) / 3);
    const { pixels, memory, warnings } = await rendered(scene, { memory: { budgetMiB: 4 } });
    expect(scene.images).toEqual(before);
    expect(memory.textures).toBeLessThanOrEqual(4 * MIB);
    expect(memory.fullTextures).toBe(full.memory.textures);
    // What is left would not hold one more level of the smallest image that was reduced.
    const sizes = memory.reducedTextures.map(({ level }) => 256 >> level);
    expect(4 * MIB - memory.textures).toBeLessThan(Math.min(...sizes) ** 2 * 4 * 4);
    const kept = 60 - sizes.length;
    const sum = sizes.reduce((bytes, size) => bytes + (size * size * 4 * 4) / 3, (kept * 256 * 256 * 4 * 4) / 3);
    expect(Math.abs(memory.textures - sum)).toBeLessThan(100);
    for (const { image, name, width, height } of memory.reducedTextures)
      expect([name, width, height]).toEqual([`pattern ${image}`, 256, 256]);
    expect(warnings.map(({ code }) => code)).toEqual(['renderer/textures-reduced']);
    expect(warnings[0]!.message).toContain(`${sizes.length} textures`);
    // A tile is 8 pixels wide: 64 texels of it are more than the image can show.
    expect(Math.max(...memory.reducedTextures.map(({ level }) => level))).toBe(2);
    expect(difference(pixels, full.pixels)).toBeLessThan(0.01);
  }, 120_000);

  it('large enough: the image without a budget, bit for bit', async () => {
    const scene = wall([pattern(256, 1), pattern(128, 2)]);
    const free = await rendered(scene);
    const within = await rendered(scene, { memory: { budgetMiB: 1 } });
    expect(within.memory.reducedTextures).toEqual([]);
    expect(within.warnings).toEqual([]);
    expect(within.pixels).toEqual(free.pixels);
  });

  it('half of the levels: the image of textures that sharp has halved', async () => {
    const images = Array.from({ length: 4 }, (_, i) => pattern(256, i));
    const halved = await Promise.all(
      images.map(async ({ name, data }): Promise<Image> => {
        const { data: pixels } = await sharp(data, { raw: { width: 256, height: 256, channels: 4 } })
          .gamma(2.2)
          .resize(64, 64, { kernel: 'linear' })
          .raw()
          .toBuffer({ resolveWithObject: true });
        return { name, width: 64, height: 64, data: new Uint8Array(pixels) };
      }),
    );
    const far = await rendered(wall(images), {}, withLimits({ maxTextureDimension2D: 64 }));
    expect(far.memory.reducedTextures.map(({ level }) => level)).toEqual([2, 2, 2, 2]);
    const theirs = await rendered(wall(halved));
    const plain = await rendered(wall(images));
    // Both blur edges alike: sharp's tent is wider than the box, by half a texel of 64.
    expect(difference(far.pixels, theirs.pixels)).toBeLessThan(0.012);
    expect(difference(far.pixels, plain.pixels)).toBeLessThan(0.02);
    // Another image is not alike.
    expect(difference(far.pixels, (await rendered(wall([...halved].reverse()))).pixels)).toBeGreaterThan(0.1);
  }, 120_000);

  it('what the image does not show is dropped before what it shows, however large', async () => {
    const scene = wall([pattern(512, 0)]);
    for (let i = 1; i <= 4; i++) {
      scene.images.push(pattern(256, i));
      scene.textures.push({ image: i, color_space: 'srgb' });
      scene.materials.push({
        name: 'unseen',
        parameters: {},
        textures: { base_color: { texture: i, channels: 'rgb' } },
      });
    }
    // The finest level is asked for, whatever the distance.
    const { memory } = await rendered(scene, { memory: { budgetMiB: 2 }, textureLodBias: -32 });
    expect(memory.reducedTextures.map(({ image, level }) => [image, level])).toEqual([
      [1, 1],
      [2, 1],
      [3, 1],
    ]);
  });

  it('images that both colour spaces use stay right in each', async () => {
    const scene = wall([pattern(512, 1)]);
    scene.textures.push({ image: 0, color_space: 'linear' });
    const [material] = scene.materials;
    scene.materials[0] = {
      ...material!,
      parameters: { base_color: [1, 1, 1], specular_weight: 0, base_weight: 1 },
      textures: { ...material!.textures, base_weight: { texture: 1, channels: 'g' } },
    };
    const full = await rendered(scene);
    const reduced = await rendered(scene, { memory: { budgetMiB: 1 } });
    expect(reduced.memory.textures).toBeLessThanOrEqual(MIB);
    expect(reduced.memory.reducedTextures.map(({ image }) => image)).toEqual([0, 0]);
    expect(difference(reduced.pixels, full.pixels)).toBeLessThan(0.01);
  });
});

describe('what a device cannot hold', () => {
  it('images beyond its largest texture lose levels, down to what it takes', async () => {
    const scene = wall([pattern(256, 1), pattern(64, 2)]);
    const { memory, warnings, pixels } = await rendered(scene, {}, withLimits({ maxTextureDimension2D: 64 }));
    expect(memory.reducedTextures.map(({ image, level }) => [image, level])).toEqual([[0, 2]]);
    expect(warnings.length).toBe(1);
    expect(difference(pixels, (await rendered(scene)).pixels)).toBeLessThan(0.02);
  });

  /** A device that has no memory for textures of more than so many texels. */
  function poor(texels: number) {
    const made: number[] = [];
    const scopes: { readonly filter: string; failed: boolean }[] = [];
    const proxy = altered({
      pushErrorScope: (filter: GPUErrorFilter) => {
        scopes.push({ filter, failed: false });
        device.pushErrorScope(filter);
      },
      popErrorScope: async () => {
        const scope = scopes.pop()!;
        const error = await device.popErrorScope();
        return scope.failed ? { message: 'test' } : error;
      },
      createTexture: (of: GPUTextureDescriptor) => {
        const [width = 1, height = 1, layers = 1] = of.size as number[];
        if (/scene texture/.test(of.label ?? '')) {
          made.push(width * height * layers);
          if (width * height * layers > texels)
            scopes.findLast(({ filter }) => filter === 'out-of-memory')!.failed = true;
        }
        return device.createTexture(of);
      },
    });
    return { proxy, made };
  }

  it('out of memory: halves the textures until there is enough', async () => {
    const scene = wall(Array.from({ length: 16 }, (_, i) => pattern(256, i)));
    const { proxy, made } = poor(300_000);
    const { memory, warnings, pixels } = await rendered(scene, {}, proxy);
    expect(made.length).toBeGreaterThan(2);
    expect(memory.textures).toBeLessThan(16 * 256 * 256 * 2);
    expect(memory.fullTextures).toBe(Math.ceil((16 * 256 * 256 * 4 * 4) / 3));
    expect(warnings.map(({ code }) => code)).toEqual(['renderer/textures-reduced']);
    expect(difference(pixels, (await rendered(scene)).pixels)).toBeLessThan(0.01);
  }, 120_000);

  it('rejects where smaller textures do not help', async () => {
    const scene = wall([pattern(64, 1)]);
    await expect(rendered(scene, {}, poor(0).proxy)).rejects.toMatchObject({ code: 'renderer/out-of-memory' });
  });

  it('a budget that cannot be met is an error before anything is allocated', async () => {
    let made = 0;
    const on = altered({
      adapterInfo: {
        ...device.adapterInfo,
        vendor: 'test',
        architecture: '',
        device: '',
        description: '',
        isFallbackAdapter: false,
      },
      features: new Set(['texture-compression-bc']),
      createTexture: () => made++,
      createBuffer: () => made++,
    });
    const blocks = (size: number, format: CompressedFormat): Image =>
      Object.defineProperty(
        { name: 'blocks', width: size, height: size, compressed: { format, levels: [new Uint8Array(size * size)] } },
        'data',
        {
          get: () => {
            throw new Error('unpacked');
          },
        },
      ) as unknown as Image;
    const scene = wall([blocks(2048, 'bc7-rgba-unorm')]);
    await expect(rendered(scene, { memory: { budgetMiB: 3 } }, on)).rejects.toMatchObject({
      code: 'scene/texture-budget',
      message: expect.stringMatching(/4\.0 MiB.*budget is 3\.0 MiB/) as string,
    });
    expect(made).toBe(0);
  });
});
