import { existsSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import type { Scene } from '@glanz/scene';
import { expect, test } from 'vitest';
import { nodeBackend } from '../src/backend';

const model = fileURLToPath(
  new URL('../../../../shared/assets/AnisotropyBarnLamp-KTX2-Basisu/AnisotropyBarnLamp.gltf', import.meta.url),
);
const note = existsSync(model) ? '' : ' (skipped: ../shared/assets is missing)';

test.skipIf(note !== '')(
  `a model with images in KTX2: packed where the device reads blocks, else unpacked, and the same image${note}`,
  { timeout: 300_000 },
  async () => {
    const backend = nodeBackend();
    const { device } = await backend.openGpu('software');
    const { signal } = new AbortController();
    // A software driver is not asked for blocks: what comes packed all the same is unpacked for it.
    expect(await backend.compressedFormats(device)).toEqual([]);
    const formats = ['bc7-rgba-unorm'] as const;
    let asked = 0;
    const packed = await backend.loadModel(model, signal, {}, async () => (asked++, formats));
    expect(asked).toBe(1);
    // One is made of two of the file's, and so is not in blocks.
    expect(
      packed.images.filter(({ compressed }) => compressed && formats.some((format) => format === compressed.format))
        .length,
    ).toBe(packed.images.length - 1);
    const plain = await backend.loadModel(model, signal);
    expect(plain.images.some((image) => image.compressed)).toBe(false);
    // Asked for, the pixels are there, and the same.
    expect(Buffer.compare(packed.images.at(-1)!.data as Uint8Array, plain.images.at(-1)!.data as Uint8Array)).toBe(0);
    const draw = async (scene: Scene) => {
      // Matt, with all of its images in use: this is about images, and other shaders take long.
      const materials = scene.materials.map(({ name, textures = {} }) => ({
        name,
        parameters: { specular_weight: 0 },
        textures: Object.fromEntries(
          Object.entries(textures).filter(
            ([parameter]) => parameter.startsWith('base_') || parameter === 'geometry_normal',
          ),
        ),
      }));
      const tracer = await backend.createTracer(
        device,
        { ...scene, materials, environment: { type: 'constant', radiance: [1, 1, 1] } },
        { width: 48, height: 48, maxDepth: 3, pathsInFlight: 1 << 12 },
      );
      for await (const _ of tracer.render({ samples: 16, maxSubmitMs: 500 }));
      const image = { pixels: await tracer.read('beauty'), textures: tracer.statistics.memory.textures };
      tracer.destroy();
      return image;
    };
    const [a, b] = [await draw(packed), await draw(plain)];
    device.destroy();
    expect(b.textures).toBe(a.textures);
    const mean = (pixels: Float32Array) => pixels.reduce((sum, value) => sum + value, 0) / pixels.length;
    expect(mean(b.pixels)).toBeGreaterThan(0.1);
    const difference = a.pixels.reduce((sum, value, i) => sum + Math.abs(value - b.pixels[i]!), 0) / a.pixels.length;
    expect(difference).toBeLessThan(0.01 * mean(b.pixels));
  },
);
