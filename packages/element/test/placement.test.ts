import { expect, test } from 'vitest';
import { placementOf, readOrientation, readScale } from '../src/placement';

/** Where a matrix takes a direction, to five digits. */
const taken = (m: readonly number[], [x, y, z]: readonly [number, number, number]) =>
  [0, 1, 2].map((k) => Math.round(1e5 * (m[k]! * x + m[4 + k]! * y + m[8 + k]! * z)) / 1e5 + 0);

test('a roll rotates about +Z, then a pitch about +X, then a yaw about +Y, after the scale', () => {
  expect(placementOf(null, null)).toBeUndefined();
  const roll = placementOf('90deg 0 0', null)!;
  expect([taken(roll, [1, 0, 0]), taken(roll, [0, 0, 1])]).toEqual([
    [0, 1, 0],
    [0, 0, 1],
  ]);
  const pitch = placementOf('0 90deg 0', null)!;
  expect([taken(pitch, [0, 1, 0]), taken(pitch, [1, 0, 0])]).toEqual([
    [0, 0, 1],
    [1, 0, 0],
  ]);
  const yaw = placementOf(`0 0 ${Math.PI / 2}rad`, null)!;
  expect([taken(yaw, [0, 0, 1]), taken(yaw, [0, 1, 0])]).toEqual([
    [1, 0, 0],
    [0, 1, 0],
  ]);
  // x becomes y by the roll, then z by the pitch, then x again by the yaw; y becomes −x, −x, z.
  const all = placementOf('90deg 90deg 90deg', '2 3 4')!;
  expect(taken(all, [1, 0, 0])).toEqual([2, 0, 0]);
  expect(taken(all, [0, 1, 0])).toEqual([0, 0, 3]);
  expect(taken(all, [0, 0, 1])).toEqual([0, -4, 0]);
  expect(all.slice(12)).toEqual([0, 0, 0, 1]);
});

test('texts that are none', () => {
  for (const text of ['', '90deg', '1 2', 'a b c', '1 2 3 4']) expect(readOrientation(text), text).toBeUndefined();
  for (const text of ['', '0', '1 0 1', '1 2', 'x', 'Infinity']) expect(readScale(text), text).toBeUndefined();
  expect(readScale('2')).toEqual([2, 2, 2]);
  expect(readScale(' 1 -2 3 ')).toEqual([1, -2, 3]);
});
