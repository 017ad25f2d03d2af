import type { GlanzError, GlanzErrorOptions } from '@glanz/wgsl/error';
import type { Image } from './texture';

/** The size limit of {@link decodeImageFile}, in pixels: a small file must not fill the memory. */
const MAX_PIXELS = 16384 * 16384;

/**
 * Decodes a PNG, JPEG or WebP file, or another format that the optional package `sharp` reads, in Node. A colour profile
 * and an orientation in the file are ignored, as glTF 2.0 (3.8.1) requires. An image has at most 16,384² pixels.
 *
 * @param missing Creates the error that is thrown where `sharp` is not installed, with the code of the caller's package.
 * @returns RGBA, 8 bits a channel, straight alpha, top row first; the codes that the file holds.
 * @throws {GlanzError} The error of `missing`. An error of `sharp` where the file cannot be decoded.
 * @example
 * const image = await decodeImageFile(bytes, (message, options) => new GlanzError('app/no-sharp', message, options));
 */
export async function decodeImageFile(
  bytes: Uint8Array,
  missing: (message: string, options: GlanzErrorOptions) => GlanzError,
): Promise<Pick<Image, 'width' | 'height'> & { data: Uint8Array<ArrayBuffer> }> {
  const { default: sharp } = await import('sharp').catch((cause: unknown) => {
    throw missing('Decoding images in Node needs the package "sharp": npm install sharp.', { cause });
  });
  const { data, info } = await sharp(bytes, { ignoreIcc: true, limitInputPixels: MAX_PIXELS })
    .toColourspace('srgb')
    .ensureAlpha()
    .raw({ depth: 'uchar' })
    .toBuffer({ resolveWithObject: true });
  return {
    width: info.width,
    height: info.height,
    data: new Uint8Array(data.buffer as ArrayBuffer, data.byteOffset, data.byteLength),
  };
}
