/** Options for {@link TemporalFilter.create}. */
export interface TemporalFilterOptions {
  /**
   * Samples per pixel that the history counts for at most: more is smoother, and slower to follow what the motion does
   * not tell, such as reflections and light that changes. 1 or more. Default 8.
   */
  readonly maxHistory?: number;
  /**
   * Standard deviations of a pixel's neighbours that the history may be off their mean: less follows changes sooner,
   * and keeps less. Above 0; `Infinity` keeps all, and does not
   * follow light that changes. Default 3.
   */
  readonly clampSigmas?: number;
  /** Whether edges and fine textures are smoothed over frames, too. Default true. */
  readonly antialias?: boolean;
  /** Passes of the spatial filter, 0 to 5; the last one reaches over 2^(passes + 1) pixels. Default 3. */
  readonly passes?: number;
  /**
   * Number of samples from which the image equals the film, bit for bit; between 4 samples and this number the image
   * fades to the film. 5 or more. Default 64.
   */
  readonly settledSamples?: number;
  /** Ends the creation with the signal's reason. */
  readonly signal?: AbortSignal | undefined;
}

/**
 * Relation of a frame to the one before.
 *
 * - `continues`: the same film, which may have more samples.
 * - `moves`: a new film of the same scene; the camera or instances have moved, as `motion` tells.
 * - `cuts`: a new film that is unrelated to the one before.
 */
export type FrameStep = 'continues' | 'moves' | 'cuts';

/**
 * A noisy film and what its pixels show, in GPU buffers with the usage `STORAGE`, as a `PathTracer` of `@glanz/renderer`
 * has them: without gaps, the top row first.
 */
export interface TemporalFrame {
  /** Pixels, 1 to 16384. */
  readonly width: number;
  /** Pixels, 1 to 16384. */
  readonly height: number;
  /** Linear radiance and alpha, four floats a pixel: the mean of the samples. It is only read. */
  readonly color: GPUBuffer;
  /** Samples per pixel that `color` is the mean of, 1 or more. */
  readonly samples: number;
  /** Reflectances 0 to 1 and coverage, four floats a pixel. */
  readonly albedo: GPUBuffer;
  /** Normals, and metres to the first surface, 0 where none is; four floats a pixel. */
  readonly normal: GPUBuffer;
  /** Positions of the first surface, and metres along the path to what is seen; four floats a pixel. */
  readonly position: GPUBuffer;
  /**
   * Number of the instance, two words that are not read, and the roughness 0 to 1, as a float, of what is seen, such as in
   * a mirror; four words a pixel.
   */
  readonly ids: GPUBuffer;
  /** Pixels from where the surface is to where it was in the frame before, x to the right, y down; two floats a pixel. */
  readonly motion: GPUBuffer;
  readonly step: FrameStep;
  /**
   * Where the frame is seen from, and where the one before was, in the space of `position`. What narrow lobes reflect
   * changes with the view: the more it turns, and the smoother a surface is, the shorter is its history, and the nearer
   * are the neighbours that it is filtered with. Default: both at the origin.
   */
  readonly eyes?: readonly [now: Point, before: Point] | undefined;
  /**
   * From the space of `position` to clip space, of the frame and of the one before: column-major 4 × 4, such as the
   * projection matrix times the view matrix; depths are not read. With them, and with `eyes`, the history of what is
   * seen in flat mirrors or straight through glass is found; without, it counts for 4 samples at most.
   */
  readonly projections?: readonly [now: ArrayLike<number>, before: ArrayLike<number>] | undefined;
  /** With `moves`: whether instances have moved, not the camera alone. Default false. */
  readonly instancesMoved?: boolean | undefined;
}

/** X, Y and Z. */
export type Point = readonly [x: number, y: number, z: number];

/** What {@link TemporalFilter.filter} has made. */
export interface FilteredImage {
  /**
   * Linear radiance and the film's alpha, four floats a pixel; usages `STORAGE` and `COPY_SRC`. It belongs to the filter,
   * which writes one of the next two images into it, and frees it where those have another size.
   */
  readonly buffer: GPUBuffer;
  readonly width: number;
  readonly height: number;
}

/** The part of a `PathTracer` of `@glanz/renderer` that {@link TemporalFilter.filterTracer} needs. */
export interface FilterableTracer {
  readonly width: number;
  readonly height: number;
  readonly samples: number;
  readonly camera: FilterableCamera;
  readonly history: { readonly camera: FilterableCamera } | undefined;
  readonly beautyBuffer: GPUBuffer;
  readonly aovs: readonly string[];
  aov(name: TemporalAov): { readonly buffer: GPUBuffer };
}

/** The part of a camera of `@glanz/scene` that {@link TemporalFilter.filterTracer} needs. */
export interface FilterableCamera {
  readonly type: string;
  /** Column-major 4 × 4; it looks along −Z. */
  readonly transform: ArrayLike<number>;
  /** Vertical field of view of a perspective camera, radians. */
  readonly yfov?: number;
}

/** First-hit AOVs that the filter reads. */
export const TEMPORAL_AOVS = [
  'albedo',
  'normal',
  'depth',
  'position',
  'virtualDepth',
  'objectId',
  'roughness',
  'motion',
] as const;

/** See {@link TEMPORAL_AOVS}. */
export type TemporalAov = (typeof TEMPORAL_AOVS)[number];
