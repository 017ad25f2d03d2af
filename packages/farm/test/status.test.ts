import { expect, it } from 'vitest';
import { keysOf } from '../src/queue/keys';
import { readStatus, type WorkerState } from '../src/queue/status';

/** The seconds left of a queue whose counts and workers are given. */
async function secondsLeft(
  counts: object,
  done: { readonly jobs: number; readonly seconds: number },
  ...jobs: readonly WorkerState['job'][]
): Promise<number | undefined> {
  const workers = jobs.map((job, i) =>
    JSON.stringify({ id: `w${i}`, host: 'h', pid: i, gpu: '', done: 0, beat: 1000, beatMs: 100, ...(job && { job }) }),
  );
  const redis = {
    call: async (command: string) =>
      command === 'HGETALL' ? ['done', String(done.jobs), 'milliseconds', String(1000 * done.seconds)] : workers,
  };
  const status = await readStatus({ getJobCounts: async () => counts } as never, redis as never, keysOf(), 1000);
  return status.secondsLeft;
}

const running = (samples: number, of: number, seconds: number) => ({ id: 'i', label: 'l', samples, of, seconds });

it('the time that is left: of what is rendered by its progress, of what waits by the mean', async () => {
  const done = { jobs: 10, seconds: 20 };
  expect(await secondsLeft({}, done)).toBe(0);
  expect(await secondsLeft({ waiting: 6, active: 0 }, done)).toBeUndefined();
  expect(await secondsLeft({ waiting: 6, active: 0 }, done, undefined, undefined)).toBe(6);
  // A job of 100 s, after the short ones: a quarter is rendered.
  expect(await secondsLeft({ waiting: 0, active: 1 }, done, running(25, 100, 25), undefined)).toBe(75);
  // Continued at 90 samples: 5 in 10 s, and 5 are left.
  const resumed = { ...running(95, 100, 10), resumed: 90 };
  expect(await secondsLeft({ waiting: 0, active: 1 }, done, resumed, undefined)).toBe(10);
  expect(await secondsLeft({ waiting: 6, active: 2 }, done, running(1, 4, 1), running(0, 4, 1))).toBe(8.5);
  // The first job of a queue.
  const none = { jobs: 0, seconds: 0 };
  expect(await secondsLeft({ waiting: 0, active: 1 }, none, running(25, 100, 25))).toBe(75);
  expect(await secondsLeft({ waiting: 1, active: 1 }, none, running(25, 100, 25))).toBeUndefined();
  expect(await secondsLeft({ waiting: 0, active: 1 }, none, running(0, 100, 5))).toBeUndefined();
});
