import { mkdirSync, writeFileSync } from 'node:fs';
import { request } from 'node:http';
import type { AddressInfo } from 'node:net';
import { join } from 'node:path';
import { expect, it, onTestFinished } from 'vitest';
import { FolderStore, statusServer, type FarmQueue, type FarmStatus } from '../src/index';
import { jobOf, temporaryFolder } from './farm-on-redis';

const STATUS: FarmStatus = {
  waiting: 2,
  active: 1,
  delayed: 0,
  failed: 1,
  done: 1,
  submitted: 5,
  retries: {},
  secondsPerJob: 1,
  workers: [],
};

/** A server of a store with one result, on a queue that only answers. */
async function served(thumbnailOf?: (file: string) => Promise<Uint8Array>) {
  const store = new FolderStore(temporaryFolder());
  const { id } = jobOf('a');
  const folder = await store.begin(id);
  writeFileSync(join(folder, '0.png'), 'PNG');
  writeFileSync(join(folder, '1.exr'), 'EXR');
  await store.commit(folder, { id, label: '<b>a</b>', seconds: 1, worker: 'w', finished: '' }, ['0.png', '1.exr']);
  let reads = 0;
  const queue = {
    status: async () => {
      reads++;
      return STATUS;
    },
    recent: async () => [(await store.result(id))!],
    deadLetters: async () => [{ id, label: 'b', reason: 'it failed', failed: '', log: ['line'] }],
  } as unknown as FarmQueue;
  const server = statusServer(queue, store, thumbnailOf);
  await new Promise<void>((done) => server.listen(0, '127.0.0.1', done));
  onTestFinished(() => void server.close());
  const base = `http://127.0.0.1:${(server.address() as AddressInfo).port}`;
  return { store, id, base, reads: () => reads, get: (path: string, init?: RequestInit) => fetch(base + path, init) };
}

it('serves the page, the status, metrics and images', async () => {
  const { get, id } = await served();
  const status = (await (await get('/status.json')).json()) as {
    status: object;
    recent: object[];
    deadLetters: object[];
  };
  expect(status).toEqual({
    status: STATUS,
    recent: [{ id, label: '<b>a</b>', seconds: 1, image: 0 }],
    deadLetters: [{ id, label: 'b', reason: 'it failed', failed: '', log: ['line'] }],
  });
  expect(await (await get(`/result/${id}/0`)).text()).toBe('PNG');
  expect((await get('/metrics')).headers.get('content-type')).toBe('text/plain; version=0.0.4');
  expect(await (await get('/metrics')).text()).toContain('glanz_farm_jobs{state="waiting"} 2');
});

it('thumbnails are made once for each image, and not found where that fails', async () => {
  const made: string[] = [];
  const { get, id } = await served(async (file) => {
    made.push(file);
    return new TextEncoder().encode('small');
  });
  const texts = await Promise.all([1, 2].map(async () => (await get(`/thumbnail/${id}/0`)).text()));
  expect(texts).toEqual(['small', 'small']);
  expect(made.length).toBe(1);
  expect(await (await get(`/result/${id}/0`)).text()).toBe('PNG');
  expect((await get(`/thumbnail/${id}/1`)).status).toBe(404);
  let tries = 0;
  const failing = await served(async () => {
    if (++tries === 1) throw new Error('no image');
    return new TextEncoder().encode('small');
  });
  expect((await failing.get(`/thumbnail/${failing.id}/0`, { method: 'HEAD' })).status).toBe(200);
  expect(tries).toBe(0);
  const failed = await failing.get(`/thumbnail/${failing.id}/0`);
  expect([failed.status, failed.headers.get('cache-control')]).toEqual([404, 'no-store']);
  expect(await (await failing.get(`/thumbnail/${failing.id}/0`)).text()).toBe('small');
  const without = await served();
  expect(await (await without.get(`/thumbnail/${without.id}/0`)).text()).toBe('PNG');
});

it('the page requests nothing from elsewhere and writes no markup of names', async () => {
  const { get } = await served();
  const page = await get('/');
  const html = await page.text();
  expect(html.match(/https?:|\/\/[a-z]/gi)).toBeNull();
  expect(html.match(/innerHTML|outerHTML|insertAdjacentHTML|document\.write|eval\(/)).toBeNull();
  const policy = page.headers.get('content-security-policy')!;
  expect(policy).toContain("default-src 'none'");
  expect(policy).toContain("img-src 'self'");
});

it('is read-only, and serves images of results alone', async () => {
  const { get, id, store } = await served();
  for (const method of ['POST', 'PUT', 'DELETE']) expect((await get('/status.json', { method })).status).toBe(405);
  mkdirSync(join(store.folder, 'objects'), { recursive: true });
  writeFileSync(join(store.folder, 'secret.png'), 'x');
  for (const path of [
    `/result/${id}/1`,
    `/result/${id}/2`,
    `/result/${'0'.repeat(40)}/0`,
    `/result/${id}/../../../secret.png`,
    '/result/..%2f..%2fsecret.png/0',
    '/secret.png',
  ])
    expect([path, (await get(path)).status]).toEqual([path, 404]);
});

it('many open pages read the queue as often as one', async () => {
  const { get, reads } = await served();
  await Promise.all(Array.from({ length: 20 }, () => get('/status.json')));
  expect(reads()).toBe(1);
});

it('on the loopback address answers to names of this machine alone', async () => {
  const { base } = await served();
  const codeFor = (host: string) =>
    new Promise<number>((resolve, reject) =>
      request(`${base}/status.json`, { headers: { host } }, (response) => {
        response.resume();
        resolve(response.statusCode!);
      })
        .on('error', reject)
        .end(),
    );
  expect(await codeFor('attacker.example')).toBe(403);
  expect(await codeFor('localhost:80')).toBe(200);
});
