import { describe, expect, it } from 'vitest';
import { CadError, cadFormat, readCad, type CadPart } from '../src/index';
import { openOcct } from '../src/node';
import { ASSEMBLY, CUBE, stepBytes } from './step';

/** By the divergence theorem; parts are closed, and their triangles point outwards. */
function volume({ positions, indices }: CadPart): number {
  let sum = 0;
  for (let i = 0; i < indices.length; i += 3) {
    const [a, b, c] = [0, 1, 2].map((k) =>
      Array.from(positions.subarray(3 * indices[i + k]!, 3 * indices[i + k]! + 3)),
    ) as [number[], number[], number[]];
    sum +=
      a[0]! * (b[1]! * c[2]! - b[2]! * c[1]!) +
      a[1]! * (b[2]! * c[0]! - b[0]! * c[2]!) +
      a[2]! * (b[0]! * c[1]! - b[1]! * c[0]!);
  }
  return sum / 6;
}

describe('an assembly', () => {
  it('has its parts in their places, with names, paths and colours', async () => {
    const { parts } = await readCad(stepBytes(ASSEMBLY), { openOcct });
    expect(parts.length).toBe(18);
    const count = new Map<string, number>();
    for (const { name } of parts) count.set(name, (count.get(name) ?? 0) + 1);
    expect(Object.fromEntries(count)).toEqual({ nut: 8, bolt: 6, 'l-bracket': 2, plate: 1, rod: 1 });
    const nut = parts.find(({ name }) => name === 'nut')!;
    expect(nut.path).toEqual(['as1', 'rod-assembly']);
    expect(nut.ranges).toEqual([{ from: 0, to: nut.indices.length / 3, color: [1, 0, 0] }]);
    // The plate of this test case is 180 × 150 × 20 mm less its holes.
    const plate = parts.find(({ name }) => name === 'plate')!;
    const extent = [0, 1, 2].map((k) => {
      const values = Array.from({ length: plate.positions.length / 3 }, (_, v) => plate.positions[3 * v + k]!);
      return Math.round(1000 * (Math.max(...values) - Math.min(...values)));
    });
    expect(extent).toEqual([180, 150, 20]);
    expect(volume(plate)).toBeGreaterThan(0.9 * 0.18 * 0.15 * 0.02);
    expect(volume(plate)).toBeLessThan(0.18 * 0.15 * 0.02);
    for (const { normals } of parts)
      for (let i = 0; i < normals!.length; i += 3)
        expect(Math.hypot(normals![i]!, normals![i + 1]!, normals![i + 2]!)).toBeCloseTo(1, 4);
  });

  it('has more triangles the closer they must lie to the surface', async () => {
    const count = async (metres: number) =>
      (await readCad(stepBytes(ASSEMBLY), { openOcct, tolerance: { metres }, angularTolerance: 1 })).parts.reduce(
        (sum, { indices }) => sum + indices.length / 3,
        0,
      );
    const [coarse, fine] = [await count(0.002), await count(0.00002)];
    expect(fine).toBeGreaterThan(2 * coarse);
  });
});

// Single precision: seven digits.
it('a cube has the volume of a cube', async () => {
  const { parts } = await readCad(stepBytes(CUBE), { openOcct });
  expect(parts.length).toBe(1);
  expect(parts[0]!.indices.length / 3).toBe(12);
  const edge = Math.cbrt(volume(parts[0]!));
  const values = Array.from(parts[0]!.positions);
  expect(edge).toBeCloseTo(
    Math.max(...values.filter((_, i) => i % 3 === 0)) - Math.min(...values.filter((_, i) => i % 3 === 0)),
    7,
  );
});

it('what is no CAD file, or a broken one, is a typed error', async () => {
  const code = (bytes: Uint8Array, options = {}) =>
    readCad(bytes, { openOcct, ...options }).then(
      () => 'none',
      (error: unknown) => {
        if (error instanceof CadError) return error.code;
        throw error;
      },
    );
  expect(await code(new TextEncoder().encode('solid stl'))).toBe('cad/format');
  expect(await code(new Uint8Array(0))).toBe('cad/format');
  expect(await code(new TextEncoder().encode('ISO-10303-21; garbage'))).toBe('cad/unreadable');
  expect(await code(stepBytes(CUBE).subarray(0, 3000))).toMatch(/^cad\/(unreadable|no-shapes)$/);
  expect(await code(stepBytes(CUBE), { tolerance: { metres: 0 } })).toBe('cad/option');
  expect(cadFormat(stepBytes(CUBE))).toBe('step');
});
