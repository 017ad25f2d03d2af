import { describe, expect, test, vi } from 'vitest';
import { BlasCache, blasKey, type BlasStore } from '../src/cache';
import { buildBlas, type Blas, type BvhError, type TriangleMesh } from '../src/index';
import { openIndexedDbStore } from '../src/indexed-db';
import { BvhWorkers } from '../src/worker/workers';
import { fakeIndexedDb } from './fake-indexed-db';
import { randomNumbers, strewn } from './shapes';

const mesh = strewn(300, 0.3, randomNumbers(71));
const other = strewn(300, 0.3, randomNumbers(72));

function memory(): BlasStore & { readonly kept: Map<string, ArrayBuffer> } {
  const kept = new Map<string, ArrayBuffer>();
  return { kept, get: async (key) => kept.get(key), set: async (key, bytes) => void kept.set(key, bytes) };
}

const builder = () => ({
  buildBlas: vi.fn<(m: TriangleMesh, options: object) => Blas>((m, options) => buildBlas(m, options)),
});

describe('blasKey', () => {
  test('is the same for the same content, whatever arrays hold it, and another for any other', async () => {
    const key = (m: TriangleMesh, options?: object) => blasKey(m, options);
    const base = await key(mesh);
    expect(base).toMatch(/^[0-9a-f]{64}$/);
    const wide = new Float32Array(mesh.positions.length + 2);
    wide.set(mesh.positions, 1);
    const shared = new Float32Array(new SharedArrayBuffer(mesh.positions.byteLength));
    shared.set(mesh.positions);
    expect(await key({ ...mesh, positions: wide.subarray(1, -1) })).toBe(base);
    expect(await key({ ...mesh, positions: shared })).toBe(base);
    expect(await key(mesh, { bins: undefined })).toBe(base);
    expect(await key(mesh, { bins: 8, maxLeafTriangles: 2 })).toBe(await key(mesh, { maxLeafTriangles: 2, bins: 8 }));
    const moved = mesh.positions.slice();
    moved[17]! += 1e-7;
    const turned = mesh.indices.slice().reverse();
    const all = [
      base,
      await key({ positions: moved, indices: mesh.indices }),
      await key({ positions: mesh.positions, indices: turned }),
      await key({ positions: mesh.positions }),
      await key({ positions: mesh.positions, indices: Uint16Array.from(mesh.indices) }),
      await key(mesh, { bins: 8 }),
      await key(mesh, { maxLeafTriangles: 2 }),
      await key(mesh, { builder: 'fast' }),
      await key(mesh, { builder: { name: 'best', build: () => undefined } }),
    ];
    expect(new Set(all).size).toBe(all.length);
  });
});

describe('BlasCache', () => {
  test('builds once, and reads the same tree ever after', async () => {
    const store = memory(),
      build = builder();
    const cache = new BlasCache(store, build, { minTriangles: 0 });
    const first = await cache.buildBlas(mesh);
    await cache.written();
    // Another cache over the same store: another visit.
    const later = new BlasCache(store, build, { minTriangles: 0 });
    const progress: number[] = [];
    expect(await later.buildBlas(mesh, { onProgress: (done) => progress.push(done) })).toEqual(first);
    expect(first).toEqual(buildBlas(mesh));
    expect(build.buildBlas).toHaveBeenCalledTimes(1);
    expect([cache.hits, cache.misses, later.hits, later.misses]).toEqual([0, 1, 1, 0]);
    expect(progress).toEqual([1]);
    // Other content, other options: built.
    await later.buildBlas(other);
    await later.buildBlas(mesh, { maxLeafTriangles: 1 });
    expect(build.buildBlas).toHaveBeenCalledTimes(3);
    await later.written();
    expect(store.kept.size).toBe(3);
  });

  test('builds small meshes each time', async () => {
    const store = memory();
    const cache = new BlasCache(store, builder());
    await cache.buildBlas(mesh);
    await cache.written();
    expect([store.kept.size, cache.misses]).toEqual([0, 1]);
  });

  test('stands in the place of workers', async () => {
    const store = memory();
    const workers = await BvhWorkers.create({ count: 1 });
    try {
      const cache = new BlasCache(store, workers, { minTriangles: 0 });
      const expected = buildBlas(mesh, { bins: 8 });
      expect(await cache.buildBlas(mesh, { bins: 8 })).toEqual(expected);
      await cache.written();
      expect(await cache.buildBlas(mesh, { bins: 8 })).toEqual(expected);
      expect(cache.hits).toBe(1);
    } finally {
      workers.destroy();
    }
  });

  test('damaged bytes, those of another mesh, and a store that fails cost a build, no more', async () => {
    const store = memory(),
      build = builder(),
      errors: unknown[] = [];
    const cache = new BlasCache(store, build, { minTriangles: 0, onError: (error) => errors.push(error) });
    const expected = await cache.buildBlas(mesh);
    await cache.written();
    const [[key, bytes]] = [...store.kept] as [[string, ArrayBuffer]];
    const spoilt = bytes.slice(0);
    new Uint8Array(spoilt)[999]! ^= 16;
    const small = { positions: mesh.positions.subarray(0, 90) };
    for (const value of [spoilt, bytes.slice(0, 100), new ArrayBuffer(0)]) {
      store.kept.set(key, value);
      expect(await cache.buildBlas(mesh)).toEqual(expected);
      await cache.written();
      // Fixed.
      expect(new Uint8Array(store.kept.get(key)!)).toEqual(new Uint8Array(bytes));
    }
    store.kept.set((await blasKey(small))!, bytes);
    expect(await cache.buildBlas(small)).toEqual(buildBlas(small));
    expect(errors.map((error) => (error as BvhError).code)).toEqual([
      'bvh/checksum',
      'bvh/truncated',
      'bvh/not-serialized',
      'bvh/other-mesh',
    ]);
    const broken = {
      get: async () => {
        throw new Error('no get');
      },
      set: async () => {
        throw new Error('no set');
      },
    };
    const reported: string[] = [];
    const over = new BlasCache(broken, build, {
      minTriangles: 0,
      onError: (error) => reported.push((error as Error).message),
    });
    expect(await over.buildBlas(mesh)).toEqual(expected);
    await over.written();
    expect(reported).toEqual(['no get', 'no set']);
  });

  test('does not wait for a store to write', async () => {
    let write = () => {};
    const cache = new BlasCache(
      { get: async () => undefined, set: () => new Promise<void>((resolve) => (write = resolve)) },
      builder(),
      { minTriangles: 0 },
    );
    await cache.buildBlas(mesh);
    let written = false;
    const pending = cache.written().then(() => (written = true));
    await new Promise((resolve) => setTimeout(resolve, 5));
    expect(written).toBe(false);
    write();
    await pending;
  });

  test('aborts before, during and after the look-up; errors of builds are the caller’s', async () => {
    const reason = new Error('no longer wanted');
    const control = new AbortController();
    const build = builder();
    const cache = new BlasCache({ get: async () => void control.abort(reason), set: async () => undefined }, build, {
      minTriangles: 0,
    });
    await expect(cache.buildBlas(mesh, { signal: control.signal })).rejects.toBe(reason);
    await expect(cache.buildBlas(mesh, { signal: control.signal })).rejects.toBe(reason);
    expect(build.buildBlas).not.toHaveBeenCalled();
    await expect(cache.buildBlas({ positions: new Float32Array(4) })).rejects.toMatchObject({ code: 'bvh/positions' });
  });

  test('without Web Crypto everything is built', async () => {
    const store = memory();
    vi.stubGlobal('crypto', undefined);
    try {
      const cache = new BlasCache(store, builder(), { minTriangles: 0 });
      expect(await cache.buildBlas(mesh)).toEqual(buildBlas(mesh));
      await cache.written();
    } finally {
      vi.unstubAllGlobals();
    }
    expect(store.kept.size).toBe(0);
  });
});

describe('openIndexedDbStore', () => {
  const bytes = (length: number, value: number) => new Uint8Array(length).fill(value).buffer;

  test('returns what was set, in a later visit too', async () => {
    const indexedDB = fakeIndexedDb();
    const store = await openIndexedDbStore({ indexedDB });
    expect(await store.get('a')).toBeUndefined();
    await store.set('a', bytes(10, 1));
    await store.set('a', bytes(12, 2));
    store.close();
    const later = await openIndexedDbStore({ indexedDB });
    expect(new Uint8Array((await later.get('a')) as ArrayBuffer)).toEqual(new Uint8Array(12).fill(2));
    await later.clear();
    expect(await later.get('a')).toBeUndefined();
  });

  test('forgets what was used longest ago, and never keeps more than it may', async () => {
    vi.useFakeTimers({ toFake: ['Date'] });
    try {
      const store = await openIndexedDbStore({ indexedDB: fakeIndexedDb(), maxBytes: 100 });
      const at = async (time: number, step: () => Promise<unknown>) => {
        vi.setSystemTime(time);
        await step();
        await new Promise((resolve) => setTimeout(resolve, 10));
      };
      await at(1, () => store.set('a', bytes(40, 1)));
      await at(2, () => store.set('b', bytes(40, 2)));
      await at(3, () => store.get('a'));
      await at(4, () => store.set('c', bytes(40, 3)));
      const kept = async () =>
        (await Promise.all(['a', 'b', 'c', 'd'].map(async (key) => ((await store.get(key)) ? key : '')))).join('');
      expect(await kept()).toBe('ac');
      await at(5, () => store.set('d', bytes(101, 4)));
      expect(await kept()).toBe('');
    } finally {
      vi.useRealTimers();
    }
  });

  test('a full disk is an error of the store, which a cache survives', async () => {
    const quota = new Error('QuotaExceededError');
    const store = await openIndexedDbStore({ indexedDB: fakeIndexedDb(() => quota) });
    await expect(store.set('a', bytes(4, 1))).rejects.toBe(quota);
    const errors: unknown[] = [];
    const cache = new BlasCache(store, builder(), { minTriangles: 0, onError: (error) => errors.push(error) });
    expect(await cache.buildBlas(mesh)).toEqual(buildBlas(mesh));
    await cache.written();
    expect(errors).toEqual([quota]);
  });
});
