import { mkdirSync, symlinkSync, writeFileSync } from 'node:fs';
import { request } from 'node:http';
import type { AddressInfo } from 'node:net';
import { join } from 'node:path';
import { validateScene } from '@glanz/scene';
import { describe, expect, it, onTestFinished } from 'vitest';
import { benchScene } from '../src/commands/bench';
import { fileServer, serveCommand } from '../src/commands/serve';
import { HELP, helpOf } from '../src/help';
import { parseCommand } from '../src/command';
import { fakeIo, run, temporaryFolder, triangleScene } from './fakes';

const folder = () => temporaryFolder({ 'm.glb': '' });

describe('info', () => {
  const scene = {
    ...triangleScene(),
    variants: ['red', 'blue'],
    animations: [{ name: 'walk', duration: 1.25 }],
    metadata: { generator: 'A\ntool' },
    images: [{ name: 'wood', width: 2, height: 1, data: new Uint8Array(8) }],
    warnings: [{ code: 'gltf/x', message: 'odd' }],
  };

  it('for people', async () => {
    const { code, out, err } = await run(['info', 'm.glb'], folder(), { scene });
    expect([code, err]).toEqual([0, '']);
    for (const line of [
      'm.glb',
      '  triangles     1',
      '  parts         1: part',
      '  size          2 × 1 × 0 m, from -1, 0, 0',
      '  images        1: wood 2×1',
      '  cameras       1: 0 "front" perspective',
      '  lights        none',
      '  variants      2: "red", "blue"',
      '  animations    1: "walk" 1.25 s',
      '  generator     A tool',
      '  warning       odd [gltf/x]',
    ])
      expect(out.split('\n')).toContain(line);
  });

  it('for programs', async () => {
    const { out } = await run(['info', 'm.glb', '--json'], folder(), { scene });
    expect(JSON.parse(out)).toMatchObject({
      ok: true,
      model: 'm.glb',
      triangles: 1,
      meshTriangles: 1,
      instances: 1,
      bounds: { size: [2, 1, 0] },
      variants: ['red', 'blue'],
      memoryBytes: { geometry: 48, images: 8 },
      environment: 'none',
      warnings: [{ code: 'gltf/x' }],
    });
  });

  it('of what is missing', async () => {
    expect(await run(['info', 'gone.glb'], folder())).toMatchObject({
      code: 3,
      err: expect.stringContaining('[cli/input]'),
    });
    expect(await run(['info'], folder())).toMatchObject({ code: 2 });
  });
});

describe('bench', () => {
  it('measures runs on an empty film each, and reports the median', async () => {
    const { code, out, created, destroyed } = await run(
      ['bench', '--size', '8x4', '--samples', '3', '--runs', '3', '--json', '-q'],
      '.',
    );
    expect(code).toBe(0);
    expect(JSON.parse(out)).toMatchObject({
      ok: true,
      model: 'built-in',
      width: 8,
      height: 4,
      samples: 3,
      adapter: { name: 'Fake 3000' },
      msPerSample: [0, 0, 0],
    });
    expect(created[0]?.scene.instances.length).toBe(50);
    expect(destroyed).toEqual(['tracer', 'device']);
  });

  it('of a model, for people', async () => {
    const { code, out } = await run(['bench', 'm.glb', '--size', '8x4', '--samples', '3', '-q'], folder());
    expect([code, out]).toEqual([0, expect.stringContaining('ms a sample')]);
  });

  it('its scene is sound and has as many triangles as the manual says', () => {
    const scene = benchScene();
    expect(validateScene(scene).filter(({ code }) => code !== 'scene/degenerate')).toEqual([]);
    const triangles = scene.instances.reduce((sum, { mesh }) => sum + scene.meshes[mesh]!.indices.length / 3, 0);
    expect(HELP).toContain(`${(triangles / 1e6).toFixed(1)} million`);
  });

  it('refuses invalid values', async () => {
    for (const argv of [
      ['--runs', '0'],
      ['--size', 'big'],
      ['a.glb', 'b.glb'],
      ['--sample', '3'],
    ])
      expect((await run(['bench', ...argv], '.')).code).toBe(2);
  });
});

describe('serve', () => {
  it('gives the files below its folder and no others', async () => {
    const cwd = temporaryFolder({ 'secret.txt': 'no' });
    mkdirSync(join(cwd, 'site'));
    writeFileSync(join(cwd, 'site', 'index.html'), '<p>hello');
    writeFileSync(join(cwd, 'site', 'a.wasm'), 'x');
    symlinkSync(join(cwd, 'secret.txt'), join(cwd, 'site', 'link.txt'));
    const server = fileServer(join(cwd, 'site'));
    await new Promise<void>((done) => server.listen(0, '127.0.0.1', done));
    onTestFinished(() => void server.close());
    // Addresses as they are: fetch() would tidy them up.
    const get = (path: string, method = 'GET', headers = {}) =>
      new Promise<readonly [number, string | undefined, string]>((resolve, reject) => {
        request({ port: (server.address() as AddressInfo).port, path, method, headers }, (response) => {
          let body = '';
          response
            .on('data', (chunk: Buffer) => (body += chunk.toString()))
            .on('end', () => resolve([response.statusCode!, response.headers['content-type'], body]));
        })
          .on('error', reject)
          .end();
      });
    expect(await get('/')).toEqual([200, 'text/html; charset=utf-8', '<p>hello']);
    expect(await get('/a.wasm?x=1')).toEqual([200, 'application/wasm', 'x']);
    for (const path of [
      '/../secret.txt',
      '/..%2fsecret.txt',
      '/%2e%2e/secret.txt',
      '/link.txt',
      '/none',
      '/%00',
      '//etc/passwd',
      '/..%5csecret.txt',
    ])
      expect((await get(path))[0], path).toBe(404);
    expect((await get('/%zz'))[0]).toBe(400);
    expect((await get('/', 'POST'))[0]).toBe(405);
    // A page whose name was made to point here.
    for (const host of ['example.com', 'localhost.example.com', '127.0.0.1.example.com:80'])
      expect((await get('/', 'GET', { host }))[0], host).toBe(403);
    for (const host of ['localhost', 'LOCALHOST:4173', '127.0.0.1', '127.1.2.3:80', '[::1]:80'])
      expect((await get('/', 'GET', { host }))[0], host).toBe(200);
  });

  it('says what is missing, and where it listens', async () => {
    const io = fakeIo('.');
    await expect(
      serveCommand({ kind: 'serve', json: false, quiet: false, port: 0, host: '127.0.0.1' }, io, temporaryFolder()),
    ).rejects.toMatchObject({ code: 'cli/missing-package' });
    const served = serveCommand(
      { kind: 'serve', json: true, quiet: false, port: 0, host: '127.0.0.1' },
      io,
      temporaryFolder({ 'index.html': 'x' }),
    );
    while (io.out.length === 0) await new Promise((done) => setTimeout(done, 5));
    const { url } = JSON.parse(io.out.join('')) as { url: string };
    expect(await (await fetch(url)).text()).toBe('x');
    const taken = serveCommand(
      { kind: 'serve', json: false, quiet: false, port: Number(new URL(url).port), host: '127.0.0.1' },
      fakeIo('.'),
      temporaryFolder({ 'index.html': 'x' }),
    );
    await expect(taken).rejects.toMatchObject({
      code: 'cli/port',
      message: expect.stringContaining('another program uses it'),
    });
    io.interrupt();
    expect(await served).toBe(0);
  });
});

describe('help', () => {
  it('of a command, by either way', async () => {
    for (const argv of [
      ['help', 'info'],
      ['info', '--help'],
      ['bench', '-h'],
      ['convert', '--help'],
    ]) {
      const { code, out } = await run(argv, '.');
      expect([code, out.includes('EXIT STATUS\n  0 success')]).toEqual([0, true]);
      expect(out).toContain(`glanz ${argv[0] === 'help' ? argv[1] : argv[0]}`);
    }
    expect(helpOf('render')).toBe(HELP);
  });

  it.each([
    ['bnch', 'Did you mean glanz bench?'],
    ['rendr', 'Did you mean glanz render?'],
    ['paint', 'Use glanz render MODEL'],
  ])('%s is no command', (word, guess) => {
    expect(() => parseCommand([word, 'm.glb'])).toThrow(guess);
  });
});
