import { createServer, type AddressInfo } from 'node:net';
import { existsSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import { findRedis, type RedisProgram } from '@glanz/redis';
import { describe, expect, it, onTestFinished } from 'vitest';
import { FolderStore, importQueueModules, openFarmQueue, startFarmWorker } from '../src/index';
import { jobOf, temporaryFolder, testFarm } from './farm-on-redis';

const redis = await findRedis();
const program = redis.program as RedisProgram;

describe.skipIf(redis.missing !== undefined)(
  redis.missing ?? 'a Redis that is away, refuses or is named wrongly',
  () => {
    it('addresses that are none are refused without their password', async () => {
      for (const address of [
        'localhost',
        'http://127.0.0.1',
        'redis:127.0.0.1',
        'redis://127.0.0.1:99999',
        'redis://[::1',
        'redis://127.0.0.1:1/shoes',
        'redis://:secret@127.0.0.1:99999',
        'redis://127.0.0.1:1?db=2',
        'redis://:p@secret@127.0.0.1:99999',
        'redis://:a/secret@127.0.0.1:99999',
        'redis://:a?secret@127.0.0.1:99999',
        'redis://127.0.0.1:99999?password=secret',
        'redis://127.0.0.1:99999?password=a@secret',
      ]) {
        const error = await openFarmQueue({ redis: address }).catch((cause: unknown) => cause);
        expect([address, error]).toEqual([address, expect.objectContaining({ code: 'farm/option' })]);
        expect((error as Error).message).not.toContain('secret');
      }
    });

    it('what it refuses once is not asked for again: a database that it has not, a wrong password', async () => {
      const farm = await testFarm(program);
      const store = new FolderStore(temporaryFolder());
      const refused = (address: string) => {
        const start = Date.now();
        return startFarmWorker({ redis: address, store, renderer: { script: 'x', args: [] } }).then(
          (worker) => worker.drain().then(() => 'started'),
          ({ code, message }: Error & { code: string }) => `${code} ${message} ${Date.now() - start < 5000}`,
        );
      };
      expect(await refused(`${farm.redis.url}/99`)).toMatch(
        /^farm\/redis Redis refuses the connection at redis:\S+\/99: ERR DB index is out of range\. true$/,
      );
      expect(await refused(farm.redis.url.replace('//', '//user:secret@'))).toMatch(
        /^farm\/redis Redis refuses the connection at redis:\/\/user:\*\*\*@\S+: WRONGPASS [^.]+\. true$/,
      );
      await expect(openFarmQueue({ redis: `${farm.redis.url}/99` })).rejects.toMatchObject({ code: 'farm/redis' });
      const second = await openFarmQueue({ redis: `${farm.redis.url}/2` });
      onTestFinished(() => second.close());
      await second.submit(farm.requests([jobOf('a')]), farm.store);
      expect([(await second.status()).waiting, (await farm.queue.status()).waiting]).toEqual([1, 0]);
    });

    it('a server that accepts and says nothing is an error after some seconds', async () => {
      const server = createServer(() => undefined);
      await new Promise<void>((done) => server.listen(0, '127.0.0.1', done));
      onTestFinished(() => void server.close());
      const address = `redis://127.0.0.1:${(server.address() as AddressInfo).port}`;
      await expect(openFarmQueue({ redis: address })).rejects.toMatchObject({ code: 'farm/redis' });
    });

    it('a queue that is open says so while Redis is away, and answers again afterwards', async () => {
      const farm = await testFarm(program);
      await farm.queue.submit(farm.requests([jobOf('a')]), farm.store);
      await farm.redis.kill();
      const away = { code: 'farm/redis', message: 'Redis does not answer any more.' };
      for (const ask of [
        () => farm.queue.status(),
        () => farm.queue.recent(),
        () => farm.queue.submit(farm.requests([jobOf('b')]), farm.store),
      ])
        await expect(ask()).rejects.toMatchObject(away);
      await farm.redis.start();
      await farm.until('answers', () =>
        farm.queue.status().then(
          ({ waiting }) => waiting === 1,
          () => false,
        ),
      );
    });

    it('a worker that is drained meanwhile keeps the samples of its job and ends', async () => {
      const farm = await testFarm(program);
      await farm.queue.submit(farm.requests([jobOf('long', { ms: 4000 })]), farm.store);
      const worker = await farm.worker({ leaveMs: 1000 });
      await farm.until('begun', async () => ((await farm.queue.status()).workers[0]?.job?.samples ?? 0) > 5);
      await farm.redis.kill();
      const start = Date.now();
      await worker.drain();
      expect(Date.now() - start).toBeLessThan(8000);
      expect(readdirSync(join(farm.store.folder, 'checkpoints')).length).toBe(1);
      expect(farm.events.at(-1)).toMatchObject({
        type: 'redis',
        message: expect.stringMatching(/when its lock expires/),
      });
      // The job is not lost: it continues when its lock has expired.
      await farm.redis.start();
      await farm.worker();
      await farm.until('done', () => existsSync(join(farm.folder, 'out/long.txt')));
      expect(Number(farm.log('begin')[1]!.split(' ')[3])).toBeGreaterThan(5);
    });

    it('a job that is submitted while all are cancelled keeps its destination', async () => {
      const farm = await testFarm(program);
      const modules = await importQueueModules();
      const late = farm.requests([jobOf('late')]);
      class Queue extends (modules.Queue as new (...given: never[]) => { drain(delayed?: boolean): Promise<void> }) {
        override async drain(delayed?: boolean) {
          await super.drain(delayed);
          await farm.queue.submit(late, farm.store);
        }
      }
      const queue = await openFarmQueue({ redis: farm.redis.url, modules: { ...modules, Queue: Queue as never } });
      onTestFinished(() => queue.close());
      await farm.queue.submit(farm.requests([jobOf('a')]), farm.store);
      expect(await queue.cancel()).toEqual({ removed: 1, stopping: 0 });
      await farm.worker();
      await farm.until('done', async () => (await farm.queue.status()).done === 1);
      expect(readdirSync(join(farm.folder, 'out'))).toEqual(['late.txt']);
    });

    it('what was cancelled and is submitted again goes to its new destination alone', async () => {
      const farm = await testFarm(program);
      const [a, b] = [jobOf('a'), jobOf('b')];
      await farm.queue.submit(farm.requests([a, b]), farm.store);
      await farm.queue.cancel([a.id]);
      await farm.queue.cancel();
      const requests = [a, b].map((job) => ({
        job,
        destination: { root: join(farm.folder, 'new'), paths: [`${job.label}.txt`] },
      }));
      await farm.queue.submit(requests, farm.store);
      await farm.worker();
      await farm.until('done', async () => (await farm.queue.status()).done === 2);
      expect(readdirSync(join(farm.folder, 'new')).sort()).toEqual(['a.txt', 'b.txt']);
      expect(existsSync(join(farm.folder, 'out'))).toBe(false);
    });
  },
);
