import { PathTracer, type PathTracerOptions } from '@glanz/renderer';
import type { Scene } from '@glanz/scene';
import { compareImages, type Comparison } from './compare';
import type { GroundTruth } from './reference-set';

/**
 * Renders a scene, and gives its image at each of these numbers of samples: RGB, stride 3, linear, top row first.
 *
 * @param counts Samples per pixel, ascending: all images are of one film, so that later ones contain those before.
 */
export async function renderImages(
  device: GPUDevice,
  scene: Scene,
  counts: readonly number[],
  options: PathTracerOptions,
): Promise<Float32Array[]> {
  const tracer = await PathTracer.create(device, scene, options);
  try {
    const images: Float32Array[] = [];
    for (const samples of counts) {
      for await (const progress of tracer.render({ samples })) void progress;
      const beauty = await tracer.read('beauty');
      const image = new Float32Array((beauty.length / 4) * 3);
      for (let i = 0; i < beauty.length / 4; i++) image.set(beauty.subarray(4 * i, 4 * i + 3), 3 * i);
      images.push(image);
    }
    return images;
  } finally {
    tracer.destroy();
  }
}

/** Renders a scene and gives its image: RGB, stride 3, linear, top row first. */
export async function renderImage(
  device: GPUDevice,
  scene: Scene,
  { samples, ...options }: PathTracerOptions & { readonly samples: number },
): Promise<Float32Array> {
  const [image] = await renderImages(device, scene, [samples], options);
  return image as Float32Array;
}

/** Options for {@link renderGroundTruth}. */
export interface GroundTruthOptions {
  readonly samples: number;
  /** Share of the noise of independent samples that is left, see {@link compareImages}. Default 1. */
  readonly noise?: number;
  /** Default `full`. */
  readonly variant?: string;
  readonly seed?: number;
  /** Default `blue-noise`. */
  readonly sampler?: NonNullable<PathTracerOptions['sampler']>;
  /** See `PathTracerOptions.lightPaths`. Default 0. */
  readonly lightPaths?: number;
  /** See `PathTracerOptions.guiding`. Default 0. */
  readonly guiding?: number;
  /** Edges of a path at most. Default that of the reference. */
  readonly maxDepth?: number;
}

/** How a scene of the reference set is rendered: as its reference was, with single scattering. */
export function groundTruthOptions(
  truth: GroundTruth,
  {
    variant = 'full',
    seed = 0,
    sampler = 'blue-noise',
    lightPaths = 0,
    guiding = 0,
    maxDepth = truth.maxDepth(variant),
  }: Omit<GroundTruthOptions, 'samples' | 'noise'>,
): PathTracerOptions {
  const { width, height } = truth.description.film;
  return { width, height, seed, sampler, lightPaths, guiding, maxDepth, camera: 0, multipleScattering: false };
}

/** Renders a scene of the reference set the way its reference was and compares. */
export async function renderGroundTruth(
  device: GPUDevice,
  truth: GroundTruth,
  { samples, noise = 1, ...how }: GroundTruthOptions,
): Promise<{ image: Float32Array; comparison: Comparison }> {
  const image = await renderImage(device, await truth.scene(), { ...groundTruthOptions(truth, how), samples });
  const { film } = truth.description;
  return { image, comparison: compareImages(image, samples, truth.image(how.variant), film, truth.tolerance, noise) };
}
