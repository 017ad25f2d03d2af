// A setup file of Vitest. Its `toEqual` takes seven seconds for a million numbers in typed arrays, through which it goes
// by their iterators. Those that are equal number by number, in its sense, are seen to be so in some milliseconds; the
// rest is left to it, with its messages.
import { expect } from 'vitest';

type Numbers = Float32Array & { readonly constructor: unknown };

function equalNumbers(a: unknown, b: unknown): true | undefined {
  if (!ArrayBuffer.isView(a) || !ArrayBuffer.isView(b) || a instanceof DataView) return undefined;
  const [one, other] = [a as Numbers, b as Numbers];
  if (one.constructor !== other.constructor || one.length !== other.length) return undefined;
  for (let i = 0; i < one.length; i++) if (!Object.is(one[i], other[i])) return undefined;
  return true;
}

expect.addEqualityTesters([equalNumbers]);
