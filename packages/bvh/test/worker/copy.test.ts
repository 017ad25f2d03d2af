import { afterEach, expect, test, vi } from 'vitest';
import { copyAll, allocateLike } from '../../src/worker/copy';

afterEach(() => void vi.restoreAllMocks());

/** Numbers 0, 1, 2 … that begin within a larger buffer. */
const counting = (length: number) => Float32Array.from({ length: length + 3 }, (_, i) => i - 3).subarray(3);

/** A clock on which every look takes five milliseconds. */
function slowClock(): void {
  let now = 0;
  vi.spyOn(performance, 'now').mockImplementation(() => (now += 5));
}

test('little is copied at once, and arrays that were given away are refused, though they are empty', () => {
  const from = counting(1000),
    indices = Uint16Array.of(1, 2, 3);
  const copies = [from, indices].map((array) => ({ from: array, to: allocateLike(array) }));
  expect(copyAll(copies)).toBe(undefined);
  expect(copies.map(({ to }) => to)).toEqual([from, indices]);
  const gone = new Float32Array(9);
  structuredClone(gone, { transfer: [gone.buffer] });
  expect(() => copyAll([{ from: gone, to: allocateLike(gone) }])).toThrow(TypeError);
});

test('much is copied piece by piece, yielding in between, and arrays detached meanwhile are reported', async () => {
  slowClock();
  const from = counting(1_000_003),
    empty = new Uint32Array(0);
  const copies = [from, empty, from].map((array) => ({ from: array, to: allocateLike(array) }));
  // Each turn of the event loop is seen, however busy the machine is: timers would be put together.
  let between = 0;
  let ticking: NodeJS.Immediate = setImmediate(function tick() {
    between++;
    ticking = setImmediate(tick);
  });
  const reported: number[] = [];
  await copyAll(copies, (entries) => {
    reported.push(entries);
    const [first, , last] = copies.map(({ to }) => to);
    // What was reported is copied, and nothing after it.
    const seen = [...first!.slice(-1), ...last!.slice(-1)].map((number) => number !== 0);
    expect(seen).toEqual([entries >= 1_000_003, entries === 2_000_006]);
  });
  clearImmediate(ticking);
  expect(between).toBeGreaterThan(3);
  expect(reported).toEqual([...reported].sort((a, b) => a - b));
  expect(reported.at(-1)).toBe(2_000_006);
  for (const { from: given, to } of copies)
    expect(Buffer.compare(Buffer.from(to.buffer), Buffer.from(given.slice().buffer))).toBe(0);

  const going = counting(1_000_003);
  const copied = copyAll([{ from: going, to: allocateLike(going) }]);
  structuredClone(going, { transfer: [going.buffer as ArrayBuffer] });
  await expect(copied).rejects.toThrow(TypeError);
});
