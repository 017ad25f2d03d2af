import { spawn } from 'node:child_process';
import { existsSync, readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import type { JobResult } from '@glanz/farm';
import { BenchError } from '../error';

/** The command, which the bundler puts beside the benchmark. */
const GLANZ = fileURLToPath(new URL('./glanz.js', import.meta.url));

/** Runs `glanz` to its end. Gives what it prints as JSON. */
export async function glanz(argv: readonly string[], cwd: string, log: (line: string) => void): Promise<unknown> {
  const child = spawn(process.execPath, [GLANZ, ...argv, '--json'], { cwd, stdio: ['ignore', 'pipe', 'pipe'] });
  let [out, err] = ['', ''];
  child.stdout.on('data', (chunk: Buffer) => (out += chunk.toString()));
  child.stderr.on('data', (chunk: Buffer) => (err += chunk.toString()));
  const code = await new Promise((done, fail) => {
    child.once('error', fail);
    child.once('close', done);
  });
  if (code === 0) return JSON.parse(out);
  log(err.slice(-2000));
  throw new BenchError('bench/farm', `glanz ${argv.join(' ')} ended with exit status ${code}: ${out.slice(-1000)}`);
}

/** The results in a store. */
export function results(store: string): JobResult[] {
  const folder = join(store, 'results');
  if (!existsSync(folder)) return [];
  return readdirSync(folder).flatMap((group) =>
    readdirSync(join(folder, group)).map(
      (id) => JSON.parse(readFileSync(join(folder, group, id, 'result.json'), 'utf8')) as JobResult,
    ),
  );
}

/** What {@link renderBatch} gives. */
export interface BatchRun {
  /** From the start of the workers' process to the end of the last job. */
  readonly seconds: number;
  readonly jobs: readonly JobResult[];
}

/** A batch of one row. */
export interface BatchPlan {
  /** Its row without the output. */
  readonly row: object;
  /** Name of the output's file. */
  readonly output: string;
  readonly redis: string;
  /** Name of its store, which lies in the folder, and of its queue; images are written to `<store>-out`. */
  readonly store: string;
  readonly split?: number | undefined;
}

/** Submits a batch to a queue of its own, and lets `glanz farm work` empty it. */
export async function renderBatch(
  { row, output, redis, store, split }: BatchPlan,
  gpus: readonly string[],
  cwd: string,
  log: (line: string) => void,
): Promise<BatchRun> {
  const where = ['--redis', redis, '--queue', store, '--store', store];
  const parts = split === undefined ? [] : ['--split', String(split)];
  const batch = `${store}.json`;
  writeFileSync(join(cwd, batch), JSON.stringify([{ ...row, output: `${store}-out/${output}` }]));
  await glanz(['farm', 'submit', batch, ...where, ...parts], cwd, log);
  const start = Date.now();
  await glanz(['farm', 'work', ...where, '--until-empty', ...gpus.flatMap((gpu) => ['--gpu', gpu])], cwd, log);
  const jobs = results(join(cwd, store));
  return { seconds: (Math.max(...jobs.map(({ finished }) => Date.parse(finished))) - start) / 1000, jobs };
}
