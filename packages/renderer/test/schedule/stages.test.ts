import { setTimeout as sleep } from 'node:timers/promises';
import { describe, expect, it } from 'vitest';
import { runStages, stageOf, type AnyStage } from '../../src/schedule/stages';

interface Products {
  a: string;
  b: string;
  c: string;
  d: string;
}

/** A promise and its ends. */
function gate() {
  let open!: () => void;
  let refuse!: (error: unknown) => void;
  const promise = new Promise<void>((resolve, reject) => ([open, refuse] = [resolve, reject]));
  return { promise, open, refuse };
}

/** Long enough for all that can go on. */
const turns = () => sleep(20);

/** Stages that note when they begin, end and are released; `gates` hold some open. */
function stagesOf(
  log: string[],
  specs: readonly [keyof Products, (keyof Products)[], AnyStage<Products>['place']][],
  gates: Partial<Record<keyof Products, ReturnType<typeof gate>>> = {},
) {
  const stage = stageOf<Products>();
  return specs.map(([name, needs, place]) =>
    stage({
      name,
      needs,
      place,
      async run(products, { signal }) {
        log.push(`${name}(${needs.map((need) => products[need]).join()})`);
        await gates[name]?.promise;
        log.push(signal.aborted ? `${name} aborted` : `${name} done`);
        return name.toUpperCase();
      },
      release: (product) => log.push(`release ${product}`),
    }),
  );
}

describe('stages', () => {
  it('begin when their inputs are there, and give all products with their times', async () => {
    const log: string[] = [];
    const { products, times } = await runStages(
      stagesOf(log, [
        ['c', ['a', 'b'], 'foreground'],
        ['b', ['a'], 'foreground'],
        ['a', [], 'foreground'],
        ['d', ['c'], 'foreground'],
      ]),
    );
    expect(products).toEqual({ a: 'A', b: 'B', c: 'C', d: 'D' });
    expect(log.filter((line) => line.includes('('))).toEqual(['a()', 'b(A)', 'c(A,B)', 'd(C)']);
    expect(times.a.end).toBeGreaterThanOrEqual(times.a.begin);
    expect(times.b.begin).toBeGreaterThanOrEqual(times.a.end);
  });

  it('in the foreground run one at a time in their order, in the background while the foreground waits', async () => {
    const log: string[] = [];
    const gates = { a: gate(), b: gate() };
    const run = runStages(
      stagesOf(
        log,
        [
          ['a', [], 'elsewhere'],
          ['b', [], 'foreground'],
          ['c', [], 'background'],
          ['d', ['a', 'b', 'c'], 'foreground'],
        ],
        gates,
      ),
    );
    await turns();
    expect(log).toEqual(['a()', 'b()']);
    gates.b.open();
    await turns();
    expect(log.slice(2)).toEqual(['b done', 'c()', 'c done']);
    gates.a.open();
    await run;
    expect(log.at(-1)).toBe('d done');
  });

  it('that fail stop the others; what was made is released, last first', async () => {
    const log: string[] = [];
    const gates = { c: gate(), d: gate() };
    const specs: Parameters<typeof stagesOf>[1] = [
      ['a', [], 'foreground'],
      ['b', ['a'], 'foreground'],
      ['c', ['b'], 'background'],
      ['d', ['b'], 'elsewhere'],
    ];
    const run = runStages(stagesOf(log, specs, gates));
    run.catch(() => {});
    await turns();
    gates.d.refuse(new Error('no memory'));
    await turns();
    // Work on this thread is waited for: it may be about to allocate.
    expect(log.some((line) => line.startsWith('release'))).toBe(false);
    gates.c.open();
    await expect(run).rejects.toThrow('no memory');
    expect(log.slice(-4)).toEqual(['c aborted', 'release C', 'release B', 'release A']);
  });

  it('are aborted by the caller, without waiting for other threads, whose products are released later', async () => {
    const log: string[] = [];
    const gates = { b: gate() };
    const controller = new AbortController();
    const specs: Parameters<typeof stagesOf>[1] = [
      ['a', [], 'foreground'],
      ['b', ['a'], 'elsewhere'],
      ['c', ['b'], 'foreground'],
      ['d', ['c'], 'foreground'],
    ];
    const run = runStages(stagesOf(log, specs, gates), { signal: controller.signal });
    run.catch(() => {});
    await turns();
    controller.abort(new Error('left'));
    await expect(run).rejects.toThrow('left');
    expect(log).toEqual(['a()', 'a done', 'b(A)', 'release A']);
    gates.b.open();
    await turns();
    expect(log.slice(-2)).toEqual(['b aborted', 'release B']);
    await expect(runStages(stagesOf(log, specs), { signal: controller.signal })).rejects.toThrow('left');
  });

  it('are checked after each', async () => {
    const log: string[] = [];
    let left = 2;
    const check = () => {
      if (--left === 0) throw new Error('lost');
    };
    const specs: Parameters<typeof stagesOf>[1] = [
      ['a', [], 'foreground'],
      ['b', ['a'], 'foreground'],
      ['c', ['b'], 'foreground'],
      ['d', ['c'], 'foreground'],
    ];
    await expect(runStages(stagesOf(log, specs), { check })).rejects.toThrow('lost');
    expect(log).toEqual(['a()', 'a done', 'b(A)', 'b done', 'release B', 'release A']);
  });

  it('that wait for each other are an error, not a hang', async () => {
    const specs: Parameters<typeof stagesOf>[1] = [
      ['a', ['b'], 'foreground'],
      ['b', ['a'], 'background'],
    ];
    await expect(runStages(stagesOf([], specs))).rejects.toThrow('The stages a, b wait for each other');
  });
});
