import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import { renderLoop } from '../../src/schedule/render-loop';
import { Scheduler, type Batch } from '../../src/schedule/scheduler';

beforeEach(() => {
  vi.useFakeTimers({ toFake: ['performance', 'setTimeout'] });
});
afterEach(() => {
  vi.useRealTimers();
});

/**
 * Renders six samples on a GPU that has `earlier` milliseconds of work, and takes `cost` for a batch. It reports nothing
 * for `stall` milliseconds.
 *
 * @returns What each batch is said to have taken.
 */
async function measured(
  cost: (turn: number, paths: number) => number,
  { earlier = 0, stall = 0, pixels = 4096 } = {},
): Promise<number[]> {
  const start = performance.now();
  let busyUntil = start + earlier;
  const times: number[] = [];
  const scheduler = new Scheduler({ pixels, capacity: pixels, budgetMs: 16 });
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
      onSubmittedWorkDone: () =>
        new Promise<void>((resolve) => setTimeout(resolve, Math.max(busyUntil, start + stall) - performance.now())),
    } as unknown as GPUQueue,
    submit: ({ pixelCount, sampleCount }) => {
      busyUntil = Math.max(busyUntil, performance.now()) + cost(turn++, pixelCount * sampleCount);
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
  expect(await measured(() => 3, { earlier: 80 })).toEqual([3, 3, 3, 3, 3, 3]);
});

it('no batch is charged for what the first one took', async () => {
  expect(await measured((turn) => (turn === 0 ? 33 : 3))).toEqual([33, 3, 3, 3, 3, 3]);
});

it('batches whose reports come late, and together, do not make the next ones long', async () => {
  const costs: number[] = [];
  // A slow GPU, while the page has other work.
  await measured(
    (_, paths) => {
      costs.push((20 * paths) / 16384);
      return costs.at(-1)!;
    },
    { stall: 200, pixels: 1 << 18 },
  );
  expect(Math.max(...costs)).toBeLessThan(30);
});
