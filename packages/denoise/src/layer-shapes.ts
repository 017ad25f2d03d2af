import { isSoftware } from './configure';
import { chooseShape, withGroups } from './kernels/choose-shape';
import type { DeviceMatrices } from './kernels/shapes';
import type { DenoiserOptions } from './options';
import type { PlanOptions } from './plan';

/**
 * How layers are shared: as the caller asks for where that fits, by subgroup matrices where the device has them, among
 * threads by the usual choice elsewhere.
 */
export function shapesOf(
  device: GPUDevice,
  shapeOf: DenoiserOptions['shapeOf'],
  matrices: DeviceMatrices | undefined,
): PlanOptions['shapeOf'] {
  const software = isSoftware(device);
  return (layer, width, height) => {
    const family = shapeOf?.(layer, width, height);
    const shape = family && withGroups(family, layer);
    return shape ?? matrices?.shapeOf(layer) ?? chooseShape(layer, width, height, software);
  };
}

/** Matrices by which a denoiser with these options computes. */
export async function matricesFor(
  device: GPUDevice,
  { storage, subgroupMatrices = true }: Pick<DenoiserOptions, 'storage' | 'subgroupMatrices'>,
): Promise<DeviceMatrices | undefined> {
  const { features } = device;
  if (!subgroupMatrices || storage === 'f32') return undefined;
  if (!features.has('shader-f16') || !features.has('chromium-experimental-subgroup-matrix')) return undefined;
  // Few devices have them: others do not load this. Without it threads do the work.
  const module = await import('./kernels/choose-matrices').catch(() => undefined);
  return module?.matricesOf(device);
}
