import { expect, test } from 'vitest';
import type { Scene } from '@glanz/scene';
import { NO_MOVE, pivotOf } from '../src/viewer/moves';
import { placedTransform } from '../src/viewer/placement';
import { middleOfParts, rotated, scaled, translated, withMoves, withNumber } from '../src/viewer/move-parts';

const box = { name: 'box', positions: Float32Array.of(1, 0, 0, 3, 2, 4), indices: Uint32Array.of() };
const at = (x: number) => [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, 0, 0, 1];
const scene: Pick<Scene, 'instances' | 'meshes'> = {
  meshes: [box],
  instances: [0, 10].map((x) => ({ name: '', mesh: 0, material: 0, transform: at(x) })),
};

/** A point of the mesh in the world. */
function placed(part: number, moves: Parameters<typeof placedTransform>[2], [x, y, z]: readonly number[]): number[] {
  const m = placedTransform(scene, part, moves);
  return [0, 1, 2].map((k) => m[k]! * x! + m[4 + k]! * y! + m[8 + k]! * z! + m[12 + k]!);
}
const close = (given: readonly number[], expected: readonly number[]) => {
  for (const [k, value] of expected.entries()) expect(given[k]).toBeCloseTo(value, 4);
};

test('a part rotates about the middle of its box, about X, then Y, then Z', () => {
  expect(pivotOf(scene, 1)).toEqual([12, 1, 2]);
  expect(placedTransform(scene, 1, {})).toBe(scene.instances[1]!.transform);
  const moves = { 0: { translation: [0, 5, 0], rotation: [90, 90, 0], scale: [1, 1, 2] } } as const;
  // From the middle (2, 1, 2) by (1, 0, 0), (0, 1, 0) and (0, 0, 1), by hand.
  close(placed(0, moves, [2, 1, 2]), [2, 6, 2]);
  close(placed(0, moves, [3, 1, 2]), [2, 6, 1]);
  close(placed(0, moves, [2, 2, 2]), [3, 6, 2]);
  close(placed(0, moves, [2, 1, 3]), [2, 4, 2]);
});

test('parts turn about their common middle, as often as one likes, and back', () => {
  const parts = [0, 1];
  expect(middleOfParts(scene, {}, parts)).toEqual([7, 1, 2]);
  const quarter = rotated(scene, {}, parts, [0, 1, 0], 90);
  close(placed(0, quarter, [2, 1, 2]), [7, 1, 7]);
  close(placed(1, quarter, [2, 1, 2]), [7, 1, -3]);
  // A corner keeps its distance to the common middle.
  close(placed(0, quarter, [3, 1, 2]), [7, 1, 6]);
  let moves = quarter;
  for (const [axis, degrees] of [
    [[1, 0, 0], 33],
    [[0, 0, 1], 71],
    [[0.6, 0, 0.8], -50],
  ] as const)
    moves = rotated(scene, moves, parts, axis, degrees);
  for (const [axis, degrees] of [
    [[0.6, 0, 0.8], 50],
    [[0, 0, 1], -71],
    [[1, 0, 0], -33],
    [[0, 1, 0], -90],
  ] as const)
    moves = rotated(scene, moves, parts, axis, degrees);
  for (const part of parts) close(placed(part, moves, [3, 2, 4]), placed(part, {}, [3, 2, 4]));
});

test('parts are scaled from their common middle, together or along their own axes, and keep an extent', () => {
  close(placed(1, scaled(scene, {}, [0, 1], undefined, 2), [3, 2, 4]), [7 + 2 * 6, 1 + 2, 2 + 2 * 2]);
  const turned = rotated(scene, {}, [0], [0, 1, 0], 90);
  // Its own X axis is the world's −Z.
  close(placed(0, scaled(scene, turned, [0], 0, 3), [3, 1, 2]), [2, 1, -1]);
  expect(scaled(scene, {}, [0], undefined, 0)[0]!.scale).toEqual([0.001, 0.001, 0.001]);
});

test('numbers: positions change together, others become the same; what changes nothing is gone', () => {
  const moves = translated({}, [0, 1], [1, 2, 3]);
  expect(withNumber(moves, [0, 1], 'translation', 1, 0)).toEqual(translated({}, [0, 1], [1, 0, 3]));
  expect(withNumber(moves, [0], 'rotation', 2, 45)[0]!.rotation).toEqual([0, 0, 45]);
  expect(translated(moves, [0, 1], [-1, -2, -3])).toEqual({});
  expect(withMoves({}, { 3: NO_MOVE })).toEqual({});
});
