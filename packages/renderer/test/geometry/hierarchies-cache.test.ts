import { buildBlas } from '@glanz/bvh';
import { BlasCache, type BlasStore } from '@glanz/bvh/cache';
import { expect, it } from 'vitest';
import type { Scene } from '@glanz/scene';
import type { HierarchyBuilder } from '../../src/options';
import { prepareGeometry } from '../../src/geometry/prepare-geometry';

it('hierarchies may come out of a cache: the same geometry, and nothing is built the second time', async () => {
  const kept = new Map<string, ArrayBuffer>();
  const store: BlasStore = { get: async (key) => kept.get(key), set: async (key, bytes) => void kept.set(key, bytes) };
  const strip = (triangles: number) => ({
    positions: Float32Array.from({ length: 3 * (triangles + 2) }, (_, i) => Math.sin(i * i + triangles)),
    indices: Uint32Array.from({ length: 3 * triangles }, (_, i) => Math.floor(i / 3) + (i % 3)),
  });
  const scene = {
    meshes: [strip(50), strip(300)],
    instances: [0, 1].map((mesh) => ({
      mesh,
      material: 0,
      transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 3 * mesh, 0, 0, 1],
    })),
    materials: [{}],
  } as unknown as Scene;
  const first = new BlasCache(store, { buildBlas }, { minTriangles: 0 });
  // As the option of PathTracer.create wants it.
  const hierarchies: HierarchyBuilder = first;
  const built = await prepareGeometry(scene, { hierarchies });
  await first.written();
  expect(built).toEqual(await prepareGeometry(scene));
  const progress: number[] = [];
  const second = new BlasCache(
    store,
    {
      buildBlas: () => {
        throw new Error('nothing is to be built');
      },
    },
    { minTriangles: 0 },
  );
  expect(await prepareGeometry(scene, { hierarchies: second, onProgress: (done) => progress.push(done) })).toEqual(
    built,
  );
  expect([first.misses, second.hits, progress.at(-1)]).toEqual([2, 2, 1]);
});
