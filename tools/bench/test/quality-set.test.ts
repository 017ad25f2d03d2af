import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { expect, it, onTestFinished } from 'vitest';
import { channelsOf, flipOf, readNpy, relativeError } from '../src/denoise/quality-set';

function npy(type: string, shape: string, body: Uint8Array): string {
  const folder = mkdtempSync(join(tmpdir(), 'glanz-npy-'));
  onTestFinished(() => rmSync(folder, { recursive: true, force: true }));
  const header = `{'descr': '${type}', 'fortran_order': False, 'shape': ${shape}, }\n`;
  const length = new Uint8Array(Uint16Array.of(header.length).buffer);
  const file = join(folder, 'a.npy');
  writeFileSync(file, Buffer.concat([Buffer.from('\x93NUMPY\x01\x00', 'latin1'), length, Buffer.from(header), body]));
  return file;
}

it('reads halves and single floats', async () => {
  const halves = Uint16Array.of(0x3c00, 0xc000, 0x3555, 0x0001, 0x7bff, 0x0000);
  const image = await readNpy(npy('<f2', '(1, 2, 3)', new Uint8Array(halves.buffer)));
  expect(image).toMatchObject({ height: 1, width: 2, channels: 3 });
  expect([...image.data]).toEqual([1, -2, 0.333251953125, 2 ** -24, 65504, 0]);
  expect([...channelsOf(image, 1, 2)]).toEqual([-2, 0.333251953125, 65504, 0]);
  const floats = new Uint8Array(Float32Array.of(0.1, 2, 3).buffer);
  expect([...(await readNpy(npy('<f4', '(1, 1, 3)', floats))).data]).toEqual([Math.fround(0.1), 2, 3]);
  await expect(readNpy(npy('<i4', '(1, 1, 3)', floats))).rejects.toMatchObject({ code: 'bench/missing-data' });
});

it('measures as the reference set does', () => {
  const reference = Float32Array.of(1, 1, 1, 0, 0, 0);
  // The mean square of the reference is 0.5; the second pixel has none of its own.
  const expected = (0.25 / 1.005 + 0.01 / 0.005) / 2;
  expect(relativeError(Float32Array.of(1.5, 0.5, 1.5, 0.1, 0.1, 0.1), reference)).toBeCloseTo(expected, 6);
  expect(flipOf(reference, reference, 2, 1)).toBe(0);
  expect(flipOf(Float32Array.of(0, 0, 0, 1, 1, 1), reference, 2, 1)).toBeGreaterThan(0.5);
});
