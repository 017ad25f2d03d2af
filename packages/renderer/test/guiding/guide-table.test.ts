import { expect, it } from 'vitest';
import { guidePoints, type GuidePoints } from '../../src/guiding/guide-points';
import { guideTable } from '../../src/guiding/guide-table';
import { GUIDE_BINS, GUIDE_COLUMNS, GUIDE_POINTS, GUIDE_ROWS } from '../../src/guiding/guide_constants.wesl';
import { parametersOf } from '../../src/materials/parameters';
import { addQuad, createScene, lambert } from '../scenes';
import { random } from '../tree-lights';

const LEAVES = 64;

/** A matt floor of 2 m in the plane z = 0, a metal and a pane above it, a hidden quad, and a far floor. */
function scene() {
  const made = createScene();
  addQuad(made, 1, 0, lambert(0.5));
  addQuad(made, 1, 1, { name: 'metal', parameters: { base_metalness: 1 } });
  addQuad(made, 1, 2, { name: 'glass', parameters: { transmission_weight: 1 } });
  addQuad(made, 1, 3, lambert(0.5));
  made.instances[3]!.visible = false;
  return made;
}

const pointsOf = (from = scene(), eye: readonly [number, number, number] = [0, 0, 20]) =>
  guidePoints(from, ({ visible }) => visible !== false, parametersOf, eye, LEAVES)!;

/** The leaf that holds a position, by the nodes. */
function leafOf({ nodes, leaves }: GuidePoints, position: ArrayLike<number>): number {
  let node = 1;
  while (node < leaves) node = 2 * node + (position[nodes[2 * node]!]! >= nodes[2 * node + 1]! ? 1 : 0);
  return node - leaves;
}

it('points lie on visible matt surfaces, and the nodes lead from each to its leaf', () => {
  const points = pointsOf();
  for (let i = 0; i < LEAVES * GUIDE_POINTS; i++) {
    const [x, y, z, , ...normal] = points.points.subarray(8 * i, 8 * i + 7);
    expect(Math.max(Math.abs(x!), Math.abs(y!))).toBeLessThanOrEqual(1);
    expect(z).toBe(0);
    expect(normal).toEqual([0, 0, 1]);
    expect(leafOf(points, [x!, y!, z!])).toBe(Math.floor(i / GUIDE_POINTS));
  }
});

it('the nodes part a floor from a light high above it, and the places of that floor from each other', () => {
  const lit = createScene();
  addQuad(lit, 1, 0, lambert(0.5));
  addQuad(lit, 0.3, 5, lambert(0));
  const points = pointsOf(lit);
  // All points of the floor have the same z, where the scene is longest.
  const own = Array.from({ length: LEAVES * GUIDE_POINTS }, (_, i) => {
    const place = points.points.subarray(8 * i, 8 * i + 3);
    return leafOf(points, place) === Math.floor(i / GUIDE_POINTS);
  });
  expect(own.filter(Boolean).length / own.length).toBeGreaterThan(0.9);
});

it('the density of points falls with the square of the distance to the camera', () => {
  const two = createScene();
  addQuad(two, 0.1, 0, lambert(0.5));
  addQuad(two, 0.1, -30, lambert(0.5));
  // 10 m and 40 m away: one in 17 points. They are drawn in strata, so that their number is off by one at most.
  const { points } = pointsOf(two, [0, 0, 10]);
  const far = Array.from({ length: LEAVES * GUIDE_POINTS }, (_, i) => points[8 * i + 2]!).filter((z) => z < -1).length;
  expect(Math.abs(far - (LEAVES * GUIDE_POINTS) / 17)).toBeLessThanOrEqual(1.5);
});

it('there are no points without matt surfaces', () => {
  const metal = createScene();
  addQuad(metal, 1, 0, { name: 'metal', parameters: { base_metalness: 1 } });
  expect(guidePoints(metal, () => true, parametersOf, [0, 0, 1], LEAVES)).toBeUndefined();
});

/** Table of a guide for light whose squares are given for each leaf, bin and half. */
function tableOf(square: (leaf: number, bin: number, half: 0 | 1) => number) {
  const squares = new Float32Array(4 * LEAVES * GUIDE_BINS);
  for (let i = 0; i < LEAVES * GUIDE_BINS; i++)
    for (const half of [0, 1] as const)
      squares[4 * i + half] = square(Math.floor(i / GUIDE_BINS), i % GUIDE_BINS, half);
  const table = guideTable(pointsOf(), squares, 8);
  return (leaf: number) =>
    table.subarray(2 * LEAVES + leaf * GUIDE_BINS, 2 * LEAVES + (leaf + 1) * GUIDE_BINS) as Float32Array;
}

/** A bin in the middle of the directions to +z: of the fifth row, a quarter of a turn on from +y. */
const UP = 4 * GUIDE_COLUMNS + (3 * GUIDE_COLUMNS) / 4;

it('directions go where light comes from, and the sums up to each bin never fall', () => {
  const table = tableOf((_, bin) => (bin === UP ? 100 : 0))(7);
  for (let bin = 1; bin < GUIDE_BINS; bin++) expect(table[bin]).toBeGreaterThanOrEqual(table[bin - 1]!);
  expect(table.at(-1)).toBeCloseTo(0.5, 6);
  // Blurred to the four bins beside it: a square of 1/2 and four of 1/8, the roots of which are probabilities.
  const chance = (table[UP]! - table[UP - 1]!) / 0.5;
  expect(chance).toBeGreaterThan(0.3);
  expect(chance).toBeLessThan(0.4);
});

it('a guide is not used where there is no light, nor where light comes evenly from everywhere', () => {
  expect(tableOf(() => 0)(3).at(-1)).toBe(0);
  expect(tableOf(() => 1)(3).at(-1)).toBe(0);
});

it('a guide is not used where halves of the samples disagree, which have learned noise alone', () => {
  const next = random(5);
  const found = Array.from({ length: 2 * LEAVES }, () => Math.floor(next() * GUIDE_BINS));
  const table = tableOf((leaf, bin, half) => (bin === found[2 * leaf + half] ? 1e6 : 1e-6));
  const used = Array.from({ length: LEAVES }, (_, leaf) => table(leaf).at(-1)!).filter((share) => share > 0.25);
  expect(used.length).toBeLessThan(LEAVES / 10);
  expect(GUIDE_ROWS * GUIDE_COLUMNS).toBe(GUIDE_BINS);
});
