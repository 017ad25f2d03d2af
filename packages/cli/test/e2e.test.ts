import { existsSync, readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { decodeExr } from '@glanz/image';
import sharp from 'sharp';
import { describe, expect, it } from 'vitest';
import { runCli } from '../src/index';
import { fakeIo, temporaryFolder, type FakeIo } from './fakes';
import { makeGlb } from './glb';
import { keptBackend } from './kept-gpu';

/** Made when packages are built. */
const WEIGHTS = join(import.meta.dirname, '../../denoise-weights/weights/rt_hdr_alb_nrm_small.tza');

const backend = keptBackend();

/** The real loader and the real renderer, on the software GPU. */
async function glanz(argv: readonly string[], cwd: string, io: FakeIo = fakeIo(cwd)) {
  io.time = 0;
  const code = await runCli(['render', ...argv, '--gpu', 'software'], io, backend);
  return { code, out: io.out.join(''), err: io.err.join('') };
}

describe('a red square', () => {
  const cwd = () => temporaryFolder({ 'red.glb': makeGlb({ camera: true }), 'bare.glb': makeGlb() });

  it('comes out red before the studio, with true features in its EXR', async () => {
    const folder = cwd();
    const { code, err } = await glanz(
      ['red.glb', '-o', 'red.png', '-o', 'red.exr', '--size', '32x24', '--samples', '16', '--max-depth', '3'],
      folder,
    );
    expect([code, err.includes('internal')], err).toEqual([0, false]);
    const { data, info } = await sharp(join(folder, 'red.png'))
      .ensureAlpha()
      .raw()
      .toBuffer({ resolveWithObject: true });
    expect([info.width, info.height]).toEqual([32, 24]);
    const pixel = (x: number, y: number) =>
      [...data.subarray((y * 32 + x) * 4, (y * 32 + x) * 4 + 4)] as [number, number, number, number];
    const [r, g, b, a] = pixel(16, 12);
    expect(r).toBeGreaterThan(100);
    expect(Math.max(g, b)).toBeLessThan(r * 0.7);
    expect(a).toBe(255);
    // The corner shows the studio, which has no colour.
    const corner = pixel(0, 0);
    expect(Math.max(...corner.slice(0, 3)) - Math.min(...corner.slice(0, 3))).toBeLessThanOrEqual(1);

    const exr = decodeExr(new Uint8Array(readFileSync(join(folder, 'red.exr'))));
    const at = (name: string, x: number, y: number) => exr.channels.get(name)?.data[y * 32 + x] as number;
    // The square is 4 m away, and 2·4·tan(0.3) = 2.47 m of height are in view: 2 m of them are 19 of 24 rows.
    // A pixel is 0.103 m wide, and this one touches the axis: rays through it are at most 0.0027 m longer.
    expect(at('depth.Z', 16, 12)).toBeCloseTo(4.0009, 2);
    expect(
      [at('normal.X', 16, 12), at('normal.Y', 16, 12), at('normal.Z', 16, 12)].map((v) =>
        Math.abs(Math.round(v * 100)),
      ),
    ).toEqual([0, 0, 100]);
    expect([at('objectId.id', 16, 12), at('materialId.id', 16, 12), at('objectId.id', 0, 0)]).toEqual([
      0, 0, 0xffffffff,
    ]);
    expect(at('A', 16, 12)).toBe(1);
    expect(at('albedo.R', 16, 12)).toBeGreaterThan(3 * at('albedo.G', 16, 12));
    let rows = 0;
    for (let y = 0; y < 24; y++) if (at('objectId.id', 16, y) === 0) rows++;
    expect(Math.abs(rows - 19.4)).toBeLessThan(1.5);
  });

  it('to a noise target, through another filter and a parallel projection', async () => {
    const folder = cwd();
    const camera = '{"position":[0,0,4],"projection":"orthographic","height":4}';
    const { code, out, err } = await glanz(
      [
        'red.glb',
        '-o',
        'red.exr',
        '--bits',
        '32',
        '--size',
        '16x16',
        '--samples',
        '256',
        '--noise',
        '0.5',
        '--filter',
        'gaussian',
        '--light-groups',
        'each',
        '--camera',
        camera,
        '--max-depth',
        '3',
        '--json',
      ],
      folder,
    );
    expect(code, err).toBe(0);
    const { samples, noise, statistics } = JSON.parse(out) as {
      samples: number;
      noise: number;
      statistics: { memory: { perPath: number } };
    };
    expect(samples).toBeGreaterThanOrEqual(64);
    expect(noise).toBeLessThanOrEqual(0.5);
    expect(statistics.memory.perPath).toBeGreaterThan(0);
    const exr = decodeExr(new Uint8Array(readFileSync(join(folder, 'red.exr'))));
    const at = (name: string, x: number, y: number) => exr.channels.get(name)?.data[y * 16 + x] as number;
    // A square of 2 m in a view of 4 m: columns 4 to 11. The filter reaches 1.5 pixels beyond.
    expect([
      at('objectId.id', 3, 8),
      at('objectId.id', 4, 8),
      at('objectId.id', 11, 8),
      at('objectId.id', 12, 8),
    ]).toEqual([0xffffffff, 0, 0, 0xffffffff]);
    expect(at('position.X', 8, 8)).toBeCloseTo(0.125, 2);
    expect(at('depth.Z', 8, 8)).toBeCloseTo(4, 5);
    // Lit by the studio alone: one group, which is the image itself.
    expect([...exr.channels.keys()].filter((name) => name.startsWith('light.'))).toEqual([]);
    expect(at('variance.R', 8, 8)).toBeGreaterThanOrEqual(0);
    expect(at('variance.R', 8, 8)).toBeLessThan(0.01);
  });

  it.skipIf(!existsSync(WEIGHTS))('of a farm in parts is denoised when it has been merged', async () => {
    const folder = cwd();
    const image = { model: 'red.glb', size: '32x24', samples: 48, denoise: 'fast' };
    const task = async (row: object, store: string) => {
      writeFileSync(join(folder, 'b.json'), JSON.stringify([row]));
      const io = fakeIo(folder);
      const argv = ['farm', 'task', 'b.json', '--split', '16', '--store', store, '--gpu', 'software'];
      expect(await runCli(argv, io, backend), io.err.join('')).toBe(0);
    };
    const pixels = (name: string) => sharp(join(folder, name)).raw().toBuffer();
    await task({ ...image, output: 'split.png' }, 'a');
    await task({ ...image, denoise: undefined, output: 'merged.film' }, 'b');
    await task({ ...image, denoise: undefined, output: 'noisy.png' }, 'c');
    // A film is a checkpoint: no sample is left to render, and the same film is denoised.
    const size = ['--size', '32x24', '--samples', '48'];
    const render = ['red.glb', ...size, '--checkpoint', 'merged.film', '--denoise', 'fast', '-o', 'whole.png'];
    const { code, err } = await glanz(render, folder);
    expect([code, err.includes('going on from sample 48')], err).toEqual([0, true]);
    const [split, whole, noisy] = await Promise.all(['split.png', 'whole.png', 'noisy.png'].map(pixels));
    expect(Buffer.compare(split!, whole!)).toBe(0);
    expect(noisy!.reduce((max, v, i) => Math.max(max, Math.abs(v - split![i]!)), 0)).toBeGreaterThan(0);
  });

  it.skipIf(!existsSync(WEIGHTS))('has less noise in the layer denoised, and the same film', async () => {
    const folder = cwd();
    // More than 32 samples: the variance of the film is known.
    const argv = ['red.glb', '--size', '48x32', '--max-depth', '4', '--bits', '32'];
    const layers = async (name: string, ...more: string[]) => {
      const { code, err } = await glanz([...argv, ...more, '-o', name], folder);
      expect(code, err).toBe(0);
      return decodeExr(new Uint8Array(readFileSync(join(folder, name)))).channels;
    };
    const plain = await layers('plain.exr', '--samples', '36');
    const denoised = await layers('denoised.exr', '--samples', '36', '--denoise', 'fast');
    // Its own noise adds the same to both errors, and so brings their ratio nearer to 1.
    const reference = await layers('reference.exr', '--samples', '192', '--seed', '9');
    for (const name of ['R', 'G', 'B', 'A']) expect(denoised.get(name)).toEqual(plain.get(name));
    const error = (image: typeof plain, prefix: string) => {
      let sum = 0;
      for (const name of ['R', 'G', 'B']) {
        const [values, exact] = [image.get(`${prefix}${name}`)!.data, reference.get(name)!.data];
        for (let i = 0; i < exact.length; i++) sum += (values[i]! - exact[i]!) ** 2;
      }
      return sum;
    };
    expect(error(denoised, 'denoised.')).toBeLessThan(0.95 * error(denoised, ''));
  });

  it('gives the same bytes for the same seed, others for another', async () => {
    const folder = cwd();
    const size = ['--size', '16x16', '--samples', '3', '--max-depth', '3'];
    for (const [name, seed] of [
      ['a', 1],
      ['b', 1],
      ['c', 2],
    ] as const)
      expect((await glanz(['red.glb', '-o', `${name}.png`, '--seed', String(seed), ...size], folder)).code).toBe(0);
    const [a, b, c] = ['a', 'b', 'c'].map((name) => readFileSync(join(folder, `${name}.png`)));
    expect(Buffer.compare(a as Buffer, b as Buffer)).toBe(0);
    expect(Buffer.compare(a as Buffer, c as Buffer)).not.toBe(0);
  });

  it('is framed without a camera, and stands alone when transparent', async () => {
    const folder = cwd();
    const { code, out, err } = await glanz(
      [
        'bare.glb',
        '-o',
        'bare.png',
        '--size',
        '24x24',
        '--samples',
        '4',
        '--max-depth',
        '2',
        '--transparent',
        '--json',
      ],
      folder,
    );
    expect(code, err).toBe(0);
    const { data } = await sharp(join(folder, 'bare.png')).raw().toBuffer({ resolveWithObject: true });
    const alpha = (x: number, y: number) => data[(y * 24 + x) * 4 + 3];
    expect([alpha(12, 12), alpha(0, 0), alpha(23, 0), alpha(0, 23)]).toEqual([255, 0, 0, 0]);
    expect(JSON.parse(out)).toMatchObject({
      ok: true,
      samples: 4,
      statistics: { triangles: 2, instances: 1, badSamples: 0 },
      adapter: { software: true },
    });
  });

  it('Ctrl-C keeps what is there', async () => {
    const folder = cwd();
    const io = fakeIo(folder);
    const stderr = io.stderr;
    let pressed = false;
    const eager: FakeIo = Object.assign(Object.create(io) as FakeIo, {
      stderr: (text: string) => {
        stderr(text);
        if (!pressed && text.startsWith('render ')) {
          pressed = true;
          io.interrupt();
        }
      },
    });
    const { code, out } = await glanz(
      ['red.glb', '-o', 'red.png', '--size', '64x64', '--samples', '100000', '--max-depth', '4', '--json'],
      folder,
      eager,
    );
    expect(code).toBe(130);
    const result = JSON.parse(out) as { samples: number; interrupted: string };
    expect(result.interrupted).toBe('SIGINT');
    expect(result.samples).toBeGreaterThan(0);
    expect(result.samples).toBeLessThan(100000);
    expect((await sharp(join(folder, 'red.png')).metadata()).width).toBe(64);
  });
});

describe('bad input ends in one line, a code and an exit status, and writes nothing', () => {
  const glb = makeGlb();
  it.each([
    ['a truncated glb', { 'm.glb': glb.subarray(0, glb.length - 40) }, ['m.glb'], 3, /^gltf\/truncated$/],
    ['a glb cut inside its header', { 'm.glb': glb.subarray(0, 10) }, ['m.glb'], 3, /^gltf\//],
    ['a text file called .glb', { 'm.glb': 'dear reader' }, ['m.glb'], 3, /^gltf\/not-gltf$/],
    ['an empty file', { 'm.glb': '' }, ['m.glb'], 3, /^gltf\//],
    ['a missing texture', { 'm.glb': makeGlb({ texture: 'gone.png' }) }, ['m.glb'], 3, /^gltf\/missing-resource$/],
    ['no triangles', { 'm.glb': makeGlb({ empty: true }) }, ['m.glb'], 3, /^(gltf|renderer)\/no-triangles$/],
    ['0×0', { 'm.glb': glb }, ['m.glb', '--size', '0x0'], 2, /^cli\/usage$/],
    ['an unknown option', { 'm.glb': glb }, ['m.glb', '--fast'], 2, /^cli\/usage$/],
    ['a missing file', {}, ['m.glb'], 3, /^cli\/input$/],
    ['no such GPU', { 'm.glb': glb }, ['m.glb', '--gpu', 'abacus'], 5, /^renderer\/no-adapter$/],
  ] as [string, Record<string, string | Uint8Array>, string[], number, RegExp][])(
    '%s',
    async (_what, files, argv, status, code) => {
      const cwd = temporaryFolder(files);
      const io = fakeIo(cwd);
      expect(
        await runCli(
          [
            'render',
            '--json',
            '--quiet',
            ...argv,
            '--samples',
            '1',
            ...(argv.includes('--size') ? [] : ['--size', '8x8']),
          ],
          io,
        ),
      ).toBe(status);
      const lines = io.err.join('').trim().split('\n');
      expect(lines.length, lines.join('\n')).toBe(1);
      const { ok, error } = JSON.parse(io.out.join('')) as { ok: boolean; error: { code: string; message: string } };
      expect(ok).toBe(false);
      expect(error.code).toMatch(code);
      expect(lines[0]).toBe(`glanz: ${error.message} [${error.code}]`);
      expect(readdirSync(cwd)).toEqual(Object.keys(files));
    },
  );
});
