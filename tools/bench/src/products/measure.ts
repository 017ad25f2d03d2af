import { type Contestant } from '../equal-time/contestant';
import { CONTESTANTS } from '../equal-time/contestants';
import { watchedDevice } from '../equal-time/device';
import { taskScene } from '../equal-time/glanz';
import { GpuTime } from '../equal-time/gpu-time';
import { WARM_UP } from '../equal-time/measure';
import { noiseOf, pixelError, type PixelError } from '../equal-time/images';
import { readReference, renderReference, writeReference, type LongRender } from '../equal-time/reference';
import { BenchError } from '../error';
import { productOf } from './scenes';

/** Who takes part. */
export const RENDERERS = ['glanz', 'three-gpu-pathtracer'] as const;
export type RendererName = (typeof RENDERERS)[number];

/** One renderer on one product. */
export interface ProductPlan {
  readonly product: string;
  readonly renderer: RendererName;
  readonly width: number;
  readonly height: number;
  /** Samples a pixel of a run, at least. */
  readonly samples: number;
  /** Independent runs, at least two. */
  readonly runs: number;
  /** Samples a pixel of the reference, which Glanz's process makes. */
  readonly referenceSamples: number;
  readonly referenceFile: string;
  /** Part of the adapter's name. */
  readonly gpu?: string;
}

/** A run with random numbers of its own. */
export interface ProductRun extends PixelError {
  /** Samples a pixel, on average. */
  readonly samples: number;
  /** Milliseconds of all samples: the GPU's, or the wall's where it has no timestamps. */
  readonly gpuMs: number;
  readonly wallMs: number;
}

/** What became of a {@link ProductPlan}. */
export interface ProductMeasurement {
  readonly product: string;
  readonly renderer: RendererName;
  readonly width: number;
  readonly height: number;
  readonly adapter: { readonly name: string; readonly software: boolean };
  /** Whether times of the GPU are its own. */
  readonly stamped: boolean;
  /** Milliseconds from the .glb file in memory to the first sample or round, in a fresh process. */
  readonly setUpMs: number;
  readonly runs: readonly ProductRun[];
  /** Noise of pairs of runs as relMSE × samples: the variance of one sample, whatever the bias. */
  readonly noise: readonly number[];
  /** Of Glanz's process, which makes it. */
  readonly reference?: Omit<LongRender, 'reference'>;
}

/** Rounds after which a renderer that gets no further is given up, for each sample requested and edge of a path. */
const PATIENCE = 8;

/**
 * Renders at least so many samples, in parts that can be timed.
 *
 * @throws {BenchError} `bench/failed` for a renderer that gets no further.
 */
export async function timedSamples(
  contestant: Contestant,
  time: Pick<GpuTime, 'measure' | 'max'>,
  requested: number,
  maxDepth: number,
): Promise<{ readonly samples: number; readonly gpuMs: number; readonly wallMs: number }> {
  let samples = 0,
    gpuMs = 0,
    wallMs = 0,
    units = 1;
  for (let done = 0; samples < requested;) {
    const part = await time.measure(() => contestant.advance(units));
    gpuMs += part.gpuMs;
    wallMs += part.wallMs;
    done += units;
    samples = await contestant.samples();
    if (samples < requested && done > PATIENCE * maxDepth * (requested + 8))
      throw new BenchError('bench/failed', `${samples.toFixed(2)} of ${requested} samples after ${done} rounds.`);
    // Half of what the clock holds, since parts differ; and of rounds as many as the samples so far have taken.
    const max = Math.ceil(time.max({ gpuMs: 0, submissions: part.submissions / units }) / 2);
    const left =
      contestant.unit === 'samples' ? requested - samples : Math.ceil((requested - samples) * (done / (samples || 1)));
    units = Math.max(1, Math.min(left, max, 8 * units));
  }
  return { samples, gpuMs, wallMs };
}

/** Measures as planned. One plan to a process: renderers must not share one. */
export async function measureProduct(plan: ProductPlan, log: (line: string) => void): Promise<ProductMeasurement> {
  const { product, renderer, width, height } = plan;
  const what = `${product}, ${width} × ${height}, ${renderer}`;
  const task = await productOf(product).task(width, height);
  const { device, adapter, check } = await watchedDevice(plan.gpu, what);
  const started = performance.now();
  const contestant = await CONTESTANTS[renderer](device, task);
  await contestant.advance(1);
  const setUpMs = performance.now() - started;
  check();
  let known: ProductMeasurement['reference'];
  if (renderer === 'glanz') {
    const { maxDepth, camera, multipleScattering } = task;
    const options = { width, height, maxDepth, camera, multipleScattering };
    const { reference: long, ...rest } = await renderReference(
      device,
      await taskScene(task),
      options,
      plan.referenceSamples,
    );
    known = rest;
    writeReference(plan.referenceFile, long);
    log(
      `${product}, ${width} × ${height}: reference of ${rest.samples} samples, own relMSE ${rest.ownRelMse.toExponential(2)}; another estimator gives ${rest.ratio.toFixed(5)} ± ${rest.ratio95.toFixed(5)} of its brightness`,
    );
  }
  const reference = readReference(plan.referenceFile);
  // Glanz is warm from the reference; the other one has compiled what its first round needs.
  if (contestant.unit === 'rounds') await contestant.advance(WARM_UP.rounds);
  const time = await GpuTime.create(device);
  const runs: ProductRun[] = [];
  const images: Float32Array[] = [];
  for (let run = 0; run < plan.runs; run++) {
    await contestant.restart(run + 1);
    const timed = await timedSamples(contestant, time, plan.samples, task.maxDepth);
    const image = await contestant.read();
    check();
    runs.push({ ...timed, ...pixelError(image, reference) });
    images.push(image);
  }
  const noise = images.flatMap((image, i) =>
    images.slice(0, i).map((other, j) => {
      // Of images with n and m samples it is the mean of their variances.
      const share = (1 / runs[i]!.samples + 1 / runs[j]!.samples) / 2;
      return noiseOf(image, other, reference) / share;
    }),
  );
  const { samples, gpuMs, relMse } = runs[0]!;
  log(`${what}: ${(gpuMs / samples).toFixed(2)} ms a sample, relMSE × samples ${(relMse * samples).toPrecision(3)}`);
  const { stamped } = time;
  time.destroy();
  contestant.destroy();
  device.destroy();
  return {
    product,
    renderer,
    width,
    height,
    adapter,
    stamped,
    setUpMs,
    runs,
    noise,
    ...(known ? { reference: known } : {}),
  };
}
