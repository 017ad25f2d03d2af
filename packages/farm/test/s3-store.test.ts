import { createHash } from 'node:crypto';
import { existsSync, mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import * as sdk from '@aws-sdk/client-s3';
import { findRedis } from '@glanz/redis';
import { startS3, type S3Server } from '@glanz/s3';
import { afterAll, beforeAll, beforeEach, describe, expect, it, vi } from 'vitest';
import { contentId, FolderStore, openFarmStore, S3Store, type FarmStore, type S3Module } from '../src/index';
import { jobOf, temporaryFolder, testFarm } from './farm-on-redis';

// Against s3rver, a server of S3's protocol, on loopback; the proxy before it records requests and cuts connections.
const ID = contentId('a job');
const KEY = 'ab'.repeat(32);
const meta = { id: ID, label: 'a', seconds: 1, worker: 'w', finished: '2026-01-01T00:00:00.000Z' };
const sha256 = (text: string) => createHash('sha256').update(text).digest('hex');
const HOUR = 3_600_000;
const DAY = 24 * HOUR;

let server: S3Server;
let prefixes = 0;
let url = '';
let folder = '';

beforeAll(async () => {
  folder = mkdtempSync(join(tmpdir(), 'glanz-s3-'));
  server = await startS3(folder, 'farm');
});
afterAll(async () => {
  await server.stop();
  rmSync(folder, { recursive: true, force: true });
});
beforeEach(() => {
  for (const [name, value] of Object.entries(server.env)) vi.stubEnv(name, value);
  server.cut = () => undefined;
  url = `s3://farm/test ${prefixes++}`;
  return () => void vi.unstubAllEnvs();
});

/** A machine: a store with a cache of its own. */
const machine = (cache = temporaryFolder()) => S3Store.open({ url, endpoint: server.endpoint, cache });

/** Finishes the job with a file of this text. */
async function finish(store: FarmStore, text: string): Promise<boolean> {
  const working = await store.begin(ID);
  writeFileSync(join(working, 'a.txt'), text);
  return store.commit(working, meta, ['a.txt']);
}

/** The requests that something makes. */
async function requestsOf(run: () => Promise<unknown>): Promise<string[]> {
  const before = server.requests.length;
  await run();
  return server.requests.slice(before);
}

/** All files below a folder. */
const filesBelow = (path: string): string[] =>
  existsSync(path)
    ? readdirSync(path, { withFileTypes: true }).flatMap((entry) =>
        entry.isDirectory() ? filesBelow(join(path, entry.name)) : [join(path, entry.name)],
      )
    : [];

describe('content', () => {
  it('lies under its SHA-256, is uploaded once, and downloaded once by each machine', async () => {
    const [a, b] = [await machine(), await machine()];
    const text = 'x'.repeat(5000);
    expect(await a.put(text)).toBe(sha256(text));
    expect(await requestsOf(() => a.put(Buffer.from(text)))).toEqual([]);
    const again = await requestsOf(async () => (await machine()).put(text));
    expect(again.filter((line) => line.startsWith('PUT'))).toEqual([]);
    const reads = await requestsOf(async () => {
      expect(Buffer.from(await b.read(sha256(text))).toString()).toBe(text);
      expect(Buffer.from(await b.read(sha256(text))).toString()).toBe(text);
    });
    expect(reads.filter((line) => line.startsWith('GET')).length).toBe(1);
    await expect(b.read('0'.repeat(64))).rejects.toMatchObject({ code: 'farm/missing-file' });
    await expect(b.read('../../x')).rejects.toMatchObject({ code: 'farm/store' });
  });

  it('bundles have the hash that they have in a folder, and their files come once', async () => {
    const source = temporaryFolder();
    writeFileSync(join(source, 'one.gltf'), '1');
    writeFileSync(join(source, 'two.bin'), '2');
    const files = [
      { name: 'model.gltf', path: join(source, 'one.gltf') },
      { name: 'textures/two.bin', path: join(source, 'two.bin') },
    ];
    const hash = await (await machine()).putBundle(files);
    expect(await new FolderStore(temporaryFolder()).putBundle(files)).toBe(hash);
    const worker = await machine();
    const path = await worker.bundle(hash);
    expect(readFileSync(join(path, 'textures/two.bin'), 'utf8')).toBe('2');
    const again = await requestsOf(() => worker.bundle(hash));
    expect(again.filter((line) => !line.startsWith('HEAD'))).toEqual([]);
  });

  it('that is damaged is refused, on the server and on this machine', async () => {
    const [a, b] = [await machine(), await machine()];
    const hash = await a.put('content');
    const client = new sdk.S3Client({ endpoint: server.endpoint, forcePathStyle: true });
    const object = { Bucket: 'farm', Key: `${url.slice('s3://farm/'.length)}/objects/${hash.slice(0, 2)}/${hash}` };
    await client.send(new sdk.PutObjectCommand({ ...object, Body: 'contenT' }));
    await expect(b.read(hash)).rejects.toThrow(/is damaged/);
    await client.send(new sdk.PutObjectCommand({ ...object, Body: 'content' }));
    expect(Buffer.from(await b.read(hash)).toString()).toBe('content');
    for (const file of filesBelow(b.address.cache as string)) writeFileSync(file, 'damaged');
    expect(Buffer.from(await b.read(hash)).toString()).toBe('content');
  });

  it('of more than 32 MB is uploaded in parts, and does not exist before the last one', async () => {
    const [a, b] = [await machine(), await machine()];
    const big = join(temporaryFolder(), 'big.bin');
    writeFileSync(big, Buffer.alloc(33 * 2 ** 20, 'glanz'));
    server.cut = (line) => (/partNumber=2/.test(line) ? 1000 : undefined);
    await expect(a.putFile(big)).rejects.toMatchObject({ code: 'farm/store' });
    const hash = createHash('sha256').update(readFileSync(big)).digest('hex');
    await expect(b.read(hash)).rejects.toThrow(/has no object/);
    expect(server.requests.some((line) => /^DELETE .*uploadId=/.test(line))).toBe(true);
    server.cut = () => undefined;
    expect(await a.putFile(big)).toBe(hash);
    expect(
      createHash('sha256')
        .update(await b.read(hash))
        .digest('hex'),
    ).toBe(hash);
  });
});

describe('results', () => {
  it('of two that finish the same job the first one counts', async () => {
    const [a, b] = [await machine(), await machine()];
    expect(await a.result(ID)).toBeUndefined();
    expect(await Promise.all([finish(a, 'first'), finish(b, 'second')]).then((all) => all.sort())).toEqual([
      false,
      true,
    ]);
    expect(await finish(b, 'third')).toBe(false);
    const result = (await b.result(ID))!;
    expect(await a.result(ID)).toEqual(result);
    const text = readFileSync(await a.resultFile(ID, 'a.txt'), 'utf8');
    expect(['first', 'second']).toContain(text);
    expect(result).toEqual({ ...meta, files: [{ name: 'a.txt', bytes: text.length, sha256: sha256(text) }] });
    await expect(a.resultFile(ID, 'b.txt')).rejects.toMatchObject({ code: 'farm/missing-file' });
  });

  it('are delivered below their root alone, and not downloaded again', async () => {
    await finish(await machine(), 'first');
    const other = await machine();
    const result = (await other.result(ID))!;
    const root = temporaryFolder();
    await other.deliver(result, { root, paths: ['x/a.txt'] });
    expect(readFileSync(join(root, 'x/a.txt'), 'utf8')).toBe('first');
    expect(readdirSync(join(root, 'x'))).toEqual(['a.txt']);
    expect(await requestsOf(() => other.deliver(result, { root, paths: ['x/a.txt'] }))).toEqual([]);
    await expect(other.deliver(result, { root, paths: ['../a.txt'] })).rejects.toMatchObject({ code: 'farm/store' });
  });

  it('with a file that is damaged on the server are neither delivered nor read', async () => {
    await finish(await machine(), 'first');
    const hash = sha256('first');
    const Key = `${url.slice('s3://farm/'.length)}/objects/${hash.slice(0, 2)}/${hash}`;
    const client = new sdk.S3Client({ endpoint: server.endpoint, forcePathStyle: true });
    await client.send(new sdk.PutObjectCommand({ Bucket: 'farm', Key, Body: 'firsT' }));
    const other = await machine();
    const root = temporaryFolder();
    const delivered = other.deliver((await other.result(ID))!, { root, paths: ['a.txt'] });
    await expect(delivered).rejects.toThrow(/is damaged/);
    await expect(other.resultFile(ID, 'a.txt')).rejects.toThrow(/is damaged/);
    expect(readdirSync(root)).toEqual([]);
    expect(filesBelow(other.address.cache as string)).toEqual([]);
  });

  it('an upload that is interrupted leaves nothing, neither a part nor the whole', async () => {
    const [a, b] = [await machine(), await machine()];
    const text = 'y'.repeat(300_000);
    for (const cut of [/\/objects\//, /\/results\//]) {
      server.cut = (line) => (line.startsWith('PUT') && cut.test(line) ? 10 : undefined);
      await expect(finish(a, text)).rejects.toMatchObject({ code: 'farm/store' });
      expect(await b.result(ID)).toBeUndefined();
      if (cut.test('/objects/')) await expect(b.read(sha256(text))).rejects.toThrow(/has no object/);
    }
    server.cut = () => undefined;
    expect(await finish(a, text)).toBe(true);
    expect(readFileSync(await b.resultFile(ID, 'a.txt'), 'utf8')).toBe(text);
  });

  it('samples of a job that was given back come to another machine, the newest', async () => {
    const [a, b] = [await machine(), await machine()];
    writeFileSync(await a.checkpoint(ID), '10 samples');
    expect(existsSync(await b.checkpoint(ID))).toBe(false);
    await a.keepCheckpoint(ID);
    const path = await b.checkpoint(ID);
    expect(readFileSync(path, 'utf8')).toBe('10 samples');
    await b.dropCheckpoint(ID);
    expect(existsSync(path)).toBe(false);
    expect(existsSync(await b.checkpoint(ID))).toBe(false);
    await b.keepCheckpoint(ID);
  });
});

const redis = await findRedis();

describe.skipIf(redis.missing !== undefined)(redis.missing ?? 'on a farm', () => {
  it('a job that is given back continues on another machine from its samples; images stay in the bucket', async () => {
    const farm = await testFarm(redis.program!);
    const store = await machine();
    await farm.queue.submit(farm.requests([jobOf('a', { ms: 2000 })]), store);
    const first = await farm.worker({ store: await machine(), outputRoot: false });
    await farm.until('begun', async () => ((await farm.queue.status()).workers[0]?.job?.samples ?? 0) > 3);
    await first.drain();
    await farm.worker({ store: await machine(), outputRoot: false });
    await farm.until('done', async () => (await farm.queue.status()).done === 1);
    const [begun, again] = farm.log('begin').map((line) => Number(line.split(' ').at(-1)));
    expect(begun).toBe(0);
    expect(again).toBeGreaterThan(3);
    expect(existsSync(join(farm.folder, 'out'))).toBe(false);
    expect(await farm.queue.submit(farm.requests([jobOf('a', { ms: 2000 })]), store)).toEqual({
      queued: 0,
      finished: 1,
    });
    expect(readFileSync(join(farm.folder, 'out/a.txt'), 'utf8')).toBe('a\n');
  });
});

describe('cleaning', () => {
  it('deletes what was not used for the time, and notes uses once an hour', async () => {
    const store = await machine();
    await finish(store, 'result');
    const hash = await store.put('kept');
    await store.hierarchies.set(KEY, Uint8Array.of(1, 2, 3).buffer);
    const other = await machine();
    expect([...(await other.hierarchies.get(KEY))!]).toEqual([1, 2, 3]);
    expect(await other.hierarchies.get('cd'.repeat(32))).toBeUndefined();
    const now = Date.now();
    expect(await store.clean(30 * DAY, now + 30 * DAY)).toEqual({ entries: 0, bytes: 0 });
    // Two hours later the next use copies the object onto itself, which sets its time.
    vi.spyOn(Date, 'now').mockReturnValue(now + 2 * HOUR);
    const copies = await requestsOf(async () => {
      expect(await (await machine()).result(ID)).toBeDefined();
    });
    expect(copies.filter((line) => line.startsWith('PUT')).length).toBe(2);
    vi.restoreAllMocks();
    const cleaned = await store.clean(DAY, now + 3 * DAY);
    expect(cleaned.entries).toBe(4);
    expect(cleaned.bytes).toBeGreaterThan('resultkept'.length + 3);
    expect(await (await machine()).result(ID)).toBeUndefined();
    await expect((await machine()).read(hash)).rejects.toThrow(/has no object/);
  });

  it('lists more than fits into one answer', async () => {
    // s3rver makes its tokens by a cipher that OpenSSL 3 lacks: the answers are cut here.
    class Paged extends sdk.S3Client {
      override async send(command: never): Promise<never> {
        const { input } = command as { input: sdk.ListObjectsV2CommandInput };
        const { ContinuationToken: from = '0', ...rest } = input;
        if (!((command as object) instanceof sdk.ListObjectsV2Command)) return super.send(command);
        const all = (await super.send(new sdk.ListObjectsV2Command(rest))).Contents ?? [];
        const end = Number(from) + 2;
        const next = end < all.length ? { NextContinuationToken: String(end) } : {};
        return { Contents: all.slice(Number(from), end), ...next } as never;
      }
    }
    const store = await openFarmStore({ url, endpoint: server.endpoint, cache: temporaryFolder() }, {
      ...sdk,
      S3Client: Paged,
    } as unknown as S3Module);
    for (let i = 0; i < 5; i++) await store.put(`object ${i}`);
    expect((await store.clean(DAY, Date.now() + 3 * DAY)).entries).toBe(5);
    expect((await store.clean(DAY, Date.now() + 3 * DAY)).entries).toBe(0);
  });

  it('a result one of whose files is gone is done again', async () => {
    const store = await machine();
    await finish(store, 'result');
    const client = new sdk.S3Client({ endpoint: server.endpoint, forcePathStyle: true });
    const hash = sha256('result');
    const Key = `${url.slice('s3://farm/'.length)}/objects/${hash.slice(0, 2)}/${hash}`;
    await client.send(new sdk.DeleteObjectCommand({ Bucket: 'farm', Key }));
    vi.spyOn(Date, 'now').mockReturnValue(Date.now() + 2 * HOUR);
    expect(await (await machine()).result(ID)).toBeUndefined();
    vi.restoreAllMocks();
    expect(await finish(store, 'result')).toBe(true);
    expect(readFileSync(await (await machine()).resultFile(ID, 'a.txt'), 'utf8')).toBe('result');
  });
});

describe('a store that cannot be opened says why', () => {
  const open = (address: object) =>
    openFarmStore({ url, endpoint: server.endpoint, cache: temporaryFolder(), ...address });

  it('no such bucket, no access, no credentials', async () => {
    const access = { code: 'farm/store-access' };
    const missing = open({ url: 's3://other-bucket' });
    await expect(missing).rejects.toMatchObject({ ...access, message: expect.stringMatching(/no such bucket/) });
    vi.stubEnv('AWS_ACCESS_KEY_ID', 'someone');
    await expect(open({})).rejects.toMatchObject({ ...access, message: expect.stringMatching(/access denied/) });
    for (const name of ['AWS_ACCESS_KEY_ID', 'AWS_SECRET_ACCESS_KEY']) vi.stubEnv(name, undefined);
    for (const name of ['AWS_SHARED_CREDENTIALS_FILE', 'AWS_CONFIG_FILE']) vi.stubEnv(name, '/dev/null');
    await expect(open({})).rejects.toMatchObject({ ...access, message: expect.stringMatching(/no credentials/) });
  });

  it('an address that is none, no server, no cache, and no package', async () => {
    for (const wrong of [{ url: 's3://' }, { url: 's3://B' }, { url: 's3://farm/../x' }, { endpoint: 'farm' }])
      await expect(open(wrong), JSON.stringify(wrong)).rejects.toMatchObject({ code: 'farm/option' });
    await expect(open({ cache: undefined })).rejects.toMatchObject({ code: 'farm/option' });
    await expect(open({ endpoint: 'http://127.0.0.1:1' })).rejects.toMatchObject({ code: 'farm/store' });
    vi.doMock('@aws-sdk/client-s3', () => {
      throw new Error('not found');
    });
    await expect(open({})).rejects.toMatchObject({
      code: 'farm/missing-package',
      message: expect.stringMatching(/npm install @aws-sdk\/client-s3/),
    });
    vi.doUnmock('@aws-sdk/client-s3');
    expect(await openFarmStore({ url: temporaryFolder() })).toBeInstanceOf(FolderStore);
    expect(
      await openFarmStore({ url, endpoint: server.endpoint, cache: temporaryFolder() }, sdk as S3Module),
    ).toBeInstanceOf(S3Store);
  });
});
