import { compileKernel, type BindingKind, type Kernel } from '../gpu';
import antialias from './antialias.wesl';
import change from './change.wesl';
import combine from './combine.wesl';
import finish from './finish.wesl';
import guides from './guides.wesl';
import reproject from './reproject.wesl';
import smooth from './smooth.wesl';
import spread from './spread.wesl';

const MODULES = { guides, reproject, change, combine, spread, smooth, finish, antialias } as const;

/** Buffers that each kernel reads, and those that it writes, in the order of their bindings from 1 on. */
const BUFFERS = {
  guides: [3, 2],
  reproject: [6, 2],
  change: [3, 1],
  combine: [6, 2],
  spread: [3, 1],
  smooth: [3, 1],
  finish: [3, 1],
  antialias: [4, 1],
} as const satisfies Readonly<Record<keyof typeof MODULES, readonly [reads: number, writes: number]>>;

/** The shaders of the temporal filter. */
export type TemporalKernels = Readonly<Record<keyof typeof MODULES, Kernel>>;

/** @throws {DenoiseError} `denoise/pipeline`. */
export async function compileTemporalKernels(device: GPUDevice): Promise<TemporalKernels> {
  const names = Object.keys(MODULES) as (keyof typeof MODULES)[];
  const kernels = await Promise.all(
    names.map((name) => {
      const [reads, writes] = BUFFERS[name];
      const bindings: Record<number, BindingKind> = { 0: 'uniform' };
      for (let i = 1; i <= reads + writes; i++) bindings[i] = i <= reads ? 'read' : 'write';
      return compileKernel(device, `temporal ${name}`, MODULES[name], {}, bindings);
    }),
  );
  return Object.fromEntries(names.map((name, i) => [name, kernels[i]])) as unknown as TemporalKernels;
}
