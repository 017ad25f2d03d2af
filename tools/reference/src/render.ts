import { PathTracer, type PathTracerOptions } from '@glanz/renderer';
import type { Scene } from '@glanz/scene';
import { compareImages, type Comparison } from './compare';
import type { GroundTruth } from './catalogue';

/** Renders a scene and gives its image: RGB, stride 3, linear, top row first. */
export async function renderImage(
  device: GPUDevice,
  scene: Scene,
  options: PathTracerOptions & { readonly samples: number },
): Promise<Float32Array> {
  const { samples, ...rest } = options;
  const tracer = await PathTracer.create(device, scene, rest);
  try {
    for await (const progress of tracer.render({ samples })) void progress;
    const beauty = await tracer.read('beauty');
    const image = new Float32Array((beauty.length / 4) * 3);
    for (let i = 0; i < beauty.length / 4; i++) image.set(beauty.subarray(4 * i, 4 * i + 3), 3 * i);
    return image;
  } finally {
    tracer.destroy();
  }
}

/** Options for {@link renderGroundTruth}. */
export interface GroundTruthOptions {
  readonly samples: number;
  /** Default `full`. */
  readonly variant?: string;
  readonly seed?: number;
  /** Default `blue-noise`. */
  readonly sampler?: NonNullable<PathTracerOptions['sampler']>;
}

/** Renders a scene of the catalogue the way its reference was (single scattering) and compares. */
export async function renderGroundTruth(
  device: GPUDevice,
  truth: GroundTruth,
  { samples, variant = 'full', seed = 0, sampler = 'blue-noise' }: GroundTruthOptions,
): Promise<{ image: Float32Array; comparison: Comparison }> {
  const { width, height } = truth.description.film;
  const image = await renderImage(device, await truth.scene(), {
    width,
    height,
    samples,
    seed,
    sampler,
    maxDepth: truth.maxDepth(variant),
    camera: 0,
    multipleScattering: false,
  });
  return {
    image,
    comparison: compareImages(image, samples, truth.image(variant), { width, height }, truth.tolerance),
  };
}
