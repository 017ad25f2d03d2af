import { BvhError } from '../error';
import { STORAGE } from './device';
import type { InputKind } from './kernels';
import type { GpuMesh } from './options';

/** @throws {BvhError} `bvh/options` */
export function whole(name: string, value: number, min: number, max: number): void {
  if (!(Number.isInteger(value) && value >= min && value <= max))
    throw new BvhError('bvh/options', `${name} is ${value}; it must be a whole number from ${min} to ${max}.`);
}

/** @throws {BvhError} With the code. */
export function expectBuffer(code: string, name: string, { size, usage }: GPUBuffer, bytes: number): void {
  if (!(usage & STORAGE)) throw new BvhError(code, `The buffer "${name}" lacks the usage STORAGE.`);
  if (size < bytes) throw new BvhError(code, `The buffer "${name}" has ${size} bytes; it must have ${bytes} or more.`);
}

/**
 * Checks a mesh: what shaders read it, and its buffers by their bindings.
 *
 * @throws {BvhError} `bvh/options`, `bvh/positions`, `bvh/indices`.
 */
export function inputOf(mesh: GpuMesh): {
  readonly kind: InputKind;
  readonly buffers: Readonly<Record<number, GPUBuffer>>;
} {
  const { positions, vertexCount, indices, triangleCount, indexFormat = 'uint32' } = mesh;
  whole('vertexCount', vertexCount, 0, 2 ** 32 - 1);
  whole('triangleCount', triangleCount, 0, 2 ** 32 - 1);
  if (indexFormat !== 'uint16' && indexFormat !== 'uint32')
    throw new BvhError('bvh/options', `indexFormat is ${String(indexFormat)}; it must be 'uint16' or 'uint32'.`);
  expectBuffer('bvh/positions', 'positions', positions, 12 * vertexCount);
  if (indices) {
    expectBuffer('bvh/indices', 'indices', indices, (indexFormat === 'uint16' ? 6 : 12) * triangleCount);
    return { kind: indexFormat, buffers: { 1: positions, 2: indices } };
  }
  if (vertexCount < 3 * triangleCount)
    throw new BvhError(
      'bvh/indices',
      `${triangleCount} triangles without indices need ${3 * triangleCount} vertices; there are ${vertexCount}.`,
    );
  return { kind: 'triangles', buffers: { 1: positions } };
}
