import { spawn } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';

/** Jobs that a benchmark does in processes of their own, since renderers must not share one. */
export interface ChildJobs<Job> {
  /** Name of the benchmark. */
  readonly name: string;
  /** Address of the file that such a process runs: the benchmark's own bundle. */
  readonly file: string;
  run(job: Job, log: (line: string) => void): Promise<unknown>;
}

/** Set in the processes that a benchmark starts: what they are to do, and the file for the result. */
const variable = (name: string) => `GLANZ_BENCH_${name.toUpperCase().replaceAll('-', '_')}`;

/** Does a job in a process of its own. Gives its result, or in words why there is none. */
export async function inChild<T extends object, Job>({ name, file }: ChildJobs<Job>, job: Job): Promise<T | string> {
  const folder = mkdtempSync(join(tmpdir(), `glanz-${name}-job-`));
  try {
    const out = join(folder, 'result.json');
    const child = spawn(process.execPath, [fileURLToPath(file)], {
      env: { ...process.env, [variable(name)]: JSON.stringify({ job, out }) },
      stdio: ['ignore', 'ignore', 'pipe'],
    });
    let messages = '';
    child.stderr.setEncoding('utf8').on('data', (text: string) => {
      messages = (messages + text).slice(-2000);
      // What the driver and three warn of is kept for failures; our own lines are printed.
      for (const line of text.split('\n'))
        if (line.startsWith(`${name}: `)) process.stderr.write(`${line.slice(name.length + 2)}\n`);
    });
    const code = await new Promise<number | null>((resolve) => child.on('close', resolve));
    return code === 0
      ? (JSON.parse(readFileSync(out, 'utf8')) as T)
      : `failed (${code}): ${messages.trim().split('\n').slice(-3).join(' | ')}`;
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
}

/** In a process that {@link inChild} started, does the job and ends the process; in others, nothing. */
export async function childJob<Job>({ name, run }: ChildJobs<Job>): Promise<void> {
  const text = process.env[variable(name)];
  if (text === undefined) return;
  const { job, out } = JSON.parse(text) as { job: Job; out: string };
  const result = await run(job, (line) => process.stderr.write(`${name}: ${line}\n`));
  writeFileSync(out, JSON.stringify(result));
  // Dawn's threads would keep the process for a while.
  process.exit(0);
}
