import { describe, expect, test } from 'vitest';
import { buildBlasAsync } from '../src/async';
import { best, bestSplit } from '../src/builders/best';
import { fast } from '../src/builders/fast';
import { buildBlas, BvhError } from '../src/index';
import { expectSame } from './same';
import { randomNumbers, sphere, strewn } from './shapes';

describe('buildBlasAsync', () => {
  for (const builder of [fast, 'balanced', best, bestSplit] as const) {
    test(`builds what buildBlas builds (${typeof builder === 'string' ? builder : builder.name}), telling progress that only grows`, async () => {
      const mesh = strewn(60_000, 0.05, randomNumbers(3));
      const reported: number[] = [];
      const blas = await buildBlasAsync(mesh, { builder, sliceMs: 0, onProgress: (done) => reported.push(done) });
      expectSame(blas, buildBlas(mesh, { builder }));
      expect(reported.length).toBeGreaterThan(8);
      expect(reported.every((done, i) => done >= (reported[i - 1] ?? 0) && done <= 1)).toBe(true);
      expect(reported.at(-1)).toBe(1);
    });
  }

  test('two builds at a time do not disturb each other', async () => {
    const meshes = [strewn(30_000, 0.1, randomNumbers(4)), sphere(160)];
    const trees = await Promise.all(meshes.map((mesh) => buildBlasAsync(mesh, { sliceMs: 0 })));
    trees.forEach((blas, i) => expectSame(blas, buildBlas(meshes[i]!)));
  });

  test('lets timers run in between', async () => {
    const mesh = strewn(200_000, 0.05, randomNumbers(5));
    let ticks = 0;
    const ticking = setInterval(() => ticks++, 0);
    await buildBlasAsync(mesh, { sliceMs: 2 });
    clearInterval(ticking);
    expect(ticks).toBeGreaterThan(5);
  });

  test('stops when aborted, and passes errors on', async () => {
    const mesh = strewn(60_000, 0.05, randomNumbers(6));
    const control = new AbortController(),
      reason = new Error('enough');
    await expect(
      buildBlasAsync(mesh, { sliceMs: 0, signal: control.signal, onProgress: () => control.abort(reason) }),
    ).rejects.toBe(reason);
    await expect(buildBlasAsync(mesh, { signal: control.signal })).rejects.toBe(reason);
    await expect(buildBlasAsync({ positions: new Float32Array(4) })).rejects.toBeInstanceOf(BvhError);
    await expect(buildBlasAsync(mesh, { builder: 'quick' as 'balanced' })).rejects.toMatchObject({
      code: 'bvh/options',
    });
    await expect(
      buildBlasAsync(mesh, {
        sliceMs: 0,
        onProgress: () => {
          throw new TypeError('mine');
        },
      }),
    ).rejects.toThrow('mine');
  });
});
