import { createHash, randomBytes } from 'node:crypto';
import { constants, createReadStream } from 'node:fs';
import { copyFile, mkdir, open, rename, rm } from 'node:fs/promises';
import { dirname } from 'node:path';
import { pipeline } from 'node:stream/promises';
import { FarmError } from '../error';

/** The SHA-256 of a file, hexadecimal. */
export async function hashFile(file: string): Promise<string> {
  const hash = createHash('sha256');
  await pipeline(createReadStream(file, { highWaterMark: 2 ** 21 }), hash);
  return hash.digest('hex');
}

/** A name beside a file that no other process uses. */
export const partialOf = (file: string): string => `${file}.${process.pid}-${randomBytes(4).toString('hex')}.partial`;

/** Writes a file through another one beside it, so that it appears whole or not at all. @throws {FarmError} `farm/store` */
export const replaced = async (file: string, write: (partial: string) => Promise<void>): Promise<void> => {
  const partial = partialOf(file);
  try {
    await mkdir(dirname(file), { recursive: true });
    await write(partial);
    await rename(partial, file);
  } catch (cause) {
    await rm(partial, { force: true }).catch(() => undefined);
    throw new FarmError('farm/store', `Cannot write "${file}": ${(cause as Error).message}.`, {
      cause,
      location: { file },
    });
  }
};

/** Writes a file that appears whole or not at all. @throws {FarmError} `farm/store` */
export const writeWhole = (file: string, content: Uint8Array | string): Promise<void> =>
  replaced(file, async (partial) => {
    const handle = await open(partial, 'wx');
    try {
      await handle.writeFile(content);
      await handle.sync();
    } finally {
      await handle.close();
    }
  });

/** Copies a file, which appears whole or not at all. @throws {FarmError} `farm/store` */
export const copyWhole = (from: string, to: string): Promise<void> =>
  replaced(to, (partial) => copyFile(from, partial, constants.COPYFILE_EXCL | constants.COPYFILE_FICLONE));
