import { spawn } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { availableParallelism } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { BenchError } from '../error';
import { flipOfSeen, seen } from '../flip/flip';

/** Set in the processes that {@link flipOfFiles} starts: the file with their jobs. */
const CHILD = 'GLANZ_BENCH_FLIP_JOBS';

/** Images that come ever nearer to a reference: files of linear RGBA, 32-bit floats. */
export interface FlipJob {
  readonly tests: readonly string[];
  readonly reference: string;
  readonly width: number;
  readonly height: number;
}

/** Writes a linear RGBA image for {@link FlipJob}. */
export const writeImage = (file: string, { buffer, byteOffset, byteLength }: Float32Array): void =>
  writeFileSync(file, new Uint8Array(buffer, byteOffset, byteLength));

/** RGB as sRGB shows it without a tone map, in 8 bits. */
function readShown(file: string): Float32Array {
  const bytes = readFileSync(file);
  const rgba = new Float32Array(bytes.buffer, bytes.byteOffset, bytes.byteLength / 4);
  const out = new Float32Array((rgba.length / 4) * 3);
  for (let i = 0; i < out.length; i++) {
    const v = Math.min(Math.max(rgba[4 * Math.floor(i / 3) + (i % 3)]!, 0), 1);
    out[i] = Math.round(255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055)) / 255;
  }
  return out;
}

/** The errors of the last test above the limit and of the one after it, and of those that were tried on the way there. */
function errorsAround({ tests, reference, width, height }: FlipJob, limit: number): (number | null)[] {
  const expected = seen(readShown(reference), width, height);
  const errors = new Array<number | null>(tests.length).fill(null);
  const isAbove = (i: number) => {
    const test = seen(readShown(tests[i]!), width, height);
    return (errors[i] = flipOfSeen(expected, test).mean) > limit;
  };
  let [low, high] = [-1, tests.length];
  while (high - low > 1) {
    const middle = Math.floor((low + high) / 2);
    if (isAbove(middle)) low = middle;
    else high = middle;
  }
  return errors;
}

/** In a process that {@link flipOfFiles} has started: does its jobs and ends. */
export function serveFlipJobs(): void {
  const file = process.env[CHILD];
  if (file === undefined) return;
  const { jobs, limit } = JSON.parse(readFileSync(file, 'utf8')) as { jobs: FlipJob[]; limit: number };
  writeFileSync(`${file}.out`, JSON.stringify(jobs.map((job) => errorsAround(job, limit))));
  process.exit(0);
}

/**
 * Mean ꟻLIP of the tests of each job around the one from which on it is at most `limit`, null for others: found by
 * bisection, as the error falls along a job's tests. On all processors: the benchmark itself is started again for a share
 * of the jobs each.
 */
export async function flipOfFiles(
  jobs: readonly FlipJob[],
  limit: number,
  folder: string,
): Promise<(number | null)[][]> {
  const count = Math.min(jobs.length, availableParallelism());
  const results = new Array<(number | null)[]>(jobs.length);
  await Promise.all(
    Array.from({ length: count }, async (_, share) => {
      const mine = jobs.flatMap((job, i) => (i % count === share ? [{ job, i }] : []));
      const file = join(folder, `flip-${share}.json`);
      writeFileSync(file, JSON.stringify({ jobs: mine.map(({ job }) => job), limit }));
      const child = spawn(process.execPath, [fileURLToPath(import.meta.url)], {
        env: { ...process.env, [CHILD]: file },
        stdio: ['ignore', 'ignore', 'inherit'],
      });
      const code = await new Promise<number | null>((resolve) => child.on('close', resolve));
      if (code !== 0) throw new BenchError('bench/not-available', `A process that compares images ended with ${code}.`);
      (JSON.parse(readFileSync(`${file}.out`, 'utf8')) as (number | null)[][]).forEach((value, k) => {
        results[mine[k]!.i] = value;
      });
    }),
  );
  return results;
}
