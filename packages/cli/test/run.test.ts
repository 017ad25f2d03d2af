import { chmodSync, existsSync, mkdirSync, readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { decodeExr, decodeHdr, encodeHdr } from '@glanz/image';
import { GlanzError } from '@glanz/scene';
import { toneMapPixels } from '@glanz/tonemap';
import sharp from 'sharp';
import { describe, expect, it } from 'vitest';
import type { Backend } from '../src/backend';
import { FAKE_GPUS, fakeDevice, fakeIo, run, temporaryFolder, triangleScene } from './fakes';

const SIZE = ['--size', '8x6', '--samples', '4'];
const folder = () => temporaryFolder({ 'm.glb': 'not read by the fake' });

describe('help and version', () => {
  it('--help is a manual page within 80 columns that names every option', async () => {
    const { code, out, err } = await run(['--help'], '.');
    expect([code, err]).toEqual([0, '']);
    for (const heading of ['NAME', 'SYNOPSIS', 'DESCRIPTION', 'EXIT STATUS', 'EXAMPLES'])
      expect(out).toContain(`\n${heading}\n`.trimStart());
    for (const option of [
      'output',
      'env',
      'env-rotation',
      'env-intensity',
      'size',
      'samples',
      'noise',
      'max-depth',
      'seed',
      'camera',
      'filter',
      'light-groups',
      'max-bounces',
      'clamp-indirect',
      'regularization',
      'shadow-softness',
      'no-caustics',
      'back-face-culling',
      'exposure',
      'tone-map',
      'bits',
      'transparent',
      'catcher',
      'scene',
      'animation',
      'time',
      'variant',
      'view',
      'turntable',
      'elevation',
      'batch',
      'resume',
      'checkpoint',
      'output-root',
      'lod',
      'materials',
      'strip',
      'tolerance',
      'runs',
      'port',
      'host',
      'json',
      'quiet',
      'list-gpus',
      'gpu',
      'help',
      'version',
    ]) {
      expect(out).toMatch(new RegExp(`--${option}\\b`));
    }
    for (const line of out.split('\n')) expect(line.length, line).toBeLessThanOrEqual(80);
  });
  it('--version is that of the package', async () => {
    const { code, out } = await run(['--version'], '.');
    expect(code).toBe(0);
    expect(out).toBe(
      `${(JSON.parse(readFileSync(new URL('../package.json', import.meta.url), 'utf8')) as { version: string }).version}\n`,
    );
  });
  it('--list-gpus, plain and as JSON', async () => {
    expect((await run(['--list-gpus'], '.')).out).toBe(
      'Fake 3000 · vulkan · fakedrv 1.2\nSwiftShader Device · vulkan · on the CPU\n',
    );
    expect(JSON.parse((await run(['--list-gpus', '--json'], '.')).out)).toEqual({ ok: true, gpus: FAKE_GPUS });
    const none = await run(['--list-gpus'], '.', { listGpus: async () => [] });
    expect([none.code, none.out, none.err.split('\n').length]).toEqual([5, '', 2]);
  });
});

it('parts become catchers by name, and a name that no part has is refused', async () => {
  const { code, created } = await run(['render', 'm.glb', ...SIZE, '--catcher', 'part', '--transparent'], folder());
  expect([code, created[0]?.scene.instances[0]?.catcher]).toEqual([0, true]);
  const refused = await run(['render', 'm.glb', ...SIZE, '--catcher', 'table'], folder());
  expect([refused.code, refused.err]).toEqual([
    2,
    expect.stringContaining('the model has no part "table"; it has "part"'),
  ]);
});

describe('writing', () => {
  it('a PNG holds the tone-mapped film', async () => {
    const cwd = folder();
    const { code, err, out, destroyed } = await run(
      ['render', 'm.glb', ...SIZE, '--tone-map', 'agx', '--exposure', '-1'],
      cwd,
    );
    expect([code, out]).toEqual([0, '']);
    expect(err).toContain('m.png: 8×6, 4 samples');
    expect(destroyed).toEqual(['tracer', 'device']);
    const film = Float32Array.from(
      { length: 8 * 6 * 4 },
      (_, i) => [((i >> 2) % 8) / 8, Math.floor((i >> 2) / 8) / 6, 0.25, 1][i & 3] as number,
    );
    const expected = toneMapPixels(film, 8, 6, { toneMap: 'agx', exposure: -1 });
    const read = await sharp(join(cwd, 'm.png')).ensureAlpha().raw().toBuffer();
    expect(Buffer.compare(read, Buffer.from(expected))).toBe(0);
  });

  it('former names of options work, on the command line and in a batch, and warn once', async () => {
    const cwd = temporaryFolder({
      'm.glb': 'not read by the fake',
      'rows.json': JSON.stringify(
        ['a', 'b'].map((name) => ({ model: 'm.glb', tonemap: 'agx', output: `${name}.png` })),
      ),
    });
    const png = (name: string) => readFileSync(join(cwd, `${name}.png`));
    const now = await run(['render', 'm.glb', ...SIZE, '--tone-map', 'agx', '-o', 'now.png'], cwd);
    expect([now.code, now.err]).toEqual([0, expect.not.stringContaining('warning')]);
    for (const [argv, file] of [
      [['m.glb', '--tonemap', 'agx', '-o', 'former.png'], 'former'],
      [['--batch', 'rows.json'], 'b'],
    ] as const) {
      const { code, err } = await run(['render', ...argv, ...SIZE], cwd);
      expect([code, err.split('"tonemap" is deprecated: the option is called "tone-map"').length - 1]).toEqual([0, 1]);
      expect(Buffer.compare(png(file), png('now'))).toBe(0);
    }
    const deep = await run(['render', 'm.glb', ...SIZE, '--depth', '3'], cwd);
    expect([deep.code, deep.created[0]?.options.maxDepth, deep.err]).toEqual([
      0,
      3,
      expect.stringContaining('"depth" is deprecated: the option is called "max-depth"'),
    ]);
    expect((await run(['render', 'm.glb', ...SIZE, '--tonemap', 'film'], cwd)).err).toContain(
      'There is no tone map "film"',
    );
  });

  it('several formats at once: 16-bit PNG, EXR with its layers, HDR', async () => {
    const cwd = folder();
    const { code } = await run(
      ['render', 'm.glb', ...SIZE, '--bits', '16', '-o', 'a.png', '-o', 'a.exr', '-o', 'a.hdr'],
      cwd,
      { lightGroups: ['key', 'soft box'].map((name) => ({ name, intensity: 1, color: [1, 1, 1] as const })) },
    );
    expect(code).toBe(0);
    expect((await sharp(join(cwd, 'a.png')).metadata()).depth).toBe('ushort');
    const exr = decodeExr(new Uint8Array(readFileSync(join(cwd, 'a.exr'))));
    expect([...exr.channels].map(([name, { type }]) => `${name} ${type}`)).toEqual([
      'A half',
      'B half',
      'G half',
      'R half',
      'albedo.B half',
      'albedo.G half',
      'albedo.R half',
      'depth.Z float',
      'light.key.B half',
      'light.key.G half',
      'light.key.R half',
      'light.soft_box.B half',
      'light.soft_box.G half',
      'light.soft_box.R half',
      'materialId.id uint',
      'normal.X half',
      'normal.Y half',
      'normal.Z half',
      'objectId.id uint',
      'position.X float',
      'position.Y float',
      'position.Z float',
      'variance.B float',
      'variance.G float',
      'variance.R float',
    ]);
    expect(exr.channels.get('R')?.data[9]).toBe(0.125);
    expect(exr.channels.get('albedo.G')?.data[5]).toBe(0.25);
    expect(exr.channels.get('normal.Z')?.data[5]).toBe(1);
    expect(exr.channels.get('position.X')?.data[5]).toBe(5);
    expect(exr.channels.get('variance.G')?.data[5]).toBe(Math.fround(2e-9));
    expect(exr.channels.get('light.soft_box.R')?.data[5]).toBe(8);
    expect(exr.channels.get('depth.Z')?.data[3]).toBe(Math.fround(0.3));
    expect(exr.channels.get('objectId.id')?.data[0]).toBe(0xffffffff);
    expect(exr.attributes.get('samples')).toBe('4');
    const hdr = decodeHdr(new Uint8Array(readFileSync(join(cwd, 'a.hdr'))));
    expect([hdr.width, hdr.height, hdr.data[3 * 9], hdr.data[2]]).toEqual([8, 6, 0.125, 0.25]);
    expect(readdirSync(cwd).sort()).toEqual(['a.exr', 'a.hdr', 'a.png', 'm.glb']);
  });

  it('--bits 32 makes floats of the colours in EXR', async () => {
    const cwd = folder();
    await run(['render', 'm.glb', ...SIZE, '--bits', '32', '-o', 'a.exr'], cwd);
    expect(decodeExr(new Uint8Array(readFileSync(join(cwd, 'a.exr')))).channels.get('R')?.type).toBe('float');
  });

  it('--transparent asks the tracer for it and keeps alpha straight', async () => {
    const cwd = folder();
    const { created } = await run(['render', 'm.glb', ...SIZE, '--transparent', '--tone-map', 'linear'], cwd);
    expect(created[0]?.options.background).toBe('transparent');
    const read = await sharp(join(cwd, 'm.png')).raw().toBuffer({ resolveWithObject: true });
    expect(read.info.channels).toBe(4);
    expect(read.data[3]).toBe(128);
    // Blue is 0.25 in front of nothing at a coverage of a half: 0.5 of itself, code 188.
    expect(read.data[2]).toBe(188);
  });

  it('--json prints one object on stdout, and nothing else goes there', async () => {
    const cwd = folder();
    const { code, out } = await run(['render', 'm.glb', ...SIZE, '--json', '--seed', '7', '--max-depth', '3'], cwd);
    expect(code).toBe(0);
    expect(out.trim().split('\n').length).toBe(1);
    const result = JSON.parse(out) as Record<string, unknown>;
    expect(result).toMatchObject({
      ok: true,
      model: 'm.glb',
      width: 8,
      height: 6,
      samples: 4,
      targetSamples: 4,
      interrupted: null,
      depth: 3,
      seed: 7,
      camera: 'front',
      environment: 'studio',
      adapter: { name: 'Fake 3000', software: false },
      statistics: { triangles: 1, compileMs: 3 },
      warnings: [],
      files: [{ path: 'm.png', format: 'png', bits: 8 }],
    });
    expect(Object.keys(result.timings as object)).toEqual([
      'loadMs',
      'environmentMs',
      'deviceMs',
      'prepareMs',
      'renderMs',
      'readMs',
      'denoiseMs',
      'writeMs',
      'totalMs',
    ]);
  });

  it('the time of loading is that of the model, without what it waits for', async () => {
    const cwd = folder(),
      io = fakeIo(cwd);
    const fake = {
      // Its images are in KTX2: 5 ms before it asks what the GPU reads, 7 after.
      loadModel: async (...[, , , formats]: Parameters<Backend['loadModel']>) => {
        io.time += 5;
        await formats?.();
        io.time += 7;
        return triangleScene();
      },
      openGpu: async () => {
        io.time += 900;
        return { device: fakeDevice(), adapterName: 'Slow', software: false };
      },
    };
    const { out } = await run(['render', 'm.glb', ...SIZE, '--json'], cwd, fake, io);
    expect((JSON.parse(out) as { timings: object }).timings).toMatchObject({
      loadMs: 12,
      environmentMs: 0,
      deviceMs: 900,
      totalMs: 912,
    });
  });

  it('--quiet leaves stderr empty', async () => {
    expect((await run(['render', 'm.glb', ...SIZE, '-q'], folder())).err).toBe('');
  });

  it('passes size, depth, seed and camera on', async () => {
    const { created } = await run(
      ['render', 'm.glb', ...SIZE, '--max-depth', '2', '--seed', '9', '--camera', '{"position":[0,0,9],"fov":20}'],
      folder(),
    );
    expect(created[0]?.options).toMatchObject({ width: 8, height: 6, maxDepth: 2, seed: 9, background: 'environment' });
    expect((created[0]?.options.camera as { yfov: number } | undefined)?.yfov).toBeCloseTo(Math.PI / 9, 12);
  });
});

describe('environment', () => {
  it('the studio by default, the model’s own if it has any, none if asked', async () => {
    const own = { ...triangleScene(), environment: { type: 'constant' as const, radiance: [1, 2, 3] as const } };
    expect((await run(['render', 'm.glb', ...SIZE], folder())).created[0]?.scene.environment).toMatchObject({
      type: 'latlong',
      width: 512,
    });
    expect(
      (await run(['render', 'm.glb', ...SIZE, '--env-intensity', '2'], folder(), { scene: own })).created[0]?.scene
        .environment,
    ).toEqual({ type: 'constant', radiance: [2, 4, 6] });
    expect(
      (await run(['render', 'm.glb', ...SIZE, '--env', 'studio'], folder(), { scene: own })).created[0]?.scene
        .environment?.type,
    ).toBe('latlong');
    expect(
      (await run(['render', 'm.glb', ...SIZE, '--env', 'none'], folder(), { scene: own })).created[0]?.scene
        .environment,
    ).toBeUndefined();
    expect(own.environment.radiance).toEqual([1, 2, 3]);
  });
  it('a file, turned and dimmed', async () => {
    const cwd = folder();
    writeFileSync(join(cwd, 'sky.hdr'), encodeHdr({ width: 2, height: 1, data: Float32Array.of(1, 2, 4, 8, 16, 32) }));
    const { created } = await run(
      ['render', 'm.glb', ...SIZE, '--env', 'sky.hdr', '--env-rotation', '-90', '--env-intensity', '0.5'],
      cwd,
    );
    expect(created[0]?.scene.environment).toEqual({
      type: 'latlong',
      width: 2,
      height: 1,
      data: Float32Array.of(1, 2, 4, 8, 16, 32),
      rotation: -Math.PI / 2,
      intensity: 0.5,
    });
  });
  it('a broken one is an error of its own', async () => {
    const cwd = folder();
    writeFileSync(join(cwd, 'sky.hdr'), 'no image');
    const { code, err } = await run(['render', 'm.glb', ...SIZE, '--env', 'sky.hdr'], cwd);
    expect([code, err.trim().split('\n').at(-1)]).toEqual([
      3,
      'glanz: The environment is neither a Radiance HDR nor an OpenEXR image. [image/format]',
    ]);
    expect((await run(['render', 'm.glb', '--env', 'gone.hdr'], cwd)).err).toContain(
      'Cannot read the environment "gone.hdr": there is no such file.',
    );
  });
});

describe('warnings', () => {
  it('of the loader are shown, five at most, and all are in the JSON', async () => {
    const scene = {
      ...triangleScene(),
      warnings: Array.from({ length: 7 }, (_, i) => ({
        code: 'gltf/x',
        message: `odd thing ${i}`,
        path: `/nodes/${i}`,
      })),
    };
    const { err, out } = await run(['render', 'm.glb', ...SIZE, '--json'], folder(), { scene });
    expect(err).toContain('warning: odd thing 4 (/nodes/4)');
    expect(err).not.toContain('odd thing 5');
    expect(err).toContain('and 2 more');
    expect((JSON.parse(out) as { warnings: string[] }).warnings.length).toBe(7);
  });
});

describe('Ctrl-C', () => {
  it('writes what has been accumulated and ends with 130', async () => {
    const cwd = folder();
    const io = fakeIo(cwd);
    const { code, out, err, destroyed } = await run(
      ['render', 'm.glb', '--size', '8x6', '--samples', '1000', '--json'],
      cwd,
      { onSample: (s) => s === 11 && io.interrupt() },
      io,
    );
    expect(code).toBe(130);
    expect(JSON.parse(out)).toMatchObject({ samples: 10, targetSamples: 1000, interrupted: 'SIGINT' });
    expect(err).toContain('m.png: 8×6, 10 of 1000 samples');
    expect((await sharp(join(cwd, 'm.png')).metadata()).width).toBe(8);
    expect(destroyed).toEqual(['tracer', 'device']);
    expect(io.listening).toBe(0);
  });
  it('SIGTERM likewise, with 143', async () => {
    const cwd = folder();
    const io = fakeIo(cwd);
    expect(
      (await run(['render', 'm.glb', ...SIZE], cwd, { onSample: (s) => s === 3 && io.interrupt('SIGTERM') }, io)).code,
    ).toBe(143);
    expect(existsSync(join(cwd, 'm.png'))).toBe(true);
  });
  it('before the first sample there is nothing to write', async () => {
    const cwd = folder();
    const io = fakeIo(cwd);
    const { code, err, out } = await run(
      ['render', 'm.glb', ...SIZE, '--json'],
      cwd,
      { onSample: () => io.interrupt() },
      io,
    );
    expect(code).toBe(130);
    expect(err).toContain('nothing has been accumulated');
    expect(JSON.parse(out)).toMatchObject({ ok: false, error: { code: 'cli/interrupted' } });
    expect(readdirSync(cwd)).toEqual(['m.glb']);
  });
  it('while the model loads ends it there', async () => {
    const cwd = folder();
    const io = fakeIo(cwd);
    const loadModel: Backend['loadModel'] = async (_file, signal) => {
      io.interrupt();
      signal.throwIfAborted();
      return triangleScene();
    };
    const { code, created } = await run(['render', 'm.glb', ...SIZE], cwd, { loadModel }, io);
    expect([code, created.length]).toEqual([130, 0]);
  });
});

describe('errors are one line with a code, and an exit status', () => {
  const last = (err: string) => err.trim().split('\n').at(-1);
  it('wrong usage: 2', async () => {
    const { code, err, out } = await run(['render', 'm.glb', '--bogus', '--json'], '.');
    expect(code).toBe(2);
    expect(err).toBe('glanz: Unknown option "--bogus". See glanz --help. [cli/usage]\n');
    expect(JSON.parse(out)).toEqual({
      ok: false,
      error: { code: 'cli/usage', message: 'Unknown option "--bogus". See glanz --help.' },
    });
    expect((await run(['render', 'm.glb', '--size', '0x0'], '.')).code).toBe(2);
    expect((await run(['render', 'm.glb', ...SIZE, '--camera', 'back'], folder())).code).toBe(2);
  });
  it('a missing model: 3', async () => {
    const { code, err } = await run(['render', 'gone.glb'], folder());
    expect([code, err]).toEqual([3, 'glanz: Cannot read the model "gone.glb": there is no such file. [cli/input]\n']);
    expect((await run(['render', '.'], folder())).err).toContain('it is a folder');
  });
  it('a typed error of the loader: 3, and nothing is started', async () => {
    class GltfError extends GlanzError {}
    const loadModel = async () => {
      throw new GltfError('gltf/truncated', 'm.glb: the file ends\nearly.');
    };
    const { code, err, created } = await run(['render', 'm.glb'], folder(), { loadModel });
    expect([code, last(err), created.length]).toEqual([3, 'glanz: m.glb: the file ends early. [gltf/truncated]', 0]);
  });
  it('a file that cannot be written, found before anything is loaded: 4', async () => {
    const cwd = folder();
    mkdirSync(join(cwd, 'dir.png'));
    const loadModel = async () => expect.fail('loaded');
    expect(await run(['render', 'm.glb', '-o', 'no/where/x.png'], cwd, { loadModel })).toMatchObject({
      code: 4,
      err: 'glanz: Cannot write "no/where/x.png": its folder does not exist. [cli/output]\n',
    });
    expect(await run(['render', 'm.glb', '-o', 'dir.png'], cwd, { loadModel })).toMatchObject({
      code: 4,
      err: 'glanz: Cannot write "dir.png": it is a folder. [cli/output]\n',
    });
    expect(await run(['render', 'm.glb', '-o', 'm.glb/x.png'], cwd, { loadModel })).toMatchObject({ code: 4 });
  });
  it.skipIf(process.getuid?.() === 0)(
    `${process.getuid?.() === 0 ? '[skipped: root may write everywhere] ' : ''}a folder without permission: 4`,
    async () => {
      const cwd = folder();
      mkdirSync(join(cwd, 'locked'), { mode: 0o500 });
      expect((await run(['render', 'm.glb', '-o', 'locked/x.png'], cwd)).code).toBe(4);
      chmodSync(join(cwd, 'locked'), 0o700);
    },
  );
  it('a file that turns unwritable meanwhile: 4, and no half file stays', async () => {
    const cwd = folder();
    const { code, err } = await run(['render', 'm.glb', ...SIZE], cwd, {
      onSample: (s) => s === 1 && mkdirSync(join(cwd, 'm.png')),
    });
    expect([code, last(err)]).toEqual([4, 'glanz: Cannot write "m.png": it is a folder. [cli/output]']);
    expect(readdirSync(cwd).sort()).toEqual(['m.glb', 'm.png']);
  });
  it('no GPU: 5', async () => {
    class DeviceError extends GlanzError {}
    const openGpu = async () => {
      throw new DeviceError('renderer/no-adapter', 'WebGPU found no usable GPU.');
    };
    expect((await run(['render', 'm.glb'], folder(), { openGpu })).code).toBe(5);
  });
  it('rendering fails: 1, and everything is freed', async () => {
    class DeviceError extends GlanzError {}
    const onSample = () => {
      throw new DeviceError('renderer/out-of-memory', 'The GPU has not enough memory.');
    };
    const { code, destroyed, io } = await run(['render', 'm.glb', ...SIZE], folder(), { onSample });
    expect([code, destroyed, io.listening]).toEqual([1, ['tracer', 'device'], 0]);
  });
  it('our own faults: 70, in one line too', async () => {
    const loadModel = async () => {
      throw new TypeError('x is not\na function');
    };
    const { code, err } = await run(['render', 'm.glb'], folder(), { loadModel });
    expect(code).toBe(70);
    expect(last(err)).toMatch(/^glanz: internal error: x is not a function — please report/);
  });
});
