import { compileKernel, type BindingKind, type Kernel } from './device';
import cluster from './cluster.wesl';
import codes from './codes.wesl';
import place from './place.wesl';
import primitives from './primitives.wesl';
import histogram from './radix_histogram.wesl';
import scan from './radix_scan.wesl';
import scatter from './radix_scatter.wesl';
import root from './root.wesl';
import triangles from './triangles.wesl';

/** What the input is. */
export type InputKind = 'boxes' | 'triangles' | 'uint16' | 'uint32';

/** The shaders that do not depend on the input. */
export interface CommonKernels {
  readonly codes: Kernel;
  readonly histogram: Kernel;
  readonly scan: Kernel;
  readonly scatter: Kernel;
  readonly lowest: Kernel;
  readonly cluster: Kernel;
  readonly root: Kernel;
  readonly place: Kernel;
}

const base = { 0: 'uniform', 1: 'read' } as const;

/** @throws {BvhError} `bvh/pipeline`. */
export async function compileCommon(device: GPUDevice): Promise<CommonKernels> {
  const clusters = { ...base, 2: 'read', 4: 'write', 5: 'write', 6: 'write', 7: 'write' } as const;
  const made = await Promise.all([
    compileKernel(device, 'bvh codes', codes, {}, { ...base, 2: 'read', 3: 'write' }),
    compileKernel(device, 'bvh digits', histogram, {}, { ...base, 2: 'read', 3: 'write' }),
    compileKernel(device, 'bvh scan', scan, {}, { 0: 'uniform', 1: 'write' }),
    compileKernel(
      device,
      'bvh scatter',
      scatter,
      {},
      { ...base, 2: 'read', 3: 'read', 4: 'read', 5: 'write', 6: 'write' },
    ),
    compileKernel(device, 'bvh lowest clusters', cluster, { BVH_GPU_LOWEST: true }, { ...clusters, 3: 'read' }),
    compileKernel(device, 'bvh clusters', cluster, { BVH_GPU_LOWEST: false }, clusters),
    compileKernel(device, 'bvh root', root, {}, { 1: 'write', 2: 'read', 3: 'write', 5: 'write', 6: 'write' }),
    compileKernel(
      device,
      'bvh layout',
      place,
      {},
      { ...base, 2: 'read', 3: 'write', 4: 'read', 5: 'write', 6: 'write' },
    ),
  ]);
  const [code, digit, sums, scattered, lowest, joined, top, placed] = made;
  return {
    codes: code,
    histogram: digit,
    scan: sums,
    scatter: scattered,
    lowest,
    cluster: joined,
    root: top,
    place: placed,
  };
}

const flagsOf = (kind: InputKind) => ({
  BVH_GPU_INDEXED: kind === 'uint16' || kind === 'uint32',
  BVH_GPU_SHORT: kind === 'uint16',
});

const inputBindings = (kind: InputKind): Record<number, BindingKind> =>
  kind === 'boxes' || kind === 'triangles' ? { ...base } : { ...base, 2: 'read' };

/** The shader that reads the input. @throws {BvhError} `bvh/pipeline`. */
export const compilePrimitives = (device: GPUDevice, kind: InputKind): Promise<Kernel> =>
  compileKernel(
    device,
    `bvh primitives of ${kind}`,
    primitives,
    { ...flagsOf(kind), BVH_GPU_BOXES: kind === 'boxes' },
    { ...inputBindings(kind), 3: 'write', 4: 'write' },
  );

/** The shader that packs triangles. @throws {BvhError} `bvh/pipeline`. */
export const compileTriangles = (device: GPUDevice, kind: InputKind): Promise<Kernel> =>
  compileKernel(device, `bvh triangles of ${kind}`, triangles, flagsOf(kind), {
    ...inputBindings(kind),
    3: 'read',
    4: 'write',
  });
