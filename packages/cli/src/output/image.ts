/** A finished rendering, as the writers take it. All planes are row-major, top row first. */
export interface RenderedImage {
  readonly width: number;
  readonly height: number;
  /** Linear RGBA, stride 4, multiplied by alpha. */
  readonly beauty: Float32Array;
  /** Read on demand: only EXR wants these. An image of merged films has only some of them. */
  readonly layers?: Partial<ImageLayers>;
  /** The beauty denoised, linear RGBA, and how; what .png and .hdr show, and a layer of .exr. */
  readonly denoised?: { readonly data: Float32Array; readonly quality: string };
  readonly samples: number;
  readonly software: string;
}

/** Features of the first surface under each pixel. */
export interface ImageLayers {
  /** RGBA, stride 4. */
  readonly albedo: Float32Array;
  /** xyz0, stride 4. */
  readonly normal: Float32Array;
  /** Mean position in the world and coverage, stride 4, metres. */
  readonly position: Float32Array;
  /** Of the beauty's mean, RGB, and the number of samples, stride 4. */
  readonly variance: Float32Array;
  /** The part of each light group in the beauty, RGBA, stride 4; empty where there is but one. */
  readonly lights: readonly { readonly name: string; readonly data: Float32Array }[];
  /** Metres, stride 1. */
  readonly depth: Float32Array;
  /** Scene indices, 0xffffffff for none. */
  readonly objectId: Uint32Array;
  readonly materialId: Uint32Array;
}

/** What the metadata of a file say of denoising, under a name; nothing of an image that was not denoised. */
export const denoisedText = (denoised: RenderedImage['denoised'], name: string): Readonly<Record<string, string>> =>
  denoised ? { [name]: `Open Image Denoise, ${denoised.quality}` } : {};
