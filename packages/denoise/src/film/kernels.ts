import { compileKernel, type Kernel } from '../gpu';
import blend from './blend.wesl';
import errors from './errors.wesl';
import fireflies from './fireflies.wesl';

/** The shaders around the network. */
export interface FilmKernels {
  readonly fireflies: Kernel;
  readonly errors: Kernel;
  readonly blend: Kernel;
}

/** @throws {DenoiseError} `denoise/pipeline`. */
export async function compileFilmKernels(device: GPUDevice): Promise<FilmKernels> {
  const base = { 0: 'uniform', 1: 'read', 3: 'write' } as const;
  const [firefly, error, mix] = await Promise.all([
    compileKernel(device, 'denoise fireflies', fireflies, {}, base),
    compileKernel(device, 'denoise errors', errors, {}, { ...base, 2: 'read', 4: 'read' }),
    compileKernel(device, 'denoise blend', blend, {}, { ...base, 2: 'read', 4: 'read', 5: 'read' }),
  ]);
  return { fireflies: firefly, errors: error, blend: mix };
}
