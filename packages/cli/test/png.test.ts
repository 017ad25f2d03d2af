import { mkdtemp, rm, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { Worker } from 'node:worker_threads';
import { build } from 'esbuild';
import sharp from 'sharp';
import { describe, expect, it, vi } from 'vitest';
import { weslSource } from '../../../tools/pipeline/wesl.mjs';
import { encodePng } from '@glanz/image/png';
import { toneMapPixels } from '@glanz/tonemap';
import type { RenderedImage } from '../src/output/image';
import { pngFile } from '../src/output/png';

/** A gradient, a flat part, and transparency. */
function image(width: number, height: number): RenderedImage {
  const beauty = new Float32Array(4 * width * height);
  for (let i = 0; i < beauty.length; i += 4) {
    const x = (i / 4) % width;
    const y = Math.floor(i / 4 / width);
    const alpha = y > height / 2 ? 1 : x / width;
    beauty.set([alpha * 0.3, (alpha * x) / width, alpha * (0.5 + 0.4 * Math.sin(x * y)), alpha], i);
  }
  return { width, height, beauty, samples: 1, software: 'Glanz' };
}

const DISPLAY = { toneMap: 'neutral', exposure: 0, transparent: true } as const;

describe('pngFile', () => {
  // Bands of 4 MiB: 1100 rows of 16 bits are three.
  it.each([8, 16] as const)('%i bits, on the threads of Node: sharp reads the codes of the tone map', async (bits) => {
    const { width, height, beauty } = image(1000, 1100);
    const png = await pngFile(image(width, height), bits, DISPLAY);
    const { toneMap, exposure } = DISPLAY;
    const output = bits === 8 ? 'uint8' : 'uint16';
    const codes = toneMapPixels(beauty, width, height, { toneMap, exposure, alpha: 'straight', output });
    const read = sharp(png);
    const raw =
      bits === 8 ? await read.raw().toBuffer() : await read.toColourspace('rgb16').raw({ depth: 'ushort' }).toBuffer();
    expect(Buffer.compare(raw, Buffer.from(codes.buffer))).toBe(0);
  });

  it('large: threads write the bytes that one writes', async () => {
    const bits = 16;
    const folder = await mkdtemp(join(tmpdir(), 'glanz-png-'));
    const script = join(folder, 'png-worker.mjs');
    const bundle = (await build({
      entryPoints: [fileURLToPath(new URL('../src/output/png-worker.ts', import.meta.url))],
      outfile: script,
      bundle: true,
      platform: 'node',
      format: 'esm',
      conditions: ['@glanz/source'],
      plugins: [weslSource()],
    })) as { errors: readonly unknown[] };
    expect(bundle.errors).toEqual([]);
    const { width, height } = image(2100, 2000);
    const opaque = { ...DISPLAY, transparent: false };
    const threads = vi.spyOn(Worker.prototype, 'postMessage').mockClear();
    const png = await pngFile(image(width, height), bits, opaque, script);
    const bands = threads.mock.calls.length;
    expect(bands).toBe(Math.ceil(height / Math.floor(2 ** 22 / (width * 3 * (bits / 8)))));
    // Without a script there are no threads.
    const alone = await pngFile(image(width, height), bits, opaque, join(folder, 'absent.mjs'));
    expect(threads.mock.calls.length).toBe(bands);
    expect(Buffer.compare(png, alone)).toBe(0);
    expect(await sharp(png).metadata()).toMatchObject({ width, height, channels: 3 });
    await rm(folder, { recursive: true });
  }, 60_000);

  it('a thread that ends without an answer is an error, not a wait without end', async () => {
    const folder = await mkdtemp(join(tmpdir(), 'glanz-png-'));
    const script = join(folder, 'ends.mjs');
    await writeFile(script, 'process.exit(0);');
    const { width, height } = image(2100, 2000);
    await expect(pngFile(image(width, height), 8, { ...DISPLAY, transparent: false }, script)).rejects.toThrow(
      'ended early',
    );
    await rm(folder, { recursive: true });
  });

  it('smaller images have the bytes of encodePng', async () => {
    const { width, height, beauty, software } = image(60, 40);
    const data = toneMapPixels(beauty, width, height, { toneMap: 'neutral', alpha: 'straight' });
    const expected = encodePng({ width, height, data, text: { Software: software } });
    expect(Buffer.compare(await pngFile(image(60, 40), 8, DISPLAY), expected)).toBe(0);
  });
});
