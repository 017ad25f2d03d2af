import { FILM_WEIGHTS, FilmDenoiser, type DenoiseQuality } from '@glanz/denoise/film';
import { requestDevice } from '@glanz/renderer';
import { createGpu } from '@glanz/renderer/node';
import { readFile } from 'node:fs/promises';
import { join } from 'node:path';
import type { Benchmark, Figure } from '../benchmark';
import { channelsOf, flipOf, QUALITY_SCENES, readNpy, relativeError } from '../denoise/quality-set';
import { BenchError } from '../error';

const DATA = '../shared/denoise/data';
const WEIGHTS = 'packages/denoise-weights/weights';
/** How much worse than the better of the film and the network's image the blend may be. */
const LIMIT = 1.05;

const isQuality = (name: string): name is DenoiseQuality => Object.hasOwn(FILM_WEIGHTS, name);

/** Four floats a pixel out of three. */
const padded = (rgb: Float32Array) =>
  Float32Array.from({ length: (rgb.length / 3) * 4 }, (_, i) =>
    i % 4 === 3 ? 1 : rgb[Math.floor(i / 4) * 3 + (i % 4)]!,
  );

/** Errors of the film, of the network's image, and of the blend of both, to references of a quality set. */
export const benchmark: Benchmark = {
  description: 'denoised films: FLIP and relMSE of film, network and blend against references',
  options: {
    data: { type: 'string', help: `folder of the quality set; default: ${DATA}` },
    weights: { type: 'string', help: `folder of the .tza archives; default: ${WEIGHTS}` },
    quality: { type: 'string', help: 'fast, balanced or best, or several with commas; default: fast,balanced' },
    scenes: { type: 'string', help: 'names with commas; default: all' },
  },
  async run({ log, quick, gpu: name, values }) {
    const qualities = (values['quality'] ?? 'fast,balanced').split(',');
    for (const quality of qualities)
      if (!isQuality(quality))
        throw new BenchError(
          'bench/option',
          `--quality ${quality}: there are ${Object.keys(FILM_WEIGHTS).join(', ')}.`,
        );
    const scenes = values['scenes']?.split(',') ?? (quick ? ['pushbutton'] : QUALITY_SCENES);
    const { gpu, adapterName, software } = await createGpu(name ? { gpu: name } : {});
    const device = await requestDevice({ gpu });
    const upload = (data: Float32Array<ArrayBuffer>) => {
      const usage = GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_DST | GPUBufferUsage.COPY_SRC;
      const buffer = device.createBuffer({ size: data.byteLength, usage });
      device.queue.writeBuffer(buffer, 0, data);
      return buffer;
    };
    const details: Record<string, unknown>[] = [];
    const worst = { flip: 0, relMse: 0 };
    for (const quality of qualities.filter(isQuality)) {
      const archives = await Promise.all(
        Object.entries(FILM_WEIGHTS[quality]).map(
          async ([use, archive]) =>
            [use, new Uint8Array(await readFile(join(values['weights'] ?? WEIGHTS, `${archive}.tza`)))] as const,
        ),
      );
      const weights = Object.fromEntries(archives) as { color: Uint8Array };
      const denoiser = await FilmDenoiser.create(device, weights, { maxSubmitMs: 200 });
      for (const scene of scenes)
        for (const samples of quick ? [4] : [1, 4, 16]) {
          const folder = values['data'] ?? DATA;
          const image = await readNpy(join(folder, `${scene}.${samples}.npy`));
          const reference = channelsOf(await readNpy(join(folder, `${scene}.ref.npy`)), 0, 3);
          const { width, height } = image;
          const film = channelsOf(image, 0, 3);
          const [color, albedo, normal] = [0, 3, 6].map((from) => upload(padded(channelsOf(image, from, 3))));
          const images = { width, height, color: color!, albedo: albedo!, normal: normal! };
          const result = async (blend: boolean) => {
            const rgba = await denoiser.read(await denoiser.denoise(images, { blend }));
            return rgba.filter((_, i) => i % 4 !== 3);
          };
          const measured = (test: Float32Array) => ({
            flip: flipOf(test, reference, width, height),
            relMse: relativeError(test, reference),
          });
          const row = {
            film: measured(film),
            network: measured(await result(false)),
            blend: measured(await result(true)),
          };
          for (const buffer of [color!, albedo!, normal!]) buffer.destroy();
          const ratio = (what: 'flip' | 'relMse') => row.blend[what] / Math.min(row.film[what], row.network[what]);
          worst.flip = Math.max(worst.flip, ratio('flip'));
          worst.relMse = Math.max(worst.relMse, ratio('relMse'));
          details.push({ scene, samples, quality, ...row });
          const text = (what: 'flip' | 'relMse') =>
            `${what} ${[row.film, row.network, row.blend].map((one) => one[what].toPrecision(4)).join(' / ')} (${ratio(what).toFixed(3)})`;
          log(`${scene}, ${samples} samples, ${quality}: film / network / blend: ${text('flip')}, ${text('relMse')}`);
        }
      denoiser.destroy();
    }
    device.destroy();
    const figure = (what: 'flip' | 'relMse', label: string, target?: Figure['target']): Figure => ({
      name: `largest ratio of the blend's ${label} to the better of film and network`,
      unit: '1',
      runs: details.length,
      mean: worst[what],
      ...(target ? { target } : {}),
    });
    return {
      settings: { scenes, qualities },
      gpu: { name: adapterName, software },
      figures: [
        figure('flip', 'FLIP', { value: LIMIT, relation: '<=', source: 'what a blend may cost' }),
        figure('relMse', 'relMSE'),
      ],
      details,
    };
  },
};
