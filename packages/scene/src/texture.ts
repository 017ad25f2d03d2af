/** Decoded pixels, row-major, top row first, no padding. */
export interface Image {
  name: string;
  width: number;
  height: number;
  /** RGBA interleaved, stride 4: 8-bit codes (0..255), or linear floats for HDR pictures. Straight alpha. */
  data: Uint8Array<ArrayBuffer> | Uint8ClampedArray<ArrayBuffer> | Float32Array<ArrayBuffer>;
  /**
   * The same pixels as the browser holds them, which go to the GPU without a way through JavaScript; of the size above, straight
   * alpha, no colour conversion. Where a loader gives one, `data` is read back from it when it is first asked for (tens of
   * milliseconds for 4 megapixels), so whoever has only the picture to show does not ask. Keep it open.
   */
  bitmap?: ImageBitmap;
}

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
