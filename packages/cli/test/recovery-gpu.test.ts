import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { GlanzError } from '@glanz/scene';
import { describe, expect, it } from 'vitest';
import type { BatchResult, RenderResult } from '../src/index';
import { runCli } from '../src/index';
import { fakeIo, temporaryFolder, type FakeIo } from './fakes';
import { faultyBackend, type Faults } from './faulty-gpu';
import { makeGlb } from './glb';

class DeviceError extends GlanzError {}

// The real renderer on the software GPU, whose device is lost at chosen submissions.
const QUALITY = ['--size', '48x32', '--samples', '24', '--max-depth', '3', '--seed', '7', '--bits', '16'];
const OUTPUTS = ['-o', 'x.png', '-o', 'x.exr', '-o', 'x.hdr'];
const files = ['x.png', 'x.exr', 'x.hdr'];
const folder = () =>
  temporaryFolder({ 'red.glb': makeGlb({ camera: true }), 'shoe.glb': makeGlb({ camera: true, variants: true }) });

/**
 * A clock that runs a thousand times as fast, so that a checkpoint is due after every batch. It does not advance while a film
 * is copied: the interval grows with the time that a copy took, and on a busy machine no second one would be due.
 */
class HastyClock {
  #copies = 0;
  #stoppedAt = 0;
  #stopped = 0;

  now(): number {
    return 1000 * ((this.#copies > 0 ? this.#stoppedAt : performance.now()) - this.#stopped);
  }

  copying(begins: boolean): void {
    if (begins && this.#copies === 0) this.#stoppedAt = performance.now();
    this.#copies += begins ? 1 : -1;
    if (this.#copies === 0) this.#stopped += performance.now() - this.#stoppedAt;
  }
}

async function glanz(argv: readonly string[], cwd: string, faults: Faults = {}) {
  const clock = new HastyClock();
  const recorded = fakeIo(cwd);
  const io = Object.assign(Object.create(recorded) as FakeIo, { now: () => clock.now() });
  const { backend, devices } = faultyBackend({ ...faults, onCopying: (begins) => clock.copying(begins) });
  const code = await runCli(['render', ...argv, '--json'], io, backend);
  const out = io.out.join('');
  return { code, out, err: io.err.join(''), devices, result: JSON.parse(out) as RenderResult };
}

const bytes = (cwd: string, names: readonly string[] = files) => names.map((name) => readFileSync(join(cwd, name)));
const same = (a: readonly Buffer[], b: readonly Buffer[]) => a.map((one, i) => Buffer.compare(one, b[i] as Buffer));

describe('the files are the same bit for bit', () => {
  it('when the GPU is lost while it is prepared, at samples, and at the last copy', async () => {
    const whole = folder();
    const plain = await glanz(['red.glb', ...OUTPUTS, ...QUALITY], whole);
    expect(plain.code, plain.err).toBe(0);
    expect(plain.result).toMatchObject({ gpuLosses: 0, resumedSamples: 0, samples: 24 });
    expect(plain.devices[0]!.submits).toBeGreaterThan(20);
    const expected = bytes(whole);
    // How many submissions there are depends on the machine's speed; these come before the first sample, or are
    // certain.
    const all = [1, 12, 'beauty', 'materialId'] as const;
    const points = process.env['GLANZ_FULL'] === undefined ? all.slice(0, 3) : all;
    for (const point of points) {
      const cwd = folder();
      const { code, err, devices, result } = await glanz(['red.glb', ...OUTPUTS, ...QUALITY], cwd, {
        onSubmit: ({ index, submits: nth, lose }) => index === 0 && nth === point && lose(),
        onRead: ({ index, lose }, layer) => index === 0 && layer === point && lose(),
      });
      expect([point, code, devices.length], err).toEqual([point, 0, 2]);
      expect(same(bytes(cwd), expected), `lost at ${point}`).toEqual([0, 0, 0]);
      expect(result).toMatchObject({ samples: 24, gpuLosses: 1 });
      expect(readdirSync(cwd).sort()).toEqual(['red.glb', 'shoe.glb', ...files].sort());
    }
  });

  it('when it continues from a checkpoint towards a noise target, lost again while the next one is copied', async () => {
    const argv = [
      'red.glb',
      '-o',
      'x.exr',
      '--size',
      '40x24',
      '--samples',
      '1024',
      '--noise',
      '0.01',
      '--max-depth',
      '3',
      '--bits',
      '32',
    ];
    const whole = folder();
    const plain = await glanz(argv, whole);
    expect(plain.code, plain.err).toBe(0);
    const cwd = folder();
    const saved = new Map<number, number>();
    const { code, err, devices, result } = await glanz(argv, cwd, {
      onSave({ index, lose }, film) {
        if (film) return;
        saved.set(index, (saved.get(index) ?? 0) + 1);
        if (index < 2 && saved.get(index) === 2) lose();
      },
    });
    expect([code, devices.length], err).toEqual([0, 3]);
    expect(err.match(/going on from sample [1-9]\d*/g)?.length, err).toBe(2);
    expect([result.samples, result.noise]).toEqual([plain.result.samples, plain.result.noise]);
    expect(same(bytes(cwd, ['x.exr']), bytes(whole, ['x.exr']))).toEqual([0]);
  });

  it('in a batch, lost in the third of four', async () => {
    const argv = ['shoe.glb', '--variant', 'red', '--variant', 'green', '--view', 'front', '--view', 'iso', ...QUALITY];
    const names = ['shoe-red-front.png', 'shoe-red-iso.png', 'shoe-green-front.png', 'shoe-green-iso.png'];
    const whole = folder();
    expect((await glanz(argv, whole)).code).toBe(0);
    const cwd = folder();
    let armed = 0;
    const { code, err, devices, out } = await glanz(argv, cwd, {
      onSubmit({ index, lose }) {
        if (index === 0 && existsSync(join(cwd, names[1]!)) && ++armed === 6) lose();
      },
    });
    expect([code, devices.length], err).toEqual([0, 2]);
    expect((JSON.parse(out) as BatchResult).images.map((image) => (image as RenderResult).gpuLosses)).toEqual([
      0, 0, 1, 0,
    ]);
    expect(same(bytes(cwd, names), bytes(whole, names))).toEqual([0, 0, 0, 0]);
  });

  it('when one of two GPUs cannot be recovered: the other continues its image from the last checkpoint', async () => {
    const argv = [
      'shoe.glb',
      '--variant',
      'red',
      '--variant',
      'green',
      '--view',
      'front',
      '--view',
      'iso',
      ...QUALITY,
      '--samples',
      '64',
    ];
    const names = ['shoe-red-front.png', 'shoe-red-iso.png', 'shoe-green-front.png', 'shoe-green-iso.png'];
    const whole = folder();
    expect((await glanz(argv, whole)).code).toBe(0);
    const cwd = folder();
    let gone = false;
    const { code, err, out } = await glanz([...argv, '--gpu', 'good', '--gpu', 'bad'], cwd, {
      onSave({ name, lose }, film) {
        if (name !== 'bad' || !film || film.samples === 0) return;
        gone = true;
        lose();
      },
      onOpen(_index, name) {
        if (gone && name === 'bad') throw new DeviceError('renderer/no-adapter', 'WebGPU found no usable GPU.');
      },
    });
    expect(code, err).toBe(0);
    const { images, gpusLost } = JSON.parse(out) as BatchResult;
    expect(gpusLost).toMatchObject([{ gpu: 'bad', error: { code: 'cli/gpu-lost' } }]);
    expect((images as RenderResult[]).map(({ adapter }) => adapter.name)).toEqual(['good', 'good', 'good', 'good']);
    expect((images as RenderResult[]).filter(({ resumedSamples }) => resumedSamples > 0).length).toBe(1);
    expect(same(bytes(cwd, names), bytes(whole, names))).toEqual([0, 0, 0, 0]);
  });

  it('when the GPU cannot be recovered, and a later run continues from --checkpoint', async () => {
    const argv = ['red.glb', ...OUTPUTS, ...QUALITY, '--samples', '96'];
    const whole = folder();
    expect((await glanz(argv, whole)).code).toBe(0);
    const cwd = folder();
    let saves = 0;
    const first = await glanz([...argv, '--checkpoint', 'x.ckpt'], cwd, {
      onSave: ({ lose }, film) => film && ++saves === 2 && lose(),
      onOpen(index) {
        if (index > 0) throw new DeviceError('renderer/no-adapter', 'WebGPU found no usable GPU.');
      },
    });
    expect([first.code, readdirSync(cwd).includes('x.ckpt'), readdirSync(cwd).includes('x.png')], first.err).toEqual([
      5,
      true,
      false,
    ]);
    expect(first.err).toMatch(
      /\d+ samples are in "x\.ckpt": the same command continues from there\. \[cli\/gpu-lost\]\n$/,
    );
    // The wrong scene is refused, whatever its settings.
    const wrong = await glanz(
      [...argv.map((word) => (word === 'red.glb' ? 'shoe.glb' : word)), '--checkpoint', 'x.ckpt'],
      cwd,
    );
    expect([wrong.code, wrong.err]).toEqual([3, expect.stringContaining('belongs to another image')]);
    const second = await glanz([...argv, '--checkpoint', 'x.ckpt'], cwd);
    expect(second.code, second.err).toBe(0);
    expect(second.result.resumedSamples).toBeGreaterThan(0);
    expect(same(bytes(cwd), bytes(whole))).toEqual([0, 0, 0]);
    expect(existsSync(join(cwd, 'x.ckpt'))).toBe(false);
  });
});

it.each(['albedo', 'ids', 'position', 'total', 'read'])(
  'no memory for the buffer "%s" of the film: a typed error, status 1, and no file',
  async (name) => {
    const cwd = folder();
    const { code, err, out } = await glanz(['red.glb', ...OUTPUTS, ...QUALITY], cwd, {
      outOfMemory: new RegExp(`^glanz (film )?${name}$`),
    });
    expect([code, readdirSync(cwd).sort()], err).toEqual([1, ['red.glb', 'shoe.glb']]);
    expect((JSON.parse(out) as unknown as { error: { code: string } }).error.code).toMatch(
      /^renderer\/(out-of-memory|gpu-error)$/,
    );
  },
);
