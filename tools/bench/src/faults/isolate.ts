import { spawn } from 'node:child_process';
import { BenchError } from '../error';
import { Journal } from './journal';

/** Deaths without a trial in between after which {@link untilDone} gives up. */
const MAX_IDLE_DEATHS = 3;

/**
 * Runs a command, which notes its trials in a journal, until it has made all of them. Where a signal ends it (a driver
 * that reads freed memory, say), the trial that was running counts as a crash, and the command is started again for the
 * others.
 *
 * @param command Program and arguments.
 * @param file The journal.
 * @throws {BenchError} `bench/failed` if the command fails without a signal, or dies repeatedly between trials.
 */
export async function untilDone(
  [program, ...args]: readonly [string, ...string[]],
  file: string,
  env: NodeJS.ProcessEnv,
): Promise<void> {
  for (let idle = 0; ;) {
    const before = new Journal(file).outcomes.length;
    const child = spawn(program, args, { stdio: ['ignore', 'inherit', 'inherit'], env });
    const [code, signal] = await new Promise<[number | null, NodeJS.Signals | null]>((resolve, reject) => {
      child.on('error', reject);
      child.on('close', (...end) => resolve(end));
    });
    if (signal === null && code === 0) return;
    if (signal === null)
      throw new BenchError(
        'bench/failed',
        `The process of the campaign ended with exit status ${code}; ${file} has what it did until then.`,
      );
    const journal = new Journal(file);
    const { running } = journal;
    if (running) journal.end({ ...running, ending: 'crash', detail: `the process died of ${signal}` });
    idle = journal.outcomes.length > before ? 0 : idle + 1;
    if (idle >= MAX_IDLE_DEATHS)
      throw new BenchError('bench/failed', `The process of the campaign dies of ${signal} before its first trial.`);
  }
}
