import { setFlagsFromString } from 'node:v8';
import { runInNewContext } from 'node:vm';
import { FaultRecorder, instrumentDevice, loseDevice } from '@glanz/gpu/faults';
import type { PathTracer } from '@glanz/renderer';
import { createTracer, render, SIZE, STEPS } from './tracer-steps';

/** What the process holds while no tracer lives, after a forced garbage collection. */
export interface SoakPoint {
  readonly seconds: number;
  readonly heapBytes: number;
  /** Typed arrays and other memory outside the heap. */
  readonly externalBytes: number;
  readonly rssBytes: number;
  readonly gpuObjects: number;
  readonly gpuBytes: number;
  /** Devices that have been lost so far. */
  readonly losses: number;
}

/** What {@link soak} takes. */
export interface SoakOptions {
  readonly open: () => Promise<GPUDevice>;
  readonly seconds: number;
  readonly seed: number;
  /** Probability that an edit meets a lost device, 0 to 1; 0 keeps one device for the whole run. */
  readonly lossRate: number;
  readonly onPoint?: (point: SoakPoint) => void;
}

/** What was done, and the measured points. */
export interface SoakResult {
  readonly points: readonly SoakPoint[];
  readonly loads: number;
  readonly edits: number;
  readonly losses: number;
  /** Most GPU bytes and objects that lived at once. */
  readonly peak: { readonly gpuBytes: number; readonly gpuObjects: number };
  /** Errors that were not expected. */
  readonly errors: readonly string[];
}

/** Random numbers of a seed: mulberry32. */
function uniform(seed: number): () => number {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let t = Math.imul(state ^ (state >>> 15), state | 1);
    t ^= t + Math.imul(t ^ (t >>> 7), t | 61);
    return ((t ^ (t >>> 14)) >>> 0) / 2 ** 32;
  };
}

const MOST_POINTS = 301;
const COLUMNS = ['seconds', 'heapBytes', 'externalBytes', 'rssBytes', 'gpuObjects', 'gpuBytes', 'losses'] as const;

/** The measured points in memory of fixed size outside the heap: as objects they would be a slope of their own. */
class PointTable {
  readonly #values: Float64Array;
  #count = 0;

  constructor(max: number) {
    this.#values = new Float64Array(max * COLUMNS.length);
  }

  get lastSeconds(): number {
    return this.#count === 0 ? -Infinity : this.#values[(this.#count - 1) * COLUMNS.length]!;
  }

  add(point: SoakPoint): void {
    this.#values.set(
      COLUMNS.map((column) => point[column]),
      this.#count++ * COLUMNS.length,
    );
  }

  points(): SoakPoint[] {
    return Array.from({ length: this.#count }, (_, index) => {
      const row = this.#values.subarray(index * COLUMNS.length);
      return Object.fromEntries(COLUMNS.map((column, at) => [column, row[at]!])) as unknown as SoakPoint;
    });
  }
}

/**
 * Turns off what V8 compiles late: optimised and baseline code, type feedback that is allocated after some calls,
 * bytecode that is dropped and made again. Code that is reached rarely is compiled long after the start, and the heap
 * grows by it, as by a small leak.
 */
export function compileEarly(): void {
  for (const flag of ['--no-opt', '--no-sparkplug', '--no-lazy-feedback-allocation', '--no-flush-bytecode'])
    setFlagsFromString(flag);
}

setFlagsFromString('--expose-gc');
const collect = runInNewContext('gc') as () => void;

/**
 * Loads, edits, orbits, resizes, reads, loses the device and destroys, in a random order of the seed; measures between
 * loads.
 */
export async function soak({ open, seconds, seed, lossRate, onPoint }: SoakOptions): Promise<SoakResult> {
  const next = uniform(seed);
  const recorder = new FaultRecorder();
  const measured = new PointTable(MOST_POINTS);
  const errors: string[] = [];
  const started = performance.now();
  const elapsed = () => (performance.now() - started) / 1000;
  let device = instrumentDevice(await open(), recorder);
  let [loads, edits, losses, gpuBytes, gpuObjects] = [0, 0, 0, 0, 0];
  while (elapsed() < seconds) {
    recorder.clear();
    let lost = false;
    let tracer: PathTracer | undefined;
    try {
      tracer = await createTracer(device);
      loads++;
      // One kind of edit a load: kernels are kept for each combination of features, and of those there are thousands.
      const step = STEPS[Math.floor(STEPS.length * next())]!;
      for (let count = 1 + Math.floor(4 * next()); count > 0; count--) {
        await step.before?.(tracer);
        // Sometimes with a call under way.
        if (next() < lossRate) {
          lost = true;
          loseDevice(device, next() < 0.5 ? 'unknown' : 'destroyed');
          losses++;
        }
        await step.act(tracer);
        edits++;
        await tracer.setCamera({
          type: 'perspective',
          name: 'orbit',
          transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, next() - 0.5, next() - 0.5, 3, 1],
          yfov: 0.7,
        });
        if (next() < 0.3) await tracer.resize(SIZE + Math.floor(20 * next()), SIZE + Math.floor(20 * next()));
        await render(tracer, 1 + Math.floor(3 * next()));
        await tracer.read('beauty');
        gpuBytes = Math.max(gpuBytes, recorder.liveBytes);
        gpuObjects = Math.max(gpuObjects, recorder.live.size);
      }
    } catch (error) {
      const { code } = error as { code?: string };
      // Edits meet scenes that other edits have made: some have nothing left to show, or no sum of light groups.
      if (
        !(lost && code === 'renderer/device-lost') &&
        code !== 'renderer/no-triangles' &&
        code !== 'renderer/light-groups'
      )
        errors.push(`${code ?? (error as Error).name}: ${(error as Error).message.slice(0, 160)}`);
    }
    tracer?.destroy();
    tracer = undefined;
    if (lost) device = instrumentDevice(await open(), recorder);
    await new Promise((resolve) => setTimeout(resolve, 10));
    if (elapsed() - measured.lastSeconds < seconds / (MOST_POINTS - 1)) continue;
    collect();
    collect();
    const { heapUsed, external, rss } = process.memoryUsage();
    const point: SoakPoint = {
      seconds: elapsed(),
      heapBytes: heapUsed,
      externalBytes: external,
      rssBytes: rss,
      gpuObjects: recorder.live.size,
      gpuBytes: recorder.liveBytes,
      losses,
    };
    measured.add(point);
    onPoint?.(point);
  }
  device.destroy();
  return {
    points: measured.points(),
    loads,
    edits,
    losses,
    peak: { gpuBytes, gpuObjects },
    errors: [...new Set(errors)],
  };
}

/** A straight line through points by least squares: its slope, and the half-width of the slope's 95 % interval. */
export function slope(points: readonly (readonly [x: number, y: number])[]): {
  readonly slope: number;
  readonly ci95: number;
} {
  const n = points.length;
  const mean = (pick: 0 | 1) => points.reduce((sum, point) => sum + point[pick], 0) / n;
  const [mx, my] = [mean(0), mean(1)];
  const sxx = points.reduce((sum, [x]) => sum + (x - mx) ** 2, 0);
  const value = points.reduce((sum, [x, y]) => sum + (x - mx) * (y - my), 0) / sxx;
  const residual = points.reduce((sum, [x, y]) => sum + (y - my - value * (x - mx)) ** 2, 0);
  return { slope: value, ci95: 1.96 * Math.sqrt(residual / Math.max(n - 2, 1) / sxx) };
}

const SERIES = [
  { name: 'heap', key: 'heapBytes', scale: 2 ** 20, unit: 'MiB', colour: '#2266bb' },
  { name: 'outside the heap', key: 'externalBytes', scale: 2 ** 20, unit: 'MiB', colour: '#cc6611' },
  { name: 'RSS', key: 'rssBytes', scale: 2 ** 20, unit: 'MiB', colour: '#228844' },
  { name: 'GPU objects', key: 'gpuObjects', scale: 1, unit: '', colour: '#aa2255' },
] as const;

/** The measured points over time as an SVG: a panel for each quantity, each from 0. */
export function soakPlot(points: readonly SoakPoint[], settledSeconds: number): string {
  const [width, height, left, gap] = [720, 130, 70, 36];
  const last = Math.max(points.at(-1)?.seconds ?? 1, 1);
  const panels = SERIES.map(({ name, key, scale, unit, colour }, index) => {
    const top = 20 + index * (height + gap);
    const max = Math.max(...points.map((point) => point[key] / scale), 1);
    const x = (seconds: number) => left + ((width - left - 10) * seconds) / last;
    const y = (value: number) => top + height - (height * value) / (1.1 * max);
    const line = points.map((point) => `${x(point.seconds).toFixed(1)},${y(point[key] / scale).toFixed(1)}`).join(' ');
    const label = (value: number) =>
      `<text x="${left - 6}" y="${y(value) + 4}" text-anchor="end">${value < 10 ? value.toFixed(1).replace('.0', '') : value.toFixed(0)}</text>`;
    return `<text x="${left}" y="${top - 6}">${name}${unit === '' ? '' : `, ${unit}`}</text><rect x="${left}" y="${top}" width="${width - left - 10}" height="${height}" fill="none" stroke="#999"/><line x1="${x(settledSeconds)}" x2="${x(settledSeconds)}" y1="${top}" y2="${top + height}" stroke="#999" stroke-dasharray="3"/>${label(0)}${label(max)}<polyline points="${line}" fill="none" stroke="${colour}" stroke-width="1.5"/>`;
  });
  const total = 20 + SERIES.length * (height + gap) + 10;
  const ticks = [0, 0.25, 0.5, 0.75, 1]
    .map(
      (t) =>
        `<text x="${left + (width - left - 10) * t}" y="${total - 14}" text-anchor="middle">${((t * last) / 60).toFixed(1)} min</text>`,
    )
    .join('');
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${width} ${total}" width="${width}" height="${total}" font-family="sans-serif" font-size="12" role="img"><title>Memory over time in the soak test</title><rect width="100%" height="100%" fill="#fff"/>${panels.join('')}${ticks}</svg>\n`;
}
