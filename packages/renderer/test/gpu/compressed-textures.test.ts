import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import { compressedBytes, type Scene } from '@glanz/scene';
import { afterAll, beforeAll, expect, it } from 'vitest';
import { compressedFormats, isSoftware, PathTracer } from '../../src/index';
import { addQuad, camera, createScene } from '../scenes';

let device: GPUDevice;
beforeAll(async () => {
  device = await testDevice({ features: ['texture-compression-bc'] });
  // Software drivers are not asked for blocks; here they are, where they can.
  const { adapterInfo } = device;
  if (isSoftware(adapterInfo) && (await readsBlocks()))
    Object.defineProperty(device, 'adapterInfo', {
      value: {
        ...adapterInfo,
        vendor: 'test',
        architecture: '',
        device: '',
        description: '',
        isFallbackAdapter: false,
      },
    });
});
afterAll(() => expectNoGpuErrors());

/**
 * A block of BC7 by the format's own description (Khronos data format specification 1.3, section 20, mode 6): seven
 * bits of mode, four channels of two 7-bit endpoints, a shared lowest bit for each endpoint, an index of 4 bits for
 * each texel (3 for the first).
 */
function block(
  low: readonly number[],
  high: readonly number[],
  index: (texel: number) => number,
): Uint8Array<ArrayBuffer> {
  const bytes = new Uint8Array(16);
  let at = 0;
  const put = (value: number, bits: number) => {
    for (let i = 0; i < bits; i++, at++) bytes[at >> 3]! |= ((value >> i) & 1) << (at & 7);
  };
  put(64, 7);
  for (let c = 0; c < 4; c++) {
    put(low[c]! >> 1, 7);
    put(high[c]! >> 1, 7);
  }
  put(low[0]! & 1, 1);
  put(high[0]! & 1, 1);
  for (let texel = 0; texel < 16; texel++) put(index(texel), texel === 0 ? 3 : 4);
  expect(at).toBe(128);
  return bytes;
}

/** Whether the driver unpacks a block at all: SwiftShader reads zeros on some processors. */
async function readsBlocks(): Promise<boolean> {
  if (!device.features.has('texture-compression-bc')) return false;
  const texture = device.createTexture({
    size: [4, 4],
    format: 'bc7-rgba-unorm',
    usage: GPUTextureUsage.TEXTURE_BINDING | GPUTextureUsage.COPY_DST,
  });
  device.queue.writeTexture(
    { texture },
    block([201, 201, 201, 255], [201, 201, 201, 255], () => 0),
    { bytesPerRow: 16 },
    [4, 4],
  );
  const module = device.createShaderModule({
    code: '@group(0) @binding(0) var blocks: texture_2d<f32>; @group(0) @binding(1) var<storage, read_write> texel: vec4f; @compute @workgroup_size(1) fn main() { texel = textureLoad(blocks, vec2u(1u), 0); }',
  });
  const pipeline = await device.createComputePipelineAsync({ layout: 'auto', compute: { module, entryPoint: 'main' } });
  const texel = device.createBuffer({ size: 16, usage: GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_SRC }),
    read = device.createBuffer({ size: 16, usage: GPUBufferUsage.MAP_READ | GPUBufferUsage.COPY_DST });
  const encoder = device.createCommandEncoder();
  const pass = encoder.beginComputePass();
  pass.setPipeline(pipeline);
  pass.setBindGroup(
    0,
    device.createBindGroup({
      layout: pipeline.getBindGroupLayout(0),
      entries: [texture.createView(), { buffer: texel }].map((resource, binding) => ({ binding, resource })),
    }),
  );
  pass.dispatchWorkgroups(1);
  pass.end();
  encoder.copyBufferToBuffer(texel, 0, read, 0, 16);
  device.queue.submit([encoder.finish()]);
  await read.mapAsync(GPUMapMode.READ);
  const [red] = new Float32Array(read.getMappedRange());
  for (const each of [texture, texel, read]) each.destroy();
  return Math.abs(red! - 201 / 255) < 0.01;
}

const WEIGHTS = [0, 4, 9, 13, 17, 21, 26, 30, 34, 38, 43, 47, 51, 55, 60, 64];
const toLinear = (code: number) => (code / 255 <= 0.04045 ? code / 255 / 12.92 : ((code / 255 + 0.055) / 1.055) ** 2.4);

/** The mean of each quarter of a quad that an image covers, in light of radiance 1. */
async function seen(scene: Scene): Promise<number[][]> {
  scene.environment = { type: 'constant', radiance: [1, 1, 1] };
  addQuad(scene, 1, 0, {
    name: 'image',
    parameters: { base_color: [1, 1, 1], specular_weight: 0 },
    textures: { base_color: { texture: 0, channels: 'rgb' } },
  });
  const size = 32;
  const tracer = await PathTracer.create(device, scene, {
    width: size,
    height: size,
    camera,
    maxDepth: 2,
    pathsInFlight: 1 << 12,
  });
  for await (const _ of tracer.render({ samples: 64 }));
  const pixels = await tracer.read('beauty');
  expect(tracer.statistics.badSamples).toBe(0);
  tracer.destroy();
  // Away from the edges between the quarters and the mirror at the border, where texels mix.
  return [
    [10, 10],
    [21, 10],
    [10, 21],
    [21, 21],
  ].map(([x, y]) => [0, 1, 2].map((c) => pixels[4 * (size * y! + x!) + c]!));
}

it('BC7, sRGB and linear: its codes are those of the description of the format', async ({ skip }) => {
  skip(!compressedFormats(device).includes('bc7-rgba-unorm'), 'the driver reads no BC7, or reads zeros from it');
  for (const color_space of ['srgb', 'linear'] as const) {
    const scene = createScene();
    // Four quarters of 8 × 8 texels, each of one colour between the two ends.
    const [low, high] = [
      [20, 200, 90, 254],
      [240, 30, 160, 254],
    ];
    const indices = [0, 3, 5, 7];
    const level = new Uint8Array(compressedBytes(16, 16));
    for (let y = 0; y < 4; y++)
      for (let x = 0; x < 4; x++)
        level.set(
          block(low, high, () => indices[2 * (y >> 1) + (x >> 1)]!),
          16 * (4 * y + x),
        );
    scene.images.push({
      name: 'blocks',
      width: 16,
      height: 16,
      compressed: { format: 'bc7-rgba-unorm', levels: [level] },
      data: new Uint8Array(4 * 256).fill(255),
    });
    scene.textures.push({ image: 0, color_space, wrap_u: 'clamp', wrap_v: 'clamp', filter: 'nearest' });
    const quarters = await seen(scene);
    quarters.forEach((color, quarter) => {
      const codes = low.map(
        (a, c) => (a * (64 - WEIGHTS[indices[quarter]!]!) + high[c]! * WEIGHTS[indices[quarter]!]! + 32) >> 6,
      );
      color.forEach((value, c) =>
        expect(
          Math.abs(value - (color_space === 'srgb' ? toLinear(codes[c]!) : codes[c]! / 255)),
          `${color_space} ${quarter} ${c}`,
        ).toBeLessThan(0.003),
      );
    });
  }
});

it('all levels are used: far away, the smallest one', async ({ skip }) => {
  skip(!compressedFormats(device).includes('bc7-rgba-unorm'), 'the driver reads no BC7, or reads zeros from it');
  const scene = createScene();
  const gray = (code: number) =>
    block(
      [code, code, code, 255].map((c) => c | 1),
      [code, code, code, 255].map((c) => c | 1),
      () => 0,
    );
  // 256 texels over a pixel's width and more: level 5 and above; each level has a colour of its own.
  const levels = Array.from({ length: 9 }, (_, level) => {
    const side = Math.max(1, 256 >> level),
      count = compressedBytes(side, side) / 16;
    const bytes = new Uint8Array(16 * count);
    for (let i = 0; i < count; i++) bytes.set(gray(25 * level + 25), 16 * i);
    return bytes;
  });
  scene.images.push({
    name: 'levels',
    width: 256,
    height: 256,
    compressed: { format: 'bc7-rgba-unorm', levels },
    data: new Uint8Array(4 * 65536).fill(255),
  });
  scene.textures.push({ image: 0, color_space: 'linear' });
  scene.environment = { type: 'constant', radiance: [1, 1, 1] };
  // Four hundred repeats over the quad: a pixel of 64 sees 6 of them.
  addQuad(scene, 1, 0, {
    name: 'image',
    parameters: { base_color: [1, 1, 1], specular_weight: 0 },
    textures: { base_color: { texture: 0, channels: 'rgb', transform: [400, 0, 0, 400, 0, 0] } },
  });
  const tracer = await PathTracer.create(device, scene, {
    width: 64,
    height: 64,
    camera,
    maxDepth: 2,
    pathsInFlight: 1 << 12,
  });
  for await (const _ of tracer.render({ samples: 8 }));
  const pixels = await tracer.read('beauty');
  const { textures } = tracer.statistics.memory;
  tracer.destroy();
  expect(Math.abs(pixels[4 * (64 * 32 + 32)]! - 225 / 255)).toBeLessThan(0.01);
  expect(textures).toBeLessThan(400_000);
});

it('asks no software driver for blocks', () => {
  const features = new Set(['texture-compression-bc']);
  const named = (description: string) =>
    compressedFormats({
      features,
      adapterInfo: {
        vendor: '',
        architecture: '',
        device: '',
        description,
        isFallbackAdapter: false,
      } as unknown as GPUAdapterInfo,
    });
  expect(named('NVIDIA H200')).toEqual(['bc7-rgba-unorm']);
  expect(named('SwiftShader driver 5.0.0')).toEqual([]);
  expect(compressedFormats({ features })).toEqual(['bc7-rgba-unorm']);
});
