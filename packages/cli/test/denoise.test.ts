import { decodeExr } from '@glanz/image/exr';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { afterEach, describe, expect, it, vi } from 'vitest';
import { parseCommand } from '../src/command';
import { fakeIo, run, temporaryFolder } from './fakes';

const render = async (...args: string[]) => {
  const cwd = temporaryFolder({ 'a.glb': '' });
  const outcome = await run(['render', 'a.glb', '--size', '4x3', '--samples', '2', ...args], cwd);
  return { ...outcome, file: (name: string) => new Uint8Array(readFileSync(join(cwd, name))) };
};
const text = (bytes: Uint8Array) => Buffer.from(bytes).toString('latin1');

describe('--denoise', () => {
  it('takes a quality, balanced where it stands alone', () => {
    const qualityOf = (...args: string[]) => {
      const command = parseCommand(['render', ...args]);
      return command.kind === 'render' ? [command.options?.model, command.options?.denoise] : [];
    };
    expect(qualityOf('a.glb')).toEqual(['a.glb', undefined]);
    expect(qualityOf('a.glb', '--denoise', 'best')).toEqual(['a.glb', 'best']);
    expect(qualityOf('--denoise', 'a.glb')).toEqual(['a.glb', 'balanced']);
    expect(qualityOf('a.glb', '--denoise', '--samples', '2')).toEqual(['a.glb', 'balanced']);
    expect(() => parseCommand(['render', 'a.glb', '--denoise=bets'])).toThrow(/fast, balanced, best, not "bets"/);
  });

  it('keeps the film in EXR, beside a layer that says what it is', async () => {
    const { code, file } = await render('--denoise', 'fast', '-o', 'a.exr', '--bits', '32');
    expect(code).toBe(0);
    const plain = await render('-o', 'a.exr', '--bits', '32');
    const [channels, raw] = [file('a.exr'), plain.file('a.exr')].map((bytes) => decodeExr(bytes).channels);
    for (const name of ['R', 'G', 'B', 'A']) expect(channels!.get(name)).toEqual(raw!.get(name));
    expect([...channels!.get('denoised.R')!.data]).toEqual(Array(12).fill(0.5));
    expect(text(file('a.exr'))).toContain('Open Image Denoise, fast');
    expect(text(plain.file('a.exr'))).not.toContain('denoised');
  });

  it('shows the denoised image in PNG and HDR, and says so', async () => {
    const { code, file, err } = await render('--denoise', '-o', 'a.png', '-o', 'a.hdr');
    expect(code).toBe(0);
    expect(err).toContain('denoised (balanced)');
    expect(text(file('a.png'))).toContain('Denoised\0Open Image Denoise, balanced');
    const plain = await render('-o', 'a.png', '-o', 'a.hdr');
    expect(file('a.hdr')).not.toEqual(plain.file('a.hdr'));
    expect(text(plain.file('a.png'))).not.toContain('Denoised');
  });

  it('ends at the first interrupt: the film is written as it is, which the message and the result say', async () => {
    const args = ['render', 'a.glb', '--size', '4x3', '--samples', '2', '--denoise', 'fast', '--json', '-o', 'a.hdr'];
    const cwd = temporaryFolder({ 'a.glb': '' });
    const io = fakeIo(cwd);
    const { code, out, err } = await run(args, cwd, { onDenoise: () => io.interrupt() }, io);
    expect(code).toBe(130);
    expect(err).toContain('stopped while it was denoised');
    expect(JSON.parse(out)).toMatchObject({ ok: true, samples: 2, interrupted: 'SIGINT' });
    expect(JSON.parse(out)).not.toHaveProperty('denoised');
    const plain = await render('-o', 'a.hdr');
    expect(new Uint8Array(readFileSync(join(cwd, 'a.hdr')))).toEqual(plain.file('a.hdr'));
  });

  it('still denoises samples that an interrupt has ended', async () => {
    const cwd = temporaryFolder({ 'a.glb': '' });
    const io = fakeIo(cwd);
    const fake = { slowly: true, onSample: (sample: number) => void (sample === 2 && io.interrupt()) };
    const args = ['render', 'a.glb', '--size', '4x3', '--samples', '9', '--denoise', 'fast', '--json', '-o', 'a.hdr'];
    const { code, out } = await run(args, cwd, fake, io);
    expect(code).toBe(130);
    expect(JSON.parse(out)).toMatchObject({ interrupted: 'SIGINT', denoised: 'fast' });
  });

  it('is in the result', async () => {
    const { out } = await render('--denoise', 'best', '--json', '-o', 'a.png');
    expect(JSON.parse(out)).toMatchObject({ ok: true, denoised: 'best' });
  });
});

describe('without the weights', () => {
  afterEach(() => vi.doUnmock('@glanz/denoise-weights/node'));

  it('names the package to install', async () => {
    vi.doMock('@glanz/denoise-weights/node', () => {
      throw new Error("Cannot find package '@glanz/denoise-weights'");
    });
    vi.resetModules();
    const { createImageDenoiser } = await import('../src/denoise');
    const device = {} as GPUDevice;
    await expect(createImageDenoiser(device, 'fast', new AbortController().signal)).rejects.toMatchObject({
      code: 'cli/missing-package',
      message: expect.stringContaining('npm install @glanz/denoise-weights') as string,
    });
  });
});
