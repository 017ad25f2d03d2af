import { describe, expect, test } from 'vitest';
import { BLAS_MAX_DEPTH, buildBlas, BvhError, closestHit, packTriangles } from '../src/index';
import { bvhStatistics } from '../src/statistics';
import { randomNumbers, sphere, strewn } from './shapes';
import { checkBlas } from './structure';

const code = (f: () => unknown) => {
  try {
    f();
  } catch (error) {
    expect(error).toBeInstanceOf(BvhError);
    return (error as BvhError).code;
  }
  return undefined;
};

describe('buildBlas', () => {
  test('a tree stays what it is when others are built', () => {
    for (const triangles of [1, 2, 3, 5, 8, 16, 100]) {
      const mesh = strewn(triangles, 0.1, randomNumbers(triangles));
      const tree = buildBlas(mesh);
      const nodes = tree.nodes.slice();
      for (const [seed, more] of [
        [7, triangles],
        [8, 2 * triangles],
        [9, triangles],
      ] as const)
        buildBlas(strewn(more, 0.1, randomNumbers(seed)));
      expect(tree.nodes.every((value, i) => Object.is(value, nodes[i]))).toBe(true);
    }
  });

  for (const seed of [1, 2, 3]) {
    test(`every triangle is in one leaf, inside all boxes above it (seed ${seed})`, () => {
      const random = randomNumbers(seed);
      for (const count of [1, 2, 3, 4, 5, 17, 100, 2000]) {
        for (const maxLeafTriangles of [1, 4, 16]) {
          const mesh = strewn(count, 0.3, random);
          checkBlas(buildBlas(mesh, { maxLeafTriangles }), mesh, maxLeafTriangles);
        }
      }
    });
  }

  test('is deterministic', () => {
    const mesh = strewn(5000, 0.1, randomNumbers(7));
    expect(buildBlas(mesh)).toEqual(buildBlas(mesh));
  });

  test('takes vertices in threes without indices, and 16-bit indices', () => {
    const mesh = strewn(300, 0.2, randomNumbers(8));
    const blas = buildBlas(mesh);
    expect(buildBlas({ positions: mesh.positions })).toEqual(blas);
    expect(buildBlas({ positions: mesh.positions, indices: Uint16Array.from(mesh.indices) })).toEqual(blas);
  });

  test('surface area cost is well below that of halving along the longest axis', () => {
    const mesh = sphere(64);
    const statistics = bvhStatistics(buildBlas(mesh));
    // A median-split tree of this sphere, built by brute force here.
    const count = mesh.indices.length / 3;
    const boxes = Array.from({ length: count }, (_, i) => {
      const corners = [0, 1, 2].map((c) => mesh.indices[3 * i + c]! * 3);
      return [
        ...[0, 1, 2].map((k) => Math.min(...corners.map((c) => mesh.positions[c + k]!))),
        ...[0, 1, 2].map((k) => Math.max(...corners.map((c) => mesh.positions[c + k]!))),
      ];
    });
    const union = (list: number[]) =>
      list.reduce(
        (b, i) => b.map((x, k) => (k < 3 ? Math.min(x, boxes[i]![k]!) : Math.max(x, boxes[i]![k]!))),
        [1, 1, 1, -1, -1, -1].map((s) => s * Infinity),
      );
    const area = ([a, b, c, x, y, z]: number[]) =>
      (x! - a!) * (y! - b!) + (y! - b!) * (z! - c!) + (z! - c!) * (x! - a!);
    const whole = area(union(boxes.map((_, i) => i)));
    const cost = (list: number[]): number => {
      if (list.length <= 4) return (area(union(list)) / whole) * list.length;
      const b = union(list),
        extents = [0, 1, 2].map((k) => b[3 + k]! - b[k]!),
        axis = extents.indexOf(Math.max(...extents));
      const sorted = list.toSorted(
        (i, j) => boxes[i]![axis]! + boxes[i]![3 + axis]! - boxes[j]![axis]! - boxes[j]![3 + axis]!,
      );
      return area(b) / whole + cost(sorted.slice(0, sorted.length / 2)) + cost(sorted.slice(sorted.length / 2));
    };
    expect(statistics.sahCost).toBeLessThan(cost(boxes.map((_, i) => i)));
    expect(statistics.leafSizes.reduce((sum, n, size) => sum + n * size, 0)).toBe(count);
  });

  test('10,000 identical triangles make a bounded tree of small leaves', () => {
    const positions = Float32Array.from({ length: 90000 }, (_, i) => [0, 0, 0, 1, 0, 0, 0, 1, 0][i % 9]!);
    const mesh = { positions };
    expect(checkBlas(buildBlas(mesh), mesh)).toBeLessThan(16);
  });

  test('positions that double from one triangle to the next cannot exceed the depth', () => {
    // Each split by area would cut off one triangle.
    const positions: number[] = [];
    for (let i = 0; i < 120; i++) {
      const x = 2 ** i * 1e-10;
      positions.push(x, 0, 0, x * 1.01, 0, 0, x, x, 0);
    }
    const mesh = { positions: new Float32Array(positions) };
    expect(checkBlas(buildBlas(mesh, { maxLeafTriangles: 1 }), mesh, 1)).toBeLessThanOrEqual(BLAS_MAX_DEPTH);
  });

  test('triangles with NaN or infinity are left out, the rest is found', () => {
    const mesh = strewn(50, 0.3, randomNumbers(9));
    mesh.positions[9 * 7 + 4] = NaN;
    mesh.positions[9 * 20] = Infinity;
    const blas = buildBlas(mesh);
    expect([...blas.triangleIndices].sort((a, b) => a - b)).toEqual(
      Array.from({ length: 50 }, (_, i) => i).filter((i) => i !== 7 && i !== 20),
    );
    checkBlas(blas, mesh);
    expect([...blas.bounds.min, ...blas.bounds.max].every(Number.isFinite)).toBe(true);
  });

  test('no triangles: a tree that is never hit', () => {
    const mesh = { positions: new Float32Array(0), indices: new Uint32Array(0) };
    const blas = buildBlas(mesh);
    expect(blas.triangleIndices).toHaveLength(0);
    expect(blas.bounds.min[0]).toBeGreaterThan(blas.bounds.max[0]!);
    expect(closestHit(blas, mesh, { origin: [0, 0, 0], direction: [1, 1, 1] })).toBeUndefined();
  });

  test('wrong arrays are refused', () => {
    expect(code(() => buildBlas({ positions: new Float32Array(4) }))).toBe('bvh/positions');
    expect(code(() => buildBlas({ positions: new Float32Array(12) }))).toBe('bvh/indices');
    expect(code(() => buildBlas({ positions: new Float32Array(9), indices: new Uint32Array([0, 1]) }))).toBe(
      'bvh/indices',
    );
    expect(code(() => buildBlas({ positions: new Float32Array(9), indices: new Uint32Array([0, 1, 3]) }))).toBe(
      'bvh/indices',
    );
    expect(code(() => buildBlas({ positions: new Float32Array(9) }, { maxLeafTriangles: 17 }))).toBe('bvh/options');
    expect(code(() => buildBlas({ positions: new Float32Array(9) }, { bins: 1 }))).toBe('bvh/options');
  });
});

test('packTriangles gives vertices and ids in leaf order', () => {
  const mesh = strewn(40, 0.3, randomNumbers(11));
  const blas = buildBlas(mesh);
  const packed = packTriangles(blas, mesh);
  const ids = new Uint32Array(packed.buffer);
  for (let i = 0; i < 40; i++) {
    const triangle = blas.triangleIndices[i]!;
    expect(ids[12 * i + 3]).toBe(triangle);
    for (let c = 0; c < 3; c++)
      expect(packed.subarray(12 * i + 4 * c, 12 * i + 4 * c + 3)).toEqual(
        mesh.positions.subarray(9 * triangle + 3 * c, 9 * triangle + 3 * c + 3),
      );
  }
});
