import { readFile, stat } from 'node:fs/promises';
import { resolve } from 'node:path';
import { CliError } from './errors';

/** Maximum bytes of an input file: what Node reads in one piece. */
export const MAX_INPUT_BYTES = 2 ** 31 - 1;
/** Maximum bytes of a file of settings: a batch, a camera. */
export const MAX_SETTINGS_BYTES = 2 ** 26;

const reason = (cause: unknown) => {
  const { code, message } = cause as NodeJS.ErrnoException;
  return code === 'ENOENT' || code === 'ENOTDIR'
    ? 'there is no such file'
    : code === 'EACCES'
      ? 'permission denied'
      : message;
};

const size = (bytes: number) => (bytes < 1e9 ? `${(bytes / 1e6).toFixed(1)} MB` : `${(bytes / 1e9).toFixed(1)} GB`);

/**
 * Makes sure that a file can be read before anything slow begins: a regular file, since devices and pipes may never
 * end, and not too large.
 *
 * @param what For the message: `the model`.
 * @param maxBytes Default {@link MAX_INPUT_BYTES}.
 * @throws {CliError} `cli/input`
 */
export async function checkInput(
  path: string,
  cwd: string,
  what: string,
  maxBytes: number = MAX_INPUT_BYTES,
): Promise<void> {
  const location = { file: path };
  const wrong = (why: string, cause?: unknown) =>
    new CliError('cli/input', `Cannot read ${what} "${path}": ${why}.`, { cause, location });
  const found = await stat(resolve(cwd, path)).catch((cause: unknown) => {
    throw wrong(reason(cause), cause);
  });
  if (found.isDirectory()) throw wrong('it is a folder; name the file in it');
  if (!found.isFile()) throw wrong('it is a device or a pipe, not a regular file; save its content to a file first');
  if (found.size > maxBytes) throw wrong(`it has ${size(found.size)}, and at most ${size(maxBytes)} are read`);
}

/**
 * The bytes of a file.
 *
 * @param maxBytes Default {@link MAX_INPUT_BYTES}.
 * @throws {CliError} `cli/input`, and the reason of `signal`
 */
export async function readInput(
  path: string,
  cwd: string,
  what: string,
  { maxBytes = MAX_INPUT_BYTES, signal }: { readonly maxBytes?: number; readonly signal?: AbortSignal } = {},
): Promise<Uint8Array> {
  await checkInput(path, cwd, what, maxBytes);
  return readFile(resolve(cwd, path), signal ? { signal } : {}).catch((cause: unknown) => {
    signal?.throwIfAborted();
    throw new CliError('cli/input', `Cannot read ${what} "${path}": ${reason(cause)}.`, {
      cause,
      location: { file: path },
    });
  });
}
