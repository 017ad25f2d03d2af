import { FormatError } from './error';
import type { ImageDecoder } from './resources';

/** Decodes images with the optional package `sharp`. */
export const decodeWithSharp: ImageDecoder = async (bytes) => {
  const { default: sharp } = await import('sharp').catch((cause: unknown) => {
    throw new FormatError(
      'formats/missing-decoder',
      'Decoding images in Node needs the package "sharp": npm install sharp.',
      { cause },
    );
  });
  const { data, info } = await sharp(bytes, { ignoreIcc: true, limitInputPixels: 16384 * 16384 })
    .toColourspace('srgb')
    .ensureAlpha()
    .raw({ depth: 'uchar' })
    .toBuffer({ resolveWithObject: true });
  return {
    width: info.width,
    height: info.height,
    data: new Uint8Array(data.buffer as ArrayBuffer, data.byteOffset, data.byteLength),
  };
};
