import { mkdtemp, readdir, readFile, rm, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { afterEach, beforeEach, expect, test } from 'vitest';
import { BlasCache } from '../src/cache';
import { buildBlas } from '../src/index';
import { fileStore } from '../src/node';
import { randomNumbers, strewn } from './shapes';

let folder = '',
  file = '';
beforeEach(async () => {
  folder = await mkdtemp(join(tmpdir(), 'glanz-bvh-'));
  file = join(folder, 'model.glb.bvh');
});
afterEach(() => rm(folder, { recursive: true }));

const meshes = [91, 92, 93].map((seed) => strewn(100 + seed, 0.3, randomNumbers(seed)));

test('the trees of a model come back out of one file beside it', async () => {
  const trees = meshes.map((mesh) => buildBlas(mesh));
  const cache = new BlasCache(fileStore(file), { buildBlas }, { minTriangles: 0 });
  expect(await Promise.all(meshes.map((mesh) => cache.buildBlas(mesh)))).toEqual(trees);
  await cache.written();
  expect(await readdir(folder)).toEqual(['model.glb.bvh']);
  const later = new BlasCache(
    fileStore(file),
    { buildBlas: () => Promise.reject(new Error('nothing is to be built')) },
    { minTriangles: 0 },
  );
  expect(await Promise.all(meshes.map((mesh) => later.buildBlas(mesh)))).toEqual(trees);
});

test('a file truncated anywhere, or something else, costs builds and is repaired', async () => {
  const cache = new BlasCache(fileStore(file), { buildBlas }, { minTriangles: 0 });
  for (const mesh of meshes) await cache.buildBlas(mesh);
  await cache.written();
  const whole = await readFile(file);
  for (const bytes of [
    Buffer.alloc(0),
    whole.subarray(0, 7),
    whole.subarray(0, 100),
    whole.subarray(0, whole.length - 5),
    Buffer.from('something else altogether'),
    Buffer.concat([whole.subarray(0, 4), Buffer.from([255, 255, 255, 255]), whole.subarray(8)]),
  ]) {
    await writeFile(file, bytes);
    const again = new BlasCache(fileStore(file), { buildBlas }, { minTriangles: 0 });
    for (const mesh of meshes) expect(await again.buildBlas(mesh)).toEqual(buildBlas(mesh));
    expect(again.misses).toBeGreaterThan(0);
    await again.written();
    const repaired = new BlasCache(fileStore(file), { buildBlas }, { minTriangles: 0 });
    for (const mesh of meshes) await repaired.buildBlas(mesh);
    expect(repaired.misses).toBe(0);
  }
});

test('a missing folder makes only the write fail', async () => {
  const errors: NodeJS.ErrnoException[] = [];
  const cache = new BlasCache(
    fileStore(join(folder, 'gone', 'x.bvh')),
    { buildBlas },
    { minTriangles: 0, onError: (error) => errors.push(error as NodeJS.ErrnoException) },
  );
  expect(await cache.buildBlas(meshes[0]!)).toEqual(buildBlas(meshes[0]!));
  await cache.written();
  expect(errors.map(({ code }) => code)).toEqual(['ENOENT']);
});

test('what was used longest ago is left out of a full file', async () => {
  const bytes = (value: number) => new Uint8Array(40).fill(value).buffer;
  const store = fileStore(file, { maxBytes: 100 });
  await store.set('a', bytes(1));
  await store.set('b', bytes(2));
  await store.get('a');
  await store.set('c', bytes(3));
  const later = fileStore(file);
  expect(
    await Promise.all(['a', 'b', 'c'].map(async (key) => new Uint8Array((await later.get(key)) ?? [])[0])),
  ).toEqual([1, undefined, 3]);
});
