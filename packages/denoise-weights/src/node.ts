import { WEIGHT_ARCHIVES, type WeightArchiveName } from './archives';
import { WeightsError } from './error';

export { WeightsError } from './error';

/** Options for {@link readWeights}. */
export interface ReadWeightsOptions {
  /** Ends the reading; the returned promise then rejects with the signal's reason. */
  readonly signal?: AbortSignal | undefined;
}

/**
 * Reads an archive of this package in Node and compares its SHA-256.
 *
 * @param name See `WEIGHT_ARCHIVES`; `rt_hdr_alb_nrm` is the network for colour with albedo and normal.
 * @returns The bytes of the TZA archive, for `@glanz/denoise`.
 * @throws {WeightsError} `denoise-weights/unreadable`
 * @example
 * const weights = await readWeights('rt_hdr_alb_nrm_small');
 */
export async function readWeights(
  name: WeightArchiveName,
  { signal }: ReadWeightsOptions = {},
): Promise<Uint8Array<ArrayBuffer>> {
  const { readFile } = await import('node:fs/promises');
  const { createHash } = await import('node:crypto');
  const expected = Object.hasOwn(WEIGHT_ARCHIVES, name) ? WEIGHT_ARCHIVES[name] : undefined;
  if (!expected)
    throw new WeightsError(
      'denoise-weights/unreadable',
      `There are no weights "${name}"; there are ${Object.keys(WEIGHT_ARCHIVES).join(', ')}.`,
    );
  const file = new URL(`../weights/${name}.tza`, import.meta.url);
  let bytes: Uint8Array<ArrayBuffer>;
  try {
    bytes = new Uint8Array(await readFile(file, signal ? { signal } : {}));
  } catch (cause) {
    signal?.throwIfAborted();
    throw new WeightsError(
      'denoise-weights/unreadable',
      `The weights ${name} cannot be read: ${(cause as Error).message}. Install @glanz/denoise-weights again.`,
      { cause },
    );
  }
  if (createHash('sha256').update(bytes).digest('hex') !== expected.sha256)
    throw new WeightsError(
      'denoise-weights/unreadable',
      `The file of the weights ${name} has been changed or cut off: install @glanz/denoise-weights again.`,
    );
  return bytes;
}
