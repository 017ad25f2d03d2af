import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import { renderLoop } from '../../src/schedule/render-loop';
import { Scheduler, type Batch } from '../../src/schedule/scheduler';

beforeEach(() => {
  vi.useFakeTimers({ toFake: ['performance', 'setTimeout'] });
});
afterEach(() => {
  vi.useRealTimers();
});

/** A GPU that has `earlier` milliseconds of work, and takes `cost` for a batch. Gives what each batch is said to take. */
async function measured(earlier: number, cost: (turn: number) => number): Promise<number[]> {
  let busyUntil = performance.now() + earlier;
  const times: number[] = [];
  const scheduler = new Scheduler({ pixels: 4096, capacity: 4096, budgetMs: 16 });
  const learn = scheduler.measured.bind(scheduler);
  scheduler.measured = (batch: Batch, milliseconds: number) => {
    times.push(milliseconds);
    learn(batch, milliseconds);
  };
  let turn = 0;
  const loop = renderLoop({
    scheduler,
    target: 6,
    queue: {
      onSubmittedWorkDone: () => new Promise<void>((resolve) => setTimeout(resolve, busyUntil - performance.now())),
    } as unknown as GPUQueue,
    submit: () => {
      busyUntil = Math.max(busyUntil, performance.now()) + cost(turn++);
      return Promise.resolve();
    },
    room: (paths) => paths,
    ready: () => undefined,
    current: () => true,
    check: () => undefined,
  });
  const done = (async () => {
    for await (const samples of loop) void samples;
  })();
  await vi.runAllTimersAsync();
  await done;
  return times;
}

it('work of others before the first batch is not taken for its own', async () => {
  expect(await measured(80, () => 3)).toEqual([3, 3, 3, 3, 3, 3]);
});

it('no batch is charged for what the first one took', async () => {
  expect(await measured(0, (turn) => (turn === 0 ? 33 : 3))).toEqual([33, 3, 3, 3, 3, 3]);
});
