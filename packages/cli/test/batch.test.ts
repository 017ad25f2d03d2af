import {
  appendFileSync,
  existsSync,
  mkdirSync,
  readdirSync,
  readFileSync,
  rmSync,
  utimesSync,
  writeFileSync,
} from 'node:fs';
import { join } from 'node:path';
import type { Camera } from '@glanz/scene';
import { describe, expect, it } from 'vitest';
import { parseCsv } from '../src/batch-file';
import type { BatchResult, RenderResult } from '../src/index';
import { fakeDevice, fakeIo, run, temporaryFolder, triangleScene } from './fakes';

const SIZE = ['--size', '4x4', '--samples', '2'];
const VARIANTS = ['red', 'green', 'deep blue'];
const scene = { ...triangleScene(), variants: VARIANTS };
const folder = () => temporaryFolder({ 'm.glb': 'not read by the fake', 'n.glb': 'nor this' });
const images = (cwd: string) =>
  readdirSync(cwd, { recursive: true, encoding: 'utf8' })
    .filter((name) => name.endsWith('.png'))
    .sort();

describe('variants and views', () => {
  it('each variant from each view, by one tracer, under names of their own', async () => {
    const cwd = folder();
    const { code, created, edits, destroyed, out } = await run(
      ['render', 'm.glb', ...SIZE, '--variant', 'all', '--view', 'front', '--view', '30,20', '--json'],
      cwd,
      { scene },
    );
    expect(code).toBe(0);
    expect(images(cwd)).toEqual([
      'm-deep_blue-30_20.png',
      'm-deep_blue-front.png',
      'm-green-30_20.png',
      'm-green-front.png',
      'm-red-30_20.png',
      'm-red-front.png',
    ]);
    expect([created.length, destroyed]).toEqual([1, ['tracer', 'device']]);
    expect(edits.filter(([what]) => what === 'variant').map(([, to]) => to)).toEqual([0, 0, 1, 1, 2, 2]);
    const result = JSON.parse(out) as BatchResult;
    expect(result).toMatchObject({ ok: true, total: 6, skipped: 0, failed: 0, interrupted: null });
    expect(
      (result.images as RenderResult[]).map(({ variant, view, files: [file] }) => [variant, view, file!.path])[1],
    ).toEqual(['red', '30_20', 'm-red-30_20.png']);
  });

  it('with a budget for textures, each view has a tracer of its own, and variants share it', async () => {
    const cwd = folder();
    const budget = ['render', 'm.glb', ...SIZE, '--memory', 'budgetMiB=64'];
    const views = await run([...budget, '--view', 'front', '--view', '30,20'], cwd, { scene });
    expect([views.code, views.created.length]).toEqual([0, 2]);
    const [front, other] = views.created.map(({ options }) => (options.camera as Camera).transform);
    expect(front).not.toEqual(other);
    const variants = await run([...budget, '--variant', 'all', '--view', 'front'], cwd, { scene });
    expect([variants.code, variants.created.length]).toEqual([0, 1]);
  });

  it('placeholders anywhere in the path, folders made', async () => {
    const cwd = folder();
    expect(
      (
        await run(
          [
            'render',
            'm.glb',
            ...SIZE,
            '--variant',
            'green',
            '--variant',
            '0',
            '--turntable',
            '2',
            '-o',
            'out/{model}/{variant}/{view}.png',
          ],
          cwd,
          { scene },
        )
      ).code,
    ).toBe(0);
    expect(images(cwd)).toEqual([
      'out/m/0/turntable-000.png',
      'out/m/0/turntable-001.png',
      'out/m/green/turntable-000.png',
      'out/m/green/turntable-001.png',
    ]);
  });

  it('one variant is one image, as ever', async () => {
    const cwd = folder();
    const { out, edits } = await run(['render', 'm.glb', ...SIZE, '--variant', 'green', '--json'], cwd, { scene });
    expect(JSON.parse(out)).toMatchObject({ ok: true, variant: 'green', files: [{ path: 'm.png' }] });
    expect(edits).toEqual([['variant', 1]]);
  });

  it.each([
    [['--variant', 'mauve'], 2, 'the model has no variant "mauve"; it has "red", "green", "deep blue"'],
    [['-o', '{colour}.png'], 2, '{colour} is unknown'],
    [['--view', 'iso', '--camera', '0'], 2, 'give one of the two'],
    [['--elevation', '5'], 2, '--elevation belongs to --turntable'],
    [['--turntable', '0'], 2, '--turntable must be'],
    [['--view', 'front', '--view', 'front'], 2, 'Two images would be written to "m-front.png"'],
    [['--view', 'nowhere'], 2, 'The model has no camera "nowhere"'],
  ])('%j is refused', async (argv, code, message) => {
    const refused = await run(['render', 'm.glb', ...SIZE, ...argv], folder(), { scene });
    expect([refused.code, refused.err], refused.err).toEqual([code, expect.stringContaining(message)]);
  });

  it('the scene, animation and time reach the loader', async () => {
    const poses: unknown[] = [];
    const loadModel = async (_file: string, _signal: AbortSignal, pose?: unknown) => (
      poses.push(pose),
      triangleScene()
    );
    await run(['render', 'm.glb', ...SIZE, '--scene', 'second', '--animation', '1', '--time', '0.5'], folder(), {
      loadModel,
    });
    expect(poses).toEqual([{ scene: 'second', animation: 1, time: 0.5 }]);
  });
});

describe('batch files', () => {
  it('JSON with defaults; the command line says the rest', async () => {
    const cwd = folder();
    mkdirSync(join(cwd, 'jobs'));
    writeFileSync(
      join(cwd, 'jobs', 'b.json'),
      JSON.stringify({
        defaults: { samples: 3, seed: 9 },
        images: [
          { model: '../m.glb', output: 'a.png', view: 'iso' },
          {
            model: '../n.glb',
            output: ['b.png', 'b.exr'],
            samples: 5,
            camera: { position: [0, 0, 9], target: [0, 0, 0] },
            transparent: true,
          },
        ],
      }),
    );
    const { code, created, out, err } = await run(
      ['render', '--batch', 'jobs/b.json', '--size', '4x4', '--max-depth', '3', '--json'],
      cwd,
      { scene },
    );
    expect(code, err).toBe(0);
    expect(images(cwd)).toEqual(['jobs/a.png', 'jobs/b.png']);
    expect(existsSync(join(cwd, 'jobs/b.exr'))).toBe(true);
    expect(created.map(({ options: { seed, maxDepth, background } }) => [seed, maxDepth, background])).toEqual([
      [9, 3, 'environment'],
      [9, 3, 'transparent'],
    ]);
    expect((JSON.parse(out) as BatchResult).images.map((image) => (image as RenderResult).samples)).toEqual([3, 5]);
  });

  it('CSV with quotes, lists and empty fields', async () => {
    const cwd = folder();
    writeFileSync(
      join(cwd, 'b.csv'),
      'model,variant,view,output,samples\r\nm.glb,red;green,"30,20;iso",x/{variant}-{view}.png,\r\nn.glb,,,"say ""n"".png",7\r\n',
    );
    const { code, out, err } = await run(
      ['render', '--batch', 'b.csv', '--size', '4x4', '--samples', '2', '--json'],
      cwd,
      { scene },
    );
    expect(code, err).toBe(0);
    expect(images(cwd)).toEqual([
      'say "n".png',
      'x/green-30_20.png',
      'x/green-iso.png',
      'x/red-30_20.png',
      'x/red-iso.png',
    ]);
    expect((JSON.parse(out) as BatchResult).images.map((image) => (image as RenderResult).samples)).toEqual([
      2, 2, 2, 2, 7,
    ]);
  });

  it('rows of CSV, by the letter of RFC 4180', () => {
    expect(parseCsv('a,b\n1,"x,""y""\nz"\n\n 2 , 3')).toEqual([
      ['a', 'b'],
      ['1', 'x,"y"\nz'],
      ['2', '3'],
    ]);
  });

  it.each([
    ['b.json', '{', 'it is not valid JSON'],
    ['b.json', '[]', 'it contains no images'],
    ['b.json', '{"images": [3]}', 'it must be a list of objects'],
    ['b.json', '[{"model":"m.glb","colour":"red"}]', 'image 1: "colour" is unknown'],
    ['b.json', '[{"model":"m.glb","size":"big"}]', 'image 1: --size must be like 1024x768'],
    ['b.json', '[{"model":"m.glb","samples":[1]}]', 'image 1: "samples" must be a string or a number'],
    ['b.json', '[{"output":"a.png"}]', 'image 1: "model" is missing'],
    ['b.json', '[{"model":"m.glb","__proto__":{"x":1},"constructor":"y"}]', '"__proto__" is unknown'],
    ['b.csv', 'model\nm.glb,extra\n', 'image 1 has 2 fields'],
    ['b.csv', 'model,json\nm.glb,true\n', 'image 1: "json" is unknown'],
  ])('%s: %s', async (name, text, message) => {
    const cwd = folder();
    writeFileSync(join(cwd, name), text);
    const { code, err } = await run(['render', '--batch', name, ...SIZE], cwd);
    expect([code, err], err).toEqual([2, expect.stringContaining(message)]);
    expect(err.trim().split('\n').length).toBe(1);
  });

  it('what fails is reported, the others are made, and the exit status is that of the failure', async () => {
    const cwd = folder();
    writeFileSync(
      join(cwd, 'b.json'),
      JSON.stringify([
        { model: 'm.glb', variant: 'mauve', output: 'a.png' },
        { model: 'm.glb', output: 'b.png' },
      ]),
    );
    const { code, out, err } = await run(['render', '--batch', 'b.json', ...SIZE, '--json'], cwd, { scene });
    expect(code).toBe(2);
    expect(images(cwd)).toEqual(['b.png']);
    expect(JSON.parse(out)).toMatchObject({
      ok: false,
      failed: 1,
      images: [{ ok: false, files: ['a.png'], error: { code: 'cli/usage' } }, { ok: true }],
    });
    expect(err).toContain('1 of 2 images in 0:00, 1 failed');
  });
});

describe('resuming', () => {
  const argv = ['render', 'm.glb', ...SIZE, '--variant', 'all', '--view', 'front', '--view', 'iso', '--json'];
  const made = (out: string) => (JSON.parse(out) as BatchResult).images.length;

  it('what is there is not made again, unless something of it has changed', async () => {
    const cwd = folder();
    expect(made((await run(argv, cwd, { scene })).out)).toBe(6);
    const again = await run([...argv, '--resume'], cwd, { scene });
    expect([made(again.out), again.created.length, JSON.parse(again.out)]).toEqual([
      0,
      0,
      expect.objectContaining({ ok: true, skipped: 6 }),
    ]);
    // Without the word, all are.
    expect(made((await run(argv, cwd, { scene })).out)).toBe(6);
    rmSync(join(cwd, 'm-red-iso.png'));
    writeFileSync(join(cwd, 'm-green-iso.png'), 'cut off');
    expect(made((await run([...argv, '--resume'], cwd, { scene })).out)).toBe(2);
    expect(made((await run([...argv, '--seed', '3', '--resume'], cwd, { scene })).out)).toBe(6);
    utimesSync(join(cwd, 'm.glb'), 1, 1);
    expect(made((await run([...argv, '--seed', '3', '--resume'], cwd, { scene })).out)).toBe(6);
    // A journal that a crash has cut off.
    appendFileSync(join(cwd, '.glanz-journal.jsonl'), '{"key":"12');
    expect(made((await run([...argv, '--seed', '3', '--resume'], cwd, { scene })).out)).toBe(0);
  });

  it('after Ctrl-C: finished images stay, the unfinished one is not written, the rest is made next time', async () => {
    const cwd = folder();
    const io = fakeIo(cwd);
    let samples = 0;
    const { code, out, err } = await run(argv, cwd, { scene, onSample: () => ++samples === 6 && io.interrupt() }, io);
    expect(code).toBe(130);
    expect(JSON.parse(out)).toMatchObject({ ok: false, interrupted: 'SIGINT', total: 6 });
    expect(images(cwd)).toEqual(['m-red-front.png', 'm-red-iso.png']);
    expect(err).toContain('2 of 6 images in 0:00; --resume continues');
    const rest = await run([...argv, '--resume'], cwd, { scene });
    expect([rest.code, made(rest.out), images(cwd).length]).toEqual([0, 4, 6]);
    expect(readFileSync(join(cwd, '.glanz-journal.jsonl'), 'utf8').trim().split('\n').length).toBe(6);
  });
});

describe('several GPUs', () => {
  it('share the images', async () => {
    const cwd = folder();
    const opened: (string | undefined)[] = [];
    const openGpu = async (name: string | undefined) => {
      opened.push(name);
      return { device: fakeDevice(), adapterName: `Fake ${name}`, software: false };
    };
    const { code, out, created } = await run(
      [
        'render',
        'm.glb',
        ...SIZE,
        '--variant',
        'all',
        '--view',
        'front',
        '--view',
        'iso',
        '--gpu',
        'a',
        '--gpu',
        'b',
        '--json',
      ],
      cwd,
      { scene, openGpu },
    );
    expect([code, opened.sort(), created.length]).toEqual([0, ['a', 'b'], 2]);
    const adapters = (JSON.parse(out) as BatchResult).images.map((image) => (image as RenderResult).adapter.name);
    expect(adapters.length).toBe(6);
    expect(new Set(adapters)).toEqual(new Set(['Fake a', 'Fake b']));
    expect(images(cwd).length).toBe(6);
  });
});
