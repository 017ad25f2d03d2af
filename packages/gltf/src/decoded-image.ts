import { type CompressedFormat, type CompressedImage } from '@glanz/scene';

/** Decoded pixels: RGBA, 8 bits a channel, straight alpha, top row first; values as stored in the file. */
export interface DecodedImage {
  readonly width: number;
  readonly height: number;
  readonly data: Uint8Array<ArrayBuffer> | Uint8ClampedArray<ArrayBuffer>;
  /**
   * The same image as the browser's bitmap (straight alpha, no colour conversion), if there is one. See `Image.bitmap`
   * of `@glanz/scene`.
   */
  readonly bitmap?: ImageBitmap;
  /** The same image in a compressed texture format. See `Image.compressed` of `@glanz/scene`. */
  readonly compressed?: CompressedImage;
}

/** Turns the bytes of a PNG, JPEG or WebP file into pixels. */
export type ImageDecoder = (bytes: Uint8Array<ArrayBuffer>, mimeType: string) => Promise<DecodedImage>;

/**
 * Turns the bytes of a KTX2 file into pixels, or into a compressed texture in one of `formats` (those that the GPU
 * supports, best first), whose pixels are decoded on first access.
 */
export type Ktx2Decoder = (
  bytes: Uint8Array<ArrayBuffer>,
  formats?: readonly CompressedFormat[],
) => Promise<DecodedImage>;

/** Formats that the GPU supports, or a function that returns them; it is called for the first KTX2 image. */
export type CompressedFormats = readonly CompressedFormat[] | (() => Promise<readonly CompressedFormat[]>);
