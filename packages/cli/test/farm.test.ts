import { spawn, type ChildProcess } from 'node:child_process';
import { createHash } from 'node:crypto';
import { existsSync, readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { openFarmQueue, type FarmStatus } from '@glanz/farm';
import { decodeExr } from '@glanz/image/exr';
import { findRedis, startRedis, type RedisServer } from '@glanz/redis';
import { startS3 } from '@glanz/s3';
import { beforeAll, describe, expect, it, onTestFinished } from 'vitest';
import { temporaryFolder } from './fakes';
import { makeGlb } from './glb';
import { bundleProgram } from './program';

// The program, Redis and the renderer as they are: processes that are killed. GLANZ_FULL=1: 240 images, four workers, a
// kill every few seconds, Redis killed and started again.
const program = fileURLToPath(new URL('../.cache/glanz-farm.mjs', import.meta.url));
const faultyDawn = fileURLToPath(new URL('faulty-dawn.mjs', import.meta.url));
const FULL = process.env['GLANZ_FULL'] !== undefined;
const MINUTES = FULL ? 40 : 6;
const redisProgram = await findRedis();

beforeAll(() => bundleProgram(program));

interface Ended {
  readonly code: number | null;
  readonly out: string;
  readonly err: string;
}

interface Running {
  readonly child: ChildProcess;
  readonly ended: Promise<Ended>;
}

function start(argv: readonly string[], cwd: string, env: NodeJS.ProcessEnv = {}): Running {
  const child = spawn(process.execPath, [program, ...argv], {
    cwd,
    stdio: ['ignore', 'pipe', 'pipe'],
    env: { ...process.env, ...env },
  });
  // A test that has failed leaves no workers.
  onTestFinished(() => void child.kill('SIGKILL'));
  let [out, err] = ['', ''];
  child.stdout.on('data', (chunk: Buffer) => (out += chunk.toString()));
  child.stderr.on('data', (chunk: Buffer) => (err += chunk.toString()));
  return {
    child,
    ended: new Promise((done, fail) => {
      child.on('error', fail);
      child.on('close', (code) => done({ code, out, err }));
    }),
  };
}

const glanz = (argv: readonly string[], cwd: string) => start(argv, cwd).ended;
const sleep = (ms: number) => new Promise((done) => setTimeout(done, ms));

/** A batch of variants × steps around the model. */
function batchFolder(views: number, defaults: object = {}): string {
  const folder = temporaryFolder({ 'shoe.glb': makeGlb({ variants: true }) });
  const batch = {
    defaults: { model: 'shoe.glb', size: '16x16', samples: 4, 'max-depth': 3, bits: 16, ...defaults },
    images: [{ variant: 'all', turntable: views, output: 'out/{variant}-{view}.png' }],
  };
  writeFileSync(join(folder, 'batch.json'), JSON.stringify(batch));
  return folder;
}

/** All files below a folder, with their bytes. */
const filesOf = (folder: string) =>
  Object.fromEntries(
    readdirSync(folder)
      .sort()
      .map((name) => [name, readFileSync(join(folder, name)).toString('base64')]),
  );

/** A Redis that ends with the test. */
async function redisOf(folder: string): Promise<RedisServer> {
  const redis = await startRedis(redisProgram.program!, join(folder, 'redis'));
  onTestFinished(() => redis.stop());
  return redis;
}

/** How far the farm is. */
async function statusOf({ url }: RedisServer): Promise<FarmStatus> {
  const queue = await openFarmQueue({ redis: url });
  try {
    return await queue.status();
  } finally {
    await queue.close();
  }
}

/** The results in a folder's store. */
const resultsOf = (folder: string) => {
  const results = join(folder, '.glanz-farm/results');
  return readdirSync(results)
    .flatMap((prefix) => readdirSync(join(results, prefix)).map((id) => join(results, prefix, id, 'result.json')))
    .map(
      (file) =>
        JSON.parse(readFileSync(file, 'utf8')) as {
          info: { samples: number; resumedSamples: number; gpuLosses: number };
        },
    );
};

describe.skipIf(redisProgram.missing !== undefined)(redisProgram.missing ?? 'glanz farm', () => {
  it(
    'renders all images, bit for bit those of one machine, while workers, GPUs and Redis end',
    async () => {
      const views = FULL ? 80 : 8;
      const count = 3 * views;
      const alone = batchFolder(views);
      const plain = await glanz(['farm', 'submit', 'batch.json', '--gpu', 'software', '--json'], alone);
      expect(plain.code, plain.err).toBe(0);
      expect(JSON.parse(plain.out)).toMatchObject({ ok: true, total: count, failed: 0 });
      const expected = filesOf(join(alone, 'out'));
      delete expected['.glanz-journal.jsonl'];
      expect(Object.keys(expected).length).toBe(count);

      const folder = batchFolder(views);
      const redis = await redisOf(folder);
      const at = ['--redis', redis.url, '--json'];
      const submitted = await glanz(['farm', 'submit', 'batch.json', ...at], folder);
      expect(submitted.code, submitted.err).toBe(0);
      expect(JSON.parse(submitted.out)).toMatchObject({ images: count, queued: count, finished: 0 });

      const done: string[] = [];
      const work = (index: number): Running => {
        // Every second worker has a GPU that is lost once in each of its renderers' processes.
        const faults = index % 2 === 1 ? { GPU_WEBGPU: faultyDawn, GLANZ_TEST_LOSE_AT: String(20 + 7 * index) } : {};
        const running = start(
          ['farm', 'work', '--redis', redis.url, '--gpu', 'software', '--until-empty', '--lock', '3'],
          folder,
          faults,
        );
        void running.ended.then(({ err }) => done.push(...(err.match(/^done .*(?=,)/gm) ?? [])));
        return running;
      };
      const workers = Array.from({ length: FULL ? 4 : 2 }, (_, i) => work(i));
      let kills = 0;
      let over = false;
      const left = async () => {
        // Redis may have been killed meanwhile.
        const status = await statusOf(redis).catch(() => undefined);
        if (!status) return Infinity;
        expect(status.failed).toBe(0);
        return status.waiting + status.active + status.delayed;
      };
      const killer = (async () => {
        let killedRedis = false;
        const finished = () => (existsSync(join(folder, 'out')) ? readdirSync(join(folder, 'out')).length : 0);
        // Some images between two kills: a worker compiles its programs first, which takes long on a busy machine.
        for (let next = 3; !over && (FULL || kills < 1); next = finished() + 5) {
          while (!over && finished() < next) await sleep(200);
          if (over) break;
          const index = kills % workers.length;
          workers[index]!.child.kill('SIGKILL');
          await workers[index]!.ended;
          kills++;
          workers[index] = work(index);
          if (!killedRedis && kills > (FULL ? 4 : 0)) {
            killedRedis = true;
            await redis.kill();
            await sleep(1000);
            await redis.start();
          }
        }
      })();
      for (const end = Date.now() + (MINUTES - 2) * 60_000; Date.now() < end; await sleep(500)) {
        if ((await left()) === 0) break;
      }
      over = true;
      await killer;
      const ended = await Promise.all(workers.map((one) => one.ended));
      expect(
        ended.map(({ code }) => code),
        ended.map(({ err }) => err).join('\n---\n'),
      ).toEqual(workers.map(() => 0));
      expect(kills).toBeGreaterThan(FULL ? 20 : 0);
      // None was finished twice. A worker may be killed between the result and this line, which then is missing.
      expect(new Set(done).size).toBe(done.length);
      expect(done.length).toBeGreaterThanOrEqual(count - kills);
      expect(filesOf(join(folder, 'out'))).toEqual(expected);
      expect(resultsOf(folder).filter(({ info }) => info.gpuLosses > 0).length).toBeGreaterThan(0);

      // Each was rendered to its end once, and stands once in the manifest.
      const manifest = await glanz(['farm', 'manifest', 'batch.json', '--manifest', 'm.json', '--json'], folder);
      expect(JSON.parse(manifest.out)).toEqual({ ok: true, images: count, missing: 0, manifest: 'm.json' });
      const { images } = JSON.parse(readFileSync(join(folder, 'm.json'), 'utf8')) as {
        images: { id: string; variant: string; files: { path: string }[] }[];
      };
      expect(new Set(images.map(({ id }) => id)).size).toBe(count);
      expect(images.map(({ files }) => files[0]!.path.replace('out/', '')).sort()).toEqual(Object.keys(expected));
      expect(readdirSync(join(folder, '.glanz-farm/checkpoints'))).toEqual([]);

      // Submitted again, nothing is rendered.
      const again = await glanz(['farm', 'submit', 'batch.json', ...at], folder);
      expect(JSON.parse(again.out)).toMatchObject({ queued: 0, finished: count });
    },
    MINUTES * 60_000,
  );

  it('SIGTERM: the job goes back with its samples, and another worker continues from there', async () => {
    const folder = batchFolder(1);
    writeFileSync(
      join(folder, 'batch.json'),
      JSON.stringify([{ model: 'shoe.glb', size: '24x24', samples: 500, 'max-depth': 2, output: 'x.png' }]),
    );
    const redis = await redisOf(folder);
    const at = ['--redis', redis.url, '--json'];
    expect((await glanz(['farm', 'submit', 'batch.json', ...at], folder)).code).toBe(0);
    const work = () => start(['farm', 'work', '--gpu', 'software', '--lock', '2', '--until-empty', ...at], folder);
    const first = work();
    const samples = async () => (await statusOf(redis)).workers[0]?.job?.samples ?? 0;
    for (let tries = 0; tries < 600 && (await samples()) === 0; tries++) await sleep(100);
    first.child.kill('SIGTERM');
    expect(await first.ended).toMatchObject({ code: 0, out: '{"ok":true,"done":0,"failed":0}\n' });
    expect(readdirSync(join(folder, '.glanz-farm/checkpoints')).length).toBe(1);
    const { out } = await glanz(['farm', 'status', ...at], folder);
    expect(JSON.parse(out)).toMatchObject({ waiting: 1, active: 0, failed: 0, done: 0, workers: [] });
    expect(await work().ended).toMatchObject({ code: 0 });
    const result = resultsOf(folder)[0]!;
    expect(result.info.resumedSamples).toBeGreaterThan(0);
    expect(result.info.samples).toBe(500);
    expect(existsSync(join(folder, 'x.png'))).toBe(true);
  });
});

describe('without a queue', () => {
  it('an image in parts: that of glanz merge bit for bit, and that of one render within the rounding of its sums', async () => {
    const folder = temporaryFolder({ 'shoe.glb': makeGlb({ camera: true }) });
    const row = { model: 'shoe.glb', size: '12x8', samples: 40, 'max-depth': 3, bits: 32, output: 'x.exr' };
    writeFileSync(join(folder, 'batch.json'), JSON.stringify([row]));
    const task = ['farm', 'task', 'batch.json', '--gpu', 'software', '--json'];
    const split = await glanz([...task, '--split', '16', '--store', 'a'], folder);
    expect([split.code, split.out], split.err).toEqual([0, '{"ok":true,"images":1,"rendered":4}\n']);
    const parts = readFileSync(join(folder, 'x.exr'));
    const again = await glanz([...task, '--split', '16', '--store', 'a', '--image', '0'], folder);
    expect(again.out).toBe('{"ok":true,"images":1,"rendered":0}\n');
    const whole = await glanz([...task, '--store', 'b'], folder);
    expect(whole.out, whole.err).toBe('{"ok":true,"images":1,"rendered":1}\n');
    const one = decodeExr(new Uint8Array(readFileSync(join(folder, 'x.exr'))));
    const films = [];
    for (const [from, samples] of [
      [0, 16],
      [16, 16],
      [32, 8],
    ]) {
      const range = ['--samples-from', String(from), '--samples', String(samples), '-o', `${from}.film`];
      const render = ['render', 'shoe.glb', '--gpu', 'software', '--size', '12x8', '--max-depth', '3'];
      expect((await glanz([...render, ...range], folder)).code).toBe(0);
      films.push(`${from}.film`);
    }
    expect((await glanz(['merge', ...films, '-o', 'm.exr', '--bits', '32'], folder)).code).toBe(0);
    expect(Buffer.compare(parts, readFileSync(join(folder, 'm.exr')))).toBe(0);
    const merged = decodeExr(new Uint8Array(parts));
    // The bound that mergeFilmStates() states, for 40 samples.
    const bound = (40 / 16 + 16) * 2 ** -23;
    let lit = 0;
    for (const channel of ['R', 'G', 'B'] as const) {
      const [a, b] = [merged, one].map(({ channels }) => channels.get(channel)!.data as Float32Array);
      for (let i = 0; i < b!.length; i++) {
        expect(Math.abs(a![i]! - b![i]!)).toBeLessThanOrEqual(bound * Math.abs(b![i]!));
        if (b![i]! > 0) lit++;
      }
    }
    expect(lit).toBeGreaterThan(100);
  });

  // The store in a bucket has tests of its own (s3-store.test.ts of the farm).
  it.runIf(FULL)(
    'machines that share a bucket alone: parts of one, the merge of another, and the bits of a folder',
    async () => {
      const folder = temporaryFolder({ 'shoe.glb': makeGlb({ camera: true }) });
      const row = { model: 'shoe.glb', size: '8x8', samples: 32, 'max-depth': 2, bits: 16, output: 'x.png' };
      writeFileSync(join(folder, 'batch.json'), JSON.stringify([row]));
      const server = await startS3(join(folder, 's3'), 'farm');
      onTestFinished(() => server.stop());
      const task = (...argv: string[]) =>
        start(
          ['farm', 'task', 'batch.json', '--gpu', 'software', '--split', '16', '--json', ...argv],
          folder,
          server.env,
        ).ended;
      const bucket = ['--store', 's3://farm/shoes', '--s3-endpoint', server.endpoint, '--store-cache'];
      const part = await task(...bucket, 'a', '--part', '0');
      expect([part.code, part.out], part.err).toEqual([0, '{"ok":true,"images":1,"rendered":1}\n']);
      expect(existsSync(join(folder, 'x.png'))).toBe(false);
      const rest = await task(...bucket, 'b');
      expect([rest.code, rest.out], rest.err).toEqual([0, '{"ok":true,"images":1,"rendered":2}\n']);
      const image = readFileSync(join(folder, 'x.png'));
      // In a folder, on two devices at the same time.
      const inFolder = await task('--store', 'c', '--gpu', 'software');
      expect(inFolder.out, inFolder.err).toBe('{"ok":true,"images":1,"rendered":3}\n');
      expect(Buffer.compare(image, readFileSync(join(folder, 'x.png')))).toBe(0);
      const missing = await task('--store', 's3://none', ...bucket.slice(2), 'd');
      expect([missing.code, missing.out]).toEqual([1, expect.stringContaining('farm/store-access')]);
    },
  );

  it('the manifest says what is missing', async () => {
    const folder = batchFolder(1);
    const task = await glanz(['farm', 'task', 'batch.json', '--image', '0,2', '--gpu', 'software'], folder);
    expect(task.code, task.err).toBe(0);
    // Images have the names of the batch, not those that they have in the store until they are finished.
    expect(task.err).toMatch(/^out\/red-turntable-000\.png · red · turntable-000: 16×16, 4 samples at /m);
    expect(task.err).not.toContain('working');
    expect(readdirSync(join(folder, 'out')).sort()).toEqual(['deep_blue-turntable-000.png', 'red-turntable-000.png']);
    const { code, out } = await glanz(['farm', 'manifest', 'batch.json', '--manifest', 'm.json', '--json'], folder);
    expect([code, out]).toEqual([1, '{"ok":false,"images":2,"missing":1,"manifest":"m.json"}\n']);
    const { images } = JSON.parse(readFileSync(join(folder, 'm.json'), 'utf8')) as {
      images: { variant: string; files: { path: string; bytes: number; sha256: string }[] }[];
    };
    expect(images.map(({ variant }) => variant)).toEqual(['red', 'deep blue']);
    for (const { path, bytes, sha256 } of images.flatMap(({ files }) => files)) {
      const content = readFileSync(join(folder, path));
      expect([content.length, createHash('sha256').update(content).digest('hex')]).toEqual([bytes, sha256]);
    }
    // Another model: nothing of it is finished.
    writeFileSync(join(folder, 'shoe.glb'), makeGlb({ variants: true, camera: true }));
    const other = await glanz(['farm', 'manifest', 'batch.json', '--manifest', 'm.json', '--json'], folder);
    expect(other.out).toBe('{"ok":false,"images":0,"missing":3,"manifest":"m.json"}\n');
  });
});
