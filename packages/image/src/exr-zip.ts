import { unzlibSync, zlibSync } from 'fflate';
import { reconstruct } from './exr-block';

/**
 * OpenEXR's ZIP: even bytes first, then odd ones (so that exponents lie together), each byte replaced by its difference
 * from the one before, plus 128, and the lot through zlib. Data that does not get smaller is kept raw.
 */
export function zipBlock(raw: Uint8Array): Uint8Array {
  const n = raw.length;
  const half = (n + 1) >> 1;
  const split = new Uint8Array(n);
  for (let i = 0; i < n; i++) split[(i & 1 ? half : 0) + (i >> 1)] = raw[i] as number;
  for (let i = n - 1; i > 0; i--) split[i] = (split[i] as number) - (split[i - 1] as number) + 128;
  const packed = zlibSync(split, { level: 6 });
  return packed.length < n ? packed : raw;
}

/** Inflates into `size` bytes; `undefined` if the data does not give exactly that. */
export function inflateTo(packed: Uint8Array, size: number): Uint8Array | undefined {
  try {
    // One byte more than needed shows data that is too long, without ever growing with it.
    const out = unzlibSync(packed, { out: new Uint8Array(size + 1) });
    return out.length === size ? out : undefined;
  } catch {
    return undefined;
  }
}

/** Undoes {@link zipBlock} into `size` bytes; `undefined` if the data does not give exactly that. */
export function unzipBlock(packed: Uint8Array, size: number): Uint8Array | undefined {
  const split = inflateTo(packed, size);
  return split && reconstruct(split);
}
