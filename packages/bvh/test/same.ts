import { expect } from 'vitest';
import type { Blas } from '../src/blas';

const bytes = (array: Float32Array | Uint32Array) => Buffer.from(array.buffer, array.byteOffset, array.byteLength);

/** Expects the same bits. `toEqual` takes seconds for arrays of a million numbers. */
export function expectSame(actual: Blas, expected: Blas): void {
  expect(actual.nodeCount).toBe(expected.nodeCount);
  expect(actual.nodes.length).toBe(expected.nodes.length);
  expect(bytes(actual.nodes).equals(bytes(expected.nodes))).toBe(true);
  expect(bytes(actual.triangleIndices).equals(bytes(expected.triangleIndices))).toBe(true);
  expect(actual.bounds).toEqual(expected.bounds);
}
