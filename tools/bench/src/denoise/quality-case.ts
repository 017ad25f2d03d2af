import { readFile } from 'node:fs/promises';
import { join } from 'node:path';
import { Denoiser, type DenoiserOptions } from '@glanz/denoise';
import { flipOf, readNpy, relativeError, type NpyImage } from './quality-set';

/** Rows of the real library's results: weights of the image's network, and of those that clean its guides. */
export const ROWS = {
  'oidn alb_nrm small': ['rt_hdr_alb_nrm_small'],
  'oidn alb_nrm base': ['rt_hdr_alb_nrm'],
  'oidn hdr base': ['rt_hdr'],
  'oidn prefiltered small': ['rt_hdr_calb_cnrm_small', 'rt_alb', 'rt_nrm'],
  'oidn prefiltered base': ['rt_hdr_calb_cnrm', 'rt_alb', 'rt_nrm'],
  'oidn prefiltered large': ['rt_hdr_calb_cnrm_large', 'rt_alb_large', 'rt_nrm_large'],
} as const;

/** A way in which the real library was run. */
export type Row = keyof typeof ROWS;

/** Errors against the reference, as the set's notes define them. */
export interface Errors {
  readonly relmse: number;
  readonly flip: number;
}

/** An image of the quality set, what the real library makes of it, and how to measure ours. */
export interface QualityCase {
  /** Errors of the real library. */
  readonly expected: Errors;
  /**
   * Errors of ours.
   *
   * @param weights Folder of Open Image Denoise's .tza archives.
   */
  errors(device: GPUDevice, weights: string, options: DenoiserOptions): Promise<Errors>;
}

/** Denoises an image of nine channels: color, albedo, normal. */
async function denoise(
  device: GPUDevice,
  [main, ...guides]: readonly Uint8Array[],
  { data, width, height }: NpyImage,
  options: DenoiserOptions,
): Promise<Float32Array> {
  const denoiser = await Denoiser.create(device, main!, {
    input: 'hdr',
    maxSubmitMs: 1000,
    ...(guides.length ? { prefilter: { albedo: guides[0]!, normal: guides[1]! } } : {}),
    ...options,
  });
  const usage = GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_DST | GPUBufferUsage.COPY_SRC;
  const source = device.createBuffer({ size: data.byteLength, usage });
  device.queue.writeBuffer(source, 0, data as Float32Array<ArrayBuffer>);
  const output = device.createBuffer({ size: width * height * 12, usage });
  // The three images lie beside each other in one buffer.
  const part = (first: number) => ({ buffer: source, offset: 4 * first, pixelStride: 9, rowStride: 9 * width });
  const result = { buffer: output, pixelStride: 3 };
  await denoiser.denoise({ color: part(0), albedo: part(3), normal: part(6), output: result, width, height });
  const staging = device.createBuffer({ size: output.size, usage: GPUBufferUsage.MAP_READ | GPUBufferUsage.COPY_DST });
  const encoder = device.createCommandEncoder();
  encoder.copyBufferToBuffer(output, 0, staging, 0, output.size);
  device.queue.submit([encoder.finish()]);
  await staging.mapAsync(GPUMapMode.READ);
  const image = new Float32Array(staging.getMappedRange().slice(0));
  denoiser.destroy();
  for (const buffer of [source, output, staging]) buffer.destroy();
  return image;
}

/**
 * Reads a case of the quality set in `folder`.
 *
 * @throws {BenchError} `bench/missing-data`
 */
export async function qualityCase(folder: string, scene: string, samples: number, row: Row): Promise<QualityCase> {
  const noisy = await readNpy(join(folder, `${scene}.${samples}.npy`));
  const { data: reference } = await readNpy(join(folder, `${scene}.ref.npy`));
  const results = JSON.parse(await readFile(join(folder, `results/${scene}.json`), 'utf8')) as Record<
    string,
    Record<string, Errors>
  >;
  return {
    expected: results[samples]![row]!,
    async errors(device, weights, options) {
      const archives = await Promise.all(ROWS[row].map((name) => readFile(join(weights, `${name}.tza`))));
      const image = await denoise(device, archives, noisy, options);
      return {
        relmse: relativeError(image, reference),
        flip: flipOf(image, reference, noisy.width, noisy.height),
      };
    },
  };
}
