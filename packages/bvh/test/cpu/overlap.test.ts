import { expect, test } from 'vitest';
import {
  BoxRegion,
  ConvexRegion,
  forEachOverlap,
  forEachOverlapInstances,
  frustumPlanes,
  INSIDE,
  OUTSIDE,
  overlapBatch,
  overlaps,
  overlapsInstances,
  SphereRegion,
  type Region,
} from '../../src/cpu/overlap';
import { buildBlas, buildTlas, BvhError, type Blas, type TriangleMesh } from '../../src/index';
import { cutInTwo } from '../cut';
import { affine, baked, direction, randomNumbers, sphere, strewn } from '../shapes';
import { boxPlanes, cornersOf, distanceTo, meetsPlanes } from './brute-shapes';

type Point = readonly [number, number, number];
type Corners = readonly [Point, Point, Point];

const found = (blas: Blas, mesh: TriangleMesh, region: Region): number[] => {
  const list: number[] = [];
  forEachOverlap(blas, mesh, region, (triangle) => void list.push(triangle));
  return list.sort((a, b) => a - b);
};

/** A WebGPU camera: at a place, looking along −z turned by a direction, 60° high. */
function viewProjection(eye: Point, forward: Point, near: number, far: number): number[] {
  const up: Point = Math.abs(forward[1]) < 0.9 ? [0, 1, 0] : [1, 0, 0];
  const cross = (a: Point, b: Point): Point => [
    a[1] * b[2] - a[2] * b[1],
    a[2] * b[0] - a[0] * b[2],
    a[0] * b[1] - a[1] * b[0],
  ];
  const x = cross(forward, up),
    length = Math.hypot(...x);
  const right = x.map((c) => c / length) as unknown as Point;
  const top = cross(right, forward);
  const f = 1 / Math.tan(Math.PI / 6);
  const row = (v: Point, s: number) => [
    s * v[0],
    s * v[1],
    s * v[2],
    -s * (v[0] * eye[0] + v[1] * eye[1] + v[2] * eye[2]),
  ];
  const depth = row(forward, 1);
  const rows = [
    row(right, f),
    row(top, f),
    Number.isFinite(far)
      ? depth.map((d, i) => (far / (far - near)) * (i === 3 ? d - near : d))
      : depth.map((d, i) => (i === 3 ? d - near : d)),
    depth,
  ];
  return [0, 1, 2, 3].flatMap((c) => rows.map((r) => r[c]!));
}

/** Regions of all kinds with what says by brute force whether a triangle is in. */
function regions(random: () => number): { region: Region; meets: (t: Corners) => boolean }[] {
  const point = (): Point => [2.4 * random() - 1.2, 2.4 * random() - 1.2, 2.4 * random() - 1.2];
  const size = () => 1.5 * 10 ** (-1.5 * random());
  const min = point(),
    max = min.map((x) => x + size()) as unknown as Point;
  const center = point(),
    radius = size();
  const eye = point();
  const m = viewProjection(eye, direction(random), 0.05, random() < 0.3 ? Infinity : 0.1 + 2 * random());
  const planes = frustumPlanes(m);
  const normal = direction(random);
  const half = [...normal, random() - 0.5];
  return [
    { region: new BoxRegion(min, max), meets: (t) => meetsPlanes(t, boxPlanes(min, max)) },
    { region: new SphereRegion(center, radius), meets: (t) => distanceTo(t, center) <= radius },
    { region: new ConvexRegion(planes), meets: (t) => meetsPlanes(t, planes) },
    {
      region: new ConvexRegion(half),
      meets: (t) => t.some((p) => p[0] * half[0]! + p[1] * half[1]! + p[2] * half[2]! + half[3]! >= 0),
    },
  ];
}

for (const seed of [231, 232, 233]) {
  test(`boxes, balls, frusta and half-spaces hold what brute force says (seed ${seed})`, () => {
    const random = randomNumbers(seed);
    const mesh = strewn(300, [0.05, 0.4, 2][seed % 3]!, random);
    const blas = buildBlas(mesh, { maxLeafTriangles: [1, 4, 16][seed % 3]! });
    const corners = cornersOf(mesh);
    const counts = [0, 0, 0, 0];
    for (let i = 0; i < 60; i++) {
      regions(random).forEach(({ region, meets }, kind) => {
        const expected = corners.flatMap((triangle, k) => (meets(triangle) ? [k] : []));
        expect(found(blas, mesh, region)).toEqual(expected);
        expect(overlaps(blas, mesh, region)).toBe(expected.length > 0);
        counts[kind]! += expected.length;
      });
    }
    for (const count of counts) expect(count).toBeGreaterThan(25);
  });
}

test('instances, mirrored and sheared ones too (seed 234)', () => {
  const random = randomNumbers(234);
  const meshes = [sphere(8), strewn(40, 0.5, random)];
  const parts = meshes.map((mesh) => ({ mesh, blas: buildBlas(mesh) }));
  const placed = Array.from({ length: 20 }, (_, i) => ({ ...parts[i % 2]!, transform: affine(random, 1) }));
  const tlas = buildTlas(placed.map(({ blas, transform }) => ({ bounds: blas.bounds, transform })));
  const corners = placed.map(({ mesh, transform }) => cornersOf(baked(mesh, transform)));
  let total = 0;
  for (let i = 0; i < 40; i++) {
    for (const { region, meets } of regions(random)) {
      const expected = corners.flatMap((triangles, instance) =>
        triangles.flatMap((triangle, k) => (meets(triangle) ? [`${instance}/${k}`] : [])),
      );
      const list: string[] = [];
      forEachOverlapInstances(tlas, placed, region, (triangle, instance) => void list.push(`${instance}/${triangle}`));
      expect(list.sort()).toEqual(expected.sort());
      expect(overlapsInstances(tlas, placed, region)).toBe(expected.length > 0);
      total += list.length;
    }
  }
  expect(total).toBeGreaterThan(1000);
});

test('batches of boxes, balls and frusta (seed 235)', () => {
  const random = randomNumbers(235);
  const mesh = strewn(200, 0.4, random);
  const blas = buildBlas(mesh);
  const number = () => 2 * random() - 1;
  const boxes = Array.from({ length: 30 }, () => [number(), number(), number()]).flatMap((p) => [
    ...p,
    ...p.map((x) => x + 0.6),
  ]);
  const balls = Array.from({ length: 30 }, () => [number(), number(), number(), 0.6 * random()]).flat();
  const frusta = Array.from({ length: 30 }, () => [
    ...frustumPlanes(viewProjection([number(), number(), number()], direction(random), 0.05, 1)),
  ]).flat();
  for (const [region, values] of [
    [new BoxRegion(), boxes],
    [new SphereRegion(), balls],
    [new ConvexRegion(new Float32Array(24)), frusta],
  ] as const) {
    const starts = new Uint32Array(31);
    const numbers = Float64Array.from(values);
    const total = overlapBatch(blas, mesh, region, numbers, { starts, triangle: new Uint32Array(0) });
    expect(total).toBeGreaterThan(100);
    const triangle = new Uint32Array(total);
    expect(overlapBatch(blas, mesh, region, numbers, { starts, triangle })).toBe(total);
    for (let i = 0; i < 30; i++) {
      region.set(values, i * region.numbers);
      expect([...triangle.subarray(starts[i], starts[i + 1])].sort((a, b) => a - b)).toEqual(found(blas, mesh, region));
    }
    expect(starts[30]).toBe(total);
  }
  expect(() =>
    overlapBatch(blas, mesh, new BoxRegion(), new Float32Array(7), {
      starts: new Uint32Array(9),
      triangle: new Uint32Array(1),
    }),
  ).toThrow(BvhError);
  expect(() =>
    overlapBatch(blas, mesh, new BoxRegion(), new Float32Array(12), {
      starts: new Uint32Array(2),
      triangle: new Uint32Array(1),
    }),
  ).toThrow(/need 3/);
});

test('borders belong to a region; degenerate triangles are found', () => {
  const mesh = {
    positions: new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0, 2, 2, 2, 2, 2, 2, 2, 2, 2, 5, 0, 0, 6, 0, 0, 7, 0, 0]),
  };
  const blas = buildBlas(mesh, { maxLeafTriangles: 1 });
  expect(found(blas, mesh, new BoxRegion([1, -1, -1], [2, 2, 2]))).toEqual([0, 1]);
  expect(found(blas, mesh, new BoxRegion([0.25, 0.25, 0], [0.25, 0.25, 0]))).toEqual([0]);
  expect(found(blas, mesh, new BoxRegion([0.6, 0.6, -1], [0.9, 0.9, 1]))).toEqual([]);
  expect(found(blas, mesh, new BoxRegion([6.2, -1, -1], [6.4, 1, 1]))).toEqual([2]);
  expect(found(blas, mesh, new SphereRegion([6, 0, -5], 5))).toEqual([2]);
  expect(found(blas, mesh, new SphereRegion([2, 2, 2], 0))).toEqual([1]);
  expect(found(blas, mesh, new ConvexRegion([1, 0, 0, -2]))).toEqual([1, 2]);
  expect(found(blas, mesh, new ConvexRegion([0, 0, 1, 0]))).toEqual([0, 1, 2]);
});

test('a region of the caller’s own, early ends, further questions, nothing there', () => {
  const mesh = sphere(16);
  const blas = buildBlas(mesh);
  const boxes: number[] = [];
  // Everything that lies above a height, known by its box alone.
  const above: Region = {
    box: (x0, y0, z0, x1, y1) => {
      boxes.push(y0);
      return y1 < 0.5 ? OUTSIDE : INSIDE;
    },
    triangle: () => {
      throw new Error('no triangle needs to be asked about');
    },
  };
  const top = found(blas, mesh, above);
  expect(top.length).toBeGreaterThan(20);
  expect(boxes.length).toBeLessThan(2 * blas.nodeCount);
  let calls = 0;
  forEachOverlap(blas, mesh, new SphereRegion([0, 0, 0], 2), () => {
    // Other queries do not disturb the one under way.
    expect(overlaps(blas, mesh, new SphereRegion([0, 1, 0], 0.1))).toBe(true);
    return ++calls === 5;
  });
  expect(calls).toBe(5);
  expect(found(blas, mesh, new SphereRegion([0, 0, 0], 2))).toHaveLength(mesh.indices.length / 3);
  const none = { positions: new Float32Array(0) };
  expect(overlaps(buildBlas(none), none, above)).toBe(false);
  expect(overlapsInstances(buildTlas([]), [], above)).toBe(false);
  expect(() => new ConvexRegion([1, 2, 3])).toThrow(BvhError);
});

test('triangles that are in several leaves are reported once (seed 236)', () => {
  const random = randomNumbers(236);
  const mesh = strewn(200, 1, random);
  const blas = cutInTwo(mesh),
    whole = buildBlas(mesh);
  let total = 0;
  for (let i = 0; i < 30; i++) {
    for (const { region } of regions(random)) {
      const expected = found(whole, mesh, region);
      expect(found(blas, mesh, region)).toEqual(expected);
      total += expected.length;
    }
  }
  expect(total).toBeGreaterThan(1000);
  const spheres = Float32Array.of(0, 0, 0, 9, 0, 0, 0, 9);
  expect(
    overlapBatch(blas, mesh, new SphereRegion(), spheres, { starts: new Uint32Array(3), triangle: new Uint32Array(0) }),
  ).toBe(400);
});
