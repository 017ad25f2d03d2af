import { unzlibSync, zlibSync } from 'fflate';

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

/** Undoes {@link zipBlock} into `size` bytes; `undefined` if the data does not give exactly that. */
export function unzipBlock(packed: Uint8Array, size: number): Uint8Array | undefined {
  if (packed.length === size) return packed;
  if (packed.length > size) return undefined;
  let split: Uint8Array;
  try {
    // One byte more than needed shows data that is too long, without ever growing with it.
    split = unzlibSync(packed, { out: new Uint8Array(size + 1) });
  } catch {
    return undefined;
  }
  if (split.length !== size) return undefined;
  for (let i = 1; i < size; i++) split[i] = (split[i] as number) + (split[i - 1] as number) - 128;
  const raw = new Uint8Array(size);
  const half = (size + 1) >> 1;
  for (let i = 0; i < size; i++) raw[i] = split[(i & 1 ? half : 0) + (i >> 1)] as number;
  return raw;
}
