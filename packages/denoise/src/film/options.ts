import type { DenoiseKernels, DenoiseOptions, DenoiserOptions, DenoiserStorage } from '../options';

/**
 * Which networks denoise a film.
 *
 * - `fast`: the small network; 0.6 MB of weights. For previews.
 * - `balanced`: the base network, half as fast; 1.8 MB.
 * - `best`: the large network, after two others have removed the noise of albedo and normal; 23 MB. For final images.
 */
export type DenoiseQuality = 'fast' | 'balanced' | 'best';

/** Archives of weights that a quality takes: as `Bytes` loaded, as names `T = string` of Open Image Denoise's files. */
export interface FilmWeights<T = Uint8Array | ArrayBuffer> {
  /** The network for the image with albedo and normal. */
  readonly color: T;
  /** The network that removes the noise of the albedo. Default: it is taken as it is. */
  readonly albedo?: T;
  /** The network that removes the noise of the normals. Default: they are taken as they are. */
  readonly normal?: T;
}

/** Options for {@link FilmDenoiser.create}. */
export interface FilmDenoiserOptions {
  /** See `DenoiserOptions.storage`. */
  readonly storage?: DenoiserStorage;
  /** See `DenoiserOptions.maxMemory`. */
  readonly maxMemory?: number;
  /** See `DenoiserOptions.maxSubmitMs`. */
  readonly maxSubmitMs?: number;
  /** See `DenoiserOptions.subgroupMatrices`. */
  readonly subgroupMatrices?: boolean;
  /** See `DenoiserOptions.webAssembly`. */
  readonly webAssembly?: boolean;
  /** See `DenoiserOptions.shapeOf`: what `tuneShapes` of `@glanz/denoise/tune` found for this device. */
  readonly shapeOf?: NonNullable<DenoiserOptions['shapeOf']>;
  /** Ends the creation with the signal's reason. */
  readonly signal?: AbortSignal | undefined;
}

/**
 * A film in GPU buffers: four floats a pixel, without gaps, the top row first. `color` is copied before it is denoised.
 * Where WebAssembly computes, which takes seconds, the others are copied too if they have the usage `COPY_SRC`: after
 * that they may change. Buffers that are not copied stay as they are until the result is there.
 */
export interface FilmImages {
  /** Pixels, 1 to 16384. */
  readonly width: number;
  /** Pixels, 1 to 16384. */
  readonly height: number;
  /** Usages `STORAGE` and `COPY_SRC`. Linear radiance and alpha. It is only read. */
  readonly color: GPUBuffer;
  /** Usage `STORAGE`. Reflectances 0 to 1; the fourth float is not read. */
  readonly albedo: GPUBuffer;
  /** Usage `STORAGE`. Normals, 0 where there is no surface; the fourth float is not read. */
  readonly normal: GPUBuffer;
  /**
   * Usage `STORAGE`. Variance of the mean that `color` is, in the first three of four floats a pixel; numbers that are
   * not finite are unknown. With it the film is shown as it is where it has converged. Default: estimated from the image
   * alone, which takes some of the detail that a network loses for noise.
   */
  readonly variance?: GPUBuffer | undefined;
}

/** Options for {@link FilmDenoiser.denoise}. */
export interface DenoiseFilmOptions extends DenoiseOptions {
  /**
   * Whether the film is shown through where its noise is not seen, see {@link FilmDenoiser}. Default true; with `false`
   * the network's image is the result.
   */
  readonly blend?: boolean;
}

/** What {@link FilmDenoiser.denoise} has made. */
export interface DenoisedFilm {
  /**
   * Linear radiance and the film's alpha, four floats a pixel; usages `STORAGE` and `COPY_SRC`. It belongs to the
   * denoiser, which writes the next result into it, and frees it where that has another size.
   */
  readonly buffer: GPUBuffer;
  readonly width: number;
  readonly height: number;
  /** What computed the network's layers, see `DenoiseResult.kernels`. */
  readonly kernels: DenoiseKernels;
}

/** The part of a `PathTracer` of `@glanz/renderer` that {@link FilmDenoiser.denoiseTracer} needs. */
export interface DenoisableTracer {
  readonly width: number;
  readonly height: number;
  readonly samples: number;
  readonly beautyBuffer: GPUBuffer;
  readonly aovs: readonly string[];
  aov(name: 'albedo' | 'normal'): { readonly buffer: GPUBuffer };
  varianceBuffer(): Promise<GPUBuffer>;
}
