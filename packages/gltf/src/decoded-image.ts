import { type CompressedFormat, type CompressedImage } from '@glanz/scene';

/** Decoded pixels: RGBA, 8 bits a channel, straight alpha, top row first; colour codes as they are in the file. */
export interface DecodedImage {
  readonly width: number;
  readonly height: number;
  readonly data: Uint8Array<ArrayBuffer> | Uint8ClampedArray<ArrayBuffer>;
  /**
   * The same as a bitmap, straight alpha, no colour conversion, where the browser has one. See `Image.bitmap` of
   * `@glanz/scene`.
   */
  readonly bitmap?: ImageBitmap;
  /** The same in blocks, as GPUs read it. See `Image.compressed` of `@glanz/scene`. */
  readonly compressed?: CompressedImage;
}

/** Turns the bytes of a PNG, JPEG or WebP file into pixels. */
export type ImageDecoder = (bytes: Uint8Array<ArrayBuffer>, mimeType: string) => Promise<DecodedImage>;

/**
 * Turns the bytes of a KTX2 file into pixels, or into blocks in one of `formats` (what the GPU reads, the best first)
 * with the pixels to be had when they are asked for.
 */
export type Ktx2Decoder = (
  bytes: Uint8Array<ArrayBuffer>,
  formats?: readonly CompressedFormat[],
) => Promise<DecodedImage>;

/** Formats that the GPU reads; or what tells them, asked at the first picture that could have one. */
export type CompressedFormats = readonly CompressedFormat[] | (() => Promise<readonly CompressedFormat[]>);
