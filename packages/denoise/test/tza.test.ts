import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { DenoiseError, parseTza } from '../src/index';
import { writeTza } from './write-tza';

const tiny = new Uint8Array(readFileSync(new URL('data/tiny.tza', import.meta.url)));

/** The code of the error that reading these bytes throws. */
function codeOf(bytes: Uint8Array | ArrayBuffer): string | undefined {
  try {
    parseTza(bytes);
    return undefined;
  } catch (error) {
    expect(error).toBeInstanceOf(DenoiseError);
    return (error as DenoiseError).code;
  }
}

/** The hash by which the weights of tiny.tza were made, in [0, 1). */
function hash01(i: number): number {
  let x = i >>> 0;
  x = Math.imul(x ^ (x >>> 16), 0x7feb352d);
  x = Math.imul(x ^ (x >>> 15), 0x846ca68b);
  x ^= x >>> 16;
  return (x >>> 8) / 16777216;
}

describe('parseTza', () => {
  it('reads the weights of a network that were made by a formula', () => {
    const tensors = parseTza(tiny);
    expect([...tensors.keys()].slice(0, 3)).toEqual(['enc_conv0.weight', 'enc_conv0.bias', 'enc_conv1.weight']);
    expect(tensors.size).toBe(32);
    const { shape, data } = tensors.get('enc_conv0.weight')!;
    expect(shape).toEqual([5, 9, 3, 3]);
    // A half has 11 bits.
    for (const [i, value] of data.entries()) {
      const exact = (hash01(i) - 0.5) * Math.sqrt(24 / 81);
      expect(Math.abs(value - exact)).toBeLessThanOrEqual(Math.abs(exact) * 2 ** -11 + 1e-7);
    }
  });

  it('reads what a writer of the format wrote, in both precisions, from any place in a buffer', () => {
    const values = [0, -0, 1, -2.5, 65504, 2 ** -24, 2 ** -14, 0.333251953125, Infinity];
    const bytes = writeTza([
      { name: 'a', shape: [9], type: 'h', data: values },
      { name: 'longer name', shape: [1, 2, 1, 1], type: 'f', data: [Math.fround(0.1), 1e30] },
    ]);
    const shifted = new Uint8Array(bytes.length + 3);
    shifted.set(bytes, 3);
    for (const given of [bytes, bytes.buffer, shifted.subarray(3)]) {
      const tensors = parseTza(given);
      expect([...tensors.get('a')!.data]).toEqual(values);
      expect([...tensors.get('longer name')!.data]).toEqual([Math.fround(0.1), Math.fround(1e30)]);
      expect(tensors.get('longer name')!.shape).toEqual([1, 2, 1, 1]);
    }
  });

  it('refuses every truncation', () => {
    for (let length = 0; length < tiny.length; length += length < 64 || length > 23_000 ? 1 : 997)
      expect(codeOf(tiny.subarray(0, length)), `${length} bytes`).toBe('denoise/weights');
  });

  it('refuses other files, unknown layouts, sizes without end and names that come twice', () => {
    expect(codeOf(new ArrayBuffer(0))).toBe('denoise/weights');
    expect(codeOf(new TextEncoder().encode('<!doctype html><title>404</title>'))).toBe('denoise/weights');
    const one = { name: 'a', shape: [2], type: 'h' as const, data: [1, 2] };
    expect(codeOf(writeTza([one]))).toBeUndefined();
    expect(codeOf(writeTza([one, one]))).toBe('denoise/weights');
    expect(codeOf(writeTza([{ ...one, layout: 'y' }]))).toBe('denoise/weights');
    expect(codeOf(writeTza([{ ...one, shape: [0] }]))).toBe('denoise/weights');
    const huge = { ...one, shape: [0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff] };
    expect(codeOf(writeTza([huge]))).toBe('denoise/weights');
  });

  it('throws nothing but DenoiseError for spoiled bytes', () => {
    const seed = Math.floor(Math.random() * 2 ** 32);
    for (let run = 0; run < 600; run++) {
      const bytes = tiny.slice();
      for (let k = 0; k < 3; k++) {
        const at = Math.floor(hash01(seed + run * 8 + k) * (run % 2 ? 12 : 1100));
        bytes[at < 12 ? at : bytes.length - (at - 11)] = Math.floor(hash01(seed + run * 8 + 4 + k) * 256);
      }
      expect(['denoise/weights', undefined], `seed ${seed}, run ${run}`).toContain(codeOf(bytes));
    }
  });
});
