import { execFile } from 'node:child_process';
import { mkdirSync, readdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { promisify } from 'node:util';
import { describe, expect, it } from 'vitest';
import { CliError } from '../src/errors';
import { chooseGpus, numbered } from '../src/gpus/choose-gpus';
import { checkHiding, hiding } from '../src/gpus/hidden-files';
import { nvidiaNodes } from '../src/gpus/nvidia-nodes';
import { fakeBackend, FAKE_GPUS, fakeDevice, run, temporaryFolder, triangleScene, type FakeOptions } from './fakes';
import { makeGlb } from './glb';

const H100 = 'NVIDIA H100 80GB HBM3';
const listed = (...names: string[]) => [...names.map((name) => ({ ...FAKE_GPUS[0]!, name })), FAKE_GPUS[1]!];
const backendOf = (...names: string[]) => fakeBackend({ listGpus: async () => listed(...names) }).backend;

/** What the kernel module of NVIDIA's driver shows. */
function machine(gpus: readonly { address: string; model: string; minor: number; hasFile?: boolean }[]): string {
  const root = temporaryFolder({});
  mkdirSync(join(root, 'dev'));
  for (const { address, model, minor, hasFile = true } of gpus) {
    const folder = join(root, 'proc/driver/nvidia/gpus', address);
    mkdirSync(folder, { recursive: true });
    writeFileSync(
      join(folder, 'information'),
      `Model: \t\t ${model}\nIRQ:   \t\t 11\nBus Location: \t ${address}\nDevice Minor: \t ${minor}\nGPU Excluded:\t No\n`,
    );
    if (hasFile) writeFileSync(join(root, `dev/nvidia${minor}`), '');
  }
  return root;
}

/** Two of one name, and another; the first on the bus has the second device file. */
const three = () =>
  machine([
    { address: '0000:04:00.0', model: H100, minor: 1 },
    { address: '0000:05:00.0', model: H100, minor: 0 },
    { address: '0000:06:00.0', model: 'NVIDIA RTX A400', minor: 2 },
    { address: '0000:07:00.0', model: H100, minor: 3, hasFile: false },
  ]);

describe('device files of NVIDIA', () => {
  it('those that can be opened, by their numbers', () => {
    expect(nvidiaNodes(three())).toEqual([
      { model: H100, file: '/dev/nvidia0' },
      { model: H100, file: '/dev/nvidia1' },
      { model: 'NVIDIA RTX A400', file: '/dev/nvidia2' },
    ]);
    expect(nvidiaNodes(temporaryFolder({}))).toEqual([]);
  });
});

describe('--gpu', () => {
  const nodes = [
    { model: H100, file: '/dev/nvidia0' },
    { model: H100, file: '/dev/nvidia1' },
    { model: 'NVIDIA RTX A400', file: '/dev/nvidia2' },
  ];
  const both = [
    { name: H100, label: `${H100} #1`, hidden: ['/dev/nvidia1', '/dev/nvidia2'] },
    { name: H100, label: `${H100} #2`, hidden: ['/dev/nvidia0', '/dev/nvidia2'] },
  ];
  const small = { name: 'NVIDIA RTX A400', label: 'NVIDIA RTX A400', hidden: [] };

  it('all: each that is no software; of those with one name each sees itself alone', async () => {
    expect(await chooseGpus(['all'], backendOf(H100, 'NVIDIA RTX A400', H100), nodes)).toEqual([
      both[0],
      small,
      both[1],
    ]);
    expect(await chooseGpus(['all'], backendOf('Fake 3000'), nodes)).toEqual([
      { name: 'Fake 3000', label: 'Fake 3000', hidden: [] },
    ]);
    await expect(chooseGpus(['all'], backendOf(), nodes)).rejects.toMatchObject({ code: 'renderer/no-adapter' });
  });

  it('a number after a name', async () => {
    const backend = backendOf(H100, 'NVIDIA RTX A400', H100);
    expect(await chooseGpus(['h100 #2', 'A400', 'h100 #1'], backend, nodes)).toEqual([
      both[1],
      { ...small, name: 'A400', label: 'A400' },
      both[0],
    ]);
    expect(await chooseGpus(['a400 #1'], backend, nodes)).toEqual([small]);
    await expect(chooseGpus(['h100 #3'], backend, nodes)).rejects.toThrow('2 GPUs have "h100" in its name');
    await expect(chooseGpus(['h100 #0'], backend, nodes)).rejects.toMatchObject({ code: 'cli/usage' });
    await expect(chooseGpus(['4090 #1'], backend, nodes)).rejects.toThrow('no GPU has "4090"');
  });

  it('names alone are not looked up', async () => {
    const { backend } = fakeBackend({ listGpus: () => Promise.reject(new Error('slow')) });
    expect(await chooseGpus([], backend, nodes)).toEqual([{ name: undefined, label: undefined, hidden: [] }]);
    expect(await chooseGpus(['H100'], backend, nodes)).toEqual([{ name: 'H100', label: 'H100', hidden: [] }]);
  });

  it('refuses GPUs of one name that have no device files of their own', async () => {
    await expect(chooseGpus(['all'], backendOf('Radeon', 'Radeon'), nodes)).rejects.toThrow(
      '2 GPUs are called "Radeon", and no device files of NVIDIA belong to them',
    );
    await expect(chooseGpus(['all'], backendOf(H100, H100, H100), nodes)).rejects.toThrow('2 of NVIDIA');
  });

  it('--list-gpus numbers equal names', async () => {
    expect(numbered(['a', 'b', 'a', 'a'])).toEqual(['a #1', 'b', 'a #2', 'a #3']);
    const { out } = await run(['--list-gpus'], '.', { listGpus: async () => listed(H100, H100) });
    expect(out.split('\n').map((line) => line.split(' · ')[0])).toEqual([
      `${H100} #1`,
      `${H100} #2`,
      'SwiftShader Device',
      '',
    ]);
  });
});

describe('commands on several GPUs', () => {
  /** Two GPUs of these names; gives the names of those that were opened. */
  const machineOf = (...names: string[]) => {
    const opened: (string | undefined)[] = [];
    const fake: FakeOptions = {
      slowly: true,
      listGpus: async () => listed(...names),
      async openGpu(name) {
        opened.push(name);
        return { device: fakeDevice(), adapterName: name ?? '', software: false };
      },
    };
    return { opened, fake };
  };
  const options = ['--samples', '3', '--size', '4x4', '--gpu', 'all'];

  it('glanz render --gpu all: each takes images', async () => {
    const { opened, fake } = machineOf('A', 'B');
    const cwd = temporaryFolder({ 'm.glb': makeGlb() });
    const { code, err } = await run(['render', 'm.glb', '--turntable', '6', '-o', '{view}.png', ...options], cwd, fake);
    expect(code, err).toBe(0);
    expect(opened.sort()).toEqual(['A', 'B']);
    expect(readdirSync(cwd).filter((name) => name.endsWith('.png')).length).toBe(6);
  });

  it('glanz render: GPUs of one name are for glanz farm task, which says so where they have no files', async () => {
    const { fake } = machineOf('Radeon', 'Radeon');
    const cwd = temporaryFolder({ 'm.glb': makeGlb() });
    const { code, err } = await run(['render', 'm.glb', '-o', 'a.png', ...options], cwd, fake);
    expect([code, err]).toEqual([2, expect.stringContaining('cannot be distinguished here')]);
  });

  it('glanz farm task --gpu all: each takes images, and a failure ends the others', async () => {
    const { opened, fake } = machineOf('A', 'B');
    const cwd = temporaryFolder({ 'm.glb': makeGlb() });
    writeFileSync(join(cwd, 'b.json'), JSON.stringify([{ model: 'm.glb', turntable: 6, output: '{view}.png' }]));
    const task = ['farm', 'task', 'b.json', '--json', ...options];
    const { code, out, err } = await run(task, cwd, fake);
    expect([code, out], err).toEqual([0, '{"ok":true,"images":6,"rendered":6}\n']);
    expect(opened.sort()).toEqual(['A', 'B']);
    expect(readdirSync(cwd).filter((name) => name.endsWith('.png')).length).toBe(6);
    expect((await run(task, cwd, fake)).out).toBe('{"ok":true,"images":6,"rendered":0}\n');
    const broken: FakeOptions = {
      ...fake,
      onRead: (layer) => {
        if (layer === 'beauty') throw new CliError('cli/output', 'No room.');
      },
    };
    const failed = await run([...task, '--store', 'other'], cwd, broken);
    expect([failed.code, failed.out]).toEqual([4, expect.stringContaining('No room.')]);
  });

  it('glanz farm task: a GPU that opens when another has failed ends without an error of its own', async () => {
    const { fake } = machineOf('A', 'B');
    const cwd = temporaryFolder({ 'm.glb': makeGlb() });
    writeFileSync(join(cwd, 'b.json'), JSON.stringify([{ model: 'm.glb', turntable: 6, output: '{view}.png' }]));
    let signal: AbortSignal | undefined;
    const failed = await run(['farm', 'task', 'b.json', '--json', ...options], cwd, {
      ...fake,
      async loadModel(_, stop) {
        signal = stop;
        return triangleScene();
      },
      async openGpu(name) {
        while (name === 'A' && !signal?.aborted) await new Promise((resolve) => setTimeout(resolve, 5));
        return { device: fakeDevice(), adapterName: name ?? '', software: false };
      },
      onRead() {
        throw new CliError('cli/output', 'No room.');
      },
    });
    expect([failed.code, failed.out]).toEqual([4, expect.stringContaining('No room.')]);
  });
});

const allowed = await checkHiding(['/dev/null']).then(
  () => '',
  (error: Error) => error.message,
);

describe('hiding files from a process', () => {
  it.skipIf(allowed)(`others keep them${allowed && `; not tried: ${allowed}`}`, async () => {
    const folder = temporaryFolder({ own: 'own', other: 'other' });
    const [own, other] = [join(folder, 'own'), join(folder, 'other')];
    const [program, ...args] = [...hiding([other]), 'cat', own, other];
    const read = promisify(execFile);
    expect((await read(program as string, args)).stdout).toBe('own');
    expect((await read('cat', [own, other])).stdout).toBe('ownother');
    expect(hiding([])).toEqual([]);
    await expect(checkHiding([join(folder, 'missing')])).rejects.toMatchObject({ code: 'cli/gpu-isolation' });
  });
});
