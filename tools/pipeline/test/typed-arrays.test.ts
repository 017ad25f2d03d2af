import { describe, expect, it } from 'vitest';

// The tester is set up for all tests (vitest.config.ts): what is equal stays equal, and what is not fails.
describe('toEqual of typed arrays', () => {
  const numbers = Float32Array.of(1, NaN, 0);

  it('holds for the same numbers, NaN among them, alone and inside of objects', () => {
    expect(numbers).toEqual(numbers.slice());
    expect({ nodes: [numbers] }).toEqual({ nodes: [numbers.slice()] });
    expect(new Uint8Array(2)).toStrictEqual(new Uint8Array(2));
  });

  it('fails for another number, sign of zero, length or type', () => {
    for (const other of [
      Float32Array.of(1, NaN, 1e-30),
      Float32Array.of(1, NaN, -0),
      Float32Array.of(1, NaN),
      Float64Array.of(1, NaN, 0),
    ]) {
      expect(() => expect(numbers).toEqual(other), String(other)).toThrow('to deeply equal');
      expect(() => expect({ nodes: numbers }).toEqual({ nodes: other }), String(other)).toThrow('to deeply equal');
    }
  });

  it('reads the numbers of a million without the iterator, which takes seconds', () => {
    let reads = 0;
    class Counted extends Float32Array {
      override *[Symbol.iterator](): ArrayIterator<number> {
        reads++;
        yield* super.values();
      }
    }
    expect(new Counted(1_000_000)).toEqual(new Counted(1_000_000));
    expect(reads).toBe(0);
  });
});
