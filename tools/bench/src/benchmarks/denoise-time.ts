import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { FILM_WEIGHTS, FilmDenoiser, type FilmWeights } from '@glanz/denoise/film';
import { PathTracer, requestDevice, type PathTracerOptions } from '@glanz/renderer';
import { createGpu } from '@glanz/renderer/node';
import type { Benchmark, Figure } from '../benchmark';
import { crossing, type Point } from '../denoise/crossing';
import { flipOfFiles, serveFlipJobs, writeImage, type FlipJob } from '../denoise/flip-jobs';
import { PRODUCT_DATA } from '../denoise/product-scenes';
import { TIME_SCENES, checkTimeScenes, timeScene } from '../denoise/time-scenes';
import { packedFolder } from '../equal-time/load';
import { BenchError } from '../error';
import { geometricMean } from '../geometric-mean';

const WEIGHTS = 'packages/denoise-weights/weights';
/** The qualities of `FilmDenoiser`, and the base network with cleaned guides. */
const NETWORKS: Readonly<Record<string, FilmWeights<string>>> = {
  ...FILM_WEIGHTS,
  cleaned: { color: 'rt_hdr_calb_cnrm', albedo: 'rt_alb', normal: 'rt_nrm' },
};
const QUALITIES: readonly string[] = ['fast', 'balanced'];
/** Mean ꟻLIP of an image that is taken for clean. */
const CLEAN = 0.05;
/** How much sooner an image shall be clean, in the geometric mean. */
const SOONER = 5;

/** Samples before what is timed: from 32 on the film's variance is known and used. */
const WARM_UP = 32;
/**
 * Seconds that are rendered for before what is timed: while kernels compile, the GPU lowers its clock, on an H200 from
 * 1,980 to 345 MHz within 3 s, and takes about half a second of work to raise it.
 */
const WARM_UP_SECONDS = 1.5;

/** An image that was made, with the time that it took. */
interface Shot {
  readonly samples: number;
  readonly milliseconds: number;
  /** Of {@link milliseconds}, what rendering took. */
  readonly rendering: number;
  readonly file: string;
}

/** Images of a scene, made one way, with ever more samples: their errors, and when they are clean. */
interface Row {
  readonly scene: string;
  /** `film`, or a name of {@link NETWORKS}. */
  readonly way: string;
  readonly points: readonly (Point & { readonly samples: number })[];
  readonly clean: number | undefined;
}

const elapsed = async (device: GPUDevice, work: () => Promise<unknown>) => {
  const started = performance.now();
  await work();
  await device.queue.onSubmittedWorkDone();
  return performance.now() - started;
};

async function addSamples(tracer: PathTracer, samples: number): Promise<void> {
  for await (const progress of tracer.render({ samples, maxSubmitMs: 100 })) void progress;
}

/** Wall time until an image is clean, denoised and not: rendering from the first sample on, and the denoiser's own. */
export const benchmark: Benchmark = {
  description: `time to a FLIP of ${CLEAN} against a long render, denoised and not, on ten product scenes at 1920 × 1080`,
  options: {
    scenes: {
      type: 'string',
      help: `names with semicolons, of products or of the models of bench:pack -- --products; default: ${TIME_SCENES.join(';')}`,
    },
    qualities: {
      type: 'string',
      help: `what is measured, of ${Object.keys(NETWORKS).join(', ')} (the base network with cleaned guides); default: ${QUALITIES.join(',')}`,
    },
    weights: { type: 'string', help: `folder of the .tza archives; default: ${WEIGHTS}` },
    'reference-seconds': { type: 'string', help: 'that a reference is rendered for; default: 10' },
    seconds: { type: 'string', help: 'after which a film that is not clean is given up; default: a third of that' },
    toggles: {
      type: 'string',
      help: 'toggles of Dawn: allow_unsafe_apis,vulkan_enable_f16_on_nvidia for subgroup matrices on NVIDIA GPUs',
    },
    deadline: { type: 'string', help: 'seconds after which no scene is begun' },
  },
  async run({ log, quick, gpu: name, values }) {
    serveFlipJobs();
    const started = performance.now();
    const scenes = values['scenes']?.split(';') ?? TIME_SCENES.slice(0, quick ? 1 : undefined);
    checkTimeScenes(scenes);
    const qualities = values['qualities']?.split(',') ?? QUALITIES;
    const unknown = qualities.find((quality) => !Object.hasOwn(NETWORKS, quality));
    if (unknown !== undefined)
      throw new BenchError(
        'bench/option',
        `--qualities: there is no "${unknown}"; there are: ${Object.keys(NETWORKS).join(', ')}.`,
      );
    const ways = ['film', ...qualities];
    const { gpu, adapterName, software } = await createGpu({
      ...(name ? { gpu: name } : {}),
      ...(values['toggles'] === undefined ? {} : { toggles: values['toggles'].split(',') }),
    });
    const device = await requestDevice({ gpu });
    const [width, height] = quick ? [96, 54] : [1920, 1080];
    const maximum = quick ? 4 : 1024;
    const seconds = quick ? 1 : Number(values['reference-seconds'] ?? 10);
    const limit = 1e3 * (quick ? 1 : Number(values['seconds'] ?? seconds / 3));
    const packed = packedFolder(PRODUCT_DATA);
    const weights = values['weights'] ?? (packed ? join(packed, 'weights') : WEIGHTS);
    const denoisers = await Promise.all(
      qualities.map(async (quality) => {
        const { color, albedo, normal } = NETWORKS[quality]!;
        const archive = (file: string) => new Uint8Array(readFileSync(join(weights, `${file}.tza`)));
        const archives = {
          color: archive(color),
          ...(albedo ? { albedo: archive(albedo) } : {}),
          ...(normal ? { normal: archive(normal) } : {}),
        };
        return [quality, await FilmDenoiser.create(device, archives, { maxSubmitMs: 100 })] as const;
      }),
    );
    const folder = mkdtempSync(join(tmpdir(), 'glanz-denoise-time-'));
    const rows: Row[] = [];
    // A scene's images are compared while the next one's reference is rendered, and nothing is timed meanwhile.
    let compared = Promise.resolve();
    const notes: string[] = [];
    try {
      for (const scene of scenes) {
        if (performance.now() - started > 1000 * Number(values['deadline'] ?? Infinity)) {
          notes.push(`${scene}: left out, the deadline had passed`);
          continue;
        }
        const product = await timeScene(scene, width, height);
        const create = (options: Partial<PathTracerOptions>) =>
          PathTracer.create(device, product.scene, {
            width,
            height,
            camera: product.camera,
            maxDepth: product.maxDepth,
            ...options,
          });
        const file = (way: string, samples: number) => join(folder, `${scenes.indexOf(scene)}-${way}-${samples}.rgb`);
        const reference = file('reference', 0);
        const long = await create({ seed: 5001 });
        const until = performance.now() + 1000 * seconds;
        while (performance.now() < until && long.samples < 8 * maximum) await addSamples(long, long.samples + 64);
        const referenceSamples = long.samples;
        writeImage(reference, await long.read('beauty'));
        long.destroy();
        await compared;
        const made = new Map<string, Shot[]>(ways.map((way) => [way, []]));
        for (const guided of [false, true]) {
          const tracer = await create(guided ? { aovs: ['albedo', 'normal'] } : {});
          // Whatever happens once, such as allocations, comes before what is timed; and the schedule finds the size of
          // submissions, which a first one with programs that were never used would make small.
          await addSamples(tracer, WARM_UP);
          if (guided) for (const [, denoiser] of denoisers) await denoiser.denoiseTracer(tracer);
          // Last: networks compile at their first image of a size.
          const awake = performance.now() + 1000 * (quick ? 0 : WARM_UP_SECONDS);
          while (performance.now() < awake) await addSamples(tracer, tracer.samples + WARM_UP);
          tracer.reset();
          let rendering = 0;
          for (let samples = 1; samples <= maximum && rendering < limit; samples *= 2) {
            rendering += await elapsed(device, () => addSamples(tracer, samples));
            const shot = (way: string, milliseconds: number, image: Float32Array) => {
              const target = file(way, samples);
              writeImage(target, image);
              made.get(way)!.push({ samples, milliseconds, rendering, file: target });
            };
            if (!guided) {
              shot('film', rendering, await tracer.read('beauty'));
              continue;
            }
            for (const [quality, denoiser] of denoisers) {
              const began = performance.now();
              // Resolves when the GPU is done.
              const image = await denoiser.denoiseTracer(tracer);
              shot(quality, rendering + performance.now() - began, await denoiser.read(image));
            }
          }
          tracer.destroy();
        }
        const last = made.get('film')!.at(-1)!;
        log(
          `${scene}: reference of ${referenceSamples} samples; ${(last.milliseconds / last.samples).toFixed(2)} ms a sample`,
        );
        compared = rowsOf(scene, made, { reference, width, height }, log).then((found) => void rows.push(...found));
        // An error is thrown where this is awaited; without a handler until then, Node would end.
        compared.catch(() => {});
      }
      for (const [, denoiser] of denoisers) denoiser.destroy();
      device.destroy();
      await compared;
      for (const { scene, way, clean } of rows)
        if (clean === undefined) notes.push(`${scene}, ${way}: not clean within ${limit / 1e3} s`);
      return {
        settings: { width, height, scenes, clean: CLEAN, qualities },
        gpu: { name: adapterName, software },
        figures: qualities.flatMap((quality) => figuresOf(quality, rows)),
        notes,
        details: rows,
      };
    } finally {
      // Processes that compare images still read them.
      await compared.catch(() => {});
      rmSync(folder, { recursive: true, force: true });
    }
  },
};

/** Compares the images of a scene. */
async function rowsOf(
  scene: string,
  made: ReadonlyMap<string, readonly Shot[]>,
  job: Omit<FlipJob, 'tests'>,
  log: (line: string) => void,
): Promise<Row[]> {
  const tests = [...made.values()].flatMap((shots) => shots.map(({ file }) => file));
  const errors = await flipOfFiles({ ...job, tests });
  let first: number | undefined;
  return [...made].map(([way, shots]) => {
    const points = shots.map(({ samples, milliseconds }) => ({ samples, milliseconds, error: errors.shift()! }));
    const [image, shot] = [points[0]!, shots[0]!];
    first ??= image.error;
    const crossed = crossing(points, CLEAN);
    // A page shows the first sample as it is, until it is denoised.
    const clean = crossed === image.milliseconds && first <= CLEAN ? shot.rendering : crossed;
    log(
      `${scene}, ${way}: clean after ${clean?.toFixed(1) ?? `more than ${points.at(-1)!.milliseconds.toFixed(0)}`} ms; FLIP ${points.map(({ samples, error, milliseconds }) => `${error.toFixed(3)} at ${samples} (${milliseconds.toFixed(0)} ms)`).join(', ')}`,
    );
    return { scene, way, points, clean };
  });
}

/** How much sooner images are clean, and what a denoised sample is worth. */
function figuresOf(quality: string, rows: readonly Row[]): Figure[] {
  const pairs = rows.flatMap((denoised) => {
    const film = rows.find((row) => row.scene === denoised.scene && row.way === 'film')!;
    return denoised.way === quality ? [{ film, denoised }] : [];
  });
  const noisy = pairs.filter(({ film }) => film.points[0]!.error > CLEAN);
  return [
    ...soonerFigures(quality, pairs),
    ...(noisy.length === pairs.length ? [] : soonerFigures(`${quality}, not clean with a first sample`, noisy)),
    ...samplesSaved(quality, pairs),
  ];
}

/** A film and its denoised images. */
interface Pair {
  readonly film: Row;
  readonly denoised: Row;
}

/**
 * Times of films over those of denoised images. Where a film never was clean, its last image counts as if it had been;
 * a scene in which neither was is left out.
 */
function soonerFigures(what: string, pairs: readonly Pair[]): Figure[] {
  const ratios = pairs.flatMap(({ film, denoised }) => {
    const late = film.points.at(-1)!.milliseconds;
    if (denoised.clean === undefined) return film.clean === undefined ? [] : [0];
    return [(film.clean ?? late) / denoised.clean];
  });
  if (ratios.length === 0) return [];
  const target = (value: number, source: string) => ({ value, relation: '>=' as const, source });
  return [
    {
      name: `${what}: sooner clean, geometric mean`,
      unit: '×',
      runs: ratios.length,
      min: Math.min(...ratios),
      median: geometricMean(ratios),
      max: Math.max(...ratios),
      target: target(SOONER, 'clean at once'),
    },
    {
      name: `${what}: sooner clean, the least of the scenes`,
      unit: '×',
      runs: ratios.length,
      median: Math.min(...ratios),
      target: target(1, 'never later'),
    },
  ];
}

/** Samples that the film needs to be as good as its first sample, denoised: what a slower GPU gains. */
function samplesSaved(quality: string, pairs: readonly Pair[]): Figure[] {
  const counts = pairs.map(({ film, denoised }) => {
    const inSamples = film.points.map(({ samples, error }) => ({ samples, error, milliseconds: samples }));
    return crossing(inSamples, denoised.points[0]!.error) ?? film.points.at(-1)!.samples;
  });
  if (counts.length === 0) return [];
  return [
    {
      name: `${quality}: samples that are as good as one denoised, geometric mean`,
      unit: 'samples',
      runs: counts.length,
      min: Math.min(...counts),
      median: geometricMean(counts),
      max: Math.max(...counts),
    },
  ];
}
