import { readFile, stat } from 'node:fs/promises';
import { resolve } from 'node:path';
import { CliError } from './errors';

const reason = (cause: unknown) => {
  const { code, message } = cause as NodeJS.ErrnoException;
  return code === 'ENOENT' || code === 'ENOTDIR' ? 'there is no such file' : code === 'EACCES' ? 'permission denied' : message;
};

/**
 * Makes sure that a file is there before anything slow begins.
 *
 * @param what For the message: `the model`.
 * @throws {CliError} `cli/input`
 */
export async function checkInput(path: string, cwd: string, what: string): Promise<void> {
  const location = { file: path };
  const found = await stat(resolve(cwd, path)).catch((cause: unknown) => {
    throw new CliError('cli/input', `Cannot read ${what} "${path}": ${reason(cause)}.`, { cause, location });
  });
  if (found.isDirectory()) throw new CliError('cli/input', `Cannot read ${what} "${path}": it is a folder; name the file in it.`, { location });
}

/** The bytes of a file. @throws {CliError} `cli/input` */
export async function readInput(path: string, cwd: string, what: string): Promise<Uint8Array> {
  await checkInput(path, cwd, what);
  return readFile(resolve(cwd, path)).catch((cause: unknown) => {
    throw new CliError('cli/input', `Cannot read ${what} "${path}": ${reason(cause)}.`, { cause, location: { file: path } });
  });
}
