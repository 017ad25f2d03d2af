import { createHash } from 'node:crypto';
import {
  existsSync,
  mkdirSync,
  readFileSync,
  readdirSync,
  rmSync,
  symlinkSync,
  utimesSync,
  writeFileSync,
} from 'node:fs';
import { join } from 'node:path';
import { describe, expect, it } from 'vitest';
import { contentId, FolderStore } from '../src/index';
import { temporaryFolder } from './farm-on-redis';

const ID = contentId('a job');
const meta = { id: ID, label: 'a', seconds: 1, worker: 'w', finished: '2026-01-01T00:00:00.000Z' };

/** A store with a result of one file. */
async function withResult(text: string) {
  const store = new FolderStore(join(temporaryFolder(), 'store'));
  const folder = await store.begin(ID);
  writeFileSync(join(folder, 'a.txt'), text);
  expect(await store.commit(folder, meta, ['a.txt'])).toBe(true);
  return store;
}

describe('content', () => {
  it('lies under its SHA-256, once, and is checked when it is read', async () => {
    const store = new FolderStore(temporaryFolder());
    const hash = await store.put('content');
    expect(hash).toBe(createHash('sha256').update('content').digest('hex'));
    expect(await store.put(Buffer.from('content'))).toBe(hash);
    expect(Buffer.from(await store.read(hash)).toString()).toBe('content');
    writeFileSync(store.objectPath(hash), 'other');
    await expect(store.read(hash)).rejects.toMatchObject({ code: 'farm/missing-file' });
    await expect(store.read('0'.repeat(64))).rejects.toMatchObject({ code: 'farm/missing-file' });
    expect(() => store.objectPath('../../etc/passwd')).toThrow(/is not the identity/);
  });

  it('a bundle has the same hash on every machine, and is unpacked once', async () => {
    const folder = temporaryFolder();
    mkdirSync(join(folder, 'x'));
    writeFileSync(join(folder, 'x/one.gltf'), '1');
    writeFileSync(join(folder, 'two.bin'), '2');
    const files = [
      { name: 'model.gltf', path: join(folder, 'x/one.gltf') },
      { name: 'textures/two.bin', path: join(folder, 'two.bin') },
    ];
    const [a, b] = [new FolderStore(temporaryFolder()), new FolderStore(temporaryFolder())];
    const hash = await a.putBundle(files);
    expect(await b.putBundle([...files].reverse())).toBe(hash);
    const [first, second] = await Promise.all([a.bundle(hash), a.bundle(hash)]);
    expect(second).toBe(first);
    expect(readFileSync(join(first, 'textures/two.bin'), 'utf8')).toBe('2');
    expect(readdirSync(join(a.folder, 'bundles'))).toEqual([hash]);
    for (const name of ['../up', '/etc/x', 'a//b', 'a\\b', ''])
      await expect(a.putBundle([{ name, path: files[0]!.path }])).rejects.toMatchObject({ code: 'farm/store' });
  });
});

describe('results', () => {
  it('of two that finish the same job the first one counts', async () => {
    const store = await withResult('first');
    const folder = await store.begin(ID);
    writeFileSync(join(folder, 'a.txt'), 'second');
    expect(await store.commit(folder, meta, ['a.txt'])).toBe(false);
    expect(existsSync(folder)).toBe(false);
    expect(readFileSync(join(store.resultFolder(ID), 'a.txt'), 'utf8')).toBe('first');
    expect(await store.result(ID)).toEqual({
      ...meta,
      files: [{ name: 'a.txt', bytes: 5, sha256: createHash('sha256').update('first').digest('hex') }],
    });
  });

  it('have the hashes that are known from writing their files, and are hashed otherwise', async () => {
    const store = new FolderStore(join(temporaryFolder(), 'store'));
    const folder = await store.begin(ID);
    for (const name of ['a.film', 'b.png']) writeFileSync(join(folder, name), name);
    const known = 'f'.repeat(64);
    expect(await store.commit(folder, meta, ['a.film', 'b.png'], { 'a.film': known })).toBe(true);
    expect((await store.result(ID))?.files.map(({ sha256 }) => sha256)).toEqual([
      known,
      createHash('sha256').update('b.png').digest('hex'),
    ]);
  });

  it('without one of its files there is none, and the job can be done again', async () => {
    const store = await withResult('first');
    rmSync(join(store.resultFolder(ID), 'a.txt'));
    expect(await store.result(ID)).toBeUndefined();
    const folder = await store.begin(ID);
    writeFileSync(join(folder, 'a.txt'), 'again');
    expect(await store.commit(folder, meta, ['a.txt'])).toBe(true);
  });

  it('are delivered below their root alone, and not written again', async () => {
    const store = await withResult('first');
    const result = (await store.result(ID))!;
    const root = temporaryFolder();
    await store.deliver(result, { root, paths: ['x/y/a.txt'] });
    expect(readFileSync(join(root, 'x/y/a.txt'), 'utf8')).toBe('first');
    expect(readdirSync(join(root, 'x/y'))).toEqual(['a.txt']);
    symlinkSync('/tmp', join(root, 'link'));
    for (const path of ['../a.txt', '/tmp/a.txt', 'link/a.txt', ''])
      await expect(store.deliver(result, { root, paths: [path] })).rejects.toMatchObject({ code: 'farm/store' });
    await expect(store.deliver(result, { root, paths: [] })).rejects.toThrow(/0 paths for 1 files/);
  });

  it('what a killed worker has left is swept after a day', async () => {
    const store = new FolderStore(temporaryFolder());
    await store.begin(ID);
    await store.sweep();
    expect(readdirSync(join(store.folder, 'working')).length).toBe(1);
    await store.sweep(Date.now() + 2 * 86_400_000);
    expect(readdirSync(join(store.folder, 'working'))).toEqual([]);
  });
});

it('identity depends on content alone', () => {
  expect(contentId({ a: 1, b: [{ d: undefined, c: 'x' }] })).toBe(contentId({ b: [{ c: 'x' }], a: 1 }));
  expect(contentId({ a: 1 })).toMatch(/^[0-9a-f]{40}$/);
  // Canonical JSON of { b: 2, a: "é" }, hashed by another program.
  expect(contentId({ b: 2, a: 'é' })).toBe(
    createHash('sha256').update('{"a":"é","b":2}', 'utf8').digest('hex').slice(0, 40),
  );
  expect(new Set([{ a: 1 }, { a: '1' }, { a: null }, {}, [], [1], { b: 1 }, { a: [1] }].map(contentId)).size).toBe(8);
});

describe('hierarchies and cleaning', () => {
  const KEY = 'ab'.repeat(32);

  it('keeps hierarchies under their keys, the first one', async () => {
    const { hierarchies, folder } = new FolderStore(temporaryFolder());
    expect(await hierarchies.get(KEY)).toBeUndefined();
    await hierarchies.set(KEY, Uint8Array.of(1, 2, 3).buffer);
    await hierarchies.set(KEY, Uint8Array.of(4).buffer);
    expect([...(await hierarchies.get(KEY))!]).toEqual([1, 2, 3]);
    expect(existsSync(join(folder, 'hierarchies/ab', KEY))).toBe(true);
    await expect(hierarchies.get('../../x')).rejects.toMatchObject({ code: 'farm/store' });
  });

  it('deletes what was not used for some time, and keeps what was', async () => {
    const store = await withResult('result');
    const [old, kept] = [await store.put('old'), await store.put('kept')];
    await store.hierarchies.set(KEY, new ArrayBuffer(5));
    const day = 86_400_000;
    const now = Date.now();
    const ago = new Date(now - 40 * day);
    for (const path of [store.objectPath(old), store.objectPath(kept), store.resultFolder(ID)])
      utimesSync(path, ago, ago);
    expect(await store.clean(50 * day)).toEqual({ entries: 0, bytes: 0 });
    // Submitting it again is a use.
    expect(await store.put('kept')).toBe(kept);
    const { entries, bytes } = await store.clean(30 * day);
    expect([entries, bytes > 'oldresult'.length]).toEqual([2, true]);
    expect(await store.result(ID)).toBeUndefined();
    expect(existsSync(store.objectPath(old))).toBe(false);
    expect(Buffer.from(await store.read(kept)).toString()).toBe('kept');
    expect(await store.clean(30 * day, now + 31 * day)).toMatchObject({ entries: 2 });
    expect(await store.hierarchies.get(KEY)).toBeUndefined();
  });

  it('notes a use within the day, which --older-than 12h must see', async () => {
    const store = await withResult('result');
    const kept = await store.put('kept');
    const ago = new Date(Date.now() - 18 * 3_600_000);
    for (const path of [store.objectPath(kept), store.resultFolder(ID)]) utimesSync(path, ago, ago);
    expect(await store.result(ID)).toBeDefined();
    expect(await store.put('kept')).toBe(kept);
    expect(await store.clean(12 * 3_600_000)).toEqual({ entries: 0, bytes: 0 });
  });
});
