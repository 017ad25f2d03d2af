import { execFileSync } from 'node:child_process';
import {
  closeSync,
  ftruncateSync,
  mkdirSync,
  openSync,
  readdirSync,
  readFileSync,
  symlinkSync,
  writeFileSync,
} from 'node:fs';
import { join } from 'node:path';
import { GlanzError } from '@glanz/scene';
import { describe, expect, it } from 'vitest';
import { run, temporaryFolder, triangleScene } from './fakes';

const SIZE = ['--size', '4x4', '--samples', '2'];
const folder = () => temporaryFolder({ 'm.glb': 'not read by the fake' });

/** Characters that a terminal obeys instead of showing: C0 but for the line's end, DEL, C1, direction marks. */
// oxlint-disable-next-line no-control-regex
const OBEYED = /[\x00-\x09\x0b-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069]/;
const EVIL = '\x1b[31mred\x1b]0;title\x07\r\x9b2J\u202eexe\x7f\tend';
const SHOWN = '\\x1b[31mred\\x1b]0;title\\x07\\x0d\\x9b2J\\u202eexe\\x7f\\x09end';

describe('names from files are printed with control characters made visible', () => {
  const base = triangleScene();
  const scene = {
    ...base,
    materials: [{ name: EVIL, parameters: {} }],
    instances: [{ ...base.instances[0]!, name: EVIL }],
    cameras: [{ ...base.cameras[0]!, name: EVIL }],
    variants: [EVIL],
    animations: [{ name: EVIL, duration: 1 }],
    images: [{ name: EVIL, width: 2, height: 1, data: new Uint8Array(8) }],
    lights: [],
    metadata: { [EVIL]: EVIL },
    warnings: [{ code: 'gltf/x', message: `odd ${EVIL}`, path: `/nodes/${EVIL}` }],
  };

  it('by info', async () => {
    const { code, out } = await run(['info', 'm.glb'], folder(), { scene });
    expect([code, OBEYED.exec(out)]).toEqual([0, null]);
    for (const line of [
      `parts         1: ${SHOWN}`,
      `materials     1: ${SHOWN}`,
      `"${SHOWN}" perspective`,
      `variants      1: "${SHOWN}"`,
      `warning       odd ${SHOWN} [gltf/x]`,
    ])
      expect(out).toContain(line);
  });

  it('by info --json, which says the same as ever', async () => {
    const { out } = await run(['info', 'm.glb', '--json'], folder(), { scene });
    expect(OBEYED.exec(out)).toBe(null);
    expect(JSON.parse(out)).toMatchObject({ parts: [EVIL], variants: [EVIL] });
  });

  it.each([
    ['a warning', [], 0, `odd ${SHOWN} (/nodes/${SHOWN})`],
    ['a missing camera', ['--camera', 'gone'], 2, `it has 0 "${SHOWN}"`],
    ['a missing variant', ['--variant', 'gone'], 2, `it has "${SHOWN}"`],
    ['a missing part', ['--catcher', 'gone'], 2, `it has "${SHOWN}"`],
    ['a word of the command line', ['--size', EVIL], 2, `not "${SHOWN}"`],
  ])('by render: %s', async (_what, argv, status, text) => {
    const { code, err, out } = await run(['render', 'm.glb', ...SIZE, ...argv, '--json'], folder(), { scene });
    expect([code, OBEYED.exec(err), OBEYED.exec(out)], err).toEqual([status, null, null]);
    expect(err).toContain(text);
  });

  it('by an error of the loader, and of a batch file', async () => {
    class GltfError extends GlanzError {}
    const loadModel = async () => {
      throw new GltfError('gltf/x', `"${EVIL}" is\nodd`);
    };
    expect((await run(['render', 'm.glb', ...SIZE], folder(), { loadModel })).err).toContain(
      `glanz: "${SHOWN}" is odd [gltf/x]`,
    );
    const cwd = folder();
    writeFileSync(join(cwd, 'b.json'), JSON.stringify([{ model: 'm.glb', [EVIL]: 1 }]));
    expect((await run(['render', '--batch', 'b.json'], cwd)).err).toContain(`"${SHOWN}" is unknown`);
  });

  it('by --list-gpus', async () => {
    const { out } = await run(['--list-gpus'], '.', {
      listGpus: async () => [{ name: EVIL, backend: 'vulkan', driver: EVIL, software: false }],
    });
    expect(out).toBe(`${SHOWN} · vulkan · ${SHOWN}\n`);
  });
});

describe('what is no regular file is refused before anything is loaded', () => {
  const loadModel = async () => expect.fail('loaded');
  const device = 'it is a device or a pipe, not a regular file';
  const fifo = (cwd: string, name: string) => execFileSync('mkfifo', [join(cwd, name)]);

  it.skipIf(process.platform === 'win32').each([
    ['--env /dev/zero', ['m.glb', '--env', '/dev/zero'], `the environment "/dev/zero": ${device}`],
    ['--env of a fifo', ['m.glb', '--env', 'pipe.hdr'], `the environment "pipe.hdr": ${device}`],
    ['--env of a folder', ['m.glb', '--env', '.'], 'the environment ".": it is a folder'],
    [
      '--env of an enormous file',
      ['m.glb', '--env', 'huge.hdr'],
      'the environment "huge.hdr": it has 100.0 GB, and at most 2.1 GB are read',
    ],
    ['a model that is a fifo', ['pipe.hdr'], `the model "pipe.hdr": ${device}`],
    ['a batch that is a fifo', ['--batch', 'pipe.hdr'], `the batch "pipe.hdr": ${device}`],
    [
      'a batch that is enormous',
      ['--batch', 'huge.hdr'],
      'the batch "huge.hdr": it has 100.0 GB, and at most 67.1 MB are read',
    ],
  ])('%s', async (_what, argv, message) => {
    const cwd = folder();
    fifo(cwd, 'pipe.hdr');
    const huge = openSync(join(cwd, 'huge.hdr'), 'w');
    ftruncateSync(huge, 100e9);
    closeSync(huge);
    const { code, err } = await run(['render', ...argv, ...SIZE], cwd, { loadModel });
    expect([code, err], err).toEqual([3, expect.stringContaining(`glanz: Cannot read ${message}`)]);
    expect(err).toContain('[cli/input]');
  });

  it.skipIf(process.platform === 'win32')('a camera that is a fifo, and an environment named by a batch', async () => {
    const cwd = folder();
    fifo(cwd, 'pipe.json');
    writeFileSync(join(cwd, 'b.json'), JSON.stringify([{ model: 'm.glb', env: '/dev/zero' }]));
    expect(await run(['render', 'm.glb', ...SIZE, '--camera', 'pipe.json'], cwd)).toMatchObject({
      code: 3,
      err: expect.stringContaining(`the camera "pipe.json": ${device}`),
    });
    expect(await run(['render', '--batch', 'b.json', ...SIZE], cwd)).toMatchObject({
      code: 3,
      err: expect.stringContaining(`the environment "/dev/zero": ${device}`),
    });
  });
});

describe('a batch file writes below its folder only', () => {
  const batch = (cwd: string, ...outputs: string[]) => {
    mkdirSync(join(cwd, 'jobs'), { recursive: true });
    writeFileSync(
      join(cwd, 'jobs', 'b.json'),
      JSON.stringify(outputs.map((output, i) => ({ model: '../m.glb', output, seed: i }))),
    );
    return ['render', '--batch', 'jobs/b.json', ...SIZE];
  };
  const images = (cwd: string) =>
    readdirSync(cwd, { recursive: true, encoding: 'utf8' })
      .filter((name) => name.endsWith('.png'))
      .sort();

  it.each([
    '../x.png',
    '../../x.png',
    'a/../../x.png',
    '/tmp/glanz-outside/x.png',
    '../jobs2/x.png',
    'out/x.png',
    'out/new/{view}.png',
  ])('%s is refused, and nothing is made', async (output) => {
    const cwd = folder();
    const argv = batch(cwd, 'fine.png', output);
    mkdirSync(join(cwd, 'elsewhere'));
    symlinkSync(join(cwd, 'elsewhere'), join(cwd, 'jobs', 'out'));
    const { code, err, created } = await run(argv, cwd);
    expect([code, created.length, images(cwd), readdirSync(join(cwd, 'elsewhere'))], err).toEqual([2, 0, [], []]);
    expect(err).toContain('jobs/b.json: image 2: "');
    expect(err).toContain('lies outside the folder "jobs", and a batch writes only in that folder.');
    expect(err).toContain('[cli/batch]');
  });

  it('unless --output-root allows another folder', async () => {
    const cwd = folder();
    expect(await run([...batch(cwd, '../out/x.png', 'y.png'), '--output-root', '.'], cwd)).toMatchObject({ code: 0 });
    expect(images(cwd)).toEqual(['jobs/y.png', 'out/x.png']);
    expect(await run([...batch(cwd, '../out/x.png'), '--output-root', 'jobs'], cwd)).toMatchObject({ code: 2 });
    expect(await run(['render', 'm.glb', ...SIZE, '--output-root', '.'], cwd)).toMatchObject({
      code: 2,
      err: expect.stringContaining('belongs to --batch'),
    });
  });

  it('deep below, by a path that goes up and down again, and by a link within', async () => {
    const cwd = folder();
    const argv = batch(cwd, 'a/b/c/x.png', 'a/../y.png', 'link/z.png');
    mkdirSync(join(cwd, 'jobs', 'real'));
    symlinkSync('real', join(cwd, 'jobs', 'link'));
    expect((await run(argv, cwd)).code).toBe(0);
    expect(images(cwd)).toEqual(expect.arrayContaining(['jobs/a/b/c/x.png', 'jobs/real/z.png', 'jobs/y.png']));
  });

  it('what the command line says goes where it says', async () => {
    const cwd = folder();
    mkdirSync(join(cwd, 'jobs'));
    writeFileSync(join(cwd, 'jobs', 'b.json'), JSON.stringify([{ model: '../m.glb' }]));
    expect((await run(['render', '--batch', 'jobs/b.json', ...SIZE, '-o', 'here.png'], cwd)).code).toBe(0);
    expect(images(cwd)).toEqual(['here.png']);
  });

  it.skipIf(process.platform === 'win32')(
    'links in the place of a file, a journal or a partial file are not written through',
    async () => {
      const cwd = folder();
      const argv = batch(cwd, 'x.png');
      writeFileSync(join(cwd, 'secret'), 'mine');
      symlinkSync(join(cwd, 'secret'), join(cwd, 'jobs', 'x.png'));
      expect((await run(argv, cwd)).code).toBe(0);
      symlinkSync(join(cwd, 'secret'), join(cwd, 'jobs', `x.png.${process.pid}.partial`));
      expect(await run(argv, cwd)).toMatchObject({ code: 4, err: expect.stringContaining('[cli/output]') });
      expect(readFileSync(join(cwd, 'secret'), 'utf8')).toBe('mine');
      const other = folder();
      const again = batch(other, 'x.png');
      writeFileSync(join(other, 'secret'), 'mine');
      symlinkSync(join(other, 'secret'), join(other, 'jobs', '.glanz-journal.jsonl'));
      expect((await run(again, other)).code).toBe(4);
      expect(readFileSync(join(other, 'secret'), 'utf8')).toBe('mine');
    },
  );
});
