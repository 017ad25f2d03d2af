import { execFileSync, spawn, type ChildProcess } from 'node:child_process';
import { existsSync, mkdirSync, readdirSync, readFileSync, statSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { decodeExr } from '@glanz/image';
import sharp from 'sharp';
import { beforeAll, describe, expect, it } from 'vitest';
import { runCli } from '../src/index';
import { fakeIo, temporaryFolder } from './fakes';
import { makeGlb } from './glb';
import { keptBackend } from './kept-gpu';
import { bundleProgram } from './program';

// The program as a process of its own: real signals, real streams, a real exit status. Bundled here from the sources,
// so that it is tested whether or not the packages have been built.
const folder = fileURLToPath(new URL('../.cache/', import.meta.url));
const program = join(folder, 'glanz.mjs');

beforeAll(() => bundleProgram(program));

interface Ended {
  readonly code: number | null;
  readonly signal: string | null;
  readonly out: string;
  readonly err: string;
}

function start(
  argv: readonly string[],
  cwd: string,
  onErr: (text: string, child: ChildProcess) => void = () => undefined,
  onOut: (text: string, child: ChildProcess) => unknown = () => undefined,
  env: NodeJS.ProcessEnv = {},
): Promise<Ended> {
  const child = spawn(process.execPath, [program, ...argv], {
    cwd,
    stdio: ['ignore', 'pipe', 'pipe'],
    env: { ...process.env, ...env },
  });
  let [out, err] = ['', ''];
  child.stdout.on('data', (chunk: Buffer) => {
    out += chunk.toString();
    void onOut(out, child);
  });
  child.stderr.on('data', (chunk: Buffer) => {
    err += chunk.toString();
    onErr(err, child);
  });
  return new Promise((resolve, reject) => {
    child.on('error', reject);
    child.on('close', (code, signal) => resolve({ code, signal, out, err }));
  });
}

const backend = keptBackend();

/** The command in this process, for what another is compared with or reads: it compiles its programs once. */
async function here(argv: readonly string[], cwd: string): Promise<Ended> {
  const io = fakeIo(cwd);
  const code = await runCli(argv, io, backend);
  return { code, signal: null, out: io.out.join(''), err: io.err.join('') };
}

it('--version, at once and by itself', async () => {
  const { code, out, err } = await start(['--version'], '.');
  expect([code, err]).toEqual([0, '']);
  expect(out).toMatch(/^\d+\.\d+\.\d+/);
});

it('an error sets the exit status', async () => {
  expect(await start(['render', 'gone.glb'], temporaryFolder())).toMatchObject({
    code: 3,
    out: '',
    err: 'glanz: Cannot read the model "gone.glb": there is no such file. [cli/input]\n',
  });
});

it('an image, exit status 0, and nothing on stdout', async () => {
  const cwd = temporaryFolder({ 'red.glb': makeGlb({ camera: true }) });
  const { code, out, err } = await start(
    [
      'render',
      'red.glb',
      '--gpu',
      'software',
      '--size',
      '16x16',
      '--samples',
      '2',
      '--max-depth',
      '2',
      '-o',
      'x.png',
      '--bits',
      '16',
    ],
    cwd,
  );
  expect([code, out], err).toEqual([0, '']);
  expect(err).toMatch(/render 2\/2 samples · [\d.]+ samples\/s · 0:00 left\n/);
  expect(err.trimEnd().split('\n').at(-1)).toMatch(/^x\.png: 16×16, 2 samples at [\d.]+\/s, 0:\d\d in all$/);
  expect((await sharp(join(cwd, 'x.png')).metadata()).depth).toBe('ushort');
});

it('SIGINT writes the image; the process ends by itself with 130', async () => {
  const cwd = temporaryFolder({ 'red.glb': makeGlb({ camera: true }) });
  let sent = false;
  const { code, signal, out, err } = await start(
    ['render', 'red.glb', '--gpu', 'software', '--size', '48x48', '--samples', '1000000', '--max-depth', '3', '--json'],
    cwd,
    (text, child) => {
      if (!sent && /render \d+\//.test(text)) {
        sent = true;
        child.kill('SIGINT');
      }
    },
  );
  expect([code, signal], err).toEqual([130, null]);
  expect(JSON.parse(out)).toMatchObject({ ok: true, interrupted: 'SIGINT' });
  expect((await sharp(join(cwd, 'red.png')).metadata()).height).toBe(48);
});

it.skipIf(process.platform === 'win32')(
  'SIGHUP writes the image like SIGINT and SIGTERM; the process ends by itself with 129',
  async () => {
    const cwd = temporaryFolder({ 'red.glb': makeGlb({ camera: true }) });
    let sent = false;
    const { code, signal, out, err } = await start(
      [
        'render',
        'red.glb',
        '--gpu',
        'software',
        '--size',
        '48x48',
        '--samples',
        '1000000',
        '--max-depth',
        '3',
        '--json',
      ],
      cwd,
      (text, child) => {
        if (!sent && /render \d+\//.test(text)) sent = child.kill('SIGHUP');
      },
    );
    expect([code, signal], err).toEqual([129, null]);
    expect(JSON.parse(out)).toMatchObject({ ok: true, interrupted: 'SIGHUP' });
    expect((await sharp(join(cwd, 'red.png')).metadata()).height).toBe(48);
  },
);

describe.skipIf(process.platform === 'win32')('a reader that closes its end of a pipe', () => {
  const quality = ['--gpu', 'software', '--size', '16x16', '--samples', '64', '--max-depth', '2'];
  // The shell's own redirections, and the exit status of the program rather than that of the pipe's last.
  const piped = (argv: readonly string[], redirections: string, cwd: string) =>
    execFileSync('sh', ['-c', `("$@"; echo $? > status) ${redirections}`, 'sh', process.execPath, program, ...argv], {
      cwd,
      encoding: 'utf8',
    });
  const status = (cwd: string) => readFileSync(join(cwd, 'status'), 'utf8').trim();

  const ends: readonly (readonly [string, string, RegExp])[] = [
    ['both', '2>&1 | head -1', /^load model\n$/],
    ['stderr, closed from the beginning', '2>&1 >/dev/null | true', /^$/],
    ['stderr', '2>&1 >/dev/null | head -1', /^load model\n$/],
    ['stdout', '2>/dev/null | true', /^$/],
  ];
  // With GLANZ_FULL each stream alone, too.
  it.each(process.env['GLANZ_FULL'] === undefined ? ends.slice(0, 2) : ends)(
    'of %s does not end the render',
    (_what, redirections, seen) => {
      const cwd = temporaryFolder({ 'red.glb': makeGlb({ camera: true }) });
      expect(piped(['render', 'red.glb', '--json', ...quality], redirections, cwd)).toMatch(seen);
      expect([status(cwd), readdirSync(cwd).sort()]).toEqual(['0', ['red.glb', 'red.png', 'status']]);
      expect(statSync(join(cwd, 'red.png')).size).toBeGreaterThan(100);
    },
  );

  it('sees an error still by the exit status', () => {
    const cwd = temporaryFolder();
    piped(['render', 'gone.glb', '--json'], '2>&1 >/dev/null | true', cwd);
    expect(status(cwd)).toBe('3');
  });

  it.skipIf(!existsSync('/dev/full'))('a full disk behind stdout is a failure of what belongs there', () => {
    const cwd = temporaryFolder({ 'red.glb': makeGlb({ camera: true }) });
    piped(['info', 'red.glb'], '> /dev/full', cwd);
    expect(status(cwd)).toBe('4');
  });
});

describe('the GPU is lost', () => {
  const dawn = fileURLToPath(new URL('faulty-dawn.mjs', import.meta.url));
  const argv = [
    'render',
    'red.glb',
    '--gpu',
    'software',
    '--size',
    '32x24',
    '--samples',
    '40',
    '--max-depth',
    '3',
    '-o',
    'x.exr',
    '-o',
    'x.png',
    '--json',
  ];
  const folderWithModel = () => temporaryFolder({ 'red.glb': makeGlb({ camera: true }) });
  const files = (cwd: string) => ['x.exr', 'x.png'].map((name) => readFileSync(join(cwd, name)));

  // In one process, and at more places, in recovery-gpu.test.ts.
  it.runIf(process.env['GLANZ_FULL'] !== undefined)(
    'and comes back: exit status 0, and the same files bit for bit',
    async () => {
      const [whole, cwd] = [folderWithModel(), folderWithModel()];
      expect((await here(argv, whole)).code).toBe(0);
      const { code, out, err } = await start(argv, cwd, undefined, undefined, {
        GPU_WEBGPU: dawn,
        GLANZ_TEST_LOSE_AT: '9',
      });
      expect(code, err).toBe(0);
      expect(JSON.parse(out)).toMatchObject({ ok: true, samples: 40, gpuLosses: 1 });
      expect(files(cwd).map((file, i) => Buffer.compare(file, files(whole)[i] as Buffer))).toEqual([0, 0]);
    },
  );

  it('and SIGTERM ends the waiting for it', async () => {
    const cwd = folderWithModel();
    let sent = 0;
    const { code, signal, err } = await start(
      argv,
      cwd,
      (text, child) => {
        if (sent === 0 && /wait for the GPU/.test(text)) sent = child.kill('SIGTERM') ? 1 : 0;
      },
      undefined,
      { GPU_WEBGPU: dawn, GLANZ_TEST_LOSE_AT: '9', GLANZ_TEST_DEVICES: '1' },
    );
    expect([code, signal, readdirSync(cwd)], err).toEqual([143, null, ['red.glb']]);
  });

  it('and does not come back: 5, and advice', async () => {
    const cwd = folderWithModel();
    const { code, out, err } = await start(argv, cwd, undefined, undefined, {
      GPU_WEBGPU: dawn,
      GLANZ_TEST_LOSE_AT: '9',
      GLANZ_TEST_DEVICES: '1',
    });
    expect([code, readdirSync(cwd)], err).toEqual([5, ['red.glb']]);
    expect(err.trim().split('\n').at(-1)).toMatch(
      /^glanz: The GPU ".+" was lost and gives no new device after 5 attempts \(.*injected refusal\)\. Often it ran out of memory, .* \[cli\/gpu-lost\]$/,
    );
    expect(JSON.parse(out)).toMatchObject({ ok: false, error: { code: 'cli/gpu-lost' } });
  });
});

it('no memory for a layer of an EXR: exit status 1, no file, and nothing on stdout but the object', async () => {
  const cwd = temporaryFolder({ 'red.glb': makeGlb({ camera: true }) });
  const env = {
    GPU_WEBGPU: fileURLToPath(new URL('faulty-dawn.mjs', import.meta.url)),
    GLANZ_TEST_NO_MEMORY: 'glanz film albedo',
  };
  const { code, out, err } = await start(
    ['render', 'red.glb', '--gpu', 'software', '--size', '16x16', '--samples', '2', '-o', 'x.exr', '--json'],
    cwd,
    undefined,
    undefined,
    env,
  );
  expect([code, readdirSync(cwd)], err).toEqual([1, ['red.glb']]);
  expect(JSON.parse(out)).toMatchObject({
    ok: false,
    error: { code: expect.stringMatching(/^renderer\/(gpu-error|out-of-memory)$/) },
  });
});

it('a batch that is killed resumes, and its images are those of runs of their own', { timeout: 600_000 }, async () => {
  const cwd = temporaryFolder({ 'shoe.glb': makeGlb({ camera: true, variants: true }) });
  const quality = ['--gpu', 'software', '--size', '24x16', '--samples', '4', '--max-depth', '3', '--seed', '5'];
  writeFileSync(join(cwd, 'hero.json'), '{"position":[1,0.5,3],"target":[0,0,0],"lens_radius":0.05}');
  const argv = [
    'render',
    'shoe.glb',
    '--variant',
    'all',
    '--view',
    'front',
    '--view',
    'iso',
    '--view',
    '30,20',
    '--view',
    'hero.json',
    '-o',
    'out/{variant}-{view}.png',
    '--bits',
    '16',
    '--json',
    ...quality,
  ];
  // Killed without warning while the third image is made.
  let sent = false;
  const killed = await start(argv, cwd, (text, child) => {
    if (!sent && /\[4\/12\] render/.test(text)) sent = child.kill('SIGKILL');
  });
  expect(killed.signal, killed.err).toBe('SIGKILL');
  const before = readdirSync(join(cwd, 'out')).filter((name) => name.endsWith('.png'));
  expect(before.length).toBeGreaterThanOrEqual(3);
  expect(before.length).toBeLessThan(12);
  const stamps = new Map(before.map((name) => [name, statSync(join(cwd, 'out', name)).mtimeMs]));
  const { code, out, err } = await start([...argv, '--resume'], cwd);
  expect(code, err).toBe(0);
  const result = JSON.parse(out) as { total: number; skipped: number; images: { files: { path: string }[] }[] };
  expect([result.total, result.skipped + result.images.length]).toEqual([12, 12]);
  // At most the one whose journal line was not yet written is made twice.
  expect(result.skipped).toBeGreaterThanOrEqual(before.length - 1);
  const files = readdirSync(join(cwd, 'out'))
    .filter((name) => name.endsWith('.png'))
    .sort();
  expect(files).toEqual(
    ['red', 'green', 'deep_blue']
      .flatMap((variant) => ['front', 'iso', '30_20', 'hero'].map((view) => `${variant}-${view}.png`))
      .sort(),
  );
  expect(
    files.filter((name) => stamps.get(name) === statSync(join(cwd, 'out', name)).mtimeMs).length,
  ).toBeGreaterThanOrEqual(before.length - 1);
  for (const [variant, view, name] of [
    ['deep blue', 'hero.json', 'deep_blue-hero'],
    ['green', 'iso', 'green-iso'],
    ['red', 'front', 'red-front'],
  ] as const) {
    const alone = await here(
      ['render', 'shoe.glb', '--variant', variant, '--view', view, '-o', 'alone.png', '--bits', '16', ...quality],
      cwd,
    );
    expect(alone.code, alone.err).toBe(0);
    expect(
      Buffer.compare(readFileSync(join(cwd, 'alone.png')), readFileSync(join(cwd, 'out', `${name}.png`))),
      name,
    ).toBe(0);
  }
});

it('serve answers with the files of its folder and ends with SIGINT', async () => {
  // The program lies in a folder of its own; the playground beside it.
  const site = join(folder, 'playground');
  mkdirSync(site, { recursive: true });
  writeFileSync(join(site, 'index.html'), '<title>here</title>');
  let page = '',
    escaped = 0;
  const { code, out, err } = await start(
    ['serve', '--port', '0', '--json'],
    temporaryFolder(),
    undefined,
    async (text, child) => {
      const { url } = JSON.parse(text) as { url: string };
      page = await (await fetch(url)).text();
      escaped = (await fetch(`${url}..%2fglanz.mjs`)).status;
      child.kill('SIGINT');
    },
  );
  expect([code, page, escaped, err]).toEqual([0, '<title>here</title>', 404, '']);
  expect(out.trim().split('\n').length).toBe(1);
});

it('a second SIGINT ends it at once', async () => {
  const cwd = temporaryFolder({ 'red.glb': makeGlb({ camera: true }) });
  const { signal, code } = await start(
    ['render', 'red.glb', '--gpu', 'software', '--size', '2000x2000', '--samples', '1000000'],
    cwd,
    (text, child) => {
      if (/load model/.test(text)) {
        child.kill('SIGINT');
        setTimeout(() => child.kill('SIGINT'), 5);
      }
    },
  );
  // Killed by the second, or, on a fast machine, already done with the first: either way soon and without an image.
  expect(signal === 'SIGINT' || code === 130).toBe(true);
  expect(existsSync(join(cwd, 'red.png'))).toBe(false);
});

describe('glanz merge', () => {
  const options = ['red.glb', '--gpu', 'software', '--size', '16x12', '--depth', '3'];
  const pixels = (file: string) => {
    const { channels } = decodeExr(new Uint8Array(readFileSync(file)));
    return (name: string) => channels.get(name)!.data;
  };

  it('makes of samples 0–49 and 50–99, these from another process, the image of 0–99; and a film again', async () => {
    const cwd = temporaryFolder({ 'red.glb': makeGlb({ camera: true }) });
    const runs = [
      ['--samples', '100', '-o', 'whole.exr', '--bits', '32'],
      ['--samples', '50', '-o', 'a.film'],
      ['--samples-from', '50', '--samples', '50', '-o', 'b.film', '-o', 'b.png'],
    ];
    for (const [i, run] of runs.entries()) {
      const { code, err } = await (i === 2 ? start : here)(['render', ...options, ...run], cwd);
      expect(code, err).toBe(0);
    }
    const outputs = ['-o', 'merged.exr', '-o', 'merged.hdr', '-o', 'all.film', '--bits', '32', '--json'];
    const { code, out, err } = await here(['merge', 'b.film', 'a.film', ...outputs], cwd);
    expect(code, err).toBe(0);
    expect(JSON.parse(out)).toMatchObject({ ok: true, samples: 100, ranges: [[0, 100]], width: 16, height: 12 });
    const [whole, merged] = [pixels(join(cwd, 'whole.exr')), pixels(join(cwd, 'merged.exr'))];
    for (const channel of ['R', 'G', 'B', 'A'])
      whole(channel).forEach((value, i) =>
        // One rounding a chunk of 16 samples and those of a split chunk, see mergeFilmStates.
        expect(Math.abs(merged(channel)[i]! - value)).toBeLessThanOrEqual((100 / 16 + 16) * 2 ** -23 * value),
      );
    expect(merged('variance.R').every((value) => Number.isFinite(value) && value >= 0)).toBe(true);

    // The merged film is a checkpoint that the same command resumes.
    const more = ['render', ...options, '--samples', '110', '--checkpoint', 'all.film', '-o', 'more.png'];
    const resumed = await here(more, cwd);
    expect([resumed.code, resumed.err.includes('going on from sample 100')], resumed.err).toEqual([0, true]);
  });

  it('refuses films that do not belong together, are damaged, or are none', async () => {
    const cwd = temporaryFolder({ 'red.glb': makeGlb({ camera: true }), 'none.film': 'GLANZ?' });
    for (const [name, seed] of [
      ['a', '1'],
      ['b', '2'],
    ]) {
      const argv = ['render', ...options, '--samples', '2', '--seed', seed!, '-o', `${name}.film`];
      expect((await here(argv, cwd)).code).toBe(0);
    }
    const film = readFileSync(join(cwd, 'a.film'));
    film[film.length - 5]! ^= 1;
    writeFileSync(join(cwd, 'damaged.film'), film);
    for (const [files, code, message] of [
      [['a.film', 'b.film'], 3, 'its --seed is 2, in "a.film" 1'],
      [['damaged.film'], 3, 'its content is damaged'],
      [['none.film'], 3, 'is not a film of glanz'],
      [['gone.film'], 3, 'there is no such file'],
      [['a.film', 'a.film'], 1, 'two have sample 0'],
    ] as const) {
      const ended = await here(['merge', ...files, '-o', 'x.png'], cwd);
      expect([ended.code, ended.err], ended.err).toEqual([code, expect.stringContaining(message)]);
      expect(existsSync(join(cwd, 'x.png'))).toBe(false);
    }
  });
});
