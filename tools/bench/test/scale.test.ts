import { validateScene } from '@glanz/scene';
import { expect, it } from 'vitest';
import { differingPixels } from '../src/scale/compare';
import { gridScene, undulatingGrid } from '../src/scale/scene';

it('the grid has the triangles asked for, shares its vertices, and its normals are those of its surface', () => {
  const { positions, indices, normals } = undulatingGrid(20_000);
  expect(indices.length / 3).toBe(20_000);
  expect(positions.length / 3).toBe(101 * 101);
  expect(new Set(indices).size).toBe(101 * 101);
  for (let t = 0; t < indices.length; t += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => [...positions.subarray(3 * indices[t + k]!, 3 * indices[t + k]! + 3)]) as [
      number[],
      number[],
      number[],
    ];
    const [u, v] = [b, c].map((p) => p.map((value, k) => value - a[k]!)) as [number[], number[]];
    const face = [0, 1, 2].map((k) => u[(k + 1) % 3]! * v[(k + 2) % 3]! - u[(k + 2) % 3]! * v[(k + 1) % 3]!);
    const length = Math.hypot(...face);
    const normal = normals!.subarray(3 * indices[t]!, 3 * indices[t]! + 3);
    expect(Math.hypot(...normal)).toBeCloseTo(1, 6);
    // Second derivatives are at most 0.12 · (√29 + 4)² + 0.006 · 41.5² = 21 per metre, and a face has the slope of a
    // point at half the diagonal of a cell at most: 0.014 m away.
    expect(face.reduce((sum, value, k) => sum + (value / length) * normal[k]!, 0)).toBeGreaterThan(Math.cos(0.3));
  }
});

it('the scene is valid', () => {
  expect(() => validateScene(gridScene(200))).not.toThrow();
});

it('a pixel differs if one bit does, also that of a zero', () => {
  const film = Float32Array.of(0, 0.5, 1, 1, 2, 2, 2, 1, 3, 3, 3, 1);
  const bits = (change: (copy: Float32Array) => void) => {
    const copy = film.slice();
    change(copy);
    return Buffer.from(copy.buffer);
  };
  const same = bits(() => {});
  expect(
    differingPixels(
      same,
      bits(() => {}),
    ),
  ).toBe(0);
  expect(
    differingPixels(
      same,
      bits((copy) => (copy[0] = -0)),
    ),
  ).toBe(1);
  expect(
    differingPixels(
      same,
      bits((copy) => copy.set([2.0000002, 2, 2, 1, 3, 3, 3, 0.5], 4)),
    ),
  ).toBe(2);
  expect(() => differingPixels(same, same.subarray(16))).toThrow(expect.objectContaining({ code: 'bench/failed' }));
});
