import { execFile, spawn, type ChildProcess } from 'node:child_process';
import { existsSync, mkdirSync, readdirSync, renameSync, rmSync } from 'node:fs';
import { connect, createServer, type AddressInfo } from 'node:net';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { promisify } from 'node:util';

const run = promisify(execFile);
const CACHE = fileURLToPath(new URL('../../../.cache/redis', import.meta.url));
/** What redis-server needs beside what every Debian has. */
const PACKAGES = ['redis-server', 'redis-tools', 'liblzf1', 'libjemalloc2'];

/** A program and the environment that it needs. */
export interface RedisProgram {
  readonly file: string;
  readonly env: Readonly<Record<string, string>>;
}

/** A Redis, or why there is none. */
export type FoundRedis =
  | { readonly program: RedisProgram; readonly missing?: undefined }
  | { readonly program?: undefined; readonly missing: string };

const works = async ({ file, env }: RedisProgram): Promise<boolean> =>
  run(file, ['--version'], { env: { ...process.env, ...env } }).then(
    () => true,
    () => false,
  );

/** Where a folder with unpacked packages has the program and its libraries. */
function unpacked(folder: string): RedisProgram {
  const libraries = join(folder, 'usr/lib');
  const folders = existsSync(libraries) ? readdirSync(libraries).map((name) => join(libraries, name)) : [];
  return { file: join(folder, 'usr/bin/redis-server'), env: { LD_LIBRARY_PATH: folders.join(':') } };
}

/** Finds `redis-server`, or downloads the distribution's package without installing it. */
export async function findRedis(cache = CACHE): Promise<FoundRedis> {
  const named = process.env.GLANZ_REDIS_SERVER;
  for (const file of named ? [named] : ['redis-server'])
    if (await works({ file, env: {} })) return { program: { file, env: {} } };
  if (named) return { missing: `GLANZ_REDIS_SERVER: "${named}" does not run` };
  if (await works(unpacked(cache))) return { program: unpacked(cache) };
  const partial = `${cache}.${process.pid}`;
  try {
    mkdirSync(partial, { recursive: true });
    await run('apt-get', ['download', ...PACKAGES], { cwd: partial, timeout: 60_000 });
    for (const name of readdirSync(partial).filter((one) => one.endsWith('.deb')))
      await run('dpkg', ['-x', name, 'root'], { cwd: partial });
    if (!(await works(unpacked(cache)))) {
      rmSync(cache, { recursive: true, force: true });
      renameSync(join(partial, 'root'), cache);
    }
  } catch (cause) {
    const why = ((cause as Error).message.trim().split('\n').at(-1) as string).slice(0, 200);
    return { missing: `there is no redis-server, and apt-get cannot download it: ${why}` };
  } finally {
    rmSync(partial, { recursive: true, force: true });
  }
  return (await works(unpacked(cache)))
    ? { program: unpacked(cache) }
    : { missing: 'the redis-server that apt-get downloaded does not run here' };
}

/** A port of the loopback address that was free a moment ago. */
export const freePort = (): Promise<number> =>
  new Promise((done, fail) => {
    const server = createServer();
    server.once('error', fail);
    server.listen(0, '127.0.0.1', () => {
      const { port } = server.address() as AddressInfo;
      server.close(() => done(port));
    });
  });

/** A Redis that can be killed and started again on what it has written. */
export class RedisServer {
  readonly port: number;
  readonly #program: RedisProgram;
  readonly #folder: string;
  #child: ChildProcess | undefined;

  /** @param folder Where its append-only file is. */
  constructor(program: RedisProgram, folder: string, port: number) {
    this.#program = program;
    this.#folder = folder;
    this.port = port;
  }

  /** The address. */
  get url(): string {
    return `redis://127.0.0.1:${this.port}`;
  }

  /** Starts it, and waits until it answers. */
  async start(): Promise<void> {
    const { file, env } = this.#program;
    const child = spawn(
      file,
      `--port ${this.port} --bind 127.0.0.1 --appendonly yes --maxmemory-policy noeviction`
        .split(' ')
        .concat('--dir', this.#folder, '--save', ''),
      { env: { ...process.env, ...env }, stdio: ['ignore', 'pipe', 'pipe'] },
    );
    let said = '';
    child.stdout.on('data', (chunk: Buffer) => (said += chunk.toString()));
    child.stderr.on('data', (chunk: Buffer) => (said += chunk.toString()));
    this.#child = child;
    for (let tries = 0; tries < 200; tries++) {
      if (child.exitCode !== null) break;
      if (await this.#answers()) return;
      await new Promise((done) => setTimeout(done, 50));
    }
    throw new Error(`redis-server does not answer: ${said.slice(-500)}`);
  }

  /** Whether it was started and not ended. */
  get running(): boolean {
    return this.#child !== undefined;
  }

  /** Ends it at once, as a crash does. */
  kill(): Promise<void> {
    return this.#end('SIGKILL');
  }

  /** Ends it. */
  stop(): Promise<void> {
    return this.#end('SIGTERM');
  }

  async #end(signal: NodeJS.Signals): Promise<void> {
    const child = this.#child;
    if (!child || child.exitCode !== null || child.signalCode !== null) return;
    const ended = new Promise((done) => child.once('close', done));
    child.kill(signal);
    await ended;
    this.#child = undefined;
  }

  /** Whether it takes commands; while it reads its file it does not. */
  #answers(): Promise<boolean> {
    return new Promise((done) => {
      const socket = connect(this.port, '127.0.0.1', () => socket.write('PING\r\n'));
      socket.once('data', (chunk: Buffer) => {
        socket.destroy();
        done(chunk.toString().startsWith('+PONG'));
      });
      socket.once('error', () => done(false));
    });
  }
}

/** Starts a Redis on a free port. */
export async function startRedis(program: RedisProgram, folder: string): Promise<RedisServer> {
  mkdirSync(folder, { recursive: true });
  const server = new RedisServer(program, folder, await freePort());
  await server.start();
  return server;
}
