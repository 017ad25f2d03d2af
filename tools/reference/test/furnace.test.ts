import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import { afterEach, describe, expect, it } from 'vitest';
import { icosphere, measureFurnace, type FurnaceMaterial } from '../src/furnace';

afterEach(() => expectNoGpuErrors());

const average = (values: readonly number[]) => values.reduce((sum, value) => sum + value, 0) / values.length;

describe('white furnace', () => {
  it('has a ball that is round, closed and faces outwards', () => {
    const { positions, indices } = icosphere(3);
    expect(indices.length / 3).toBe(20 * 4 ** 3);
    const edges = new Map<string, number>();
    for (let i = 0; i < indices.length; i += 3) {
      const corner = [0, 1, 2].map((k) => indices[i + k]!);
      const [a, b, c] = corner.map((v) => Array.from(positions.subarray(3 * v, 3 * v + 3))) as [
        number[],
        number[],
        number[],
      ];
      const [u, v] = [b.map((x, k) => x - a[k]!), c.map((x, k) => x - a[k]!)];
      const outward =
        a[0]! * (u[1]! * v[2]! - u[2]! * v[1]!) +
        a[1]! * (u[2]! * v[0]! - u[0]! * v[2]!) +
        a[2]! * (u[0]! * v[1]! - u[1]! * v[0]!);
      expect(outward).toBeGreaterThan(0);
      for (let k = 0; k < 3; k++) edges.set(`${corner[k]},${corner[(k + 1) % 3]}`, 1);
    }
    for (const edge of edges.keys()) expect(edges.has(edge.split(',').reverse().join(','))).toBe(true);
    expect(positions.length / 3).toBe(edges.size / 2 - indices.length / 3 + 2);
  });

  // The renderer's issue is energy: within 1 % of all light comes back, at every roughness. Its ends, with GLANZ_FULL more
  // between them.
  const cases = (['diffuse', 'metal', 'dielectric'] as FurnaceMaterial[]).flatMap((material) =>
    (process.env['GLANZ_FULL'] === undefined ? [0.05, 1] : [0.05, 0.25, 0.5, 1]).map((roughness) => ({
      material,
      roughness,
    })),
  );
  it.each(cases)('$material, roughness $roughness, returns all light within 1 %', async ({ material, roughness }) => {
    const { whole } = await measureFurnace(await testDevice(), material, roughness, { size: 32, samples: 64, runs: 1 });
    expect(Math.abs(average(whole) - 1)).toBeLessThan(0.01);
  });

  it('sees the energy that single scattering loses', async () => {
    const { whole } = await measureFurnace(await testDevice(), 'metal', 1, {
      size: 32,
      samples: 64,
      runs: 1,
      multipleScattering: false,
    });
    expect(average(whole)).toBeLessThan(0.9);
  });
});
