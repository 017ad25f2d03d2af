import { BenchError } from '../error';
import { CONTESTANTS, type ContestantName } from './contestants';
import { watchedDevice } from './device';
import { GpuTime } from './gpu-time';
import { noiseOf, imageError, shrink, type ImageError, type Reference } from './images';
import { readReference } from './reference';
import { SCENES } from './scenes';

/** One contestant on one scene. */
export interface MeasurementPlan {
  readonly scene: string;
  readonly contestant: ContestantName;
  /** Width and height of the image that is rendered. */
  readonly size: number;
  /** GPU milliseconds after which the image is looked at, ascending. */
  readonly budgetsMs: readonly number[];
  /** Independent runs. */
  readonly runs: number;
  /** Part of the adapter's name. */
  readonly gpu?: string;
  /** Where the scene's own reference lies, for scenes that the reference set has none of. */
  readonly referenceFile?: string;
}

/** An image after some time. */
export interface Point extends ImageError {
  readonly budgetMs: number;
  readonly gpuMs: number;
  readonly wallMs: number;
  /** Samples per rendered pixel, on average. */
  readonly samples: number;
}

/** What became of a {@link MeasurementPlan}. */
export interface Measurement {
  readonly scene: string;
  readonly contestant: ContestantName;
  readonly adapter: { readonly name: string; readonly software: boolean };
  /** From the file to a warm renderer: hierarchy, upload, pipelines. */
  readonly setUpMs: number;
  /** By run, then by budget. */
  readonly points: readonly (readonly Point[])[];
  /** By budget: relMSE of the noise alone, from pairs of runs; empty with a single run. */
  readonly noise: readonly number[];
  readonly notes: readonly string[];
}

/** Shrinks an image to its reference's size. */
function fitted(image: Float32Array, size: number, reference: Reference): Float32Array {
  return size === reference.width ? image : shrink(image, size, size, size / reference.width);
}

/** Rounds that compile all pipelines and bring clocks up. */
export const WARM_UP = { samples: 8, rounds: 24 } as const;

/** Renders as planned, and measures. One plan to a process: contestants must not share one. */
export async function measure(plan: MeasurementPlan, log: (line: string) => void): Promise<Measurement> {
  const scene = SCENES.find(({ name }) => name === plan.scene);
  if (!scene)
    throw new BenchError(
      'bench/option',
      `There is no scene "${plan.scene}"; scenes: ${SCENES.map(({ name }) => name).join(', ')}.`,
    );
  const { task, reference: known } = await scene.load(plan.size);
  const reference = known ?? readReference(plan.referenceFile);
  const { device, adapter, check } = await watchedDevice(plan.gpu, `${plan.contestant} on ${plan.scene}`);
  const notes: string[] = [];
  const started = performance.now();
  const contestant = await CONTESTANTS[plan.contestant](device, task);
  await contestant.advance(WARM_UP[contestant.unit]);
  const setUpMs = performance.now() - started;
  check();
  const time = await GpuTime.create(device);
  if (!time.stamped) notes.push('no timestamp queries: GPU times are wall times');
  const points: Point[][] = [];
  const images: Float32Array[][] = [];
  for (let run = 0; run < plan.runs; run++) {
    await contestant.restart(1000);
    let cost = await time.unitCost(contestant);
    await contestant.restart(run + 1);
    const runPoints: Point[] = [];
    const runImages: Float32Array[] = [];
    let gpuMs = 0,
      wallMs = 0;
    for (const budgetMs of plan.budgetsMs) {
      // What is measured as it runs may miss the budget by what the estimate was off; the next one makes up for it.
      const units = Math.max(Math.floor((budgetMs - gpuMs) / cost.gpuMs), runPoints.length === 0 ? 1 : 0);
      if (units > 0 && time.holds(units, cost)) {
        const measured = await time.measure(() => contestant.advance(units));
        gpuMs += measured.gpuMs;
        wallMs += measured.wallMs;
        cost = { gpuMs: measured.gpuMs / units, submissions: measured.submissions / units };
      } else if (units > 0) {
        const before = performance.now();
        await contestant.advance(units);
        wallMs += performance.now() - before;
        gpuMs += units * cost.gpuMs;
      }
      const samples = await contestant.samples();
      const image = fitted(await contestant.read(), plan.size, reference);
      check();
      const point: Point = { budgetMs, gpuMs, wallMs, samples, ...imageError(image, reference) };
      runPoints.push(point);
      runImages.push(image);
      log(
        `${plan.scene}, ${plan.contestant}, run ${run + 1}: ${gpuMs.toFixed(0)} ms GPU, ${wallMs.toFixed(0)} ms wall, ${samples.toFixed(1)} samples, relMSE ${point.relMse.toExponential(2)}, FLIP ${point.flip.toFixed(4)}, brightness ${point.brightness.toFixed(4)}`,
      );
    }
    points.push(runPoints);
    images.push(runImages);
  }
  const noise =
    plan.runs < 2
      ? []
      : plan.budgetsMs.map((_, b) => {
          let sum = 0,
            pairs = 0;
          for (let i = 0; i < plan.runs; i++) {
            for (let j = i + 1; j < plan.runs; j++, pairs++) sum += noiseOf(images[i]![b]!, images[j]![b]!, reference);
          }
          return sum / pairs;
        });
  time.destroy();
  contestant.destroy();
  device.destroy();
  return {
    scene: plan.scene,
    contestant: plan.contestant,
    adapter,
    setUpMs,
    points,
    noise,
    notes,
  };
}
