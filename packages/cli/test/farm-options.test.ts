import { mkdirSync, utimesSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { describe, expect, it } from 'vitest';
import type { BlasCache } from '@glanz/bvh/cache';
import { farmRenderer } from '../src/farm/job-renderer';
import { FarmPlan, type PlannedImage } from '../src/farm/plan';
import { parseFarm } from '../src/commands/farm/parse';
import { modelFiles } from '../src/farm/model-files';
import { FolderStore } from '@glanz/farm';
import { fakeBackend, fakeIo, run, temporaryFolder } from './fakes';
import { makeGlb } from './glb';

async function plan(cwd: string, options: { split?: number; outputRoot?: string; values?: object } = {}) {
  const warnings: string[] = [];
  const opened = await FarmPlan.open({
    batch: 'b.json',
    cwd,
    values: options.values ?? {},
    outputRoot: options.outputRoot,
    split: options.split,
    variantsOf: async () => ['red', 'blue'],
    warn: (text) => void warnings.push(text),
  });
  const count = await opened.check();
  const images: PlannedImage[] = [];
  for await (const image of opened.images(new FolderStore(join(cwd, 'store')))) images.push(image);
  expect(images.length).toBe(count);
  return { images, warnings };
}

const withBatch = (images: object[]) => {
  const folder = temporaryFolder({ 'm.glb': makeGlb(), 'n.glb': makeGlb(), 'o.glb': makeGlb({ camera: true }) });
  writeFileSync(join(folder, 'b.json'), JSON.stringify(images));
  return folder;
};

describe('identity of jobs', () => {
  it('depends on what decides the pixels, not on names', async () => {
    const row = { model: 'm.glb', samples: 8, view: 'front', output: 'a.png' };
    const cwd = withBatch([
      row,
      // The same bytes under other names, in another place, the view in numbers.
      { ...row, model: 'n.glb', view: '0,0', output: 'sub/b.png' },
      { ...row, model: 'o.glb', output: 'c.png' },
      { ...row, samples: 9, output: 'd.png' },
      { ...row, view: '0,1', output: 'e.png' },
      { ...row, variant: '0', output: 'f.png' },
      { ...row, output: 'g.png', bits: 16 },
      { ...row, output: 'h.exr' },
      { ...row, exposure: 1, output: 'i.png' },
      { ...row, env: 'none', output: 'j.png' },
      { ...row, seed: 3, output: 'k.png' },
    ]);
    const { images } = await plan(cwd);
    expect(images[0]!.id).toBe(images[1]!.id);
    expect(new Set(images.map(({ id }) => id)).size).toBe(images.length - 1);
    expect(images[1]!.paths).toEqual([join('sub', 'b.png')]);
  });

  it('of parts: ranges of whole chunks, and a merge that names them', async () => {
    const cwd = withBatch([{ model: 'm.glb', samples: 100, output: 'a.png' }]);
    const { images } = await plan(cwd, { split: 40 });
    const jobs = images[0]!.requests.map(({ job }) => job);
    expect(jobs.map(({ payload }) => (payload as { range: object }).range)).toEqual([
      { from: 0, samples: 48 },
      { from: 48, samples: 48 },
      { from: 96, samples: 4 },
    ]);
    expect(jobs[0]!.merge!.parts).toEqual(jobs.map(({ id }) => id));
    expect(images[0]!.id).toBe(jobs[0]!.merge!.id);
    expect(images[0]!.id).not.toBe((await plan(cwd)).images[0]!.id);
    const { images: whole, warnings } = await plan(cwd, { split: 40, values: { noise: '0.1' } });
    expect(whole[0]!.requests.length).toBe(1);
    expect(warnings.join()).toContain('are not split');
    const { images: denoised } = await plan(cwd, { split: 40, values: { denoise: 'fast' } });
    expect(denoised[0]!.requests.length).toBe(3);
  });
});

describe('a batch is checked before anything is queued', () => {
  const refused = (images: object[], outputRoot?: string) =>
    plan(withBatch(images), outputRoot === undefined ? {} : { outputRoot }).catch(
      (error: { code?: string }) => error.code,
    );
  it('names, files, places', async () => {
    const row = { model: 'm.glb', output: 'a.png' };
    expect(await refused([row, row])).toBe('cli/usage');
    expect(await refused([row, { ...row, model: 'gone.glb', output: 'b.png' }])).toBe('cli/input');
    expect(await refused([row, { ...row, output: '../b.png' }])).toBe('cli/batch');
    expect(await refused([{ ...row, output: '../b.png' }], '..')).not.toBe('cli/batch');
    expect(await refused([row, { ...row, output: 'b.png', sample: 3 }])).toBe('cli/batch');
  });
});

describe('the files of a model', () => {
  it('glTF with what it names, wherever in the file; nothing outside of its folder', async () => {
    const json = {
      asset: { version: '2.0' },
      buffers: [{ uri: 'a%20b.bin' }, { uri: 'data:application/octet-stream;base64,AA==' }],
      images: [{ uri: 'tex/gone.png' }, { uri: 'https://example.invalid/x.png' }],
      extensions: { EXT_lights_ies: { lights: [{ uri: 'lamp.ies' }] } },
    };
    const folder = temporaryFolder({ 'Shoe.GLTF': JSON.stringify(json), 'a b.bin': 'x', 'lamp.ies': 'y' });
    expect(await modelFiles(join(folder, 'Shoe.GLTF'))).toEqual({
      main: 'model.gltf',
      files: [
        { name: 'model.gltf', path: join(folder, 'Shoe.GLTF') },
        { name: 'a b.bin', path: join(folder, 'a b.bin') },
        { name: 'lamp.ies', path: join(folder, 'lamp.ies') },
      ],
    });
    const outside = temporaryFolder({ 'x.gltf': JSON.stringify({ buffers: [{ uri: `${folder}/a b.bin` }] }) });
    await expect(modelFiles(join(outside, 'x.gltf'))).rejects.toMatchObject({ code: 'cli/input' });
  });

  it('OBJ with its libraries and their textures', async () => {
    const folder = temporaryFolder({
      'x.obj': 'mtllib my mat.mtl\nv 0 0 0\n',
      'my mat.mtl': 'newmtl a\nmap_Kd -s 1 1 1 wood.png\nbump no such.png\n',
      'wood.png': 'x',
    });
    const { files } = await modelFiles(join(folder, 'x.obj'));
    expect(files.map(({ name }) => name)).toEqual(['model.obj', 'my mat.mtl', 'wood.png']);
  });

  it('USD with the images beside it, an archive alone, and what is no USD alone', async () => {
    const shader = 'def Shader "A" { asset inputs:file = @./maps/wood.png@\n asset inputs:more = @gone.png@ }';
    const folder = temporaryFolder({ 'x.usda': `#usda 1.0\n${shader}\n`, 'broken.usdc': 'nothing' });
    mkdirSync(join(folder, 'maps'));
    writeFileSync(join(folder, 'maps/wood.png'), 'x');
    expect(await modelFiles(join(folder, 'x.usda'))).toEqual({
      main: 'model.usda',
      files: [
        { name: 'model.usda', path: join(folder, 'x.usda') },
        { name: 'maps/wood.png', path: join(folder, 'maps/wood.png') },
      ],
    });
    expect((await modelFiles(join(folder, 'broken.usdc'))).files).toHaveLength(1);
    const test = new URL('../../formats/test/usd/', import.meta.url);
    const named = async (file: string) =>
      (await modelFiles(fileURLToPath(new URL(file, test)))).files.map(({ name }) => name);
    expect(await named('model.usdz')).toEqual(['model.usdz']);
  });
});

describe('where the store is', () => {
  const storeOf = (argv: string[], environment: NodeJS.ProcessEnv = {}) =>
    parseFarm(['clean', '--older-than', '1d', ...argv], environment).store;

  it('a folder, or a bucket with its server and a cache', () => {
    expect(storeOf([])).toEqual({ url: '.glanz-farm' });
    const s3 = ['--store', 's3://a/b'];
    expect(storeOf([...s3, '--store-cache', 'c'])).toEqual({ url: 's3://a/b', endpoint: undefined, cache: 'c' });
    const environment = { AWS_ENDPOINT_URL: 'http://x', XDG_CACHE_HOME: '/h' };
    expect(storeOf(s3, environment)).toEqual({ url: 's3://a/b', endpoint: 'http://x', cache: '/h/glanz/farm' });
    expect(storeOf([...s3, '--s3-endpoint', 'http://y'], environment).endpoint).toBe('http://y');
  });
});

describe('the command line', () => {
  it.each([
    [['farm'], /glanz farm needs an action/],
    [['farm', 'submit'], /takes one batch file/],
    [['farm', 'work'], /needs --redis/],
    [['farm', 'status', 'x', '--redis', 'redis://a'], /takes no files/],
    [['farm', 'retry', '--redis', 'redis://a'], /takes ids of jobs/],
    [['farm', 'cancel', 'x', '--all', '--redis', 'redis://a'], /takes ids of jobs/],
    [['farm', 'submit', 'b', '--split', '8'], /--split must be a whole number from 16/],
    [['farm', 'task', 'b', '--image', '3-1'], /--image must be numbers/],
    [['farm', 'manifest', 'b'], /needs --manifest/],
    [['farm', 'submit', 'b', '--untl-empty'], /Did you mean --until-empty/],
    [['farm', 'status', '--redis', 'localhost'], /must be like redis:/],
    [['farm', 'clean', '--older-than', '1d', '--s3-endpoint', 'http://a'], /--s3-endpoint is for a store in a bucket/],
    [['farm', 'clean', '--older-than', '1d', '--store', 's3://B/x'], /s3:\/\/bucket or s3/],
  ])('%j', async (argv, message) => {
    const { code, err } = await run(argv, temporaryFolder());
    expect(err).toMatch(message);
    expect(code).toBe(2);
  });

  it('without --redis it renders here, as render --batch --resume does', async () => {
    const cwd = withBatch([{ model: 'm.glb', size: '8x8', samples: 2, output: 'a.png' }]);
    const first = await run(['farm', 'submit', 'b.json', '--json'], cwd);
    expect(JSON.parse(first.out)).toMatchObject({ ok: true, total: 1, skipped: 0 });
    const second = await run(['farm', 'submit', 'b.json', '--json'], cwd);
    expect(JSON.parse(second.out)).toMatchObject({ ok: true, total: 1, skipped: 1 });
  });

  it('clean deletes what is old, and needs an age', async () => {
    const cwd = withBatch([{ model: 'm.glb', output: 'a.png' }]);
    const store = new FolderStore(join(cwd, '.glanz-farm'));
    const hash = await store.put('content');
    utimesSync(store.objectPath(hash), new Date(0), new Date(0));
    const { out } = await run(['farm', 'clean', '--older-than', '30d', '--json'], cwd);
    expect(JSON.parse(out)).toEqual({ ok: true, entries: 1, bytes: 7 });
    for (const args of [[], ['--older-than', '30'], ['--older-than', '1y'], ['x', '--older-than', '1d']])
      expect((await run(['farm', 'clean', ...args], cwd)).code).toBe(2);
  });

  it('a renderer reads the hierarchies that another one has built', async () => {
    const cwd = withBatch([{ model: 'm.glb', samples: 2, output: 'a.png' }]);
    const { images } = await plan(cwd);
    const { job } = images[0]!.requests[0]!;
    const store = new FolderStore(join(cwd, 'store'));
    const positions = Float32Array.from({ length: 9 * 20_000 }, (_, i) => Math.sin(i * i));
    const mesh = { positions, indices: Uint32Array.from({ length: 3 * 20_000 }, (_, i) => i) };
    const caches: BlasCache[] = [];
    const built: Uint32Array[] = [];
    for (let i = 0; i < 2; i++) {
      const { backend, created } = fakeBackend();
      const renderer = farmRenderer(fakeIo(cwd), backend, undefined);
      const message = {
        type: 'job' as const,
        job,
        store: store.address,
        folder: await store.begin(job.id),
        checkpoint: await store.checkpoint(job.id),
      };
      expect(await renderer.render(message, new AbortController().signal, () => undefined)).toBeDefined();
      const cache = created[0]!.options.hierarchies as BlasCache;
      built.push(new Uint32Array((await cache.buildBlas(mesh)).nodes.buffer));
      await cache.written();
      caches.push(cache);
    }
    expect(caches.map(({ hits, misses }) => [hits, misses])).toEqual([
      [0, 1],
      [1, 0],
    ]);
    expect(built[1]).toEqual(built[0]);
  });
});
