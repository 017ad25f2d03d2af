import { expect, it } from 'vitest';
import { toHalf, toHalves } from '../../src/materials/texture-upload';

/** The value of half bits, by the definition of IEEE 754. */
function valueOf(half: number): number {
  const [sign, exponent, mantissa] = [half >> 15 ? -1 : 1, (half >> 10) & 31, half & 1023];
  if (exponent === 31) return mantissa ? Number.NaN : sign * Infinity;
  return sign * (exponent === 0 ? mantissa * 2 ** -24 : (1 + mantissa / 1024) * 2 ** (exponent - 15));
}

const FINITE = Array.from({ length: 0x7c00 }, (_, bits) => bits);

it('every finite half keeps its bits', () => {
  for (const sign of [0, 0x8000]) {
    expect([...toHalves(Float32Array.from(FINITE, (bits) => valueOf(sign | bits)))]).toEqual(
      FINITE.map((bits) => sign | bits),
    );
  }
});

it('what lies between two halves goes to the nearer one, and from the middle to the even one', () => {
  const below = FINITE.slice(0, -1);
  const between = (share: number) => [
    ...toHalves(Float32Array.from(below, (bits) => valueOf(bits) + share * (valueOf(bits + 1) - valueOf(bits)))),
  ];
  expect(between(0.25)).toEqual(below);
  expect(between(0.75)).toEqual(below.map((bits) => bits + 1));
  expect(between(0.5)).toEqual(below.map((bits) => bits + (bits & 1)));
});

it('what is no finite half saturates, and nothing is nothing', () => {
  const odd = [Number.NaN, Infinity, -Infinity, 65504, 65519, 65520, 1e30, -1e30, 1e-9, 0];
  expect([...toHalves(Float32Array.from(odd))].map(valueOf)).toEqual([
    0, 65504, -65504, 65504, 65504, 65504, 65504, -65504, 0, 0,
  ]);
  expect([...toHalves(Float32Array.from(odd))]).toEqual(odd.map(toHalf));
});
