import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { createCornellBox, createPushButton } from '@glanz/models';
import { sceneToGlb } from '@glanz/models/gltf';
import { listGpus } from '@glanz/renderer/node';
import { findRedis, startRedis } from '@glanz/redis';
import type { Benchmark, Figure } from '../benchmark';
import { BenchError } from '../error';
import { compareFilms, readFilm } from '../farm/compare-films';
import { renderBatch, type BatchRun } from '../farm/workers';

const number = (text: string | undefined, fallback: number, name: string) => {
  const value = text === undefined ? fallback : Number(text);
  if (!Number.isInteger(value) || value < 1)
    throw new BenchError('bench/option', `--${name} ${text}: it must be a whole number of at least 1.`);
  return value;
};
/** What the large image shows: it fills the image. */
const SCENES: Readonly<Record<string, { readonly model: string; readonly camera: object }>> = {
  'push-button': { model: 'm.glb', camera: { position: [0.07, 0.038, 0.048], target: [0, 0, -0.01], fov: 25 } },
  'cornell-box': { model: 'box.glb', camera: { position: [0, 0.5, 0.49], target: [0, 0.45, 0], fov: 50 } },
};
const pixels = (size: string) => size.split('x').reduce((product, side) => product * Number(side), 1);
/** Of issue and guide: the samples of a large image for print. */
const FULL_SAMPLES = 4096;

/** One image on one GPU, and in as many parts as there are GPUs on all. */
interface LargeRun {
  readonly samples: number;
  readonly one: BatchRun;
  readonly split: BatchRun;
}

/** Two GPUs of one machine beside one of them, by `glanz farm` as it is. */
export const benchmark: Benchmark = {
  description: 'several GPUs of one machine: images a minute, and one large image split over them, beside one GPU',
  options: {
    folder: { type: 'string', help: 'for stores and images; default below the folder for temporary files' },
    images: { type: 'string', help: 'of the batch, default 60' },
    size: { type: 'string', help: 'of these, default 1920x1080' },
    samples: { type: 'string', help: 'of these, default 512' },
    'large-size': { type: 'string', help: 'of the large image, default 7680x4320' },
    'large-samples': { type: 'string', help: 'of the large image: counts, default 512,2048; or none' },
    'large-scene': { type: 'string', help: 'push-button (default), seen from near by, or cornell-box' },
    gpus: { type: 'string', help: 'workers on one GPU instead of one on each, to try it on a machine with one' },
    level: { type: 'string', help: 'detail of the push-button: low, medium, high; default medium' },
  },
  async run({ log, quick, values, gpu }) {
    const images = number(values['images'], quick ? 6 : 60, 'images');
    const size = values['size'] ?? (quick ? '96x64' : '1920x1080');
    const samples = number(values['samples'], quick ? 16 : 512, 'samples');
    const largeSize = values['large-size'] ?? (quick ? '192x128' : '7680x4320');
    const largeSamples = (values['large-samples'] ?? (quick ? '32,64' : '512,2048'))
      .split(',')
      .filter((text) => text !== 'none')
      .map((text) => number(text, 0, 'large-samples'));
    const scene = SCENES[values['large-scene'] ?? 'push-button'];
    if (!scene)
      throw new BenchError('bench/option', `--large-scene: it must be one of ${Object.keys(SCENES).join(', ')}.`);
    const level = (values['level'] ?? 'medium') as 'low' | 'medium' | 'high';
    const { program, missing } = await findRedis();
    if (!program) throw new BenchError('bench/missing', `No Redis: ${missing}.`);
    const adapters = (await listGpus()).filter(({ software }) => !software).map(({ name }) => name);
    const copies = values['gpus'] === undefined ? undefined : number(values['gpus'], 1, 'gpus');
    const own = gpu ?? 'software';
    const [single, all, count] = copies
      ? [own, Array.from({ length: copies }, () => own), copies]
      : [adapters[0] === adapters[1] ? `${adapters[0]} #1` : adapters[0], ['all'], adapters.length];
    if (single === undefined || count < 2)
      throw new BenchError('bench/missing', 'One GPU alone is here; --gpus 2 tries it with two workers on it.');
    const folder = mkdtempSync(join(values['folder'] ?? tmpdir(), 'glanz-farm-gpus-'));
    const redis = await startRedis(program, join(folder, 'redis'));
    try {
      writeFileSync(join(folder, 'm.glb'), await sceneToGlb(createPushButton({ level })));
      writeFileSync(join(folder, 'box.glb'), await sceneToGlb(createCornellBox()));
      const render = (row: object, output: string, store: string, gpus: readonly string[], split?: number) =>
        renderBatch({ row: { model: 'm.glb', ...row }, output, redis: redis.url, store, split }, gpus, folder, log);

      const turntable = { turntable: images, size, samples };
      const one = await render(turntable, 'a-{view}.png', 'images-one', [single]);
      log(`${images} images on one GPU: ${one.seconds.toFixed(1)} s`);
      const both = await render(turntable, 'a-{view}.png', 'images-all', all);
      log(`${images} images on ${count}: ${both.seconds.toFixed(1)} s`);
      const hashes = ({ jobs }: BatchRun) => jobs.map(({ id, files }) => `${id} ${files[0]?.sha256}`).sort();
      const same = JSON.stringify(hashes(one)) === JSON.stringify(hashes(both));
      if (!same || one.jobs.length !== images)
        throw new BenchError('bench/farm', 'The images of all GPUs are not those of one.');

      const runs: LargeRun[] = [];
      const differences: Figure[] = [];
      for (const n of largeSamples) {
        const large = { ...scene, camera: JSON.stringify(scene.camera), size: largeSize, samples: n };
        const part = Math.ceil(n / count);
        const whole = await render(large, 'large.png', `large-one-${n}`, [single]);
        log(`${largeSize}, ${n} samples on one GPU: ${whole.seconds.toFixed(1)} s`);
        const split = await render(large, 'large.png', `large-all-${n}`, all, part);
        log(`${largeSize}, ${n} samples on ${count}: ${split.seconds.toFixed(1)} s`);
        runs.push({ samples: n, one: whole, split });
        if (n !== Math.min(...largeSamples)) continue;
        // Their sums are compared where that takes least.
        await render(large, 'large.film', `film-one-${n}`, [single]);
        await render(large, 'large.film', `film-all-${n}`, all, part);
        const film = (store: string) => readFilm(join(folder, `${store}-out`, 'large.film'));
        const { equal, max, bound } = compareFilms(film(`film-all-${n}`), film(`film-one-${n}`));
        differences.push(
          { name: 'large image: sums with the bits of one run', unit: '%', runs: 1, median: 100 * equal },
          {
            name: 'large image: maximum relative difference of a sum',
            unit: '2⁻²³',
            runs: 1,
            median: max * 2 ** 23,
            target: { value: bound * 2 ** 23, relation: '<=', source: 'what mergeFilmStates promises' },
          },
        );
      }
      const target = { value: 0.95 * count, relation: '>=', source: `1.9 for two GPUs` } as const;
      const value = (name: string, unit: string, median: number): Figure => ({ name, unit, runs: 1, median });
      const perMinute = ({ seconds }: BatchRun) => (60 * images) / seconds;
      return {
        settings: {
          images,
          size,
          samples,
          largeSize,
          largeSamples,
          largeScene: scene,
          level,
          gpus: copies ? all : adapters,
        },
        figures: [
          value('one GPU', 'images/min', steadyPerMinute(one)),
          value(`${count} GPUs`, 'images/min', steadyPerMinute(both)),
          { ...value('images: ratio', '1', steadyPerMinute(both) / steadyPerMinute(one)), target },
          value('one GPU, its start included', 'images/min', perMinute(one)),
          value(`${count} GPUs, their start included`, 'images/min', perMinute(both)),
          ...runs.flatMap((run) => [
            value(`large image, ${run.samples} samples: one GPU`, 's', run.one.seconds),
            value(`large image, ${run.samples} samples: ${count} GPUs`, 's', run.split.seconds),
            value(`large image, ${run.samples} samples: ratio`, '1', run.one.seconds / run.split.seconds),
            value(`large image, ${run.samples} samples: merge`, 's', secondsOf(run.split, true)),
            value(
              `large image, ${run.samples} samples: ratio of the slowest part`,
              '1',
              secondsOf(run.one, false) / secondsOf(run.split, false),
            ),
          ]),
          ...predicted(runs, pixels(largeSize), target),
          ...differences,
        ],
        gpu: { name: single, software: copies !== undefined && own === 'software' },
        details: { one, both, runs },
      };
    } finally {
      await redis.stop();
      rmSync(folder, { recursive: true, force: true });
    }
  },
};

/** Images a minute, once each worker has finished one: it starts with its GPU, the model and its kernels. */
function steadyPerMinute({ jobs }: BatchRun): number {
  const times = new Map<string, number[]>();
  for (const { worker, finished } of jobs) times.set(worker, [...(times.get(worker) ?? []), Date.parse(finished)]);
  let perMinute = 0;
  for (const ends of times.values())
    if (ends.length > 1) perMinute += (60_000 * (ends.length - 1)) / (Math.max(...ends) - Math.min(...ends));
  return perMinute;
}

/** The longest job: a merge, or one that renders. */
const secondsOf = ({ jobs }: BatchRun, isMerge: boolean) =>
  Math.max(
    ...jobs
      .filter(({ info }) => isMerge === ((info as { parts?: number } | undefined)?.parts !== undefined))
      .map(({ seconds }) => seconds),
  );

/** What {@link FULL_SAMPLES} take, by the line through the smallest and the largest number of samples measured. */
function predicted(runs: readonly LargeRun[], pixelCount: number, target: NonNullable<Figure['target']>): Figure[] {
  const sorted = [...runs].sort((a, b) => a.samples - b.samples);
  const [first, last] = [sorted[0], sorted.at(-1)];
  if (!first || !last || first === last) return [];
  const line = (seconds: (run: LargeRun) => number) => {
    const slope = (seconds(last) - seconds(first)) / (last.samples - first.samples);
    return { slope, at: (samples: number) => seconds(last) + slope * (samples - last.samples) };
  };
  const one = line((run) => run.one.seconds);
  const split = line((run) => run.split.seconds);
  const value = (name: string, unit: string, median: number): Figure => ({ name, unit, runs: 1, median });
  const isMeasured = last.samples >= FULL_SAMPLES;
  return [
    value('large image: one GPU', 'Msamples/s', pixelCount / one.slope / 1e6),
    value('large image: apart from samples, one GPU', 's', one.at(0)),
    value('large image: apart from samples, all GPUs', 's', split.at(0)),
    ...(isMeasured
      ? []
      : [
          value(`large image, ${FULL_SAMPLES} samples, computed: one GPU`, 's', one.at(FULL_SAMPLES)),
          {
            ...value(
              `large image, ${FULL_SAMPLES} samples, computed: ratio`,
              '1',
              one.at(FULL_SAMPLES) / split.at(FULL_SAMPLES),
            ),
            target,
          },
        ]),
  ];
}
