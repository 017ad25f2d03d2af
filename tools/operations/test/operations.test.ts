import { afterAll, describe, expect, it } from 'vitest';
import { OperationCounter } from '../src/index';
import { each, pairs } from './work';

const counter = new OperationCounter(/operations\/test\/work\.ts$/);
afterAll(() => counter.end());
const operations = async (run: () => unknown) => (await counter.measure(run)).operations;

describe('OperationCounter', () => {
  it('counts each turn of a loop, at every run alike', async () => {
    for (const _ of [0, 1]) {
      expect(Math.abs((await operations(() => each(1000))) - 1000)).toBeLessThan(5);
      expect((await operations(() => pairs(1000))) / 1e6).toBeCloseTo(1, 2);
    }
  });

  it('counts optimised code as any other', async () => {
    for (let i = 0; i < 1000; i++) each(1000);
    expect(await operations(() => each(100_000))).toBeGreaterThanOrEqual(100_000);
  });

  it('counts nothing of other files and gives what was computed, and what was thrown', async () => {
    const other = await counter.measure(() => Array.from({ length: 1000 }, (_, i) => i).reduce((a, b) => a + b));
    expect(other).toEqual({ operations: 0, result: 499_500 });
    await expect(counter.measure(() => Promise.reject(new Error('no')))).rejects.toThrow('no');
    expect(await operations(() => Promise.resolve().then(() => each(10)))).toBeLessThan(20);
    const first = counter.measure(() => each(10));
    await expect(counter.measure(() => each(10))).rejects.toThrow('one measurement');
    await first;
  });
});
