import { describe, expect, test } from 'vitest';
import { best, bestSplit } from '../../src/builders/best';
import { fast } from '../../src/builders/fast';
import { buildBlas, buildTlas, closestHit, packTriangles, type TriangleMesh } from '../../src/index';
import { WIDE_BLAS_DEPTH, WIDE_TLAS_DEPTH, WIDE_WORDS } from '../../src/wide/layout';
import { anyHitWide, closestHitWide, widenBlas, widenTlas, type WideNodes } from '../../src/wide/index';
import { bruteForce, direction, randomNumbers, sphere, strewn } from '../shapes';

/**
 * Walks a wide tree in the numbers that the shader sees. Every primitive is in one leaf, inside all boxes above it.
 * Gives the depth.
 */
function check({ nodes, nodeCount }: WideNodes, count: number, boxOf: (place: number) => ArrayLike<number>): number {
  expect(nodes.length).toBe(nodeCount * WIDE_WORDS);
  const bytes = new Uint8Array(nodes.buffer),
    floats = new Float32Array(nodes.buffer);
  const seen = new Uint8Array(count),
    reached = new Uint8Array(nodeCount);
  let deepest = 0;
  const walk = (node: number, depth: number, boxes: number[][]) => {
    if (reached[node]) throw new Error(`node ${node} is reached twice`);
    reached[node] = 1;
    deepest = Math.max(deepest, depth);
    const at = WIDE_WORDS * node;
    let inner = 0;
    for (let slot = 0; slot < 8; slot++) {
      const kind = bytes[4 * at + 24 + slot]!;
      if (kind === 0) continue;
      const box = [0, 1, 2, 3, 4, 5].map(
        (k) => floats[at + (k % 3)]! + bytes[4 * at + 32 + 8 * k + slot]! * 2 ** (bytes[4 * at + 12 + (k % 3)]! - 127),
      );
      if (kind === 0xe0) {
        expect((bytes[4 * at + 15]! >> slot) & 1).toBe(1);
        walk(nodes[at + 4]! + inner++, depth + 1, [...boxes, box]);
        continue;
      }
      for (let i = 0; i < kind >> 5; i++) {
        const place = nodes[at + 5]! + (kind & 31) + i;
        if (seen[place]) throw new Error(`primitive ${place} is in two leaves`);
        seen[place] = 1;
        const own = boxOf(place);
        for (const b of [...boxes, box])
          for (let k = 0; k < 3; k++)
            if (own[k]! < b[k]! || own[3 + k]! > b[3 + k]!)
              throw new Error(
                `primitive ${place} reaches out of a box above it: ${own[k]} ${own[3 + k]} not in ${b[k]} ${b[3 + k]}`,
              );
      }
    }
  };
  walk(0, 1, []);
  expect(seen.every((s) => s === 1)).toBe(true);
  expect(reached.every((s) => s === 1)).toBe(true);
  return deepest;
}

function checkWide(mesh: TriangleMesh, options = {}): number {
  const blas = buildBlas(mesh, options),
    wide = widenBlas(blas);
  expect([...wide.triangleIndices].sort((a, b) => a - b)).toEqual([...blas.triangleIndices].sort((a, b) => a - b));
  const packed = packTriangles(wide, mesh);
  return check(wide, wide.triangleIndices.length, (place) => [
    ...[0, 1, 2].map((k) => Math.min(...[0, 4, 8].map((c) => packed[12 * place + c + k]!))),
    ...[0, 1, 2].map((k) => Math.max(...[0, 4, 8].map((c) => packed[12 * place + c + k]!))),
  ]);
}

describe('widenBlas', () => {
  test('every triangle is in one leaf, inside all boxes above it, whatever the leaves and the builder (seed 1)', () => {
    const random = randomNumbers(1);
    for (const count of [1, 2, 3, 5, 17, 100, 3000]) {
      for (const maxLeafTriangles of [1, 3, 4, 7, 16]) {
        for (const builder of [fast, 'balanced', best] as const)
          expect(checkWide(strewn(count, 0.3, random), { maxLeafTriangles, builder })).toBeLessThanOrEqual(
            WIDE_BLAS_DEPTH,
          );
      }
    }
  });

  test('is bounded in depth at adversarial inputs', () => {
    const doubling = Float32Array.from(
      { length: 1080 },
      (_, i) => [0, 0, 0, 1, 0, 0, 0, 1, 0][i % 9]! * 2 ** (Math.floor(i / 9) - 60),
    );
    const same = Float32Array.from({ length: 90_000 }, (_, i) => [0, 0, 0, 1, 0, 0, 0, 1, 0][i % 9]!);
    const flat = Float32Array.from({ length: 9000 }, (_, i) => (i % 3 === 1 ? 0 : Math.cos(i * i * 0.7)));
    const steps: number[] = [];
    for (let i = 0; i < 120; i++) {
      const x = 2 ** i * 1e-20;
      steps.push(x, 0, 0, x * 1.01, 0, 0, x, x, 0);
    }
    for (const positions of [doubling, same, flat, new Float32Array(steps)])
      for (const maxLeafTriangles of [1, 4, 16])
        expect(checkWide({ positions }, { maxLeafTriangles })).toBeLessThanOrEqual(WIDE_BLAS_DEPTH);
  });

  test('takes less than half the memory', () => {
    const blas = buildBlas(sphere(96));
    expect(widenBlas(blas).nodes.byteLength).toBeLessThan(0.5 * blas.nodes.byteLength);
  });

  test('no triangles: a tree that is never hit', () => {
    const mesh = { positions: new Float32Array(0) };
    expect(
      closestHitWide(widenBlas(buildBlas(mesh)), mesh, { origin: [0, 0, 0], direction: [1, 1, 1] }),
    ).toBeUndefined();
  });

  test('holds every instance of a TLAS', () => {
    const random = randomNumbers(2);
    for (const count of [1, 2, 9, 1000]) {
      const instances = Array.from({ length: count }, () => ({
        bounds: { min: Float32Array.of(-1, -1, -1), max: Float32Array.of(1, 1, 1) },
        transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 50 * random(), 50 * random(), 50 * random(), 1],
      }));
      const wide = widenTlas(buildTlas(instances));
      const depth = check(wide, count, (place) =>
        [0, 1, 2, 3, 4, 5].map(
          (k) => instances[wide.instanceOrder[place]!]!.transform[12 + (k % 3)]! + (k < 3 ? -1 : 1),
        ),
      );
      expect(depth).toBeLessThanOrEqual(WIDE_TLAS_DEPTH);
    }
  });
});

for (const [name, make, options] of [
  ['strewn', (r: () => number) => strewn(500, 0.4, r), {}],
  ['a sphere', () => sphere(24), { maxLeafTriangles: 16 }],
  ['pieces', (r: () => number) => strewn(500, 0.9, r), { builder: bestSplit }],
] as const) {
  test(`finds what brute force and the other layout find: ${name} (seed 3)`, () => {
    const random = randomNumbers(3);
    const mesh = make(random),
      blas = buildBlas(mesh, options),
      wide = widenBlas(blas);
    let hits = 0;
    for (let i = 0; i < 1500; i++) {
      const origin = direction(random).map((x) => 3 * x);
      const ray = {
        origin,
        direction:
          i % 10 === 0
            ? [0, 0, 0].with(i % 3, -Math.sign(origin[i % 3]!))
            : origin.map((x) => 1.6 * random() - 0.8 - x),
      };
      const expected = bruteForce(mesh, ray.origin, ray.direction),
        hit = closestHitWide(wide, mesh, ray);
      expect(hit).toEqual(closestHit(blas, mesh, ray));
      expect(hit?.triangle).toBe(expected?.triangle);
      expect(anyHitWide(wide, mesh, ray)).toBe(expected !== undefined);
      if (!expected) continue;
      hits++;
      expect(anyHitWide(wide, mesh, { ...ray, tMax: 0.9999 * hit!.t })).toBe(false);
      expect(anyHitWide(wide, mesh, { ...ray, tMax: 1.0001 * hit!.t })).toBe(true);
    }
    expect(hits).toBeGreaterThan(200);
  });
}
