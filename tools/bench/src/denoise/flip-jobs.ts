import { spawn } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { availableParallelism } from 'node:os';
import { fileURLToPath } from 'node:url';
import { BenchError } from '../error';
import { flipOfSeen, seen } from '../flip/flip';
import { shownImage } from '../flip/shown';

/** Set in the processes that {@link flipOfFiles} starts: the file with their job. */
const CHILD = 'GLANZ_BENCH_FLIP_JOBS';

/** Images and what they are compared with: files of linear RGBA, 32-bit floats. */
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
  return shownImage(rgba);
}

function errorsOf({ tests, reference, width, height }: FlipJob): number[] {
  const expected = seen(readShown(reference), width, height);
  return tests.map((test) => flipOfSeen(expected, seen(readShown(test), width, height)).mean);
}

/** In a process that {@link flipOfFiles} has started: does its job and ends. */
export function serveFlipJobs(): void {
  const file = process.env[CHILD];
  if (file === undefined) return;
  const job = JSON.parse(readFileSync(file, 'utf8')) as FlipJob;
  writeFileSync(`${file}.out`, JSON.stringify(errorsOf(job)));
  process.exit(0);
}

/** Mean ꟻLIP of each test. On all processors: the benchmark itself is started again for a share of the tests each. */
export async function flipOfFiles(job: FlipJob): Promise<number[]> {
  const { tests, reference } = job;
  const count = Math.min(tests.length, availableParallelism());
  const results = new Array<number>(tests.length);
  await Promise.all(
    Array.from({ length: count }, async (_, share) => {
      const mine = tests.flatMap((test, i) => (i % count === share ? [{ test, i }] : []));
      const file = `${reference}-${share}.json`;
      writeFileSync(file, JSON.stringify({ ...job, tests: mine.map(({ test }) => test) }));
      const child = spawn(process.execPath, [fileURLToPath(import.meta.url)], {
        env: { ...process.env, [CHILD]: file },
        stdio: ['ignore', 'ignore', 'inherit'],
      });
      const code = await new Promise<number | null>((resolve) => child.on('close', resolve));
      if (code !== 0) throw new BenchError('bench/not-available', `A process that compares images ended with ${code}.`);
      (JSON.parse(readFileSync(`${file}.out`, 'utf8')) as number[]).forEach((value, k) => {
        results[mine[k]!.i] = value;
      });
    }),
  );
  return results;
}
