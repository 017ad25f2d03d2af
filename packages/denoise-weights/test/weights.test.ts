import { createHash } from 'node:crypto';
import { mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { writeWeights } from '../scripts/weights.mjs';
import manifest from '../package.json' with { type: 'json' };
import { baseUrl } from '../src/base';
import { WEIGHT_ARCHIVES, type WeightArchiveName } from '../src/index';
import { largeUrl } from '../src/large';
import { WeightsError, readWeights } from '../src/node';
import { smallUrl } from '../src/small';

const own = fileURLToPath(new URL('..', import.meta.url));
const names = Object.keys(WEIGHT_ARCHIVES) as WeightArchiveName[];
const temporary = mkdtempSync(join(tmpdir(), 'glanz-weights-'));

beforeAll(() => writeWeights(WEIGHT_ARCHIVES));
afterAll(() => rmSync(temporary, { recursive: true }));

/** Channels of the first layer's input, read from an archive's table of tensors (TZA 2.0). */
function inputChannels(bytes: Uint8Array): { readonly layers: number; readonly channels: number } {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  expect(view.getUint16(0, true)).toBe(0x41d7);
  let at = Number(view.getBigUint64(4, true));
  const count = view.getUint32(at, true);
  // The first tensor: length of the name, name, rank, sizes
  const length = view.getUint16(at + 4, true);
  at += 6;
  expect(new TextDecoder().decode(bytes.subarray(at, at + length))).toMatch(/^enc_conv(0|1a)\.weight$/);
  return { layers: count / 2, channels: view.getUint32(at + length + 1 + 4, true) };
}

describe('the archives', () => {
  it.each(names)('%s has the network that its name says', async (name) => {
    const { layers, channels } = inputChannels(await readWeights(name));
    expect(layers).toBe(name.endsWith('_large') ? 19 : 16);
    expect(channels).toBe(3 * name.split('_').filter((part) => /^(hdr|ldr|c?alb|c?nrm)$/.test(part)).length);
  });

  it('have licence and origin beside them, and nothing else is there', () => {
    const files = readdirSync(join(own, 'weights')).sort();
    expect(files).toEqual([...names.map((name) => `${name}.tza`), 'LICENSE.txt', 'ORIGIN.md'].sort());
    expect(readFileSync(join(own, 'weights/LICENSE.txt'), 'utf8')).toContain('Apache License');
    expect(readFileSync(join(own, 'weights/ORIGIN.md'), 'utf8')).toMatch(/Copyright Intel Corporation/);
  });
});

describe('addresses', () => {
  const entries = Object.values(manifest.exports).flatMap((entry) =>
    typeof entry === 'string' ? [] : [entry['@glanz/source']],
  );

  it('lead to each archive once', async () => {
    const found: string[] = [];
    for (const source of entries) {
      const exported = (await import(new URL(`../${source}`, import.meta.url).href)) as Record<string, unknown>;
      for (const [name, value] of Object.entries(exported))
        if (/^(url|\w+Url)$/.test(name)) {
          const bytes = readFileSync((value as () => URL)());
          found.push(createHash('sha256').update(bytes).digest('hex'));
          // An entry that has the name of an archive leads to that one.
          if (name === 'url')
            expect((value as () => URL)().pathname).toBe(
              new URL(`../weights/${source.slice(6, -3)}.tza`, import.meta.url).pathname,
            );
        }
    }
    expect(found.sort()).toEqual(
      Object.values(WEIGHT_ARCHIVES)
        .map(({ sha256 }) => sha256)
        .sort(),
    );
  });

  it('are those of the qualities', () => {
    expect(smallUrl().href).toMatch(/\/weights\/rt_hdr_alb_nrm_small\.tza$/);
    expect(baseUrl().href).toMatch(/\/weights\/rt_hdr_alb_nrm\.tza$/);
    expect(largeUrl().href).toMatch(/\/weights\/rt_hdr_calb_cnrm_large\.tza$/);
  });
});

describe('what is wrong', () => {
  it('a name that does not exist', async () => {
    const read = readWeights('toString' as WeightArchiveName);
    await expect(read).rejects.toMatchObject({ code: 'denoise-weights/unreadable' });
    await expect(read).rejects.toBeInstanceOf(WeightsError);
  });

  it('reading that is aborted rejects with the reason', async () => {
    const reason = new Error('enough');
    await expect(readWeights('rt_hdr', { signal: AbortSignal.abort(reason) })).rejects.toBe(reason);
  });

  it('an archive that is not the expected one is not written', () => {
    const { rt_hdr_small } = WEIGHT_ARCHIVES;
    writeFileSync(join(temporary, 'rt_hdr_small.tza'), new Uint8Array(rt_hdr_small.bytes));
    const to = join(temporary, 'to');
    expect(() => writeWeights({ rt_hdr_small }, { from: temporary, to })).toThrow(rt_hdr_small.sha256);
    expect(readdirSync(to)).toEqual([]);
  });
});
