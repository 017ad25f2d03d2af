import { mkdtempSync, rmSync } from 'node:fs';
import { connect } from 'node:net';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { expect, it, onTestFinished } from 'vitest';
import { findRedis, startRedis } from '../src/index';

const command = (port: number, text: string): Promise<string> =>
  new Promise((done, fail) => {
    const socket = connect(port, '127.0.0.1', () => socket.write(`${text}\r\n`));
    socket.once('data', (chunk: Buffer) => {
      socket.destroy();
      done(chunk.toString().trim());
    });
    socket.once('error', fail);
  });

const found = await findRedis();
it.skipIf(found.missing !== undefined)(
  'keeps what it was given when it is killed, and listens on loopback',
  async () => {
    const folder = mkdtempSync(join(tmpdir(), 'glanz-redis-'));
    const redis = await startRedis(found.program!, folder);
    onTestFinished(async () => {
      await redis.stop();
      rmSync(folder, { recursive: true, force: true });
    });
    expect(await command(redis.port, 'SET a 1')).toBe('+OK');
    await redis.kill();
    await expect(command(redis.port, 'GET a')).rejects.toThrow(/ECONNREFUSED/);
    await redis.start();
    expect(await command(redis.port, 'GET a')).toBe('$1\r\n1');
    expect(await command(redis.port, 'CONFIG GET bind')).toContain('127.0.0.1');
  },
);

it('a program that does not run is reported', async () => {
  process.env.GLANZ_REDIS_SERVER = '/nonexistent/redis-server';
  onTestFinished(() => void delete process.env.GLANZ_REDIS_SERVER);
  expect(await findRedis()).toEqual({ missing: 'GLANZ_REDIS_SERVER: "/nonexistent/redis-server" does not run' });
});
