import { existsSync, readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { GlanzError } from '@glanz/scene';
import { describe, expect, it } from 'vitest';
import type { BatchResult, RenderResult } from '../src/index';
import { fakeDevice, fakeIo, run, temporaryFolder, triangleScene, type FakeDevice, type FakeOptions } from './fakes';

class DeviceError extends GlanzError {}
const SIZE = ['--size', '4x4', '--samples', '100'];
const folder = () => temporaryFolder({ 'm.glb': 'not read by the fake' });
const images = (cwd: string) =>
  readdirSync(cwd)
    .filter((name) => name.endsWith('.png'))
    .sort();
const last = (err: string) => err.trim().split('\n').at(-1) as string;

/** GPUs by name: `onSample` hears of which. */
function gpus({
  refuses = () => false,
  onSample = () => undefined,
}: {
  refuses?: (name: string, before: number) => boolean;
  onSample?: (sample: number, name: string, nth: number, device: FakeDevice) => void;
}) {
  const opened: { name: string; device: FakeDevice }[] = [];
  const fake: FakeOptions = {
    async openGpu(name = 'only') {
      if (refuses(name, opened.filter((one) => one.name === name).length))
        throw new DeviceError('renderer/no-device', 'The GPU refused a device.');
      const device = fakeDevice();
      opened.push({ name, device });
      return { device, adapterName: `Fake ${name}`, software: false };
    },
    onSample(sample, device) {
      const of = opened.find((one) => one.device === device) as { name: string };
      onSample(
        sample,
        of.name,
        opened.filter(({ name }) => name === of.name).findIndex((one) => one.device === device),
        device,
      );
    },
  };
  return { fake, opened };
}

/** Moves the clock on by a second for each sample, so that a checkpoint is due. */
const ticking = (cwd: string) => {
  const io = fakeIo(cwd);
  return { io, tick: () => void (io.time += 1000) };
};

describe('a render whose GPU is lost', () => {
  it('takes a new device and continues from the last checkpoint', async () => {
    const cwd = folder();
    const { io, tick } = ticking(cwd);
    const seen: number[] = [];
    const { fake, opened } = gpus({
      onSample(sample, _name, nth, device) {
        tick();
        if (nth === 1) seen.push(sample);
        if (nth === 0 && sample === 50) throw device.lose();
      },
    });
    const { code, out, err, edits } = await run(['render', 'm.glb', ...SIZE, '--json'], cwd, fake, io);
    expect([code, opened.length], err).toEqual([0, 2]);
    const result = JSON.parse(out) as RenderResult;
    expect(result).toMatchObject({ ok: true, samples: 100, gpuLosses: 1, resumedSamples: 0 });
    const [[what, from]] = edits as [[string, number]];
    expect([what, from, seen[0], seen.length]).toEqual(['film', 49, 50, 51]);
    expect(err).toContain('m.png: the GPU was lost; going on from sample 49 on a new device.');
    expect([io.waits.length, images(cwd)]).toEqual([0, ['m.png']]);
  });

  it('starts again, and says so, where the new tracer does not take the film, as one of other shapes does not', async () => {
    const cwd = folder();
    const { io, tick } = ticking(cwd);
    const seen: number[] = [];
    const { fake } = gpus({
      onSample(sample, _name, nth, device) {
        tick();
        if (nth === 1) seen.push(sample);
        if (nth === 0 && sample === 50) throw device.lose();
      },
    });
    const { code, err, edits } = await run(['render', 'm.glb', ...SIZE], cwd, { ...fake, resumes: false }, io);
    expect([code, edits, seen.length, seen[0]], err).toEqual([0, [], 100, 1]);
    expect(err).toContain('m.png: starts from the first sample');
  });

  it('takes checkpoints rarely enough: each a second or more after the one before, whatever a sample takes', async () => {
    const cwd = folder();
    const io = fakeIo(cwd);
    const at: number[] = [];
    const { fake } = gpus({ onSample: () => void (io.time += 10) });
    const copies: FakeOptions = { ...fake, onSave: () => void at.push(io.time) };
    expect((await run(['render', 'm.glb', '--size', '4x4', '--samples', '1000'], cwd, copies, io)).code).toBe(0);
    expect(at.length).toBeGreaterThan(5);
    for (let i = 1; i < at.length; i++) expect(at[i]! - at[i - 1]!).toBeGreaterThanOrEqual(1000);
  });

  it('takes no checkpoint of a film that is larger than a quarter of the memory, and says so where one is wanted', async () => {
    const cwd = folder();
    const { io, tick } = ticking(cwd);
    let saves = 0;
    const fake: FakeOptions = {
      onSave: () => saves++,
      onSample(sample) {
        io.time += 1e9;
        tick();
        if (sample === 50) throw new DeviceError('renderer/gpu-error', 'enough');
      },
    };
    const { code, err } = await run(
      ['render', 'm.glb', '--size', '65536x65536', '--samples', '100', '--checkpoint', 'm.ckpt'],
      cwd,
      fake,
      io,
    );
    expect([code, saves]).toEqual([1, 0]);
    expect(err).toContain(
      'warning: a film of 275 GB is too large to be copied on this machine: there will be no checkpoints.',
    );
  });

  it('a checkpoint that cannot be taken does not keep the image, and is reported once', async () => {
    const cwd = folder();
    const { io, tick } = ticking(cwd);
    const fake: FakeOptions = {
      onSample: tick,
      onSave() {
        throw new DeviceError('renderer/out-of-memory', 'The GPU has not enough memory.');
      },
    };
    const { code, err } = await run(['render', 'm.glb', ...SIZE, '--checkpoint', 'm.ckpt'], cwd, fake, io);
    expect([code, images(cwd)], err).toEqual([0, ['m.png']]);
    expect(err.match(/no checkpoint could be taken: The GPU has not enough memory\./g)?.length).toBe(1);
    const other = folder();
    const without = ticking(other);
    expect(
      (await run(['render', 'm.glb', ...SIZE], other, { ...fake, onSample: without.tick }, without.io)).err,
    ).not.toContain('checkpoint');
    const stopped = fakeIo(cwd);
    const interrupted = await run(
      ['render', 'm.glb', ...SIZE, '--checkpoint', 'm.ckpt'],
      cwd,
      { ...fake, onSample: (sample) => sample === 9 && stopped.interrupt() },
      stopped,
    );
    expect([interrupted.code, images(cwd), existsSync(join(cwd, 'm.ckpt'))], interrupted.err).toEqual([
      130,
      ['m.png'],
      false,
    ]);
  });

  it('is lost while it is read: what has been rendered is not rendered again', async () => {
    const cwd = folder();
    const { io, tick } = ticking(cwd);
    const { fake, opened } = gpus({ onSample: tick });
    const lossy: FakeOptions = {
      ...fake,
      onRead(_layer, device) {
        if (device === opened[0]?.device) throw device.lose();
      },
    };
    const { code, edits, err } = await run(['render', 'm.glb', ...SIZE], cwd, lossy, io);
    expect([code, images(cwd)], err).toEqual([0, ['m.png']]);
    expect(edits).toEqual([['film', expect.any(Number)]]);
    expect(edits[0]![1]).toBeGreaterThanOrEqual(80);
  });

  it('knows a loss also by what the device says, when the error says something else', async () => {
    const cwd = folder();
    const { fake } = gpus({
      onSample(sample, _name, nth, device) {
        if (nth > 0 || sample < 5) return;
        device.lose();
        throw new Error('AbortError');
      },
    });
    expect((await run(['render', 'm.glb', ...SIZE], cwd, fake)).code).toBe(0);
  });

  it('that gives no device any more: 5, after a bounded number of attempts with growing pauses, and advice', async () => {
    const cwd = folder();
    const io = fakeIo(cwd);
    const { fake, opened } = gpus({
      refuses: (_name, before) => before > 0,
      onSample(sample, _name, _nth, device) {
        if (sample === 9) throw device.lose();
      },
    });
    const { code, err, out } = await run(['render', 'm.glb', ...SIZE, '--json'], cwd, fake, io);
    expect([code, opened.length, io.waits.filter((ms) => ms !== 100)]).toEqual([5, 1, [300, 1000, 3000, 10_000]]);
    expect(last(err)).toBe(
      'glanz: The GPU "Fake only" was lost and gives no new device after 5 attempts (The GPU refused a device). Often it ran out of memory, its driver crashed or was updated, or the machine was suspended: close other programs that use it, try a smaller --size, update the driver, or choose another one with --gpu (see glanz --list-gpus; --gpu software uses the processor). With --checkpoint FILE, a later run continues from the last samples. [cli/gpu-lost]',
    );
    expect(JSON.parse(out)).toMatchObject({ ok: false, error: { code: 'cli/gpu-lost' } });
    expect(images(cwd)).toEqual([]);
  });

  it('repeatedly without progress: 5; with progress it continues for as long as it takes', async () => {
    const cwd = folder();
    const always = gpus({
      onSample(sample, _name, _nth, device) {
        if (sample === 9) throw device.lose();
      },
    });
    const { code, err } = await run(['render', 'm.glb', ...SIZE], cwd, always.fake);
    expect([code, always.opened.length, images(cwd)]).toEqual([5, 6, []]);
    expect(last(err)).toContain('was lost 6 times, the last time without progress in between (injected)');
    const { io, tick } = ticking(cwd);
    const often = gpus({
      onSample(sample, _name, nth, device) {
        tick();
        if (sample >= 8 * (nth + 1)) throw device.lose();
      },
    });
    const moving = await run(['render', 'm.glb', ...SIZE, '--json'], cwd, often.fake, io);
    expect(moving.code, moving.err).toBe(0);
    expect((JSON.parse(moving.out) as RenderResult).gpuLosses).toBe(12);
  });

  it('Ctrl-C while it waits for the GPU ends it', async () => {
    const cwd = folder();
    const io = fakeIo(cwd);
    const { fake } = gpus({
      refuses: (_name, before) => {
        if (before > 0) io.interrupt();
        return before > 0;
      },
      onSample(sample, _name, _nth, device) {
        if (sample === 9) throw device.lose();
      },
    });
    const { code, err } = await run(['render', 'm.glb', ...SIZE], cwd, fake, io);
    expect([code, images(cwd), last(err)]).toEqual([130, [], 'no image written.']);
  });
});

describe('errors that the device reports outside of a call', () => {
  const failing = (when: (layer: string) => boolean): FakeOptions => {
    let report: (error: Error) => void = () => undefined;
    return {
      async openGpu(_name, onError = () => undefined) {
        report = onError;
        return { device: fakeDevice(), adapterName: 'Fake', software: false };
      },
      onRead(layer) {
        if (when(layer)) report(new DeviceError('renderer/out-of-memory', 'The GPU has not enough memory: 3 GB.'));
      },
    };
  };
  const EXR = ['render', 'm.glb', '--size', '4x4', '--samples', '3', '-o', 'x.exr', '-o', 'x.png'];

  it('a feature pass that never ran: 1, and no file', async () => {
    const cwd = folder();
    const { code, err } = await run(
      EXR,
      cwd,
      failing((layer) => layer === 'albedo'),
    );
    expect([code, last(err), readdirSync(cwd)]).toEqual([
      1,
      'glanz: The GPU has not enough memory: 3 GB. [renderer/out-of-memory]',
      ['m.glb'],
    ]);
  });

  it('of one image of a batch: the others are made, by tracers that know nothing of it', async () => {
    const cwd = folder();
    let reads = 0;
    const { code, out, created } = await run(
      [
        'render',
        'm.glb',
        '--size',
        '4x4',
        '--samples',
        '3',
        '--view',
        'front',
        '--view',
        'back',
        '--view',
        'left',
        '--json',
      ],
      cwd,
      failing(() => ++reads === 2),
    );
    expect([code, created.length, images(cwd)]).toEqual([1, 2, ['m-front.png', 'm-left.png']]);
    expect(JSON.parse(out)).toMatchObject({
      ok: false,
      failed: 1,
      images: [{ ok: true }, { ok: false, error: { code: 'renderer/out-of-memory' } }, { ok: true }],
    });
  });
});

describe('a batch', () => {
  const scene = { ...triangleScene(), variants: ['a', 'b', 'c', 'd', 'e', 'f', 'g', 'h'] };
  const EIGHT = ['render', 'm.glb', '--size', '4x4', '--samples', '20', '--variant', 'all', '--json'];

  it('whose GPU is lost in one image continues, and makes all', async () => {
    const cwd = folder();
    let made = 0;
    const { fake, opened } = gpus({
      onSample(sample, _name, nth, device) {
        if (sample === 20) made++;
        if (nth === 0 && made === 2 && sample === 7) throw device.lose();
      },
    });
    const { code, out, err } = await run(EIGHT, cwd, { ...fake, scene });
    expect([code, opened.length, images(cwd).length], err).toEqual([0, 2, 8]);
    expect((JSON.parse(out) as BatchResult).images.map((image) => (image as RenderResult).gpuLosses)).toEqual([
      0, 0, 1, 0, 0, 0, 0, 0,
    ]);
  });

  const two = [...EIGHT, '--gpu', 'good', '--gpu', 'bad'];

  it.each([
    ['gives no device any more', (name: string, before: number) => name === 'bad' && before > 0],
    ['loses every device', () => false],
  ])('a worker whose GPU %s passes its image and its samples to the other', async (_what, refuses) => {
    const cwd = folder();
    const { io, tick } = ticking(cwd);
    const { fake } = gpus({
      refuses,
      onSample(sample, name, _nth, device) {
        tick();
        if (name === 'bad' && sample === 15) throw device.lose();
      },
    });
    const { code, out, err, edits } = await run(two, cwd, { ...fake, scene }, io);
    expect([code, images(cwd).length], err).toEqual([0, 8]);
    const result = JSON.parse(out) as BatchResult;
    expect(result).toMatchObject({
      ok: true,
      failed: 0,
      gpusLost: [{ gpu: 'Fake bad', error: { code: 'cli/gpu-lost' } }],
    });
    expect(new Set(result.images.map((image) => (image as RenderResult).adapter.name))).toEqual(new Set(['Fake good']));
    // One of the images began on the one and was finished on the other.
    const resumed = result.images
      .map((image) => (image as RenderResult).resumedSamples)
      .filter((samples) => samples > 0);
    expect(resumed.length).toBe(1);
    expect(edits.filter(([what, to]) => what === 'film' && to === resumed[0]).length).toBeGreaterThanOrEqual(1);
    expect(err).toContain('The other GPUs take over its images.');
  });

  it('one that never was there leaves everything to the other', async () => {
    const { fake } = gpus({ refuses: (name) => name === 'bad' });
    const { code, out } = await run(two, folder(), { ...fake, scene });
    expect([code, JSON.parse(out)]).toEqual([
      0,
      expect.objectContaining({
        ok: true,
        gpusLost: [{ gpu: 'bad', error: { code: 'renderer/no-device', message: 'The GPU refused a device.' } }],
      }),
    ]);
  });

  it('without any GPU left, what is not made fails, each with its reason: 5', async () => {
    const cwd = folder();
    let samples = 0;
    const { fake } = gpus({
      refuses: (_name, before) => before > 0,
      onSample(_sample, _name, _nth, device) {
        if (++samples > 70) throw device.lose();
      },
    });
    const { code, out, err } = await run(two, cwd, { ...fake, scene });
    const result = JSON.parse(out) as BatchResult;
    expect([code, result.images.length, result.gpusLost.length], err).toEqual([5, 8, 2]);
    expect(result.failed).toBe(8 - images(cwd).length);
    expect(result.failed).toBeGreaterThanOrEqual(5);
    const reasons = result.images.flatMap((image) => (image.ok ? [] : [image.error]));
    for (const { code: why, message } of reasons)
      expect([why, message]).toEqual(['cli/gpu-lost', expect.stringContaining('gives no new device')]);
    expect(err).toContain(`${result.failed} failed`);
  });

  it('none of whose GPUs is there ends with the error of the first: 5', async () => {
    const { fake } = gpus({ refuses: () => true });
    const { code, err, out } = await run(two, folder(), { ...fake, scene });
    expect([code, last(err), JSON.parse(out)]).toEqual([
      5,
      'glanz: The GPU refused a device. [renderer/no-device]',
      { ok: false, error: expect.objectContaining({ code: 'renderer/no-device' }) },
    ]);
  });

  it('one image that no GPU survives does not keep the others', async () => {
    const cwd = folder();
    // The third image, by its samples' order: the tracer was set to variant 2.
    for (const argv of [EIGHT, two]) {
      const { fake } = gpus({});
      let variant: unknown;
      const deadly: FakeOptions = {
        ...fake,
        scene,
        onEdit: (what, to, device) =>
          void (what === 'variant' && ((device as { variant?: unknown }).variant = variant = to)),
        onSample(sample, device) {
          if (sample === 5 && (device as { variant?: unknown }).variant === 2) throw device.lose();
        },
      };
      const { code, out, err } = await run(argv, cwd, deadly);
      expect(variant).toBeDefined();
      const result = JSON.parse(out) as BatchResult;
      expect([code, result.failed, result.images.length], err).toEqual([5, 1, 8]);
      expect(result.images.find(({ ok }) => !ok)).toMatchObject({ variant: 'c', error: { code: 'cli/gpu-lost' } });
    }
  });

  it('a fault of our own in one worker stops the others after their image: 70', async () => {
    const cwd = folder();
    const { fake } = gpus({
      onSample(sample, name) {
        if (name === 'bad' && sample === 3) throw new TypeError('x is not a function');
      },
    });
    const { code, io } = await run(two, cwd, { ...fake, scene });
    expect([code, io.listening]).toEqual([70, 0]);
    expect(images(cwd).length).toBeLessThan(4);
  });
});

describe('--checkpoint FILE', () => {
  const argv = ['render', 'm.glb', ...SIZE, '--checkpoint', 'm.ckpt', '--json'];
  /** A run that Ctrl-C ends after so many samples. */
  const stopped = async (cwd: string, at = 40, more: readonly string[] = []) => {
    const io = fakeIo(cwd);
    return run([...argv, ...more], cwd, { onSample: (s) => s === at + 1 && io.interrupt() }, io);
  };

  it('keeps the samples of a run that is stopped, and a later run continues from there; then the file is gone', async () => {
    const cwd = folder();
    const first = await stopped(cwd);
    expect([first.code, images(cwd), existsSync(join(cwd, 'm.ckpt'))]).toEqual([130, ['m.png'], true]);
    expect(first.err).toContain('m.ckpt: 40 samples; the same command continues from there');
    const second = await run(argv, cwd);
    expect([second.code, second.edits]).toEqual([0, [['film', 40]]]);
    expect(JSON.parse(second.out)).toMatchObject({ samples: 100, resumedSamples: 40 });
    expect(readdirSync(cwd).sort()).toEqual(['m.glb', 'm.png']);
  });

  it('is written while rendering continues, rarely, and whole at any time', async () => {
    const cwd = folder();
    const io = fakeIo(cwd);
    const long = argv.map((word) => (word === '100' ? '1500' : word));
    const seen = new Set<string>();
    const onSample = () => {
      io.time += 2000;
      for (const name of readdirSync(cwd)) seen.add(name);
      if (existsSync(join(cwd, 'm.ckpt'))) seen.add(readFileSync(join(cwd, 'm.ckpt'), 'latin1'));
    };
    expect((await run(long, cwd, { onSample, slowly: true }, io)).code).toBe(0);
    const contents = [...seen].filter((text) => text.startsWith('GLANZ CHECKPOINT 1\n'));
    // 3000 s by this clock, and 30 s or more between two.
    expect(contents.length).toBeGreaterThanOrEqual(3);
    expect(contents.length).toBeLessThanOrEqual(100);
    for (const text of contents) expect(text).toMatch(/\n\[\d+,4,4\]$/);
  });

  it('keeps what a lost GPU had', async () => {
    const cwd = folder();
    const { io, tick } = ticking(cwd);
    const { fake } = gpus({
      refuses: (_name, before) => before > 0,
      onSample(sample, _name, _nth, device) {
        tick();
        if (sample === 60) throw device.lose();
      },
    });
    const { code, err } = await run(argv, cwd, fake, io);
    const [, samples] =
      /(\d+) samples are in "m\.ckpt": the same command continues from there\. \[cli\/gpu-lost\]$/.exec(last(err)) ??
      [];
    expect([code, Number(samples) > 40], err).toEqual([5, true]);
    expect((await run(argv, cwd)).edits).toEqual([['film', Number(samples)]]);
  });

  it.each([
    ['another seed', ['--seed', '3'], 'its --seed is 0, here 3'],
    ['another size', ['--size', '5x4'], 'its --size is 4x4, here 5x4'],
    [
      'another depth and filter',
      ['--max-depth', '3', '--filter', 'gaussian'],
      'its --max-depth is 8, here 3; its --filter is box, here gaussian',
    ],
    [
      'another view',
      ['--view', 'iso'],
      'its --camera or --view is {"kind":"camera"}, here {"kind":"direction","azimuth":45,',
    ],
    ['fewer samples', ['--samples', '30'], 'has 40 samples already, more than --samples 30'],
  ])('of %s is refused before anything is loaded, and stays as it is', async (_what, more, message) => {
    const cwd = folder();
    await stopped(cwd);
    const before = readFileSync(join(cwd, 'm.ckpt'));
    const { code, err, created } = await run([...argv, ...more], cwd);
    expect([code, created.length], err).toEqual([3, 0]);
    expect(last(err)).toContain(`The checkpoint "m.ckpt" `);
    expect(last(err)).toContain(message);
    expect(last(err)).toContain('[cli/checkpoint]');
    expect(readFileSync(join(cwd, 'm.ckpt')).equals(before)).toBe(true);
  });

  it('of another model is refused, by the content of the file; more samples are welcome', async () => {
    const cwd = folder();
    await stopped(cwd);
    writeFileSync(join(cwd, 'm.glb'), 'something else');
    expect(last((await run(argv, cwd)).err)).toContain('belongs to another image: it is of another model.');
    writeFileSync(join(cwd, 'm.glb'), 'not read by the fake');
    expect(JSON.parse((await run([...argv, '--samples', '200'], cwd)).out)).toMatchObject({
      samples: 200,
      resumedSamples: 40,
    });
  });

  it.each([
    ['is something else', 'my diary', 'is not a checkpoint of glanz and is not changed'],
    ['has a damaged header', 'GLANZ CHECKPOINT 1\n{"settings"\n[]', 'its header is damaged'],
    ['is cut off', undefined, 'bytes instead of'],
    ['has a wrong bit', undefined, 'its content is damaged'],
  ])('a file that %s is refused and not replaced', async (what, text, message) => {
    const cwd = folder();
    await stopped(cwd);
    const file = join(cwd, 'm.ckpt');
    const bytes = readFileSync(file);
    if (what === 'has a wrong bit') bytes[bytes.length - 3]! ^= 1;
    writeFileSync(file, text ?? (what === 'is cut off' ? bytes.subarray(0, -1) : bytes));
    const before = readFileSync(file);
    const { code, err } = await run(argv, cwd);
    expect([code, last(err)]).toEqual([3, expect.stringContaining(message)]);
    expect(readFileSync(file).equals(before)).toBe(true);
  });

  it('of several images each has its own, and Ctrl-C keeps that of the one under way', async () => {
    const cwd = folder();
    const io = fakeIo(cwd);
    const many = [...argv, '--view', 'front', '--view', 'iso'];
    let samples = 0;
    const { code, err } = await run(many, cwd, { onSample: () => ++samples === 131 && io.interrupt() }, io);
    expect(
      [
        code,
        readdirSync(cwd)
          .filter((name) => !name.startsWith('.'))
          .sort(),
      ],
      err,
    ).toEqual([130, ['m-front.png', 'm-iso.ckpt', 'm.glb']]);
    const rest = await run([...many, '--resume'], cwd);
    expect([rest.code, rest.edits.filter(([what]) => what === 'film'), images(cwd)]).toEqual([
      0,
      [['film', 30]],
      ['m-front.png', 'm-iso.png'],
    ]);
  });

  it('that cannot be written is found before anything is loaded', async () => {
    const cwd = folder();
    expect(await run(['render', 'm.glb', ...SIZE, '--checkpoint', 'no/where.ckpt'], cwd)).toMatchObject({
      code: 4,
      created: [],
    });
    expect(await run(['render', 'm.glb', ...SIZE, '--checkpoint', '{colour}.ckpt'], cwd)).toMatchObject({
      code: 2,
      err: expect.stringContaining('--checkpoint "{colour}.ckpt": {colour} is unknown'),
    });
    expect(await run(['render', 'm.glb', ...SIZE, '--checkpoint', 'm.png'], cwd)).toMatchObject({
      code: 2,
      err: expect.stringContaining('Two images would be written to "m.png"'),
    });
  });
});
