import { describe, expect, it } from 'vitest';
import { buildBlas, buildTlas, packTriangles } from '../../src/index';
import { bvhInstanceStruct, bvhNodeStruct, packHierarchy } from '../../src/wgsl/index';
import { widenBlas, widenTlas } from '../../src/wide/index';
import { bvhNodeStruct as wideNodeStruct } from '../../src/wgsl/wide/index';
import { sphere } from '../shapes';

const shifted = (x: number) => [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, 0, 0, 1];
const flat = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1];
const ball = sphere(12),
  dot = { positions: Float32Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0) };
const [ballBlas, dotBlas] = [buildBlas(ball), buildBlas(dot)];

describe('packHierarchy', () => {
  it('has nodes and triangles of a shared BLAS once, and says of each instance that is there where they begin', () => {
    const parts = [
      { blas: ballBlas, mesh: ball },
      { blas: dotBlas, mesh: dot },
      { blas: ballBlas, mesh: ball },
      { blas: ballBlas, mesh: ball },
    ];
    const tlas = buildTlas(
      parts.map(({ blas }, i) => ({ bounds: blas.bounds, transform: i === 2 ? flat : shifted(5 * i) })),
    );
    const { nodes, triangles, instances } = packHierarchy(tlas, parts);
    const [ballCount, dotCount] = [ballBlas.triangleIndices.length, 1];
    expect(nodes.byteLength).toBe((tlas.nodeCount + ballBlas.nodeCount + dotBlas.nodeCount) * bvhNodeStruct.size);
    expect(triangles.length).toBe(12 * (ballCount + dotCount));
    expect(instances.byteLength).toBe(3 * bvhInstanceStruct.size);
    const f = new Float32Array(instances),
      u = new Uint32Array(instances),
      words = new Uint32Array(nodes);
    const seen = [0, 1, 2].map((slot) => ({
      id: u[16 * slot + 14]!,
      node: u[16 * slot + 12]!,
      triangle: u[16 * slot + 13]!,
      x: f[16 * slot + 3]!,
    }));
    expect(seen.map(({ id }) => id).sort()).toEqual([0, 1, 3]);
    for (const { id, node, triangle, x } of seen) {
      const { blas, mesh } = parts[id]!;
      expect(x).toBeCloseTo(-5 * id, 6);
      expect(words.subarray(16 * node, 16 * (node + blas.nodeCount))).toEqual(
        new Uint32Array(blas.nodes.buffer, 0, 16 * blas.nodeCount),
      );
      expect(triangles.subarray(12 * triangle, 12 * (triangle + blas.triangleIndices.length))).toEqual(
        packTriangles(blas, mesh),
      );
    }
    expect(words.subarray(0, 16 * tlas.nodeCount)).toEqual(new Uint32Array(tlas.nodes.buffer, 0, 16 * tlas.nodeCount));
  });

  it('takes the wide layout, and refuses both in one', () => {
    const tlas = buildTlas([{ bounds: ballBlas.bounds, transform: shifted(0) }]);
    const wide = widenBlas(ballBlas);
    expect(packHierarchy(widenTlas(tlas), [{ blas: wide, mesh: ball }]).nodes.byteLength).toBe(
      (1 + wide.nodeCount) * wideNodeStruct.size,
    );
    expect(() => packHierarchy(tlas, [{ blas: wide, mesh: ball }])).toThrow(
      expect.objectContaining({ code: 'bvh/layout' }) as Error,
    );
    expect(() => packHierarchy(tlas, [])).toThrow(
      expect.objectContaining({
        code: 'bvh/parts',
        message: 'The TLAS has an instance 0, but there are 0 parts.',
      }) as Error,
    );
  });

  it('gives buffers that can be bound where there is nothing', () => {
    const { nodes, triangles, instances } = packHierarchy(buildTlas([]), []);
    expect([nodes.byteLength, triangles.byteLength, instances.byteLength]).toEqual([64, 48, 64]);
  });
});
