import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { FolderStore, startFarmWorker } from '@glanz/farm';
import { findRedis, startRedis } from '@glanz/redis';
import sharp from 'sharp';
import { expect, it, onTestFinished } from 'vitest';
import { runCli } from '../src/index';
import { fakeBackend, fakeIo, temporaryFolder } from './fakes';
import { makeGlb } from './glb';

const found = await findRedis();

it.skipIf(found.missing !== undefined)(
  found.missing ?? 'submit, status, serve and cancel of one queue, in this process',
  async () => {
    const cwd = temporaryFolder({ 'm.glb': makeGlb() });
    writeFileSync(join(cwd, 'b.json'), JSON.stringify([{ model: 'm.glb', turntable: 3, output: '{view}.png' }]));
    const redis = await startRedis(found.program!, join(cwd, 'redis'));
    onTestFinished(() => redis.stop());
    const run = async (...argv: string[]) => {
      const io = fakeIo(cwd);
      const code = await runCli(['farm', ...argv, '--redis', redis.url], io, fakeBackend().backend);
      return { code, out: io.out.join(''), err: io.err.join('') };
    };
    const submitted = await run('submit', 'b.json');
    expect(submitted.code, submitted.err).toBe(0);
    expect(submitted.err).toMatch(/^3 images: 3 jobs queued, in /m);
    // The queue drops what it has.
    expect((await run('submit', 'b.json')).code).toBe(0);
    expect((await run('status')).out).toBe('0 done · 0 active · 3 waiting · 0 delayed · 0 failed\n');
    expect((await run('status', '--metrics')).out).toContain('glanz_farm_jobs{state="waiting"} 3\n');

    const io = fakeIo(cwd);
    const serving = runCli(['farm', 'serve', '--port', '0', '--json', '--redis', redis.url], io, fakeBackend().backend);
    while (io.out.length === 0) await new Promise((done) => setTimeout(done, 20));
    const { url } = JSON.parse(io.out[0]!) as { url: string };
    expect(new URL(url).hostname).toBe('127.0.0.1');
    expect(await (await fetch(`${url}status.json`)).json()).toMatchObject({ status: { waiting: 3 }, recent: [] });
    // A result that the store has, and its thumbnail.
    const store = new FolderStore(join(cwd, '.glanz-farm'));
    const id = 'a'.repeat(40);
    const folder = await store.begin(id);
    const image = sharp({ create: { width: 1000, height: 500, channels: 3, background: 'red' } });
    await image.png().toFile(join(folder, '0.png'));
    await store.commit(folder, { id, label: 'a', seconds: 1, worker: 'w', finished: '' }, ['0.png']);
    const thumbnail = await (await fetch(`${url}thumbnail/${id}/0`)).arrayBuffer();
    expect(await sharp(Buffer.from(thumbnail)).metadata()).toMatchObject({ format: 'png', width: 400, height: 200 });
    const { port } = new URL(url);
    expect(await run('serve', '--port', port)).toMatchObject({ code: 2, err: expect.stringMatching(/\[cli\/port\]/) });
    io.interrupt();
    expect(await serving).toBe(0);

    expect((await run('cancel', '--all')).err).toBe('3 jobs removed, 0 stop\n');
    expect((await run('retry', '--all')).err).toBe('0 jobs are queued again\n');
    expect(JSON.parse((await run('status', '--json')).out)).toMatchObject({ ok: true, waiting: 0, deadLetters: [] });
    // Taken back, they can be submitted again.
    const again = await run('submit', 'b.json');
    expect([again.code, again.err]).toEqual([0, expect.not.stringContaining('permanently')]);
    expect((await run('status')).out).toContain('3 waiting');

    // Those that have failed permanently stay so, and submitting says it.
    const worker = await startFarmWorker({
      redis: redis.url,
      store: new FolderStore(join(cwd, '.glanz-farm')),
      renderer: {
        script: fileURLToPath(new URL('../../farm/test/renderer.mjs', import.meta.url)),
        args: [join(cwd, 'log.txt')],
        env: { TEST_FAIL: 'input' },
      },
    });
    onTestFinished(() => worker.drain());
    writeFileSync(join(cwd, 'log.txt'), '');
    await expect.poll(async () => (await run('status')).out, { timeout: 30_000 }).toContain('3 failed');
    expect((await run('submit', 'b.json')).err).toMatch(
      /3 jobs of this queue have failed permanently.*glanz farm retry/,
    );
  },
);
