/** One measured quantity. */
export interface Figure {
  /** What was measured, e.g. `push-button high: GPU time per sample`. Unique within a result. */
  readonly name: string;
  /** `ms`, `Mrays/s`, `MB`, `1` for pure numbers, … */
  readonly unit: string;
  /** Repetitions measured; warm-up runs do not count. */
  readonly runs: number;
  /** Present where repetitions were timed. */
  readonly min?: number;
  readonly median?: number;
  readonly max?: number;
  /** Present where a statistical mean was estimated, with the half-width of its 95 % interval. */
  readonly mean?: number;
  readonly ci95?: number;
  /** A limit or a published figure to hold this one against. */
  readonly target?: { readonly value: number; readonly relation: '<=' | '>='; readonly source: string };
}

/** What a benchmark gives to the runner. */
export interface BenchmarkResult {
  /** Everything that decides the figures: sizes, depths, seeds, models. */
  readonly settings: Readonly<Record<string, unknown>>;
  readonly figures: readonly Figure[];
  /** The adapter used, for benchmarks that use a GPU. */
  readonly gpu?: { readonly name: string; readonly software: boolean };
  /** Remarks a reader needs, e.g. that timestamps were unavailable. */
  readonly notes?: readonly string[];
  /** The data behind the figures, for tables and plots. */
  readonly details?: unknown;
}

/** What a benchmark may use while it runs. */
export interface BenchmarkContext {
  /** A line of progress for people; goes to stderr. */
  log(line: string): void;
  /** `--quick`: fewer repetitions and smaller sizes, to see that it works. The figures are then no measurement. */
  readonly quick: boolean;
  /** `--gpu NAME`: part of the name of the adapter to use. */
  readonly gpu?: string;
  /** `--seed N`: for those that draw random numbers. */
  readonly seed?: number;
  /** What the command line says for {@link Benchmark.options}. */
  readonly values: Readonly<Record<string, string | undefined>>;
}

/** A benchmark; each lives in `benchmarks/<name>.ts` as the export `benchmark`. */
export interface Benchmark {
  /** One line for the list of benchmarks. */
  readonly description: string;
  /** Options of its own, beside those that all have. */
  readonly options?: Readonly<Record<string, { readonly type: 'string'; readonly help: string }>>;
  run(context: BenchmarkContext): Promise<BenchmarkResult>;
}

/** Sorts and summarises repeated timings. */
export function timed(name: string, unit: string, values: readonly number[], target?: Figure['target']): Figure {
  const sorted = [...values].sort((a, b) => a - b);
  if (sorted.length === 0) throw new RangeError(`${name}: no values`);
  const middle = (sorted.length - 1) / 2;
  const median = (sorted[Math.floor(middle)]! + sorted[Math.ceil(middle)]!) / 2;
  return {
    name,
    unit,
    runs: sorted.length,
    min: sorted[0]!,
    median,
    max: sorted[sorted.length - 1]!,
    ...(target ? { target } : {}),
  };
}

/** Two-sided 97.5 % quantiles of Student's t for 1 to 30 degrees of freedom. */
const T975 = [
  12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228, 2.201, 2.179, 2.16, 2.145, 2.131, 2.12, 2.11,
  2.101, 2.093, 2.086, 2.08, 2.074, 2.069, 2.064, 2.06, 2.056, 2.052, 2.048, 2.045, 2.042,
];

/** Summarises independent estimates by their mean and its 95 % interval (Student's t). */
export function estimated(name: string, unit: string, values: readonly number[], target?: Figure['target']): Figure {
  const n = values.length;
  if (n < 2) throw new RangeError(`${name}: an interval needs at least two values`);
  const mean = values.reduce((sum, value) => sum + value, 0) / n;
  const variance = values.reduce((sum, value) => sum + (value - mean) ** 2, 0) / (n - 1);
  return {
    name,
    unit,
    runs: n,
    mean,
    ci95: (T975[n - 2] ?? 1.96) * Math.sqrt(variance / n),
    ...(target ? { target } : {}),
  };
}

/** Times `work` `runs` times after `warmUp` runs that do not count, in milliseconds of wall time. */
export async function wallTimes(runs: number, warmUp: number, work: () => unknown): Promise<number[]> {
  const times: number[] = [];
  for (let i = -warmUp; i < runs; i++) {
    const start = performance.now();
    await work();
    if (i >= 0) times.push(performance.now() - start);
  }
  return times;
}
