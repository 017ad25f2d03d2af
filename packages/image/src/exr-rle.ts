import { reconstruct } from './exr-block';

/** Runs: a count below 0 announces that many bytes as they are, one from 0 on a byte to repeat once more than that. */
export function unpackRuns(packed: Uint8Array, size: number): Uint8Array | undefined {
  const out = new Uint8Array(size);
  let to = 0;
  for (let at = 0; at < packed.length;) {
    const count = ((packed[at++] as number) << 24) >> 24;
    if (count < 0) {
      if (at - count > packed.length || to - count > size) return undefined;
      out.set(packed.subarray(at, at - count), to);
      at -= count;
      to -= count;
    } else {
      if (at >= packed.length || to + count + 1 > size) return undefined;
      out.fill(packed[at++] as number, to, to + count + 1);
      to += count + 1;
    }
  }
  return to === size ? out : undefined;
}

/** OpenEXR's RLE into `size` bytes; `undefined` if the data does not give exactly that. */
export function unpackRle(packed: Uint8Array, size: number): Uint8Array | undefined {
  const split = unpackRuns(packed, size);
  return split && reconstruct(split);
}
