import { estimated, timed, type Figure } from '../benchmark';
import { geometricMean } from '../geometric-mean';
import type { ProductMeasurement } from './measure';

/** How many times less error at equal time is aimed at, over all products. */
const AIM = 20;

/** Milliseconds of wall time after which errors are compared. */
const EQUAL_TIME = 1000;

const mean = (values: readonly number[]) => values.reduce((sum, value) => sum + value, 0) / values.length;
const size = ({ width, height }: ProductMeasurement) => `${width} × ${height}`;
const msPerSample = ({ runs }: ProductMeasurement) => runs.map(({ gpuMs, samples }) => gpuMs / samples);
const relMsePerSample = ({ runs }: ProductMeasurement) => runs.map(({ relMse, samples }) => relMse * samples);

/** Error × wall time of a sample: the noise alone, since a bias does not fall with time. */
const noiseTime = ({ noise, runs }: ProductMeasurement) =>
  mean(noise) * mean(runs.map(({ wallMs, samples }) => wallMs / samples));

const median = (values: readonly number[]) => {
  const sorted = [...values].sort((a, b) => a - b);
  const middle = (sorted.length - 1) / 2;
  return (sorted[Math.floor(middle)]! + sorted[Math.ceil(middle)]!) / 2;
};

/**
 * relMSE of an image after so many milliseconds of wall time, and after one sample at the earliest: the noise of its
 * samples, and what of the error is no noise and stays.
 */
export function errorAfter({ noise, runs }: ProductMeasurement, ms: number): number {
  const perSample = mean(noise);
  const samples = Math.max(1, ms / median(runs.map((run) => run.wallMs / run.samples)));
  // Two estimates that err: of an image without a bias their difference is 0 on average, and as often below.
  const bias = Math.max(0, mean(runs.map((run) => run.relMse - perSample / run.samples)));
  return perSample / samples + bias;
}

/** The other renderer's measurement of the same product at the same size. */
const peerOf = (ours: ProductMeasurement, all: readonly ProductMeasurement[]) =>
  all.find(
    ({ renderer, product, width, height }) =>
      renderer !== 'glanz' && product === ours.product && width === ours.width && height === ours.height,
  );

const ERROR_RATIO = "relMSE after 1 s of wall time, three-gpu-pathtracer's over Glanz's";
const MEAN_ERROR_RATIO = `${ERROR_RATIO}, geometric mean`;
const MEAN_NOISE_RATIO = "noise × wall time, three-gpu-pathtracer's over Glanz's, geometric mean";

/** All figures of the measurements. `judge`: whether targets are stated. */
export function figuresOf(all: readonly ProductMeasurement[], judge: boolean): Figure[] {
  const figures: Figure[] = [];
  const [ratios, errors]: [number[], number[]] = [[], []];
  for (const one of all) {
    const name = `${one.product}, ${size(one)}${one.renderer === 'glanz' ? '' : `, ${one.renderer}`}`;
    figures.push(
      timed(`${name}: set-up`, 'ms', [one.setUpMs]),
      timed(`${name}: ${one.stamped ? 'GPU' : 'wall'} time a sample`, 'ms', msPerSample(one)),
      estimated(`${name}: relMSE × samples`, '1', relMsePerSample(one)),
      timed(`${name}: noise × samples, of pairs of runs`, '1', one.noise),
      estimated(
        `${name}: brightness over the reference's`,
        '1',
        one.runs.map(({ brightness }) => brightness),
      ),
    );
    if (one.reference) {
      const { ownRelMse, ratio, ratio95 } = one.reference;
      const checked = `${name}: brightness with other random numbers over the reference's`;
      figures.push(
        timed(`${name}: relMSE of the reference itself`, '1', [ownRelMse]),
        // Few samples have no variance to make an interval of.
        Number.isFinite(ratio95)
          ? { name: checked, unit: '1', runs: 1, mean: ratio, ci95: ratio95 }
          : timed(checked, '1', [ratio]),
      );
    }
    const peer = one.renderer === 'glanz' ? peerOf(one, all) : undefined;
    if (peer) {
      const ratio = noiseTime(peer) / noiseTime(one);
      if (Number.isFinite(ratio) && ratio > 0) ratios.push(ratio);
      const error = errorAfter(peer, EQUAL_TIME) / errorAfter(one, EQUAL_TIME);
      if (Number.isFinite(error) && error > 0) errors.push(error);
      figures.push(
        timed(`${name}: noise × wall time, three-gpu-pathtracer's over Glanz's`, '×', [ratio]),
        timed(`${name}: ${ERROR_RATIO}`, '×', [error]),
      );
    }
  }
  const whole = (name: string, values: readonly number[]): Figure => ({
    name,
    unit: '×',
    runs: values.length,
    min: Math.min(...values),
    median: geometricMean(values),
    max: Math.max(...values),
    ...(judge ? { target: { value: AIM, relation: '>=', source: 'error at equal time aimed at' } } : {}),
  });
  if (errors.length > 0) figures.push(whole(MEAN_ERROR_RATIO, errors));
  if (ratios.length > 0) figures.push(whole(MEAN_NOISE_RATIO, ratios));
  return figures;
}

/** The geometric means over all products and sizes, with three digits, and a dash where no peer was measured. */
export function meansOf(figures: readonly Figure[]): { readonly noise: string; readonly error: string } {
  const value = (full: string) => figures.find(({ name }) => name === full)?.median?.toPrecision(3) ?? '–';
  return { noise: value(MEAN_NOISE_RATIO), error: value(MEAN_ERROR_RATIO) };
}

const three = (value: number) => (Math.abs(value) >= 1000 ? value.toFixed(0) : String(Number(value.toPrecision(3))));

/** The measurements as a table in Markdown, a line for each product and size. */
export function productTable(all: readonly ProductMeasurement[]): string {
  const head = [
    'product',
    'size',
    'set-up, ms',
    'ms a sample',
    'relMSE × samples',
    "reference's relMSE",
    'peer: set-up, ms',
    'ms a sample',
    'relMSE × samples',
    'brightness',
    'noise × time, peer / Glanz',
    'error after 1 s, peer / Glanz',
  ];
  const columns = (one: ProductMeasurement) => [
    three(one.setUpMs),
    three(mean(msPerSample(one))),
    three(mean(relMsePerSample(one))),
  ];
  const rows = all
    .filter(({ renderer }) => renderer === 'glanz')
    .map((one) => {
      const peer = peerOf(one, all);
      return [
        one.product,
        size(one),
        ...columns(one),
        one.reference ? one.reference.ownRelMse.toExponential(1) : '–',
        ...(peer
          ? [
              ...columns(peer),
              three(mean(peer.runs.map(({ brightness }) => brightness))),
              three(noiseTime(peer) / noiseTime(one)),
              three(errorAfter(peer, EQUAL_TIME) / errorAfter(one, EQUAL_TIME)),
            ]
          : ['–', '–', '–', '–', '–', '–']),
      ];
    });
  return [head, head.map(() => '---'), ...rows].map((row) => `| ${row.join(' | ')} |`).join('\n');
}

/** What a reader of the figures must know. */
export function remarks(all: readonly ProductMeasurement[]): string[] {
  const notes: string[] = [];
  if (all.some(({ stamped }) => !stamped)) notes.push('no timestamp queries: GPU times are wall times');
  for (const one of all) {
    if (!one.reference) continue;
    const where = `${one.product}, ${size(one)}`;
    const error = mean(one.runs.map(({ relMseWithReference }) => relMseWithReference));
    const share = one.reference.ownRelMse / error;
    if (share > 0.1)
      notes.push(
        `${where}: the reference's own noise is ${(100 * share).toFixed(0)} % of what was measured; it is taken off, but raise --reference`,
      );
    const { outside, blocks, checkSamples, checkedBy, ratio, ratio95 } = one.reference;
    const check = `${checkedBy ? 'another estimator' : 'other random numbers'} (${checkSamples} samples)`;
    if (outside > 0.03 * blocks)
      notes.push(
        `${where}: by ${check} ${outside} of ${blocks} blocks differ from the reference by more than three standard errors`,
      );
    // Three standard errors, as of the blocks; of fewer than 32 samples there is none, and a report has null for infinity.
    if (Number.isFinite(ratio95) && Math.abs(ratio - 1) > (3 / 1.96) * ratio95)
      notes.push(
        `${where}: by ${check} the image has ${ratio.toFixed(5)} ± ${ratio95.toFixed(5)} of the reference's brightness`,
      );
  }
  return notes;
}
