import { constants, deflateRaw, inflateSync } from 'node:zlib';
import sharp from 'sharp';
import { describe, expect, it } from 'vitest';
import { encodePng, encodePngAsync, ImageError } from '../src/index';
import { randomNumbers } from './shared';

/** An image with flat parts, gradients and noise, so that every filter is used. */
function image<T extends Uint8Array | Uint16Array>(data: T, width: number, top: number, opaque: boolean): T {
  const random = randomNumbers(3);
  for (let i = 0; i < data.length; i += 4) {
    const x = (i / 4) % width;
    const y = Math.floor(i / 4 / width);
    data[i] = (x / width) * top;
    data[i + 1] = y % 7 < 3 ? random() * top : ((y * 11) % 256) * (top / 255);
    data[i + 2] = ((x * y) % 97) * (top / 97);
    data[i + 3] = opaque ? top : random() * top;
  }
  return data;
}

describe('encodePng', () => {
  it.each([
    [1, 1],
    [7, 5],
    [64, 33],
  ])('8 bits, %i×%i: sharp reads the same pixels', async (width, height) => {
    const data = image(new Uint8Array(width * height * 4), width, 255, false);
    const read = await sharp(encodePng({ width, height, data })).raw().toBuffer({ resolveWithObject: true });
    expect(read.info).toMatchObject({ width, height, channels: 4 });
    expect(Buffer.compare(read.data, Buffer.from(data))).toBe(0);
  });

  it('an opaque image loses its alpha channel and nothing else', async () => {
    const data = image(new Uint8Array(20 * 10 * 4), 20, 255, true);
    const png = encodePng({ width: 20, height: 10, data });
    expect((await sharp(png).metadata()).channels).toBe(3);
    const read = await sharp(png).ensureAlpha().raw().toBuffer();
    expect(Buffer.compare(read, Buffer.from(data))).toBe(0);
  });

  it.each([true, false])('16 bits, opaque %s: sharp reads the same pixels', async (opaque) => {
    const [width, height] = [31, 17];
    const data = image(new Uint16Array(width * height * 4), width, 65535, opaque);
    const png = encodePng({ width, height, data });
    const meta = await sharp(png).metadata();
    expect([meta.depth, meta.channels]).toEqual(['ushort', opaque ? 3 : 4]);
    const read = await sharp(png).ensureAlpha().toColourspace('rgb16').raw({ depth: 'ushort' }).toBuffer();
    const codes = new Uint16Array(read.buffer, read.byteOffset, read.length / 2);
    expect([...codes]).toEqual([...data]);
  });

  it('has the chunks of the specification in order, an sRGB chunk among them, and text', () => {
    const png = encodePng({ width: 2, height: 1, data: new Uint8ClampedArray(8), text: { Software: 'glanz' } });
    const view = new DataView(png.buffer);
    const types: string[] = [];
    for (let at = 8; at < png.length; at += 12 + view.getUint32(at))
      types.push(String.fromCharCode(...png.subarray(at + 4, at + 8)));
    expect(types).toEqual(['IHDR', 'sRGB', 'gAMA', 'tEXt', 'IDAT', 'IEND']);
    expect([...png.subarray(0, 8)]).toEqual([137, 80, 78, 71, 13, 10, 26, 10]);
    // The checksum of an empty IEND chunk is the same in every PNG there is.
    expect(view.getUint32(png.length - 4)).toBe(0xae426082);
  });

  it('refuses an array of the wrong length and an empty image', () => {
    expect(() => encodePng({ width: 2, height: 2, data: new Uint8Array(12) })).toThrow(ImageError);
    expect(() => encodePng({ width: 0, height: 2, data: new Uint8Array(0) })).toThrow(/0×2/);
  });
});

describe('encodePngAsync', () => {
  const deflate = (bytes: Uint8Array) =>
    new Promise<Uint8Array>((done, fail) =>
      deflateRaw(bytes, { finishFlush: constants.Z_SYNC_FLUSH }, (error, out) => (error ? fail(error) : done(out))),
    );

  it.each([
    ['one band', 64, 33],
    ['several, the last one of fewer rows', 2000, 1777],
  ])('%s: sharp reads the same pixels', async (_, width, height) => {
    const data = image(new Uint8Array(width * height * 4), width, 255, false);
    const read = await sharp(await encodePngAsync({ width, height, data }, deflate))
      .raw()
      .toBuffer();
    expect(Buffer.compare(read, Buffer.from(data))).toBe(0);
  });

  it('16 bits, opaque: the chunks join to the stream of zlib with its checksum', async () => {
    const [width, height] = [1500, 1300];
    const data = image(new Uint16Array(width * height * 4), width, 65535, true);
    const png = Buffer.from(await encodePngAsync({ width, height, data, text: { Software: 'glanz' } }, deflate));
    const parts: Buffer[] = [];
    for (let at = 8; at < png.length; at += 12 + png.readUInt32BE(at))
      if (png.toString('latin1', at + 4, at + 8) === 'IDAT')
        parts.push(png.subarray(at + 8, at + 8 + png.readUInt32BE(at)));
    expect(parts.length).toBeGreaterThan(4);
    // Node's zlib checks the checksum, which libpng may ignore.
    expect(inflateSync(Buffer.concat(parts)).length).toBe(height * (1 + width * 6));
    const codes = await sharp(png).ensureAlpha().toColourspace('rgb16').raw({ depth: 'ushort' }).toBuffer();
    expect(Buffer.compare(codes, Buffer.from(data.buffer))).toBe(0);
  });

  it('fails as the compression does', async () => {
    const source = { width: 2, height: 2, data: new Uint8Array(16) };
    await expect(encodePngAsync(source, () => Promise.reject(new Error('no memory')))).rejects.toThrow('no memory');
    await expect(encodePngAsync({ ...source, height: 3 }, deflate)).rejects.toThrow(ImageError);
  });
});
