import { expect, test } from 'vitest';
import { buildBlas, type TriangleMesh } from '../src/index';
import { refitBlas } from '../src/refit';
import { REBUILD_ABOVE, RefitQuality } from '../src/refit-quality';
import { randomNumbers, sphere, strewn } from './shapes';
import { work } from './work';

type Mesh = TriangleMesh & { indices: Uint32Array };

/** The mesh with each vertex moved. */
function moved(mesh: Mesh, move: (x: number, y: number, z: number, triangle: number) => readonly number[]): Mesh {
  const positions = new Float32Array(mesh.positions.length);
  for (let i = 0; i < positions.length; i += 3)
    positions.set(move(mesh.positions[i]!, mesh.positions[i + 1]!, mesh.positions[i + 2]!, Math.floor(i / 9)), i);
  return { positions, indices: mesh.indices };
}

/** Triangles that fly apart, and a body that is twisted. */
function deformations(seed: number): { name: string; mesh: Mesh; at: (strength: number) => Mesh }[] {
  const random = randomNumbers(seed);
  const loose = strewn(3000, 0.1, random),
    body = sphere(64);
  const flight = Float32Array.from({ length: 9000 }, () => random() - 0.5);
  return [
    {
      name: 'flying apart',
      mesh: loose,
      at: (s) =>
        moved(loose, (x, y, z, i) => [
          x + 0.3 * s * flight[3 * i]!,
          y + 0.3 * s * flight[3 * i + 1]!,
          z + 0.3 * s * flight[3 * i + 2]!,
        ]),
    },
    {
      name: 'twist',
      mesh: body,
      at: (s) =>
        moved(body, (x, y, z) => [
          x * Math.cos(s * y) - z * Math.sin(s * y),
          y,
          x * Math.sin(s * y) + z * Math.cos(s * y),
        ]),
    },
  ];
}

for (const { name, mesh, at } of deformations(25)) {
  test(`${name}: the ratio is that of the work per ray, counted (seed 25)`, () => {
    const blas = buildBlas(mesh);
    const quality = new RefitQuality(blas);
    const before = work(blas, mesh, 26);
    expect(quality.ratio(blas)).toBe(1);
    let last = 1;
    for (const strength of [0.5, 1, 2, 4]) {
      const now = at(strength);
      refitBlas(blas, now);
      const ratio = quality.ratio(blas),
        counted = work(blas, now, 26) / before;
      expect(ratio).toBeGreaterThan(last);
      expect(ratio / counted).toBeGreaterThan(0.75);
      expect(ratio / counted).toBeLessThan(1.25);
      expect(quality.shouldRebuild(blas)).toBe(ratio > REBUILD_ABOVE);
      last = ratio;
    }
    expect(last).toBeGreaterThan(REBUILD_ABOVE);
  });
}

test('rebuilt when advised, triangles that fly apart never cost much more than in a fresh tree (seed 27)', () => {
  const [{ mesh, at }] = deformations(27) as [ReturnType<typeof deformations>[number]];
  let blas = buildBlas(mesh),
    quality = new RefitQuality(blas),
    rebuilt = 0;
  for (let strength = 0.25; strength <= 4; strength += 0.25) {
    const now = at(strength);
    refitBlas(blas, now);
    if (quality.shouldRebuild(blas)) {
      const tired = work(blas, now, 28);
      quality = new RefitQuality((blas = buildBlas(now)));
      expect(work(blas, now, 28)).toBeLessThan(tired / 1.3);
      expect(quality.shouldRebuild(blas)).toBe(false);
      rebuilt++;
    }
    expect(work(blas, now, 28)).toBeLessThan(1.75 * work(buildBlas(now), now, 28));
  }
  expect(rebuilt).toBeGreaterThan(1);
  expect(rebuilt).toBeLessThan(8);
});

test('moving, turning and growing as a whole asks for no rebuild', () => {
  const mesh = sphere(48);
  const blas = buildBlas(mesh);
  const quality = new RefitQuality(blas);
  for (let i = 0; i < 8; i++) {
    const c = Math.cos(i),
      s = Math.sin(i);
    refitBlas(
      blas,
      moved(mesh, (x, y, z) => [3 ** i * (c * x - s * y) + 5 * i, 3 ** i * (s * x + c * y), 3 ** i * z]),
    );
    expect(quality.shouldRebuild(blas)).toBe(false);
  }
});
