import type { Layer } from '../network';
import { packMatrices } from './pack-matrices';
import { matrixConvolution } from './matrix-convolution.wgsl';
import {
  matrixBytes,
  threadsOf,
  tileOutputs,
  type DeviceMatrices,
  type MatrixCode,
  type MatrixShape,
  type MatrixSize,
} from './shapes';

/** An entry of `GPUAdapterInfo.subgroupMatrixConfigs`, which is not yet among WebGPU's types. */
interface MatrixConfig {
  readonly componentType: string;
  readonly resultComponentType: string;
  readonly M: number;
  readonly N: number;
  readonly K: number;
}

/** What is tried where a device does not list its matrices, as in Node: those of NVIDIA's GPUs, of Intel's, of others. */
const USUAL: readonly MatrixSize[] = [
  { m: 16, n: 16, k: 16 },
  { m: 8, n: 16, k: 16 },
  { m: 8, n: 8, k: 8 },
];

/** Whether the driver compiles products of halves with sums in single precision in this size. */
async function compiles(device: GPUDevice, { m, n, k }: MatrixSize, lanes: number): Promise<boolean> {
  const code = /* wgsl */ `
enable f16;
enable chromium_experimental_subgroup_matrix;
@group(0) @binding(0) var<storage, read_write> result: array<f32>;
@compute @workgroup_size(${lanes})
fn main() {
  let left = subgroup_matrix_left<f16, ${k}, ${m}>();
  let right = subgroup_matrix_right<f16, ${n}, ${k}>();
  let sum = subgroupMatrixMultiplyAccumulate(left, right, subgroup_matrix_result<f32, ${n}, ${m}>());
  subgroupMatrixStore<row_major>(&result, 0u, sum, ${n}u);
}`;
  device.pushErrorScope('validation');
  const module = device.createShaderModule({ label: 'denoise matrices', code });
  const pipeline = device
    .createComputePipelineAsync({ label: 'denoise matrices', layout: 'auto', compute: { module, entryPoint: 'main' } })
    .then(
      () => true,
      () => false,
    );
  // A lost device rejects; the next step says so.
  const invalid = await device.popErrorScope().catch(() => true);
  return (await pipeline) && invalid === null;
}

async function findMatrices(device: GPUDevice): Promise<DeviceMatrices | undefined> {
  const { adapterInfo } = device;
  const {
    subgroupMinSize,
    subgroupMaxSize: lanes,
    subgroupMatrixConfigs = [],
  } = adapterInfo as GPUAdapterInfo & {
    readonly subgroupMatrixConfigs?: readonly MatrixConfig[];
  };
  // Where subgroups have one of several sizes, which one is not known before a kernel runs.
  if (!lanes || subgroupMinSize !== lanes) return undefined;
  const listed = [...subgroupMatrixConfigs]
    .filter(({ componentType, resultComponentType }) => componentType === 'f16' && resultComponentType === 'f32')
    .map(({ M, N, K }) => ({ m: M, n: N, k: K }));
  const sizes = subgroupMatrixConfigs.length === 0 ? USUAL : listed;
  const usable = sizes.filter(({ m, n, k }) => m % 2 === 0 && n % 4 === 0 && k % 8 === 0);
  for (const matrix of usable.toSorted((a, b) => b.m * b.n * b.k - a.m * a.n * a.k))
    if (await compiles(device, matrix, lanes))
      return { matrix, lanes, shapeOf: (layer) => chooseMatrices(layer, matrix, lanes) };
  return undefined;
}

const known = new WeakMap<GPUDevice, Promise<DeviceMatrices | undefined>>();

/**
 * The largest matrices of halves with sums in single precision that a device multiplies, which has the features
 * `shader-f16` and `chromium-experimental-subgroup-matrix`; `undefined` where the size of subgroups is not known.
 */
export function matricesOf(device: GPUDevice): Promise<DeviceMatrices | undefined> {
  let found = known.get(device);
  if (!found) known.set(device, (found = findMatrices(device)));
  return found;
}

const CODE: MatrixCode = { convolution: matrixConvolution, pack: packMatrices };

/** Bytes of workgroup memory, and threads, that every device has. */
const WORKGROUP = { bytes: 16384, threads: 256 } as const;

/**
 * The shape for a layer; `undefined` where there are too few output channels to fill a matrix. On an H200 one matrix of
 * output channels a subgroup is faster than two or four, and eight rows than four where a layer has more than two.
 */
export function chooseMatrices(layer: Layer, matrix: MatrixSize, lanes: number): MatrixShape | undefined {
  const { channels } = layer;
  if (channels < matrix.n) return undefined;
  const up = layer.up !== undefined;
  const blocks = Math.ceil(channels / matrix.n);
  const rows = up ? 2 : blocks > 2 ? 8 : 4;
  const shapes = Array.from({ length: Math.min(8, blocks) }, (_, i) => ({
    matrix,
    code: CODE,
    lanes,
    rows,
    subgroups: i + 1,
    pixelStride: matrix.k + 8,
    up,
  })).filter((shape) => matrixBytes(shape) <= WORKGROUP.bytes && threadsOf(shape) <= WORKGROUP.threads);
  // The fewest channels in vain; of those the most at a time, for which pixels are staged together.
  const computed = (shape: MatrixShape) => Math.ceil(channels / tileOutputs(shape)) * tileOutputs(shape);
  return shapes.toSorted((a, b) => computed(a) - computed(b) || b.subgroups - a.subgroups)[0];
}
