import { access, constants, open, rename, rm, stat, type FileHandle } from 'node:fs/promises';
import { dirname, resolve } from 'node:path';
import { encodeHdr } from '@glanz/image/hdr';
import { CliError } from '../errors';
import { exrFile } from './exr';
import type { OutputTarget } from './formats';
import type { RenderedImage } from './image';
import { pngFile, type DisplayOptions } from './png';

/** A file that has been written. */
export interface WrittenFile {
  readonly path: string;
  readonly format: OutputTarget['format'];
  readonly bits: number;
  readonly bytes: number;
  /** SHA-256, hexadecimal, where it was computed while writing. */
  readonly sha256?: string;
}

const REPLACE = constants.O_WRONLY | constants.O_CREAT | constants.O_TRUNC | (constants.O_NOFOLLOW ?? 0);

const reason = (cause: unknown) => {
  const { code, message } = cause as NodeJS.ErrnoException;
  const known: Record<string, string> = {
    ENOENT: 'its folder does not exist',
    EACCES: 'permission denied',
    EPERM: 'permission denied',
    EROFS: 'the file system is read-only',
    ENOSPC: 'the disk is full',
    ENOTDIR: 'its folder is not a folder',
    EISDIR: 'it is a folder',
  };
  return (code && known[code]) || message;
};
const unwritable = (path: string, cause: unknown) =>
  new CliError('cli/output', `Cannot write "${path}": ${reason(cause)}.`, { cause, location: { file: path } });

/**
 * Makes sure, before hours of rendering, that a file can be written.
 *
 * @throws {CliError} `cli/output`
 */
export async function checkWritable(path: string, cwd: string): Promise<void> {
  const file = resolve(cwd, path);
  try {
    const found = await stat(file).catch((error: NodeJS.ErrnoException) => {
      if (error.code === 'ENOENT') return undefined;
      throw error;
    });
    if (found?.isDirectory()) throw Object.assign(new Error(), { code: 'EISDIR' });
    if (found) await access(file, constants.W_OK);
    else {
      const folder = await stat(dirname(file));
      if (!folder.isDirectory()) throw Object.assign(new Error(), { code: 'ENOTDIR' });
      await access(dirname(file), constants.W_OK);
    }
  } catch (cause) {
    throw unwritable(path, cause);
  }
}

/** A file that shows an image; a `.film` holds samples, see `FilmFile`. */
export type ImageTarget = OutputTarget & { readonly format: Exclude<OutputTarget['format'], 'film'> };

/** Whether an output shows an image. */
export const isImage = (target: OutputTarget): target is ImageTarget => target.format !== 'film';

/** The bytes of one output file. */
export async function encodeImage(
  image: RenderedImage,
  target: ImageTarget,
  display: DisplayOptions,
): Promise<Uint8Array> {
  if (target.format === 'png') return pngFile(image, target.bits === 16 ? 16 : 8, display);
  if (target.format === 'exr') return exrFile(image, target.bits === 32 ? 32 : 16);
  return encodeHdr({ width: image.width, height: image.height, data: image.denoised?.data ?? image.beauty });
}

/**
 * Writes a file that appears whole or not at all.
 *
 * @param path Relative to `cwd`, or absolute.
 * @param parts One after the other; or writes them to the open file.
 * @param sync Whether the bytes are on the disk before the file appears, so that it survives a power failure.
 * @throws {CliError} `cli/output`
 */
export async function writeWhole(
  path: string,
  cwd: string,
  parts: readonly Uint8Array[] | ((handle: FileHandle) => Promise<void>),
  { sync = false } = {},
): Promise<void> {
  const file = resolve(cwd, path);
  const partial = `${file}.${process.pid}.partial`;
  try {
    // Not through a link in its place.
    const handle = await open(partial, REPLACE);
    try {
      if (typeof parts === 'function') await parts(handle);
      else for (const part of parts) await handle.writeFile(part);
      if (sync) await handle.sync();
    } finally {
      await handle.close();
    }
    await rename(partial, file);
  } catch (cause) {
    await rm(partial, { force: true }).catch(() => undefined);
    throw unwritable(path, cause);
  }
}

/**
 * Encodes and writes one output. The file appears whole or not at all.
 *
 * @throws {CliError} `cli/output`
 */
export async function writeImage(
  image: RenderedImage,
  target: ImageTarget,
  display: DisplayOptions,
  cwd: string,
): Promise<WrittenFile> {
  const bytes = await encodeImage(image, target, display);
  await writeWhole(target.path, cwd, [bytes]);
  return { path: target.path, format: target.format, bits: target.bits, bytes: bytes.length };
}
