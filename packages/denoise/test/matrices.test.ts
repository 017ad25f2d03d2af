import { expectNoGpuErrors, nullDevice, testDevice } from '@glanz/gpu';
import { compose } from '@glanz/wgsl/compose';
import { afterEach, describe, expect, it } from 'vitest';
import { concatenate, convolveChannel, pool, upsample, type Planes } from '../src/cpu/layers';
import { matricesFor } from '../src/layer-shapes';
import { chooseMatrices } from '../src/kernels/choose-matrices';
import { layerStruct } from '../src/kernels/layouts';
import { matrixConvolution } from '../src/kernels/matrix-convolution.wgsl';
import { matrixBytes, threadsOf, tileHeight, tileOutputs, tileWidth, type MatrixShape } from '../src/kernels/shapes';
import { readNetwork, type Layer } from '../src/network';
import { halfBits, packMatrices } from '../src/kernels/pack-matrices';
import { quadsOf } from '../src/pack-weights';
import { download } from './gpu';
import { Denoiser } from '../src/index';
import { numbersFrom, randomNetwork } from './random-network';

/** Of NVIDIA's GPUs. */
const large = (layer: Layer, lanes = 32) => chooseMatrices(layer, { m: 16, n: 16, k: 16 }, lanes);
/** What {@link emulated} computes with: a subgroup is one thread. */
const small = (layer: Layer) => chooseMatrices(layer, { m: 2, n: 4, k: 8 }, 1);

/** A layer of random weights, which are halves. */
function layerOf(upChannels: number, directChannels: number, channels: number, pooled = false): Layer {
  const random = numbersFrom(channels);
  const halves = (length: number) => Float32Array.from({ length }, () => Math.round((random() - 0.5) * 512) / 1024);
  return {
    name: 'layer',
    level: 0,
    up: upChannels > 0 ? 0 : undefined,
    direct: 1,
    upChannels,
    directChannels,
    channels,
    pool: pooled,
    weights: halves(channels * (upChannels + directChannels) * 9),
    bias: halves(channels),
  };
}

/** Random planes of halves between 0 and 1. */
function planesOf(channels: number, width: number, height: number): Planes {
  const random = numbersFrom(channels + width);
  const data = Float32Array.from({ length: channels * width * height }, () => Math.round(random() * 1024) / 1024);
  return { channels, width, height, data };
}

/** Planes as the kernels store them: `[row][channels / 4][column]`, four halves in two words. */
function texelsOf({ channels, width, height, data }: Planes): Uint32Array<ArrayBuffer> {
  const quads = quadsOf(channels);
  const halves = new Uint16Array(height * quads * width * 4);
  for (let c = 0; c < channels; c++)
    for (let y = 0; y < height; y++)
      for (let x = 0; x < width; x++)
        halves[((y * quads + (c >> 2)) * width + x) * 4 + (c & 3)] = halfBits(data[(c * height + y) * width + x]!);
  return new Uint32Array(halves.buffer);
}

/** The kernel with functions in place of subgroup matrices, each "subgroup" a thread. */
function emulated({ m, n, k }: MatrixShape['matrix'], code: string): string {
  const text = code
    .replace('enable chromium_experimental_subgroup_matrix;', '')
    .replace('diagnostic(off, chromium.subgroup_matrix_uniformity);', '')
    .replace(/alias DenoisePixels = .*;/, `alias DenoisePixels = array<f32, ${m * k}>;`)
    .replace(/alias DenoiseWeights = .*;/, `alias DenoiseWeights = array<f32, ${k * n}>;`)
    .replace(/alias DenoiseSums = .*;/, `alias DenoiseSums = array<f32, ${m * n}>;`)
    .replace(/subgroupMatrixLoad<DenoisePixels, row_major>\(&denoise_patch, /g, 'load_pixels(')
    .replace(
      /subgroupMatrixLoad<DenoiseWeights, col_major>\(&denoise_weights\[(.*)\]\.halves, 0u, /g,
      'load_weights($1, ',
    )
    .replace(/(\w+) = subgroupMatrixMultiplyAccumulate\((\w+), w, \1\);/g, 'add_products(&$1, $2, w);')
    .replace(/subgroupMatrixStore<row_major>\(&denoise_sums\[subgroup\]\.vectors, 0u, /g, 'store_sums(subgroup, ');
  expect(text).not.toMatch(/subgroup_?matrix/i);
  return `${text}
fn half_of(halves: vec4u, i: u32) -> f32 { return unpack2x16float(halves[i / 2u])[i % 2u]; }
fn load_pixels(at: u32, stride: u32) -> DenoisePixels {
  var p: DenoisePixels;
  for (var r = 0u; r < ${m}u; r++) { for (var c = 0u; c < ${k}u; c++) {
    p[r * ${k}u + c] = half_of(denoise_patch[at + r * stride + c / 8u], c % 8u);
  } }
  return p;
}
fn load_weights(block: u32, stride: u32) -> DenoiseWeights {
  var w: DenoiseWeights;
  for (var r = 0u; r < ${k}u; r++) { for (var c = 0u; c < ${n}u; c++) {
    w[r * ${n}u + c] = half_of(denoise_weights[block].halves[c * stride + r / 8u], r % 8u);
  } }
  return w;
}
fn add_products(sums: ptr<function, DenoiseSums>, pixels: DenoisePixels, weights: DenoiseWeights) {
  var p = pixels;
  var w = weights;
  for (var r = 0u; r < ${m}u; r++) { for (var c = 0u; c < ${n}u; c++) { for (var i = 0u; i < ${k}u; i++) {
    (*sums)[r * ${n}u + c] += p[r * ${k}u + i] * w[i * ${n}u + c];
  } } }
}
fn store_sums(subgroup: u32, sums: DenoiseSums, stride: u32) {
  var s = sums;
  for (var r = 0u; r < ${m}u; r++) { for (var c = 0u; c < ${n}u; c++) {
    denoise_sums[subgroup].vectors[r * stride + c / 4u][c % 4u] = s[r * ${n}u + c];
  } }
}`;
}

/**
 * Runs the emulated kernel on whole images, or as a strip from a row of workgroups on, with what of the tensors it needs;
 * gives the planes of the result, zeros above the strip.
 */
async function run(layer: Layer, direct: Planes, up: Planes | undefined, fromRow = 0): Promise<Planes> {
  const device = await testDevice();
  const shape = small(layer)!;
  const packed = packMatrices(layer, tileOutputs(shape), shape.matrix);
  const flags = { DENOISE_HALF: true, DENOISE_F16: false };
  const code = emulated(shape.matrix, compose([matrixConvolution({ shape, pool: layer.pool })], { flags }).code);
  const pipeline = await device.createComputePipelineAsync({
    layout: 'auto',
    compute: { module: device.createShaderModule({ code }), entryPoint: 'main' },
  });
  const half = layer.pool ? 2 : 1;
  const [width, height, quads] = [direct.width / half, direct.height / half, quadsOf(layer.channels)];
  // Texels before the rows that are bound.
  const first = fromRow * tileHeight(shape);
  const before = (planes: Planes, row: number) => Math.max(0, row) * quadsOf(planes.channels) * planes.width;
  const [directBase, upBase] = [before(direct, first - 1), up ? before(up, first / 2 - 1) : 0];
  const resultBase = (first / half) * quads * width;
  const uniform = layerStruct.allocate();
  layerStruct.write(uniform, 0, {
    size: [direct.width, direct.height],
    up_quads: up ? quadsOf(up.channels) : 0,
    direct_quads: quadsOf(direct.channels),
    up_base: upBase,
    direct_base: directBase,
    result_base: resultBase,
    result_quads: quads,
    output_quads: packed.outputQuads,
    up_weights: packed.upAt,
    direct_weights: packed.directAt,
  });
  const { STORAGE, UNIFORM, COPY_DST, COPY_SRC } = GPUBufferUsage;
  const filled = (data: ArrayBuffer, usage: number) => {
    const buffer = device.createBuffer({ size: Math.ceil(data.byteLength / 16) * 16, usage: usage | COPY_DST });
    device.queue.writeBuffer(buffer, 0, data);
    return buffer;
  };
  const weights = filled(packed.data.buffer, STORAGE);
  const result = device.createBuffer({ size: (width * height * quads - resultBase) * 8, usage: STORAGE | COPY_SRC });
  const resources: Record<number, GPUBuffer> = {
    0: filled(uniform, UNIFORM),
    1: filled(Uint32Array.of(fromRow, 0, 0, 0).buffer, UNIFORM),
    2: weights,
    3: filled(texelsOf(direct).slice(2 * directBase).buffer, STORAGE),
    ...(up ? { 4: filled(texelsOf(up).slice(2 * upBase).buffer, STORAGE) } : {}),
    5: result,
    6: weights,
  };
  const group = device.createBindGroup({
    layout: pipeline.getBindGroupLayout(0),
    entries: Object.entries(resources).map(([binding, buffer]) => ({ binding: Number(binding), resource: { buffer } })),
  });
  const encoder = device.createCommandEncoder();
  const pass = encoder.beginComputePass();
  pass.setPipeline(pipeline);
  pass.setBindGroup(0, group);
  pass.dispatchWorkgroups(
    Math.ceil(direct.width / tileWidth(shape)),
    Math.ceil(direct.height / tileHeight(shape)) - fromRow,
    Math.ceil(layer.channels / tileOutputs(shape)),
  );
  pass.end();
  device.queue.submit([encoder.finish()]);
  const words = new Uint32Array((await download(device, result)).buffer);
  for (const buffer of Object.values(resources)) buffer.destroy();
  const value = (bits: number) => {
    const exponent = (bits >> 10) & 31;
    return exponent === 0 ? bits * 2 ** -24 : (1 + (bits & 1023) / 1024) * 2 ** (exponent - 15);
  };
  const data = new Float32Array(layer.channels * width * height);
  for (let c = 0; c < layer.channels; c++)
    for (let y = first / half; y < height; y++)
      for (let x = 0; x < width; x++) {
        const word = words[((y * quads + (c >> 2)) * width + x - resultBase) * 2 + ((c & 3) >> 1)]!;
        data[(c * height + y) * width + x] = value((word >> (16 * (c & 1))) & 0xffff);
      }
  return { channels: layer.channels, width, height, data };
}

/** The same by the CPU twin's arithmetic. */
function expected(layer: Layer, direct: Planes, up: Planes | undefined): Planes {
  const input = up ? concatenate(upsample(up), direct) : direct;
  const { width, height } = input;
  const data = new Float32Array(layer.channels * width * height);
  for (let c = 0; c < layer.channels; c++)
    convolveChannel(layer, c, input, data.subarray(c * width * height, (c + 1) * width * height));
  const planes = { channels: layer.channels, width, height, data };
  return layer.pool ? pool(planes) : planes;
}

const FEATURES = ['shader-f16', 'chromium-experimental-subgroup-matrix'];

afterEach(() => expectNoGpuErrors());

describe('convolution by subgroup matrices', () => {
  it.each([
    ['of channels and pixels that do not fill matrices', layerOf(0, 9, 22), 11, 14, 0],
    ['pooled, as a strip', layerOf(0, 6, 12, true), 10, 20, 1],
    ['with an upsampled source, both in several blocks of channels, as a strip', layerOf(11, 17, 8), 18, 10, 1],
  ] as const)('%s equals the CPU', async (_, layer, width, height, fromRow) => {
    const direct = planesOf(layer.directChannels, width, height);
    const up = layer.up === undefined ? undefined : planesOf(layer.upChannels, width / 2, height / 2);
    const gpu = await run(layer, direct, up, fromRow);
    const cpu = expected(layer, direct, up);
    expect([gpu.channels, gpu.width, gpu.height]).toEqual([cpu.channels, cpu.width, cpu.height]);
    // Stored as halves, of sums whose order differs; sums of the upsampled source's weights are rounded to halves.
    const rounding = up ? 2 ** -10 * (1 + 0.25 * Math.sqrt(layer.upChannels * 4)) : 2 ** -11;
    const above = (fromRow * tileHeight(small(layer)!)) / (layer.pool ? 2 : 1);
    for (const [i, value] of gpu.data.entries())
      if (Math.floor(i / gpu.width) % gpu.height >= above)
        expect(Math.abs(value - cpu.data[i]!), `value ${i}`).toBeLessThanOrEqual(rounding * Math.max(1, cpu.data[i]!));
  });

  it('has text that compilers accept, within default limits, for all layers of both graphs', async () => {
    const { device } = await nullDevice(FEATURES);
    const flags = { DENOISE_HALF: true, DENOISE_F16: true };
    const seen = new Set<string>();
    for (const channels of [16, 32, 48, 64, 80, 96, 112, 128, 192])
      for (const layer of [layerOf(0, 9, channels), layerOf(0, 32, channels, true), layerOf(channels, 32, channels)]) {
        const shape = large(layer, 128)!;
        const { code } = compose([matrixConvolution({ shape, pool: layer.pool })], { flags });
        if (seen.has(code)) continue;
        seen.add(code);
        device.pushErrorScope('validation');
        const module = device.createShaderModule({ code });
        await device.createComputePipelineAsync({ layout: 'auto', compute: { module, entryPoint: 'main' } });
        expect((await module.getCompilationInfo()).messages.map(({ message }) => message)).toEqual([]);
        expect(await device.popErrorScope()).toBeNull();
      }
    expect(seen.size).toBeGreaterThan(8);
    device.destroy();
  });

  it('is shared within default limits, with no workgroup that only pads where channels fill matrices', () => {
    for (const graph of ['plain', 'large'] as const)
      for (const layer of readNetwork(randomNetwork(9, graph)).layers)
        for (const channels of [16, 32, 64, 80, 96, 112, 128, 200]) {
          const shape = large({ ...layer, channels })!;
          expect(matrixBytes(shape)).toBeLessThanOrEqual(16384);
          expect(threadsOf(shape)).toBeLessThanOrEqual(256);
          if (layer.pool) expect(shape.rows % 2).toBe(0);
          if (channels <= 64) expect(tileOutputs(shape)).toBe(Math.ceil(channels / 16) * 16);
        }
    expect(large(layerOf(0, 9, 12))).toBeUndefined();
  });

  it('computes all layers of a network that have as many channels', async () => {
    const { device } = await nullDevice(FEATURES);
    const programs: string[] = [];
    const watched = new Proxy(device, {
      get(target, key) {
        if (key === 'adapterInfo') return { subgroupMinSize: 128, subgroupMaxSize: 128 };
        if (key === 'createComputePipelineAsync')
          return (descriptor: GPUComputePipelineDescriptor) => {
            programs.push(descriptor.label!);
            return target.createComputePipelineAsync(descriptor);
          };
        const value = Reflect.get(target, key) as unknown;
        return typeof value === 'function' ? (value as (...args: unknown[]) => unknown).bind(target) : value;
      },
    });
    const denoiser = await Denoiser.create(watched, randomNetwork(3), { webAssembly: false });
    await denoiser.prepare(16, 16);
    // Of the layers two have 16 channels or more, and both an upsampled source.
    expect(programs.filter((label) => /rows of matrices .*, upsampled/.test(label))).not.toEqual([]);
    expect(programs.filter((label) => /threads of .*, last/.test(label))).toHaveLength(1);
    const plain = await Denoiser.create(watched, randomNetwork(3), { subgroupMatrices: false, webAssembly: false });
    programs.length = 0;
    await plain.prepare(16, 16);
    expect(programs.filter((label) => label.includes('matrices'))).toEqual([]);
    for (const one of [denoiser, plain]) one.destroy();
    device.destroy();
  });

  it('gives way to threads where a driver does not compile it', async () => {
    const { device } = await nullDevice();
    let asked = 0;
    const features = {
      has: (name: string) =>
        name === 'chromium-experimental-subgroup-matrix' ||
        // Asked for first by what looks for matrices, then by what stores halves, which the device has not.
        (name === 'shader-f16' ? asked++ === 0 : device.features.has(name)),
    };
    const programs: string[] = [];
    const pretender = new Proxy(device, {
      get(target, key) {
        if (key === 'features') return features;
        if (key === 'adapterInfo') return { subgroupMinSize: 32, subgroupMaxSize: 32, description: 'SwiftShader' };
        if (key === 'createShaderModule')
          return ({ label, code }: GPUShaderModuleDescriptor) => {
            programs.push(label!);
            const text = label === 'denoise matrices' ? '@compute @workgroup_size(1) fn main() {}' : code;
            return target.createShaderModule({ label: label!, code: text });
          };
        const value = Reflect.get(target, key) as unknown;
        return typeof value === 'function' ? (value as (...args: unknown[]) => unknown).bind(target) : value;
      },
    });
    const denoiser = await Denoiser.create(pretender, randomNetwork(3), { webAssembly: false });
    await denoiser.prepare(16, 16);
    expect(programs.filter((label) => label.includes('rows of matrices')).length).toBeGreaterThan(0);
    expect(programs.at(-1)).toContain('threads of');
    denoiser.destroy();
  });

  it('is not used by devices without the features', async () => {
    expect(await matricesFor(await testDevice(), {})).toBeUndefined();
  });
});

describe('halfBits', () => {
  it.each([
    [0, 0],
    [1, 0x3c00],
    [-2, 0xc000],
    [65504, 0x7bff],
    [1e6, 0x7bff],
    [2 ** -24, 1],
    [2 ** -14, 0x400],
    [1 / 3, 0x3555],
    // Halfway between two numbers: the even one, and up to the next power of two.
    [1 + 2 ** -11, 0x3c00],
    [1 + 3 * 2 ** -11, 0x3c02],
    [2 - 2 ** -12, 0x4000],
  ])('%f', (value, bits) => expect(halfBits(value)).toBe(bits));
});
