import { stat } from 'node:fs/promises';
import { resolve } from 'node:path';
import { FarmError } from '../error';
import type { Destination, JobResult, ResultFile } from '../job';
import { hashFile } from './files';
import { liesBelow } from './lies-below';

/**
 * Writes the files of a result to their destination, except for those that are there already.
 *
 * @param write Writes one of them.
 * @throws {FarmError} `farm/store` for paths outside of the root, and too few paths
 */
export async function deliverFiles(
  { label, files }: JobResult,
  { root, paths }: Destination,
  write: (file: ResultFile, target: string) => Promise<void>,
): Promise<void> {
  if (paths.length !== files.length)
    throw new FarmError('farm/store', `${label}: ${paths.length} paths for ${files.length} files.`);
  for (const [i, file] of files.entries()) {
    const target = resolve(root, paths[i] as string);
    if (!(await liesBelow(target, root)))
      throw new FarmError('farm/store', `"${target}" lies outside the folder "${root}".`);
    const there = await stat(target).catch(() => undefined);
    if (there?.isFile() && there.size === file.bytes && (await hashFile(target)) === file.sha256) continue;
    await write(file, target);
  }
}
