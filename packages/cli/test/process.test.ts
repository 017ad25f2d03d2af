import { spawn, type ChildProcess } from 'node:child_process';
import { existsSync, mkdirSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { build } from 'esbuild';
import sharp from 'sharp';
import { beforeAll, expect, it } from 'vitest';
import { temporaryFolder } from './fakes';
import { makeGlb } from './glb';

// The program as a process of its own: real signals, real streams, a real exit status. Bundled here from the sources,
// so that it is tested whether or not the packages have been built.
const folder = fileURLToPath(new URL('../.cache/', import.meta.url));
const program = join(folder, 'glanz.mjs');

beforeAll(async () => {
  mkdirSync(folder, { recursive: true });
  await build({
    entryPoints: [fileURLToPath(new URL('../src/glanz.ts', import.meta.url))],
    outfile: program,
    bundle: true,
    platform: 'node',
    format: 'esm',
    target: 'node20',
    conditions: ['@glanz/source'],
    external: ['webgpu', 'sharp', '@sparticuz/chromium', 'draco3dgltf', 'meshoptimizer', 'meshoptimizer/*'],
    // Some dependencies of dependencies are CommonJS and ask for Node's modules by require().
    banner: { js: "import { createRequire as glanzRequire } from 'node:module'; const require = glanzRequire(import.meta.url);" },
    logLevel: 'error',
  });
});

interface Ended {
  readonly code: number | null;
  readonly signal: string | null;
  readonly out: string;
  readonly err: string;
}

function start(argv: readonly string[], cwd: string, onErr: (text: string, child: ChildProcess) => void = () => undefined): Promise<Ended> {
  const child = spawn(process.execPath, [program, ...argv], { cwd, stdio: ['ignore', 'pipe', 'pipe'] });
  let [out, err] = ['', ''];
  child.stdout.on('data', (chunk: Buffer) => void (out += chunk.toString()));
  child.stderr.on('data', (chunk: Buffer) => {
    err += chunk.toString();
    onErr(err, child);
  });
  return new Promise((resolve, reject) => {
    child.on('error', reject);
    child.on('close', (code, signal) => resolve({ code, signal, out, err }));
  });
}

it('--version, at once and by itself', async () => {
  const { code, out, err } = await start(['--version'], '.');
  expect([code, err]).toEqual([0, '']);
  expect(out).toMatch(/^\d+\.\d+\.\d+/);
});

it('an error sets the exit status', async () => {
  expect(await start(['render', 'gone.glb'], temporaryFolder())).toMatchObject({ code: 3, out: '', err: 'glanz: Cannot read the model "gone.glb": there is no such file. [cli/input]\n' });
});

it('a picture, exit status 0, and nothing on stdout', async () => {
  const cwd = temporaryFolder({ 'red.glb': makeGlb({ camera: true }) });
  const { code, out, err } = await start(['render', 'red.glb', '--gpu', 'software', '--size', '16x16', '--samples', '2', '--depth', '2', '-o', 'x.png', '--bits', '16'], cwd);
  expect([code, out], err).toEqual([0, '']);
  expect(err).toMatch(/render 2\/2 samples · [\d.]+ samples\/s · 0:00 left\n/);
  expect(err.trimEnd().split('\n').at(-1)).toMatch(/^x\.png: 16×16, 2 samples at [\d.]+\/s, 0:\d\d in all$/);
  expect((await sharp(join(cwd, 'x.png')).metadata()).depth).toBe('ushort');
});

it('SIGINT writes the picture; the process ends by itself with 130', async () => {
  const cwd = temporaryFolder({ 'red.glb': makeGlb({ camera: true }) });
  let sent = false;
  const { code, signal, out, err } = await start(['render', 'red.glb', '--gpu', 'software', '--size', '48x48', '--samples', '1000000', '--depth', '3', '--json'], cwd, (text, child) => {
    if (!sent && /render \d+\//.test(text)) {
      sent = true;
      child.kill('SIGINT');
    }
  });
  expect([code, signal], err).toEqual([130, null]);
  expect(JSON.parse(out)).toMatchObject({ ok: true, interrupted: 'SIGINT' });
  expect((await sharp(join(cwd, 'red.png')).metadata()).height).toBe(48);
});

it('a second SIGINT ends it at once', async () => {
  const cwd = temporaryFolder({ 'red.glb': makeGlb({ camera: true }) });
  const { signal, code } = await start(['render', 'red.glb', '--gpu', 'software', '--size', '2000x2000', '--samples', '1000000'], cwd, (text, child) => {
    if (/load model/.test(text)) {
      child.kill('SIGINT');
      setTimeout(() => child.kill('SIGINT'), 5);
    }
  });
  // Killed by the second, or, on a fast machine, already done with the first: either way soon and without a picture.
  expect(signal === 'SIGINT' || code === 130).toBe(true);
  expect(existsSync(join(cwd, 'red.png'))).toBe(false);
});
