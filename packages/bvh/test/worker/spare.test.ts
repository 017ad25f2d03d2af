import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import { HOLD_MS, Spare } from '../../src/worker/spare';

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

it('gives what was left last, once', () => {
  const spare = new Spare<{ name: string }>();
  expect(spare.take()).toBeUndefined();
  const last = { name: 'last' };
  spare.leave({ name: 'first' });
  spare.leave(last);
  expect(spare.take()).toBe(last);
  expect(spare.take()).toBeUndefined();
  spare.leave(last);
  spare.clear();
  expect(spare.take()).toBeUndefined();
  expect(vi.getTimerCount()).toBe(0);
});

it('holds it for a second: no timer is left behind, and it is lent while somebody else holds it', () => {
  const spare = new Spare<object>(),
    what = {};
  spare.leave(what);
  vi.advanceTimersByTime(HOLD_MS - 1);
  expect(vi.getTimerCount()).toBe(1);
  vi.advanceTimersByTime(1);
  expect(vi.getTimerCount()).toBe(0);
  expect(spare.take()).toBe(what);
});
