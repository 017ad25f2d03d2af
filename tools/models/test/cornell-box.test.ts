import { describe, expect, it } from 'vitest';
import { createCornellBox } from '../src/index';
import { inspect } from './solids';

describe('Cornell box', () => {
  const scene = createCornellBox();
  const mesh = (name: string) => scene.meshes.find((one) => one.name === name)!;

  it('has 36 triangles and one light', () => {
    expect(scene.meshes.reduce((sum, one) => sum + one.indices.length / 3, 0)).toBe(36);
    expect(scene.materials.filter(({ parameters }) => (parameters.emission_luminance ?? 0) > 0)).toHaveLength(1);
  });

  it('has blocks that are closed and face outwards', () => {
    for (const [name, volume] of [
      ['Short block', 0.3 ** 3],
      ['Tall block', 0.3 * 0.3 * 0.6],
    ] as const) {
      const found = inspect(mesh(name));
      expect(found.openEdges).toBe(0);
      expect(found.volume).toBeCloseTo(volume, 6);
    }
  });

  it('has walls that face into the room and a light that shines down', () => {
    const centre = [0, 0.5, 0];
    for (const name of ['Floor, ceiling and back wall', 'Left wall', 'Right wall', 'Light']) {
      const { positions: p, indices } = mesh(name);
      for (let i = 0; i < indices.length; i += 3) {
        const [a, b, c] = [0, 1, 2].map((k) =>
          Array.from(p.subarray(3 * indices[i + k]!, 3 * indices[i + k]! + 3)),
        ) as [number[], number[], number[]];
        const [u, v] = [b.map((x, k) => x - a[k]!), c.map((x, k) => x - a[k]!)];
        const n = [u[1]! * v[2]! - u[2]! * v[1]!, u[2]! * v[0]! - u[0]! * v[2]!, u[0]! * v[1]! - u[1]! * v[0]!];
        expect(
          n.reduce((sum, x, k) => sum + x * (centre[k]! - a[k]!), 0),
          name,
        ).toBeGreaterThan(0);
      }
    }
  });
});
