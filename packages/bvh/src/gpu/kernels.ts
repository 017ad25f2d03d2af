import { compileKernel, type BindingKind, type Kernel } from './device';
import cluster from './cluster.wesl';
import codes from './codes.wesl';
import heights from './heights.wesl';
import place from './place.wesl';
import primitives from './primitives.wesl';
import histogram from './radix_histogram.wesl';
import scan from './radix_scan.wesl';
import scatter from './radix_scatter.wesl';
import refit from './refit.wesl';
import root from './root.wesl';
import triangles from './triangles.wesl';

/** What the input is. */
export type InputKind = 'boxes' | 'triangles' | 'uint16' | 'uint32';

/** The three steps of a pass of the sort. */
export interface SortKernels {
  readonly histogram: Kernel;
  readonly scan: Kernel;
  readonly scatter: Kernel;
}

/** The shaders that do not depend on the input. */
export interface CommonKernels extends SortKernels {
  readonly codes: Kernel;
  readonly lowest: Kernel;
  readonly cluster: Kernel;
  readonly root: Kernel;
  readonly place: Kernel;
}

const base = { 0: 'uniform', 1: 'read' } as const;

/** @throws {BvhError} `bvh/pipeline`. */
export async function compileSort(device: GPUDevice): Promise<SortKernels> {
  const scattered = { ...base, 2: 'read', 3: 'read', 4: 'read', 5: 'write', 6: 'write' } as const;
  const [digits, sums, places] = await Promise.all([
    compileKernel(device, 'bvh digits', histogram, {}, { ...base, 2: 'read', 3: 'write' }),
    compileKernel(device, 'bvh scan', scan, {}, { 0: 'uniform', 1: 'write' }),
    compileKernel(device, 'bvh scatter', scatter, {}, scattered),
  ]);
  return { histogram: digits, scan: sums, scatter: places };
}

/** @throws {BvhError} `bvh/pipeline`. */
export async function compileCommon(device: GPUDevice): Promise<CommonKernels> {
  const clusters = { ...base, 2: 'read', 4: 'write', 5: 'write', 6: 'write', 7: 'write' } as const;
  const placed = { ...base, 2: 'read', 3: 'write', 4: 'read', 5: 'write', 6: 'write' } as const;
  const top = { 1: 'write', 2: 'read', 3: 'write', 5: 'write', 6: 'write' } as const;
  const [sort, ...made] = await Promise.all([
    compileSort(device),
    compileKernel(device, 'bvh codes', codes, {}, { ...base, 2: 'read', 3: 'write', 4: 'read' }),
    compileKernel(device, 'bvh lowest clusters', cluster, { BVH_GPU_LOWEST: true }, { ...clusters, 3: 'read' }),
    compileKernel(device, 'bvh clusters', cluster, { BVH_GPU_LOWEST: false }, clusters),
    compileKernel(device, 'bvh root', root, {}, top),
    compileKernel(device, 'bvh layout', place, {}, placed),
  ]);
  return { ...sort, codes: made[0], lowest: made[1], cluster: made[2], root: made[3], place: made[4] };
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

/** The shader that finds the heights of nodes. @throws {BvhError} `bvh/pipeline`. */
export const compileHeights = (device: GPUDevice): Promise<Kernel> =>
  compileKernel(device, 'bvh heights', heights, {}, { 0: 'uniform', 1: 'read', 2: 'write' });

/** The shader that fits boxes to moved vertices. @throws {BvhError} `bvh/pipeline`. */
export const compileRefit = (device: GPUDevice, kind: InputKind): Promise<Kernel> =>
  compileKernel(device, `bvh refit of ${kind}`, refit, flagsOf(kind), {
    ...inputBindings(kind),
    3: 'read',
    4: 'read',
    5: 'write',
  });
