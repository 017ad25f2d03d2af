import { bindImages, type BoundImages } from './images';
import type { Network } from './network';
import type { DenoiseImages, DenoiserInput } from './options';
import type { PreludeKernels } from './prelude-kernels';

/** A network, and what it denoises. */
export type NetworkOf = readonly [input: DenoiserInput, network: Network];

/** A network on the device: what it denoises, and its shaders. */
export interface Stage {
  readonly input: DenoiserInput;
  readonly network: Network;
  readonly kernels: PreludeKernels;
}

/** Guides that are cleaned before they guide. */
type CleanGuide = 'albedo' | 'normal';

/**
 * The images of each stage, checked: those that clean guides write into `guides`, the last takes what they have
 * written.
 *
 * @throws {DenoiseError} `denoise/size`, `denoise/input`, `denoise/limit`, `denoise/option`.
 */
export function boundChain(
  device: GPUDevice,
  stages: readonly Stage[],
  guides: readonly GPUBuffer[],
  images: DenoiseImages,
): BoundImages[] {
  const cleaned: Partial<Record<CleanGuide, { buffer: GPUBuffer; pixelStride: 3 }>> = {};
  return stages.map(({ input, network }, i) => {
    const guide = guides[i];
    if (guide) cleaned[input as CleanGuide] = { buffer: guide, pixelStride: 3 };
    const taken = guide ? { ...images, output: { buffer: guide, pixelStride: 3 } } : { ...images, ...cleaned };
    return bindImages(network, input, taken, device.limits);
  });
}
