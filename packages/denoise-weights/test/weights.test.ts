import { createHash } from 'node:crypto';
import { mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { writeWeights } from '../scripts/weights.mjs';
import * as base from '../src/base';
import { WEIGHT_ARCHIVES, type WeightArchiveName } from '../src/index';
import * as large from '../src/large';
import * as ldr from '../src/ldr';
import { WeightsError, readWeights } from '../src/node';
import * as small from '../src/small';

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
  const addresses = [small, base, large, ldr].flatMap((entry) => Object.values(entry).map((url) => url()));

  it('lead to each archive once', () => {
    const found = addresses.map((url) => createHash('sha256').update(readFileSync(url)).digest('hex'));
    expect(found.sort()).toEqual(
      Object.values(WEIGHT_ARCHIVES)
        .map(({ sha256 }) => sha256)
        .sort(),
    );
  });

  it('are those of the qualities', () => {
    expect(small.smallUrl().href).toMatch(/\/weights\/rt_hdr_alb_nrm_small\.tza$/);
    expect(base.baseUrl().href).toMatch(/\/weights\/rt_hdr_alb_nrm\.tza$/);
    expect(large.largeUrl().href).toMatch(/\/weights\/rt_hdr_calb_cnrm_large\.tza$/);
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
