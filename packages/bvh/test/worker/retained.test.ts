import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import { RETAIN_MS, Retained } from '../../src/worker/retained';

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

it('returns what was kept last, once', () => {
  const retained = new Retained<{ name: string }>();
  expect(retained.take()).toBeUndefined();
  const last = { name: 'last' };
  retained.keep({ name: 'first' });
  retained.keep(last);
  expect(retained.take()).toBe(last);
  expect(retained.take()).toBeUndefined();
  retained.keep(last);
  retained.clear();
  expect(retained.take()).toBeUndefined();
  expect(vi.getTimerCount()).toBe(0);
});

it('holds it for a second: no timer remains, and it can be taken while something else refers to it', () => {
  const retained = new Retained<object>(),
    what = {};
  retained.keep(what);
  vi.advanceTimersByTime(RETAIN_MS - 1);
  expect(vi.getTimerCount()).toBe(1);
  vi.advanceTimersByTime(1);
  expect(vi.getTimerCount()).toBe(0);
  expect(retained.take()).toBe(what);
});
