import { getEventListeners, once } from 'node:events';
import { setImmediate as soon } from 'node:timers/promises';
import { Worker } from 'node:worker_threads';
import { afterAll, afterEach, beforeAll, describe, expect, it, vi } from 'vitest';
import { buildBlas, type Blas } from '../../src/blas';
import type { TriangleMesh } from '../../src/layout';
import { best, bestSplit } from '../../src/builders/best';
import { fast } from '../../src/builders/fast';
import { BvhError } from '../../src/error';
import { BvhWorkers, type BvhWorkersOptions } from '../../src/worker/workers';
import { expectSame } from '../same';
import { randomNumbers, sphere, strewn } from '../shapes';
import { bundledWorker } from './bundled';

const random = randomNumbers(11);
const meshes: TriangleMesh[] = [
  sphere(96),
  strewn(9000, 0.1, random),
  { positions: strewn(500, 0.3, random).positions },
  { positions: sphere(24).positions, indices: Uint16Array.from(sphere(24).indices) },
  { positions: new Float32Array(0), indices: new Uint32Array(0) },
  ...Array.from({ length: 40 }, () => strewn(1 + Math.floor(200 * random()), 0.5, random)),
];
/** About a second of work: there is time to do something meanwhile. */
const big = () => strewn(700_000, 0.02, randomNumbers(5));

/** How many messages of a kind the workers have been sent, from now on. */
function counting(workers: readonly Worker[], kind: string): () => number {
  const spies = workers.map((worker) => vi.spyOn(worker, 'postMessage'));
  return () =>
    spies.reduce(
      (sum, { mock }) => sum + mock.calls.filter(([message]) => (message as { kind: string }).kind === kind).length,
      0,
    );
}

describe('BvhWorkers', () => {
  let worker: Awaited<ReturnType<typeof bundledWorker>>;
  const started: Worker[] = [];
  const pools: BvhWorkers[] = [];
  const create = async (options: BvhWorkersOptions = {}) => {
    const createWorker = () => {
      const made = worker.start();
      started.push(made);
      return made;
    };
    const pool = await BvhWorkers.create({ count: 2, createWorker, ...options });
    pools.push(pool);
    return pool;
  };
  beforeAll(async () => {
    worker = await bundledWorker();
  });
  afterAll(() => worker.remove());
  afterEach(() => {
    for (const pool of pools.splice(0)) pool.destroy();
    started.length = 0;
  });

  it('lets two workers build a large mesh together, bit for bit what buildBlas builds', async () => {
    const workers = await create({ together: true });
    const pieces = counting(started, 'together');
    const large = sphere(480);
    expect(large.indices.length / 3).toBeGreaterThan(200_000);
    // Both have to be there.
    while (pieces() === 0) expectSame(await workers.buildBlas(large), buildBlas(large));
    const flat = strewn(260_000, 0.02, randomNumbers(13));
    // Some on one spot, some broken, and pairs that only the order on the curve brings together.
    for (let i = 0; i < flat.positions.length; i += 9 * 50) flat.positions.fill(i % 2 === 0 ? 0.25 : NaN, i, i + 9);
    const several: readonly (readonly [TriangleMesh, object])[] = [
      [flat, {}],
      [flat, { maxLeafTriangles: 1, bins: 7 }],
      [{ positions: new Float32Array(9 * 210_000).fill(1) }, {}],
      [{ positions: large.positions.map((x, i) => (i % 3 === 0 ? 1000 * x : x)), indices: large.indices }, {}],
    ];
    for (const [mesh, options] of several) {
      // The second one may still be on its way back from the last build.
      for (const before = pieces(); pieces() === before;)
        expectSame(await workers.buildBlas(mesh, options), buildBlas(mesh, options));
    }
    // A fault that only one of them meets; then both are there again.
    const { positions, indices } = large;
    for (const at of [5, indices.length - 5]) {
      const broken = indices.slice();
      broken[at] = 1e9;
      await expect(workers.buildBlas({ positions, indices: broken })).rejects.toMatchObject({ code: 'bvh/indices' });
    }
    for (const before = pieces(); pieces() === before;)
      expectSame(await workers.buildBlas({ positions, indices }), buildBlas({ positions, indices }));
    // Given away while both wait for the rest of it; then they do not wait any more.
    for (const turns of [0, 1, 5]) {
      const given = { positions: positions.slice(), indices: indices.slice() };
      let now = 0;
      // A clock that advances five milliseconds at each reading: the thread yields after each piece.
      const clock = vi.spyOn(performance, 'now').mockImplementation(() => (now += 5));
      const build = workers.buildBlas(given);
      for (let turn = 0; turn < turns; turn++) await soon();
      structuredClone(given, { transfer: [given.indices.buffer] });
      await expect(build).rejects.toThrow(TypeError);
      clock.mockRestore();
    }
    // Short indices.
    const few = {
      positions: positions.slice(0, 3 * 60_000),
      indices: Uint16Array.from({ length: 3 * 230_000 }, (_, i) => (i * 7919) % 60_000),
    };
    for (const before = pieces(); pieces() === before;) expectSame(await workers.buildBlas(few), buildBlas(few));
    const control = new AbortController();
    const aborted = workers.buildBlas({ positions, indices }, { signal: control.signal });
    control.abort(new Error('enough'));
    await expect(aborted).rejects.toThrow('enough');
    const all = await Promise.all([0, 1, 2].map(() => workers.buildBlas({ positions, indices })));
    for (const blas of all) expectSame(blas, all[0] as Blas);
  });

  it('builds what buildBlas builds, bit for bit, many meshes at once and with options', async () => {
    const workers = await create();
    expect(workers.fallback).toBeUndefined();
    expect(workers.count).toBe(2);
    const all = await Promise.all(meshes.map((mesh) => workers.buildBlas(mesh)));
    all.forEach((blas, i) => expectSame(blas, buildBlas(meshes[i] as TriangleMesh)));
    const options = { maxLeafTriangles: 2, bins: 8 };
    expectSame(
      await workers.buildBlas(meshes[0] as TriangleMesh, options),
      buildBlas(meshes[0] as TriangleMesh, options),
    );
    for (const builder of [fast, best, bestSplit])
      expectSame(
        await workers.buildBlas(meshes[1] as TriangleMesh, { builder }),
        buildBlas(meshes[1] as TriangleMesh, { builder }),
      );
    expect(buildBlas(meshes[0] as TriangleMesh, options).nodeCount).not.toBe(
      buildBlas(meshes[0] as TriangleMesh).nodeCount,
    );
  });

  it('leaves the calling thread free and runs two builds at a time', async () => {
    const workers = await create();
    const mesh = big();
    // Turns of this thread's event loop, which a build on it would hold up.
    let turns = 0;
    const turning = setInterval(() => turns++, 1);
    const events: { readonly done: number; readonly turn: number }[] = [];
    await Promise.all(
      [0, 1].map(() => workers.buildBlas(mesh, { onProgress: (done) => void events.push({ done, turn: turns }) })),
    );
    clearInterval(turning);
    expect(events.map(({ done }) => done)).toEqual([0, 0, 1, 1]);
    expect(events[2]!.turn - events[1]!.turn).toBeGreaterThan(10);
  });

  it('keeps the mesh by default, empties its arrays with transfer, and shares those over a SharedArrayBuffer', async () => {
    const workers = await create();
    const expected = buildBlas(sphere(48));
    const kept = sphere(48);
    expectSame(await workers.buildBlas(kept), expected);
    expect(kept.positions.length).toBe(sphere(48).positions.length);
    const given = sphere(48);
    expectSame(await workers.buildBlas(given, { transfer: true }), expected);
    expect([given.positions.length, given.indices.length]).toEqual([0, 0]);

    const part = sphere(48);
    const room = new Float32Array(part.positions.length + 7);
    room.set(part.positions, 7);
    expectSame(
      await workers.buildBlas({ positions: room.subarray(7), indices: part.indices }, { transfer: true }),
      expected,
    );
    expect([room.length, part.indices.length]).toEqual([part.positions.length + 7, 0]);

    const shared = new Float32Array(new SharedArrayBuffer(kept.positions.byteLength));
    shared.set(kept.positions);
    expectSame(await workers.buildBlas({ positions: shared, indices: kept.indices }), expected);
  });

  it('reports progress per mesh: 0 when started, 1 when done', async () => {
    const workers = await create();
    const reported: number[][] = [[], [], []];
    await Promise.all(reported.map((list) => workers.buildBlas(sphere(32), { onProgress: (done) => list.push(done) })));
    expect(reported).toEqual([
      [0, 1],
      [0, 1],
      [0, 1],
    ]);
  });

  it('passes typed errors across, with code and message, and continues', async () => {
    const workers = await create();
    const faults: readonly [TriangleMesh, object][] = [
      [{ positions: new Float32Array(4) }, {}],
      [{ positions: new Float32Array(9), indices: new Uint32Array([0, 1, 3]) }, {}],
      [sphere(8), { maxLeafTriangles: 99 }],
    ];
    for (const [mesh, options] of faults) {
      let own: unknown;
      try {
        buildBlas(mesh, options);
      } catch (error) {
        own = error;
      }
      const theirs = await workers.buildBlas(mesh, options).catch((error: unknown) => error);
      expect(theirs).toBeInstanceOf(BvhError);
      expect(theirs).toMatchObject({ code: (own as BvhError).code, message: (own as BvhError).message });
    }
    await expect(workers.buildBlas(sphere(8), { bins: (() => 8) as unknown as number })).rejects.toThrow(/clone/);
    await expect(
      workers.buildBlas(sphere(8), {
        onProgress: () => {
          throw new TypeError('mine');
        },
      }),
    ).rejects.toThrow('mine');
    expectSame(await workers.buildBlas(sphere(16)), buildBlas(sphere(16)));
    expect(started).toHaveLength(2);
  });

  it('aborts builds that run, wait or are yet to come; a long one ends its worker, which is replaced', async () => {
    const workers = await create({ count: 1 });
    const running = new AbortController(),
      waiting = new AbortController();
    let begun = () => undefined as void;
    const hasBegun = new Promise<void>((resolve) => (begun = resolve));
    const first = workers.buildBlas(big(), { signal: running.signal, onProgress: () => begun() });
    const second = workers.buildBlas(big(), { signal: waiting.signal });
    const third = workers.buildBlas(sphere(24));
    const settled = Promise.allSettled([first, second]);
    await hasBegun;
    const reason = new Error('enough');
    const gone = once(started[0] as Worker, 'exit');
    waiting.abort();
    running.abort(reason);
    const [a, b] = await settled;
    expect(a).toMatchObject({ status: 'rejected', reason });
    expect((b as PromiseRejectedResult).reason).toMatchObject({ name: 'AbortError' });
    await gone;
    expectSame(await third, buildBlas(sphere(24)));
    expect(started).toHaveLength(2);
    await expect(workers.buildBlas(sphere(8), { signal: running.signal })).rejects.toBe(reason);
  });

  it('listens once to a signal that many builds share, and no longer than they take', async () => {
    const workers = await create();
    const { signal } = new AbortController();
    const builds = [0, 1, 2, 3].map(() => workers.buildBlas(sphere(16), { signal }));
    expect(getEventListeners(signal, 'abort')).toHaveLength(1);
    await Promise.all(builds);
    expect(getEventListeners(signal, 'abort')).toHaveLength(0);
  });

  it('gives up a large mesh that is still being copied, and takes the next', async () => {
    for (const together of [false, true]) {
      // A clock on which every look takes five milliseconds: each piece is a turn of its own.
      let now = performance.now();
      const clock = vi.spyOn(performance, 'now').mockImplementation(() => (now += 5));
      const workers = await create({ together });
      const large = sphere(480),
        controller = new AbortController();
      const pieces = counting(started, 'build'),
        halves = counting(started, 'together');
      const aborted = workers.buildBlas(large, { signal: controller.signal });
      const gone = workers.buildBlas(sphere(480));
      controller.abort();
      await expect(aborted).rejects.toMatchObject({ name: 'AbortError' });
      expect(pieces() + halves()).toBe(0);
      expectSame(await gone, buildBlas(large));
      const later = [counting(started, 'build'), counting(started, 'together')];
      const sent = () => later.reduce((sum, count) => sum + count(), 0);
      const before = sent();
      const last = workers.buildBlas(large);
      workers.destroy();
      await expect(last).rejects.toMatchObject({ code: 'bvh/destroyed' });
      await new Promise((resolve) => setTimeout(resolve, 50));
      expect(sent()).toBe(before);
      clock.mockRestore();
      started.length = 0;
    }
  });

  it('lets a short build run out when it is aborted, and says nothing of it', async () => {
    const workers = await create({ count: 1 });
    const controller = new AbortController();
    const reported: number[] = [];
    const build = workers.buildBlas(sphere(128), {
      signal: controller.signal,
      onProgress: (done) => reported.push(done),
    });
    controller.abort();
    await expect(build).rejects.toMatchObject({ name: 'AbortError' });
    expectSame(await workers.buildBlas(sphere(16)), buildBlas(sphere(16)));
    expect(reported).toEqual([]);
    expect(started).toHaveLength(1);
  });

  it('rejects what a dying worker was at, and replaces it', async () => {
    const workers = await create({ count: 1 });
    const build = workers.buildBlas(big());
    const failed = expect(build).rejects.toMatchObject({ code: 'bvh/worker' });
    await (started[0] as Worker).terminate();
    await failed;
    expectSame(await workers.buildBlas(sphere(24)), buildBlas(sphere(24)));
    expect(started).toHaveLength(2);
  });

  it('rejects all that is not done when destroyed, and ends its workers', async () => {
    const workers = await create();
    const builds = Promise.allSettled([big(), big(), sphere(8)].map((mesh) => workers.buildBlas(mesh)));
    const gone = Promise.all(started.map((thread) => once(thread, 'exit')));
    workers.destroy();
    for (const build of await builds)
      expect(build).toMatchObject({ status: 'rejected', reason: { code: 'bvh/destroyed' } });
    await gone;
    await expect(workers.buildBlas(sphere(8))).rejects.toMatchObject({ code: 'bvh/destroyed' });
  });

  it('builds the same after a warm-up', async () => {
    const workers = await create({ warmUp: true });
    await new Promise((resolve) => setTimeout(resolve, 100));
    expectSame(await workers.buildBlas(sphere(64)), buildBlas(sphere(64)));
  });

  it('warms up two at a time, and one after another all of them', async () => {
    const sent: Worker[] = [];
    const done: Worker[] = [];
    let max = 0;
    await create({
      count: 4,
      warmUp: true,
      createWorker() {
        const made = worker.start();
        const post = made.postMessage.bind(made);
        made.postMessage = (message, transfer) => {
          if ((message as { kind: string }).kind === 'warm-up') sent.push(made);
          max = Math.max(max, sent.length - done.length);
          post(message, transfer as never);
        };
        made.on('message', ({ kind }: { kind: string }) => kind === 'warmed' && done.push(made));
        return made;
      },
    });
    await vi.waitFor(() => expect(done).toHaveLength(4), { timeout: 30_000, interval: 20 });
    expect(new Set(sent).size).toBe(4);
    expect(max).toBe(2);
  });

  it('asks no more workers than the triangles are worth', async () => {
    const workers = await create({ count: 3 });
    const busy = async (list: readonly TriangleMesh[]) => {
      const counts = started.map((each) => counting([each], 'build'));
      const before = counts.map((count) => count());
      await Promise.all(list.map((mesh) => workers.buildBlas(mesh)));
      return counts.filter((count, i) => count() > (before[i] as number)).length;
    };
    expect(await busy(Array.from({ length: 20 }, () => sphere(24)))).toBe(1);
    await vi.waitFor(async () => expect(await busy(Array.from({ length: 6 }, () => sphere(150)))).toBe(3), {
      timeout: 30_000,
      interval: 20,
    });
    expect(await busy(Array.from({ length: 20 }, () => sphere(24)))).toBe(1);
  });

  it('builds here where no worker can be made, whatever the cause, and yields in between', async () => {
    const causes: (() => Worker)[] = [
      () => {
        throw new Error('refused by policy');
      },
      () => new Worker('/no/such/worker.mjs'),
      () => new Worker('throw new Error("broken script")', { eval: true }),
      () => new Worker('', { eval: true }),
    ];
    for (const [i, createWorker] of causes.entries()) {
      const workers = await create({ createWorker });
      expect(workers.fallback).toMatch(
        [/refused by policy/, /Cannot find module/, /broken script/, /it has ended/][i] as RegExp,
      );
      expect(workers.count).toBe(0);
      const reported: number[] = [];
      expectSame(
        await workers.buildBlas(sphere(24), { onProgress: (done) => reported.push(done) }),
        buildBlas(sphere(24)),
      );
      expect([reported[0], reported.at(-1)]).toEqual([0, 1]);
      expect(reported).toEqual([...reported].sort((a, b) => a - b));
      await expect(workers.buildBlas({ positions: new Float32Array(4) })).rejects.toMatchObject({
        code: 'bvh/positions',
      });
    }
    const workers = await create({ createWorker: causes[0] as () => Worker });
    const controller = new AbortController();
    let between = 0;
    const ticking = setInterval(() => between++, 0);
    const builds = Array.from({ length: 12 }, () => workers.buildBlas(sphere(160), { signal: controller.signal }));
    const last = workers.buildBlas(sphere(160), { signal: controller.signal }).catch((error: unknown) => error);
    await builds[10];
    controller.abort();
    await Promise.allSettled(builds);
    clearInterval(ticking);
    expect(between).toBeGreaterThan(3);
    expect(await last).toMatchObject({ name: 'AbortError' });
    const left = workers.buildBlas(sphere(8));
    workers.destroy();
    await expect(left).rejects.toMatchObject({ code: 'bvh/destroyed' });
  });

  it('uses the package file by default: not there in the sources, so it builds here', async () => {
    const workers = await BvhWorkers.create({ count: 1 });
    expect(workers.fallback).toMatch(/worker\.js/);
    expectSame(await workers.buildBlas(sphere(16)), buildBlas(sphere(16)));
  });

  it('refuses a senseless count', async () => {
    for (const count of [0, -1, 1.5, NaN])
      await expect(BvhWorkers.create({ count })).rejects.toMatchObject({ code: 'bvh/options' });
  });
});
