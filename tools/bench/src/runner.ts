import { mkdirSync, writeFileSync } from 'node:fs';
import { dirname, resolve } from 'node:path';
import { parseArgs } from 'node:util';
import { GlanzError } from '@glanz/scene';
import type { Benchmark, BenchmarkResult, Figure } from './benchmark';
import { BenchError } from './error';
import { machine, type Machine } from './machine';

/** What `--json` writes. */
export interface BenchmarkReport extends BenchmarkResult {
  readonly benchmark: string;
  readonly machine: Machine;
  /** Seconds of wall time for the whole benchmark. */
  readonly seconds: number;
  /** True: a `--quick` run, whose figures are no measurement. */
  readonly quick: boolean;
}

const number = (value: number) => (Math.abs(value) >= 1000 || value === 0 ? value.toFixed(0) : value.toPrecision(4));

/** One line of a figure for people. */
export function figureLine(figure: Figure): string {
  const parts: string[] = [];
  if (figure.median !== undefined)
    parts.push(
      `${number(figure.median)} ${figure.unit} (${number(figure.min ?? figure.median)} – ${number(figure.max ?? figure.median)}, n=${figure.runs})`,
    );
  if (figure.mean !== undefined)
    parts.push(`${number(figure.mean)} ± ${number(figure.ci95 ?? 0)} ${figure.unit} (n=${figure.runs})`);
  if (figure.target) {
    const value = figure.median ?? figure.mean ?? NaN;
    const met = figure.target.relation === '<=' ? value <= figure.target.value : value >= figure.target.value;
    parts.push(
      `${met ? 'meets' : 'MISSES'} ${figure.target.relation} ${number(figure.target.value)} (${figure.target.source})`,
    );
  }
  return `${figure.name}: ${parts.join('; ')}`;
}

/** Runs a benchmark with the command line's options, prints its figures, and writes the report. */
export async function runBenchmark(
  name: string,
  benchmark: Benchmark,
  argv: readonly string[],
): Promise<BenchmarkReport> {
  const own = benchmark.options ?? {};
  let values: { json?: string; quick?: boolean; gpu?: string; seed?: string };
  try {
    ({ values } = parseArgs({
      args: [...argv],
      options: {
        ...own,
        json: { type: 'string' },
        quick: { type: 'boolean' },
        gpu: { type: 'string' },
        seed: { type: 'string' },
      },
      strict: true,
    }));
  } catch (cause) {
    const more = Object.entries(own).map(([option, { help }]) => `--${option}: ${help}`);
    throw new BenchError(
      'bench/option',
      `${(cause as Error).message.split('\n', 1)[0]} Usage: bench ${name} [--json FILE] [--quick] [--gpu NAME] [--seed N]${more.length === 0 ? '' : `; ${more.join('; ')}`}.`,
      { cause },
    );
  }
  const seed = values.seed === undefined ? undefined : Number(values.seed);
  if (seed !== undefined && !Number.isSafeInteger(seed))
    throw new BenchError('bench/option', `--seed ${values.seed}: it must be a whole number.`);
  const start = performance.now();
  const result = await benchmark.run({
    log: (line) => process.stderr.write(`${line}\n`),
    quick: values.quick ?? false,
    ...(values.gpu === undefined ? {} : { gpu: values.gpu }),
    ...(seed === undefined ? {} : { seed }),
    values: Object.fromEntries(
      Object.keys(own).map((option) => [option, (values as Record<string, string | undefined>)[option]]),
    ),
  });
  const report: BenchmarkReport = {
    benchmark: name,
    machine: machine(),
    seconds: (performance.now() - start) / 1000,
    quick: values.quick ?? false,
    ...result,
  };
  if (values.json !== undefined) {
    const file = resolve(values.json);
    mkdirSync(dirname(file), { recursive: true });
    writeFileSync(file, `${JSON.stringify(report, null, 2)}\n`);
  }
  const lines = [
    `${name}${report.quick ? ' (quick: no measurement)' : ''} — ${report.machine.cpu}, ${report.machine.cores} cores${result.gpu ? `, GPU ${result.gpu.name}${result.gpu.software ? ' (software)' : ''}` : ''}`,
  ];
  lines.push(
    ...result.figures.map((figure) => `  ${figureLine(figure)}`),
    ...(result.notes ?? []).map((note) => `  note: ${note}`),
  );
  process.stdout.write(`${lines.join('\n')}\n`);
  return report;
}

/** The whole process of a benchmark: runs it and ends with an exit code; errors become one line. */
export async function benchmarkMain(name: string, benchmark: Benchmark, argv: readonly string[]): Promise<void> {
  try {
    await runBenchmark(name, benchmark, argv);
  } catch (error) {
    process.stderr.write(
      error instanceof GlanzError
        ? `bench: ${error.code}: ${error.message}\n`
        : `bench: ${(error as Error).stack ?? String(error)}\n`,
    );
    process.exitCode = 1;
  }
}
