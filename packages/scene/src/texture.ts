/** Decoded pixels, row-major, top row first, no padding. */
export interface Image {
  name: string;
  width: number;
  height: number;
  /** RGBA interleaved, stride 4: 8-bit codes (0..255), or linear floats for HDR pictures. Straight alpha. */
  data: Uint8Array<ArrayBuffer> | Uint8ClampedArray<ArrayBuffer> | Float32Array<ArrayBuffer>;
  /**
   * The same pixels as the browser holds them, which go to the GPU without a way through JavaScript; of the size above,
   * straight alpha, no colour conversion. Where a loader gives one, `data` is read back from it when it is first asked
   * for (tens of milliseconds for 4 megapixels), so whoever has only the picture to show does not ask. Keep it open.
   */
  bitmap?: ImageBitmap;
  /**
   * The same pixels in a form that GPUs read without unpacking it, a quarter of the memory. A renderer takes it where
   * its device reads that format, and `data` elsewhere; where a loader gives one, `data` is unpacked when it is first
   * asked for.
   */
  compressed?: CompressedImage;
}

/**
 * Blocks of 4 × 4 texels in 16 bytes, RGBA; names are WebGPU's. Whether RGB is sRGB is a matter of the {@link Texture}.
 */
export type CompressedFormat = 'bc7-rgba-unorm' | 'astc-4x4-unorm' | 'etc2-rgba8unorm';

/** An {@link Image} in blocks. */
export interface CompressedImage {
  readonly format: CompressedFormat;
  /**
   * The blocks of each mip level, row-major, from the whole picture on: level `i` is max(1, width >> i) × max(1, height
   * >> i) texels and has ceil(w / 4) × ceil(h / 4) blocks of 16 bytes. At least one level; it need not go down to one
   * texel.
   */
  readonly levels: readonly Uint8Array<ArrayBuffer>[];
}

/** Bytes of a level of width × height texels in any {@link CompressedFormat}. */
export const compressedBytes = (width: number, height: number): number =>
  16 * Math.ceil(width / 4) * Math.ceil(height / 4);

/** What lies outside 0..1 of a picture: it again, its mirror image, or its edge texels. */
export type WrapMode = 'repeat' | 'mirror' | 'clamp';

/** An {@link Image} with the way to read it. */
export interface Texture {
  name?: string;
  /** Index into `Scene.images`. */
  image: number;
  /** `srgb`: RGB codes go through the sRGB curve to linear (alpha never does). `linear`: as they are. */
  color_space: 'srgb' | 'linear';
  /** Default `repeat`. */
  wrap_u?: WrapMode;
  /** Default `repeat`. */
  wrap_v?: WrapMode;
  /** Default `linear`: trilinear with mips. `nearest`: no filter. */
  filter?: 'linear' | 'nearest';
}
