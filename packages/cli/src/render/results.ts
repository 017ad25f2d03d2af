import type { RenderStatistics } from '../backend';
import type { Interrupt } from '../io';
import type { WrittenFile } from '../output/write';
import { version } from '../version';
import type { Shot } from './shots';

/** Milliseconds per stage. */
export interface RenderTimings {
  /** Time to load the model, without the time in which it waits for the texture formats of the GPU. */
  loadMs: number;
  /** The environment, made or read. */
  environmentMs: number;
  deviceMs: number;
  /** All of the preparation; its parts are in the statistics. */
  prepareMs: number;
  renderMs: number;
  readMs: number;
  /** 0 without `--denoise`. */
  denoiseMs: number;
  writeMs: number;
  totalMs: number;
}

/** An image that has been written. */
export interface RenderedShot {
  readonly files: readonly WrittenFile[];
  /** Paths per pixel in the image. */
  readonly samples: number;
  /** Samples that a checkpoint brought along. */
  readonly resumedSamples: number;
  /** How often the GPU was lost, and its work continued on a new device; the pixels do not depend on that. */
  readonly gpuLosses: number;
  /** Relative error of the image when it was last measured; only with `--noise`. */
  readonly noise?: number;
  /** How the image was denoised; absent: not at all. */
  readonly denoised?: string;
  readonly samplesPerSecond: number;
  readonly camera: string;
  readonly environment: string;
  readonly adapter: { readonly name: string; readonly software: boolean };
  readonly timings: RenderTimings;
  readonly statistics: RenderStatistics;
  readonly warnings: readonly string[];
}

/** What `--json` prints for one image. */
export interface RenderResult extends RenderedShot {
  readonly ok: true;
  readonly version: string;
  readonly model: string;
  readonly width: number;
  readonly height: number;
  readonly targetSamples: number;
  /** The signal that ended it early, if one did. */
  readonly interrupted: Interrupt | null;
  readonly depth: number;
  readonly seed: number;
  readonly variant?: string;
  readonly view?: string;
}

/** An image that could not be made. */
export interface FailedImage {
  readonly ok: false;
  readonly model: string;
  readonly files: readonly string[];
  readonly variant?: string;
  readonly view?: string;
  readonly error: { readonly code: string; readonly message: string };
}

/** A GPU that was lost and not recovered, or never found. */
export interface LostGpu {
  readonly gpu: string;
  readonly error: { readonly code: string; readonly message: string };
}

/** What `--json` prints for several images. */
export interface BatchResult {
  /** Whether every image was written. */
  readonly ok: boolean;
  readonly version: string;
  /** Those of this run, in the order they were finished. */
  readonly images: readonly (RenderResult | FailedImage)[];
  readonly total: number;
  /** Finished by an earlier run, with `--resume`. */
  readonly skipped: number;
  readonly failed: number;
  /** GPUs that were lost and not recovered; the others, if any, have taken over their images. */
  readonly gpusLost: readonly LostGpu[];
  readonly interrupted: Interrupt | null;
  readonly totalMs: number;
}

/** What distinguishes an image from others of its model. */
export const namesOf = ({ variant, view }: Shot) => ({
  ...(variant === undefined ? {} : { variant }),
  ...(view.kind === 'camera' && view.camera === undefined ? {} : { view: view.name }),
});

/** The result of an image that has been written. */
export const resultOf = (shot: Shot, made: RenderedShot, interrupted: Interrupt | null): RenderResult => {
  const { options } = shot;
  const {
    files,
    samples,
    resumedSamples,
    gpuLosses,
    noise,
    denoised,
    samplesPerSecond,
    camera,
    environment,
    adapter,
    timings,
    statistics,
    warnings,
  } = made;
  return {
    ok: true,
    version: version(),
    model: options.model,
    files,
    width: options.width,
    height: options.height,
    samples,
    targetSamples: options.settings.samples,
    resumedSamples,
    gpuLosses,
    ...(noise === undefined ? {} : { noise }),
    ...(denoised === undefined ? {} : { denoised }),
    samplesPerSecond,
    interrupted,
    depth: options.settings.maxDepth,
    seed: options.settings.seed,
    ...namesOf(shot),
    camera,
    environment,
    adapter,
    timings,
    statistics,
    warnings,
  };
};
