import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import type { Scene } from '@glanz/scene';
import { afterAll, beforeAll, expect, it } from 'vitest';
import { PathTracer } from '../../src/index';
import { addQuad, camera, createScene, lambert } from '../scenes';

let device: GPUDevice;
beforeAll(async () => {
  device = await testDevice({ defaultLimits: true });
});
afterAll(() => expectNoGpuErrors());

it('60 textures of mixed sizes, kinds and wrap modes, within the default limits', async () => {
  expect([device.limits.maxStorageBuffersPerShaderStage, device.limits.maxSampledTexturesPerShaderStage]).toEqual([
    8, 16,
  ]);
  const scene = createScene();
  const colors: (readonly number[])[] = [];
  const wraps = ['repeat', 'mirror', 'clamp'] as const;
  for (let i = 0; i < 60; i++) {
    const [width, height] = [3 + ((i * 5) % 29), 2 + ((i * 11) % 23)];
    const codes = [(37 * i) % 256, (91 * i + 13) % 256, (151 * i + 71) % 256];
    const float = i % 7 === 0;
    const linear = float || i % 3 === 0;
    const texel = [...codes.map((c) => (float ? c / 256 : c)), float ? 1 : 255];
    const data = Array.from({ length: width * height }, () => texel).flat();
    scene.images.push({ name: `${i}`, width, height, data: float ? new Float32Array(data) : new Uint8Array(data) });
    scene.textures.push({
      image: i,
      color_space: linear ? 'linear' : 'srgb',
      wrap_u: wraps[i % 3]!,
      wrap_v: wraps[(i >> 2) % 3]!,
    });
    colors.push(
      codes.map((c) =>
        float ? c / 256 : linear ? c / 255 : c / 255 <= 0.04045 ? c / 255 / 12.92 : ((c / 255 + 0.055) / 1.055) ** 2.4,
      ),
    );
    const [x, y] = [(i % 8) * 0.25 - 0.875, 0.875 - Math.floor(i / 8) * 0.25];
    addQuad(
      scene,
      0.12,
      0,
      {
        name: `tile ${i}`,
        parameters: { base_color: [1, 1, 1], specular_weight: 0 },
        textures: { base_color: { texture: i, channels: 'rgb' } },
      },
      { transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, y, 0, 1] },
    );
  }
  scene.environment = { type: 'constant', radiance: [1, 1, 1] };
  const size = 64;
  const tracer = await PathTracer.create(device, scene, {
    width: size,
    height: size,
    camera,
    maxDepth: 2,
    pathsInFlight: 1 << 12,
  });
  for await (const progress of tracer.render({ samples: 4 })) void progress;
  const pixels = await tracer.read('beauty');
  expect(tracer.statistics.badSamples).toBe(0);
  tracer.destroy();
  colors.forEach((color, i) => {
    const at = 4 * (Math.floor(8 * (Math.floor(i / 8) + 0.5)) * size + Math.floor(8 * ((i % 8) + 0.5)));
    // Half floats hold 11 bits, the curve of sRGB in hardware is good to half a code.
    color.forEach((c, k) => expect(Math.abs(pixels[at + k]! - c)).toBeLessThan(0.002 + 0.002 * c));
  });
}, 300_000);

it('all ways to wrap and to filter in one scene, within the default limits', async () => {
  const scene = createScene();
  const side = 4;
  const code = (x: number, y: number, k: number) => (53 * x + 97 * y + 31 * k * (x + 1)) % 256;
  const data = new Uint8Array(4 * side * side);
  for (let y = 0; y < side; y++)
    for (let x = 0; x < side; x++) data.set([0, 1, 2].map((k) => code(x, y, k)).concat(255), 4 * (y * side + x));
  scene.images.push({ name: 'texels', width: side, height: side, data });
  const wraps = {
    repeat: (i: number) => i - side * Math.floor(i / side),
    mirror: (i: number) => {
      const j = i - 2 * side * Math.floor(i / (2 * side));
      return j < side ? j : 2 * side - 1 - j;
    },
    clamp: (i: number) => Math.min(Math.max(i, 0), side - 1),
  };
  const names = ['repeat', 'mirror', 'clamp'] as const;
  /** Texels that a coordinate reads, with their weights. */
  const read = (at: number, wrap: (typeof names)[number], filter: 'nearest' | 'linear') => {
    if (filter === 'nearest') return [[wraps[wrap](Math.floor(at * side)), 1]] as const;
    const x = at * side - 0.5;
    const f = x - Math.floor(x);
    return [
      [wraps[wrap](Math.floor(x)), 1 - f],
      [wraps[wrap](Math.floor(x) + 1), f],
    ] as const;
  };
  const expected: number[][] = [];
  for (const [u, v] of [
    [1.3, -0.55],
    [-0.8, 2.35],
    [0.62, 1.9],
  ] as const)
    for (const filter of ['nearest', 'linear'] as const)
      for (const wrap_u of names)
        for (const wrap_v of names) {
          const i = expected.length;
          const texture = scene.textures.push({ image: 0, color_space: 'linear', filter, wrap_u, wrap_v }) - 1;
          const [x, y] = [(i % 8) * 0.25 - 0.875, 0.875 - Math.floor(i / 8) * 0.25];
          addQuad(
            scene,
            0.12,
            0,
            {
              name: `tile ${i}`,
              parameters: { base_color: [1, 1, 1], specular_weight: 0 },
              textures: { base_color: { texture, channels: 'rgb' } },
            },
            { transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, y, 0, 1] },
          );
          // One place of the image all over the tile.
          scene.meshes[i] = { ...scene.meshes[i]!, uvs: [new Float32Array([u, v, u, v, u, v, u, v])] };
          expected.push(
            [0, 1, 2].map((k) => {
              let sum = 0;
              for (const [tx, a] of read(u, wrap_u, filter))
                for (const [ty, b] of read(v, wrap_v, filter)) sum += (a * b * code(tx, ty, k)) / 255;
              return sum;
            }),
          );
        }
  scene.environment = { type: 'constant', radiance: [1, 1, 1] };
  const size = 64;
  const tracer = await PathTracer.create(device, scene, { width: size, height: size, camera, maxDepth: 2 });
  for await (const progress of tracer.render({ samples: 4 })) void progress;
  const pixels = await tracer.read('beauty');
  tracer.destroy();
  expected.forEach((color, i) => {
    const at = 4 * (Math.floor(8 * (Math.floor(i / 8) + 0.5)) * size + Math.floor(8 * ((i % 8) + 0.5)));
    // Filters of GPUs have weights of 8 bits.
    color.forEach((c, k) => expect(Math.abs(pixels[at + k]! - c), `tile ${i}`).toBeLessThan(0.006));
  });
});

/** A floor of tiles, each with a texture of a size of its own and of one colour, and a ceiling that light comes from. */
function tiles(count: number): Scene {
  const scene = createScene();
  for (let i = 0; i < count; i++) {
    const [width, height] = [4 + i, 3 + ((i * 7) % 11)];
    const data = Array.from({ length: width * height }, () => [60 + 9 * i, 240 - 8 * i, 100 + 5 * i, 255]).flat();
    scene.images.push({ name: `${i}`, width, height, data: new Uint8Array(data) });
    // The nearest texel: sizes that share an array are resampled, which leaves one colour as it is.
    scene.textures.push({ image: i, color_space: 'linear', filter: 'nearest' });
    const [x, y] = [(i % 5) * 0.4 - 0.8, 0.75 - Math.floor(i / 5) * 0.5];
    const material = {
      name: `tile ${i}`,
      parameters: { base_color: [1, 1, 1], specular_weight: 0 },
      textures: { base_color: { texture: i, channels: 'rgb' } },
    } as const;
    addQuad(scene, 0.19, 0, material, { transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, y, 0, 1] });
  }
  // Beside what the camera sees, 1 m above the floor, illuminated from below: all light of the floor is indirect.
  addQuad(scene, 0.5, 0, lambert(0.9), { transform: [1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 0, 1.25, 0, 1, 1] });
  scene.lights.push({
    type: 'spot',
    name: 'spot',
    color: [1, 1, 1],
    intensity: 10,
    position: [1.25, 0, 0.3],
    direction: [0, 0, 1],
    inner_cone_angle: 0.5,
    outer_cone_angle: 0.6,
  });
  return scene;
}

it('a guide beside as many texture arrays as the default limits leave: the image of a device with more', async () => {
  const all = await testDevice();
  const count = 20;
  expect(all.limits.maxSampledTexturesPerShaderStage).toBeGreaterThan(count + 5);
  const film = async (on: GPUDevice, guiding: number) => {
    const size = 16;
    const options = { width: size, height: size, camera, maxDepth: 4, pathsInFlight: 1 << 10, guiding };
    const tracer = await PathTracer.create(on, tiles(count), options);
    for await (const progress of tracer.render({ samples: 16 })) void progress;
    const pixels = await tracer.read('beauty');
    tracer.destroy();
    return pixels;
  };
  const guided = await film(device, 0.01);
  expect(guided).toEqual(await film(all, 0.01));
  // The guide has something to do, and tiles of all colours reflect light.
  const lit = Array.from({ length: guided.length / 4 }, (_, i) => guided[4 * i + 1]! > 0);
  expect(lit.filter(Boolean).length).toBeGreaterThan(100);
  expect(guided).not.toEqual(await film(device, 0));
});
