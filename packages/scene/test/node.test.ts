import { GlanzError } from '@glanz/wgsl/error';
import sharp from 'sharp';
import { expect, it, vi } from 'vitest';
import { decodeImageFile } from '../src/node';

const missing = (message: string, options: object) => new GlanzError('test/no-sharp', message, options);

it('decodes to RGBA with straight alpha, the codes as they are in the file', async () => {
  const pixels = Uint8Array.from([200, 40, 90, 255, 10, 20, 30, 0]);
  const png = await sharp(pixels, { raw: { width: 2, height: 1, channels: 4 } })
    .png()
    .toBuffer();
  const image = await decodeImageFile(new Uint8Array(png), missing);
  expect([image.width, image.height, Array.from(image.data)]).toEqual([2, 1, Array.from(pixels)]);
});

it('expands grey to RGBA, and ignores an orientation in the file', async () => {
  const jpeg = await sharp(new Uint8Array(32 * 16).fill(128), { raw: { width: 32, height: 16, channels: 1 } })
    .jpeg({ quality: 100 })
    .withMetadata({ orientation: 6 })
    .toBuffer();
  const image = await decodeImageFile(new Uint8Array(jpeg), missing);
  expect([image.width, image.height, Array.from(image.data.subarray(0, 4))]).toEqual([32, 16, [128, 128, 128, 255]]);
});

it('throws the error of the caller without sharp', async () => {
  vi.resetModules();
  vi.doMock('sharp', () => {
    throw new Error('Cannot find package');
  });
  const { decodeImageFile: decode } = await import('../src/node');
  const error: unknown = await decode(new Uint8Array(8), missing).catch((e: unknown) => e);
  vi.doUnmock('sharp');
  expect(error).toMatchObject({ code: 'test/no-sharp', message: expect.stringMatching(/npm install sharp/) });
});
