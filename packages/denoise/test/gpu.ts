import { testDevice } from '@glanz/gpu';
import { expect } from 'vitest';
import { Denoiser, type DenoiserInput, type DenoiserOptions } from '../src/index';
import { randomImages } from './random-network';

/** Images in memory: RGB without gaps. */
export interface Images {
  readonly width: number;
  readonly height: number;
  readonly color?: ArrayLike<number> | undefined;
  readonly albedo?: ArrayLike<number> | undefined;
  readonly normal?: ArrayLike<number> | undefined;
  readonly scale?: number;
}

/** A buffer of RGBA with these RGB, and alpha 0.25. */
export function upload(device: GPUDevice, rgb: ArrayLike<number>): GPUBuffer {
  const data = new Float32Array((rgb.length / 3) * 4).fill(0.25);
  for (let i = 0; i < rgb.length; i++) data[Math.floor(i / 3) * 4 + (i % 3)] = rgb[i]!;
  const buffer = device.createBuffer({
    size: data.byteLength,
    usage: GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_DST,
  });
  device.queue.writeBuffer(buffer, 0, data);
  return buffer;
}

/** An empty buffer of RGBA for results. */
export const outputBuffer = (device: GPUDevice, pixels: number): GPUBuffer =>
  device.createBuffer({ size: pixels * 16, usage: GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_SRC });

/** All floats of a buffer. */
export async function download(device: GPUDevice, buffer: GPUBuffer): Promise<Float32Array<ArrayBuffer>> {
  const staging = device.createBuffer({ size: buffer.size, usage: GPUBufferUsage.MAP_READ | GPUBufferUsage.COPY_DST });
  const encoder = device.createCommandEncoder();
  encoder.copyBufferToBuffer(buffer, 0, staging, 0, buffer.size);
  device.queue.submit([encoder.finish()]);
  await staging.mapAsync(GPUMapMode.READ);
  const data = new Float32Array(staging.getMappedRange().slice(0));
  staging.destroy();
  return data;
}

/** RGB out of RGBA. */
export const rgbOf = (rgba: Float32Array): Float32Array => rgba.filter((_, i) => i % 4 < 3);

/** Denoises images in memory on the GPU, by shaders unless options say otherwise: RGB, and the RGBA written. */
export async function denoiseOnGpu(
  weights: Uint8Array,
  images: Images,
  options: DenoiserOptions & { readonly input: DenoiserInput },
  device?: GPUDevice,
) {
  const gpu = device ?? (await testDevice());
  const { width, height, scale } = images;
  const denoiser = await Denoiser.create(gpu, weights, { maxSubmitMs: 1000, webAssembly: false, ...options });
  const output = outputBuffer(gpu, width * height);
  const inputs = Object.fromEntries(
    (['color', 'albedo', 'normal'] as const).flatMap((name) =>
      images[name] ? [[name, upload(gpu, images[name])]] : [],
    ),
  );
  const result = await denoiser.denoise({
    ...inputs,
    output,
    width,
    height,
    ...(scale === undefined ? {} : { scale }),
  });
  const rgba = await download(gpu, output);
  const { memoryBytes } = denoiser;
  denoiser.destroy();
  for (const buffer of [output, ...Object.values(inputs)]) buffer.destroy();
  return { ...result, memoryBytes, rgba, rgb: rgbOf(rgba) };
}

/** Random images in buffers, one for the result, and what reads that. */
export function bindImages(device: GPUDevice, width: number, height: number) {
  const { color, albedo, normal } = randomImages(width, height);
  const output = outputBuffer(device, width * height);
  const images = {
    color: upload(device, color),
    albedo: upload(device, albedo),
    normal: upload(device, normal),
    output,
    width,
    height,
  };
  return { images, result: () => download(device, output) };
}

/** How many floats of two images differ: a comparison by `toEqual` takes minutes to print what does. */
export function different(a: Float32Array, b: Float32Array): number {
  expect(a.length).toBe(b.length);
  return a.reduce((count, value, i) => count + (Object.is(value, b[i]) ? 0 : 1), 0);
}

/** What is compared with the CPU twin: input, channels, shape of the network, width and height. */
export const TWIN_CASES: readonly (readonly [DenoiserInput, 3 | 6 | 9, 'plain' | 'large', number, number])[] = [
  ['hdr', 9, 'plain', 45, 37],
  ['hdr', 6, 'large', 16, 50],
  ['hdr', 3, 'plain', 33, 16],
  ['ldr', 9, 'large', 17, 15],
  ['srgb', 6, 'plain', 31, 33],
  ['albedo', 3, 'plain', 1, 1],
  ['normal', 3, 'large', 5, 70],
];
