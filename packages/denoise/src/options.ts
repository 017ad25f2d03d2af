import type { KernelFamily } from './kernels/shapes';

/**
 * What the image that a network cleans holds.
 *
 * - `hdr`: linear radiance, 0 to any value (networks `rt_hdr…`)
 * - `ldr`: linear, 0 to 1 (`rt_ldr…`)
 * - `srgb`: the same, encoded as sRGB; the result is encoded too (`rt_ldr…`)
 * - `albedo`: reflectances, linear, 0 to 1 (`rt_alb`)
 * - `normal`: unit vectors or means of such, −1 to 1 (`rt_nrm`)
 */
export type DenoiserInput = 'hdr' | 'ldr' | 'srgb' | 'albedo' | 'normal';

/** How values are stored between layers. Sums are computed in single precision either way. */
export type DenoiserStorage = 'f16' | 'f32';

/** Options for {@link Denoiser.create}. */
export interface DenoiserOptions {
  /** What is denoised. Default `hdr`. */
  readonly input?: DenoiserInput;
  /**
   * Weights of networks that remove the noise of guides before they guide (`rt_alb`, `rt_nrm`), for guides of few
   * samples and for final images. The weights of the denoiser itself are then those for clean guides
   * (`rt_hdr_calb_cnrm`). Guides that are not named are taken as they are. Default: none.
   */
  readonly prefilter?: {
    readonly albedo?: Uint8Array | ArrayBuffer;
    readonly normal?: Uint8Array | ArrayBuffer;
  };
  /**
   * Precision between layers. `f16`, the default, takes half of the memory and changes an image by 0.06 % on average;
   * no feature of the device is needed.
   */
  readonly storage?: DenoiserStorage;
  /**
   * Bytes of memory for values between layers, on the GPU or in WebAssembly. Images that need more are computed in
   * tiles, with the same result bit for bit; tiles of 512 pixels take 2.6 times the work. Default 1 GiB; at least what
   * a tile of 256 × 256 pixels needs.
   */
  readonly maxMemory?: number;
  /**
   * Whether layers are computed by subgroup matrices where the device has the features `shader-f16` and
   * `chromium-experimental-subgroup-matrix`, subgroups of one size, and matrices of halves with sums in single
   * precision. An image changes by 0.06 % on average, and takes a third of the time (on an H200). No effect with
   * storage `f32`, and on other devices. Default true.
   */
  readonly subgroupMatrices?: boolean;
  /**
   * Whether the CPU computes the layers, in WebAssembly, on the calling thread in slices of about 6 ms; the GPU still
   * encodes and decodes. Values between layers are in single precision, whatever `storage` says; last bits may differ
   * between processors, which round a product and a sum once or twice (relaxed SIMD). Default: on adapters
   * that are software (SwiftShader, lavapipe, WARP); on SwiftShader it takes a tenth of the time or less. A page with a
   * content security policy allows it with `'wasm-unsafe-eval'` in `script-src`. Where it is forbidden, the browser has
   * no SIMD, or no memory for the smallest tile, shaders compute as elsewhere, and {@link DenoiseResult.kernels} says
   * so.
   */
  readonly webAssembly?: boolean;
  /** Milliseconds that one submission should take at most, so that a page stays responsive. Default 8. */
  readonly maxSubmitMs?: number;
  /** Ends the creation with the signal's reason. */
  readonly signal?: AbortSignal;
  /**
   * How the threads of a layer of `width` × `height` pixels share its work, see `tuneShapes` of `@glanz/denoise/tune`;
   * `undefined`, or what does not fit into workgroup memory, for the usual choice. Results do not depend on it: each
   * sum is computed in the same order. A layer with a shape is not computed by subgroup matrices.
   */
  readonly shapeOf?: (layer: LayerSize, width: number, height: number) => KernelFamily | undefined;
}

/** Options for {@link Denoiser.prepare}. */
export interface DenoiserPrepareOptions {
  /**
   * Whether {@link Denoiser.encode} is to be called, which shaders always compute. Where {@link Denoiser.denoise} uses
   * shaders too, they are made in any case. Default false.
   */
  readonly encode?: boolean;
}

/** What a kernel's shape is chosen by. */
export interface LayerSize {
  /** Name in the archive, e.g. `dec_conv1a`. */
  readonly name: string;
  /** Channels that it computes. */
  readonly channels: number;
  /** Channels of the upsampled source, 0 without one. */
  readonly upChannels: number;
  /** Channels of the source that is read as it is. */
  readonly directChannels: number;
}

/** What computes the layers of a network: the GPU by `shaders`, or the CPU in `webAssembly`. */
export type DenoiseKernels = 'shaders' | 'webAssembly';

/** What {@link Denoiser.denoise} did. */
export interface DenoiseResult {
  /** Tiles that the image was cut into: 1 where there is memory for the whole. */
  readonly tiles: number;
  /** Submissions to the GPU. */
  readonly submissions: number;
  /** What computed the layers, see {@link DenoiserOptions.webAssembly}. */
  readonly kernels: DenoiseKernels;
}

/**
 * An image in a GPU buffer: 32-bit floats, row by row, the top row first. A `GPUBuffer` has four floats per pixel
 * (RGBA), without padding, from byte 0.
 */
export interface ImageBuffer {
  /** Usage `STORAGE`. */
  readonly buffer: GPUBuffer;
  /** Bytes before the first pixel, a multiple of 4. Default 0. */
  readonly offset?: number;
  /** Floats from a pixel to the next, 3 or more. Default 4. */
  readonly pixelStride?: number;
  /** Floats from a row to the next. Default `width × pixelStride`. */
  readonly rowStride?: number;
}

/** What {@link Denoiser.denoise} works on. */
export interface DenoiseImages {
  /** Pixels, 1 to 16384. */
  readonly width: number;
  /** Pixels, 1 to 16384. */
  readonly height: number;
  /**
   * The image to denoise, for `hdr`, `ldr` and `srgb`. NaN counts as 0, negative values as 0. Infinity counts as the
   * largest float, which spreads: replace it before.
   */
  readonly color?: GPUBuffer | ImageBuffer;
  /** Guide: reflectances, linear, 0 to 1. The image to denoise, for `albedo`. */
  readonly albedo?: GPUBuffer | ImageBuffer;
  /** Guide: normals, −1 to 1, 0 where there is no surface. The image to denoise, for `normal`. */
  readonly normal?: GPUBuffer | ImageBuffer;
  /**
   * Buffer of the result, different from those above. With a `pixelStride` of 4 or more, the fourth float is copied
   * from the image where that has one, and 1 otherwise; what lies beyond stays as it is.
   */
  readonly output: GPUBuffer | ImageBuffer;
  /**
   * For `hdr`: the factor that scales the image to a mean of about 0.18. Default: computed on the GPU from the image.
   * Give a constant where images of a sequence should not flicker. The result is at the brightness of the input.
   */
  readonly scale?: number;
}

/** Options for {@link Denoiser.denoise}. */
export interface DenoiseOptions {
  /**
   * Ends the work between two submissions, or slices of a layer in WebAssembly; the promise rejects with the signal's
   * reason, and the output is undefined.
   */
  readonly signal?: AbortSignal;
  /** Called after each submission or slice with the part of the work that is done, 0 to 1. */
  readonly onProgress?: (done: number) => void;
}
