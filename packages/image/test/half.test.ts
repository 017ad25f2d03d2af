import { expect, it } from 'vitest';
import { fromHalf, HALF_MAX, toHalf } from '../src/index';
import { randomNumbers } from './shared';

it('all 65536 bit patterns survive the round trip', () => {
  for (let bits = 0; bits < 65536; bits++) {
    const value = fromHalf(bits);
    if (Number.isNaN(value)) expect(toHalf(value) & 0x7fff).toBeGreaterThan(0x7c00);
    else expect(toHalf(value)).toBe(bits);
  }
});

it('rounds to the nearest half and ties to even (seed 8)', () => {
  const random = randomNumbers(8);
  for (let n = 0; n < 20000; n++) {
    const value = Math.fround((random() - 0.5) * 2 ** (random() * 40 - 26));
    const got = fromHalf(toHalf(value));
    const bits = toHalf(value);
    const gap = Math.abs(value - got);
    for (const neighbour of [bits - 1, bits + 1]) {
      // Below zero lies the other sign, which the pattern does not count down to.
      if ((bits & 0x7fff) === 0 && neighbour < bits) continue;
      const other = Math.abs(value - fromHalf(neighbour & 0xffff));
      if (!(other >= gap)) expect.fail(`${value} became ${got}, but ${fromHalf(neighbour)} is nearer`);
      if (other === gap) expect(bits & 1).toBe(0);
    }
  }
});

it('ties go to the even neighbour, among subnormals too', () => {
  expect(
    [1 + 2 ** -11, 1 + 3 * 2 ** -11, 2 ** -25, 3 * 2 ** -25, 5 * 2 ** -25].map((v) => fromHalf(toHalf(v))),
  ).toEqual([1, 1 + 2 * 2 ** -10, 0, 2 * 2 ** -24, 2 * 2 ** -24]);
});

it('keeps bright numbers finite and leaves infinities and NaN alone', () => {
  expect([65504, 65519, 65520, 1e30, -1e30].map((v) => fromHalf(toHalf(v)))).toEqual([
    HALF_MAX,
    HALF_MAX,
    HALF_MAX,
    HALF_MAX,
    -HALF_MAX,
  ]);
  expect(fromHalf(toHalf(Infinity))).toBe(Infinity);
  expect(fromHalf(toHalf(NaN))).toBeNaN();
  expect(Object.is(fromHalf(toHalf(-0)), -0)).toBe(true);
});
