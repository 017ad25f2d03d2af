import { buildBlas } from '@glanz/bvh';
import { describe, expect, it } from 'vitest';
import type { Scene } from '@glanz/scene';
import { prepareGeometry } from '../../src/geometry/prepare-geometry';
import type { HierarchyBuilder } from '../../src/options';

/** A strip of triangles with heights that no two strips share. */
function strip(triangles: number) {
  const positions = new Float32Array(3 * (triangles + 2));
  for (let i = 0; i < triangles + 2; i++) positions.set([i >> 1, i & 1, Math.sin(i * triangles)], 3 * i);
  return { positions, indices: Uint32Array.from({ length: 3 * triangles }, (_, i) => Math.floor(i / 3) + (i % 3)) };
}

const SIZES = [3, 400, 20, 90];
const scene = {
  meshes: SIZES.map(strip),
  // The third mesh is used twice, the last one not at all.
  instances: [0, 1, 2, 2].map((mesh, i) => ({
    mesh,
    material: 0,
    transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5 * i, 0, 0, 1],
  })),
  materials: [{}],
} as unknown as Scene;

/** Builds late, in the reverse order of the requests. */
function lateBuilder() {
  const asked: {
    triangles: number;
    signal: AbortSignal;
    onProgress: (done: number) => void;
    answer: () => void;
    fail: (error: Error) => void;
  }[] = [];
  const hierarchies: HierarchyBuilder = {
    buildBlas: (mesh, { signal, onProgress }) =>
      new Promise((resolve, reject) => {
        signal.addEventListener('abort', () => reject(signal.reason as Error));
        asked.push({
          triangles: mesh.indices.length / 3,
          signal,
          onProgress,
          answer: () => resolve(buildBlas(mesh)),
          fail: reject,
        });
      }),
  };
  return { asked, hierarchies };
}

describe('hierarchies built elsewhere', () => {
  it('give the same geometry as those built here, whatever the order they come in', async () => {
    const { asked, hierarchies } = lateBuilder();
    const reported: number[] = [];
    const pending = prepareGeometry(scene, { hierarchies, onProgress: (done) => reported.push(done) });
    expect(asked.map(({ triangles }) => triangles)).toEqual([400, 20, 3]);
    asked[0]?.onProgress(0.5);
    for (const { answer } of asked.toReversed()) answer();
    expect(await pending).toEqual(await prepareGeometry(scene));
    expect(reported).toEqual([200 / 423, 203 / 423, 223 / 423, 1].map((share) => expect.closeTo(share, 12)));
  });

  it('abort the rest when one fails', async () => {
    const { asked, hierarchies } = lateBuilder();
    const pending = prepareGeometry(scene, { hierarchies });
    const error = new Error('no memory');
    asked[1]?.fail(error);
    await expect(pending).rejects.toBe(error);
    expect(asked.map(({ signal }) => signal.reason)).toEqual([error, error, error]);
  });

  it('are aborted with the scene', async () => {
    const { asked, hierarchies } = lateBuilder();
    const control = new AbortController();
    const pending = prepareGeometry(scene, { hierarchies, signal: control.signal });
    const reason = new Error('another scene');
    control.abort(reason);
    await expect(pending).rejects.toBe(reason);
    expect(asked.every(({ signal }) => signal.reason === reason)).toBe(true);
    await expect(prepareGeometry(scene, { hierarchies, signal: control.signal })).rejects.toBe(reason);
    expect(asked).toHaveLength(3);
    await expect(prepareGeometry(scene, { signal: control.signal })).rejects.toBe(reason);
  });
});
