/** Decoded pixels, row-major, top row first, no padding. */
export interface Image {
  name: string;
  width: number;
  height: number;
  /** RGBA interleaved, stride 4: 8-bit codes (0..255), or linear floats for HDR images. Straight alpha. */
  data: Uint8Array<ArrayBuffer> | Uint8ClampedArray<ArrayBuffer> | Float32Array<ArrayBuffer>;
  /**
   * The same pixels as the browser holds them, for upload to the GPU without a copy in JavaScript; of the size above,
   * straight alpha, no colour conversion. Where a loader gives one, `data` is read back from it on first access (tens of
   * milliseconds for 4 megapixels), so do not read `data` just to show the image. Do not close the bitmap.
   */
  bitmap?: ImageBitmap;
  /**
   * The same pixels in a block-compressed format that GPUs sample directly, a quarter of the memory. A renderer uses it
   * where its device supports the format, and `data` elsewhere; where a loader gives one, `data` is decompressed on
   * first access.
   */
  compressed?: CompressedImage;
}

/**
 * Blocks of 4 × 4 texels in 16 bytes, RGBA; names are WebGPU's. The {@link Texture} decides whether RGB is sRGB.
 */
export type CompressedFormat = 'bc7-rgba-unorm' | 'astc-4x4-unorm' | 'etc2-rgba8unorm';

/** The pixels of an {@link Image} in a block-compressed format. */
export interface CompressedImage {
  readonly format: CompressedFormat;
  /**
   * The blocks of each mip level, row-major, full size first: level `i` is max(1, width >> i) × max(1, height
   * >> i) texels and has ceil(w / 4) × ceil(h / 4) blocks of 16 bytes. At least one level; the chain need not end
   * at one texel.
   */
  readonly levels: readonly Uint8Array<ArrayBuffer>[];
}

/** Bytes of a level of width × height texels in any {@link CompressedFormat}. */
export const compressedBytes = (width: number, height: number): number =>
  16 * Math.ceil(width / 4) * Math.ceil(height / 4);

/** What a texture shows outside 0..1: the image repeated, its mirror image, or its edge texels. */
export type WrapMode = 'repeat' | 'mirror' | 'clamp';

/** An {@link Image} and how to sample it. */
export interface Texture {
  name?: string;
  /** Index into `Scene.images`. */
  image: number;
  /** `srgb`: RGB codes are decoded from sRGB to linear (alpha never is). `linear`: used as they are. */
  color_space: 'srgb' | 'linear';
  /** Default `repeat`. */
  wrap_u?: WrapMode;
  /** Default `repeat`. */
  wrap_v?: WrapMode;
  /** Default `linear`: trilinear with mips. `nearest`: no filter. */
  filter?: 'linear' | 'nearest';
}
