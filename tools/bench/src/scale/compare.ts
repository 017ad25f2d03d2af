import { BenchError } from '../error';

/**
 * How many pixels of two films of RGBA floats differ in a bit.
 *
 * @throws {BenchError} `bench/failed` for films of different sizes.
 */
export function differingPixels(a: Buffer, b: Buffer): number {
  if (a.length !== b.length) throw new BenchError('bench/failed', 'The two films have different sizes.');
  let differing = 0;
  for (let i = 0; i < a.length; i += 16) if (a.compare(b, i, i + 16, i, i + 16) !== 0) differing++;
  return differing;
}
