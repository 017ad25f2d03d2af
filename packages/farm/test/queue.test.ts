import { existsSync, readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { findRedis, type RedisProgram } from '@glanz/redis';
import { describe, expect, it } from 'vitest';
import { farmMetrics, FolderStore } from '../src/index';
import { jobOf, temporaryFolder, testFarm } from './farm-on-redis';

const redis = await findRedis();
const program = redis.program as RedisProgram;

// The real queue on a real Redis. The renderer's process is a script that behaves as a job's payload says.
describe.skipIf(redis.missing !== undefined)(redis.missing ?? 'a farm on Redis', () => {
  it('finishes jobs, each once; submitted again they cost nothing', async () => {
    const farm = await testFarm(program);
    const jobs = ['a', 'b', 'c', 'd', 'e'].map((label) => jobOf(label));
    expect(await farm.queue.submit(farm.requests([...jobs, jobs[0]!]), farm.store)).toEqual({ queued: 6, finished: 0 });
    await farm.worker();
    await farm.worker();
    await farm.until('done', async () => (await farm.queue.status()).done === 5);
    for (const { label } of jobs)
      expect(readFileSync(join(farm.folder, 'out', `${label}.txt`), 'utf8')).toBe(`${label}\n`);
    expect(readdirSync(join(farm.folder, 'out')).sort()).toEqual(['a.txt', 'b.txt', 'c.txt', 'd.txt', 'e.txt']);
    expect(farm.log('begin').length).toBe(5);
    // Again, to another folder: copied from the store.
    const again = jobs.map((job) => ({ job, destination: { root: join(farm.folder, 'more'), paths: ['x/1.txt'] } }));
    expect(await farm.queue.submit([again[0]!], farm.store)).toEqual({ queued: 0, finished: 1 });
    expect(readFileSync(join(farm.folder, 'more/x/1.txt'), 'utf8')).toBe('a\n');
    expect(farm.log('begin').length).toBe(5);
    expect(readdirSync(join(farm.store.folder, 'working'))).toEqual([]);
    expect(await farm.queue.warnings()).toEqual([]);
    const status = await farm.queue.status();
    expect(status).toMatchObject({ waiting: 0, active: 0, failed: 0, secondsLeft: 0, retries: {} });
    await farm.until('heartbeats', async () => {
      const { workers } = await farm.queue.status();
      return workers.length === 2 && workers.reduce((sum, { done }) => sum + done, 0) === 5;
    });
    expect(farmMetrics(status)).toMatch(/^glanz_farm_jobs_done_total 5$/m);
    expect((await farm.queue.recent()).map(({ label }) => label).sort()).toEqual(['a', 'b', 'c', 'd', 'e']);
  });

  it('keeps wrong input from being tried again, and tries other failures by their kind', async () => {
    const farm = await testFarm(program);
    await farm.queue.submit(
      farm.requests([
        jobOf('wrong', { fail: 'input' }),
        jobOf('full-disk', { fail: 'output', times: 1 }),
        jobOf('bug', { fail: 'other' }),
        jobOf('lost', { fail: 'gpu', times: 1 }),
      ]),
      farm.store,
    );
    await farm.worker();
    await farm.worker();
    await farm.until('over', async () => {
      const { done, failed } = await farm.queue.status();
      return done === 2 && failed === 2;
    });
    const tried = (label: string) => farm.events.filter((e) => e.type === 'failed' && e.job.label === label).length;
    expect(['wrong', 'full-disk', 'bug', 'lost'].map(tried)).toEqual([1, 1, 3, 1]);
    const letters = await farm.queue.deadLetters();
    expect(letters.map(({ label, reason }) => [label, reason]).sort()).toEqual([
      ['bug', 'It fails by other. [test/other] (it failed 3 times)'],
      ['wrong', 'It fails by input. [test/input] (its input is wrong)'],
    ]);
    expect(letters.find(({ label }) => label === 'bug')?.log.join('\n')).toMatch(
      /It fails by other\. \[test\/other\]\n {2}rendering bug\n(.|\n)*It fails by other/,
    );
    expect((await farm.queue.status()).retries).toEqual({ output: 1, other: 2, gpu: 1 });
    // Queued again, it has all its tries.
    expect(await farm.queue.retry()).toBe(2);
    await farm.until('dead again', async () => (await farm.queue.status()).failed === 2);
    expect(tried('bug')).toBe(6);
    expect(await farm.queue.cancel()).toEqual({ removed: 2, stopping: 0 });
  });

  it('a lost GPU: its job goes to another worker at once, while its own pauses', async () => {
    const farm = await testFarm(program);
    await farm.worker();
    await farm.queue.submit(farm.requests([jobOf('lost', { fail: 'gpu', times: 1 })]), farm.store);
    await farm.until('lost', () => farm.events.some(({ type }) => type === 'failed'));
    const first = farm.log('begin')[0]!.split(' ')[2];
    await farm.worker();
    await farm.until('done', async () => (await farm.queue.status()).done === 1);
    expect(farm.log('end')[0]!.split(' ')[2]).not.toBe(first);
  });

  it('a worker that cannot write its files pauses, and the others take the jobs', async () => {
    const farm = await testFarm(program);
    const jobs = ['a', 'b', 'c', 'd', 'e', 'f'].map((label) => jobOf(label));
    await farm.queue.submit(farm.requests(jobs), farm.store);
    await farm.worker({
      renderer: {
        script: fileURLToPath(new URL('renderer.mjs', import.meta.url)),
        args: [join(farm.folder, 'log.txt')],
        env: { TEST_FAIL: 'output' },
      },
    });
    await farm.until('failed', () => farm.events.some(({ type }) => type === 'failed'));
    await farm.worker();
    await farm.until('done', async () => (await farm.queue.status()).done === jobs.length);
    expect(farm.events.filter(({ type }) => type === 'failed').length).toBeLessThan(4);
    expect((await farm.queue.status()).failed).toBe(0);
  });

  it('a destination that cannot be written does not hold up the jobs of others', async () => {
    const farm = await testFarm(program);
    writeFileSync(join(farm.folder, 'file'), '');
    const bad = ['x', 'y', 'z'].map((label) => ({
      job: jobOf(label),
      destination: { root: join(farm.folder, 'file'), paths: [`${label}.txt`] },
    }));
    await farm.queue.submit([...bad, ...farm.requests(['a', 'b', 'c'].map((label) => jobOf(label)))], farm.store);
    await farm.worker();
    await farm.until('failed', () => farm.events.some(({ type }) => type === 'failed'));
    await farm.until('done', async () => (await farm.queue.status()).done === 3);
    // A kind of failure after which the worker does not pause.
    expect(Object.keys((await farm.queue.status()).retries)).toEqual(['files']);
  });

  it('a worker does not start with a store that it cannot write', async () => {
    const farm = await testFarm(program);
    writeFileSync(join(farm.folder, 'file'), '');
    const store = new FolderStore(join(farm.folder, 'file'));
    await expect(farm.worker({ store })).rejects.toMatchObject({ code: 'farm/store' });
  });

  it('a job that ends its process three times is given up, and holds the others up by its tries alone', async () => {
    const farm = await testFarm(program);
    await farm.queue.submit(
      farm.requests([jobOf('poison', { exit: true }), ...['a', 'b', 'c', 'd'].map((label) => jobOf(label))]),
      farm.store,
    );
    await farm.worker();
    await farm.until('done', async () => {
      const { done, failed } = await farm.queue.status();
      return done === 4 && failed === 1;
    });
    expect(farm.log(`begin ${jobOf('poison', { exit: true }).id}`).length).toBe(3);
    const [letter] = await farm.queue.deadLetters();
    expect(letter!.reason).toMatch(/^The renderer's process ended by SIGKILL\. .*\(it ended its process 3 times\)$/);
    expect(letter!.log.filter((line) => line.trim() === 'about to end').length).toBe(3);
    // Three attempts of the poisoned job, then the others: nothing waits between them.
    expect(farm.log('begin').length).toBe(7);
  });

  it('a renderer that blocks for longer than the lock does not look stalled; one that hangs is ended', async () => {
    const farm = await testFarm(program);
    await farm.queue.submit(farm.requests([jobOf('slow', { block: 3000 })]), farm.store);
    await farm.worker({ lockMs: 500 });
    await farm.worker({ lockMs: 500 });
    await farm.until('done', async () => (await farm.queue.status()).done === 1);
    expect(farm.log('begin').length).toBe(1);
    const hung = await testFarm(program);
    await hung.queue.submit(hung.requests([jobOf('hung', { block: 60_000 })]), hung.store);
    await hung.worker({
      renderer: {
        script: new URL('renderer.mjs', import.meta.url).pathname,
        args: [join(hung.folder, 'log.txt')],
        hangMs: 300,
      },
    });
    await hung.until('given up', async () => (await hung.queue.status()).failed === 1);
    expect((await hung.queue.deadLetters())[0]!.reason).toMatch(/did not respond/);
  });

  it('drained, it gives its job back with its samples, and another worker continues', async () => {
    const farm = await testFarm(program);
    await farm.queue.submit(farm.requests([jobOf('long', { ms: 4000 })]), farm.store);
    const first = await farm.worker();
    await farm.until('begun', async () => ((await farm.queue.status()).workers[0]?.job?.samples ?? 0) > 5);
    await first.drain();
    expect(await farm.queue.status()).toMatchObject({ waiting: 1, active: 0, failed: 0, done: 0, workers: [] });
    await farm.worker();
    await farm.until('done', async () => (await farm.queue.status()).done === 1);
    const from = farm.log('begin').map((line) => Number(line.split(' ')[3]));
    expect(from[0]).toBe(0);
    expect(from[1]).toBeGreaterThan(5);
    expect(readdirSync(join(farm.store.folder, 'checkpoints'))).toEqual([]);
  });

  it('cancelled: what waits is gone, what is rendered stops and leaves nothing', async () => {
    const farm = await testFarm(program);
    await farm.queue.submit(farm.requests([jobOf('long', { ms: 60_000 }), jobOf('b'), jobOf('c')]), farm.store);
    await farm.worker();
    await farm.until('begun', async () => (await farm.queue.status()).active === 1);
    expect(await farm.queue.cancel([jobOf('c').id])).toEqual({ removed: 1, stopping: 0 });
    expect(await farm.queue.cancel()).toEqual({ removed: 1, stopping: 1 });
    await farm.until('stopped', () => farm.events.some(({ type }) => type === 'cancelled'));
    await farm.until('empty', async () => {
      const { waiting, active, failed, done } = await farm.queue.status();
      return waiting + active + failed + done === 0;
    });
    expect(existsSync(join(farm.folder, 'out'))).toBe(false);
    expect(readdirSync(join(farm.store.folder, 'checkpoints'))).toEqual([]);
    // It may be submitted again.
    await farm.queue.submit(farm.requests([jobOf('c')]), farm.store);
    await farm.until('done', async () => (await farm.queue.status()).done === 1);
  });

  it('parts, and the merge that follows the last of them', async () => {
    const farm = await testFarm(program);
    const parts = ['p0', 'p1', 'p2'].map((label) => jobOf(label));
    const merge = { ...jobOf('merged'), kind: 'merge' as const, parts: parts.map(({ id }) => id) };
    const destination = { root: join(farm.folder, 'out'), paths: ['merged.txt'] };
    const requests = parts.map((part) => ({ job: { ...part, kind: 'part' as const, merge }, destination }));
    await farm.queue.submit(requests, farm.store);
    await farm.worker();
    await farm.worker();
    await farm.until('done', async () => (await farm.queue.status()).done === 4);
    expect(readdirSync(join(farm.folder, 'out'))).toEqual(['merged.txt']);
    expect(farm.log('end').at(-1)).toContain(merge.id);
    expect(farm.log('end').length).toBe(4);
  });

  it('says where Redis is not, and what to install', async () => {
    const { openFarmQueue, importQueueModules, startFarmWorker } = await import('../src/index');
    const modules = await importQueueModules();
    await expect(openFarmQueue({ redis: 'redis://:secret@127.0.0.1:1', modules })).rejects.toMatchObject({
      code: 'farm/redis',
      message: expect.stringMatching(/redis:\/\/:\*\*\*@127\.0\.0\.1:1/),
    });
    const worker = {
      redis: 'redis://127.0.0.1:1',
      connectMs: 0,
      store: new FolderStore(temporaryFolder()),
      renderer: { script: 'x', args: [] },
    };
    await expect(startFarmWorker(worker)).rejects.toMatchObject({ code: 'farm/redis' });
    await expect(openFarmQueue({ redis: 'localhost', modules })).rejects.toMatchObject({ code: 'farm/option' });
    await expect(openFarmQueue({ redis: 'redis://127.0.0.1:1', name: 'a:b', modules })).rejects.toMatchObject({
      code: expect.stringMatching(/^farm\/(option|redis)$/),
    });
  });
});
