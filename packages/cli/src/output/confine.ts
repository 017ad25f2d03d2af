import { realpath } from 'node:fs/promises';
import { basename, dirname, isAbsolute, join, relative, resolve, sep } from 'node:path';

/** The path with symbolic links followed in as much of it as exists. */
async function followed(path: string): Promise<string> {
  const real = await realpath(path).catch(() => undefined);
  if (real !== undefined) return real;
  const parent = dirname(path);
  return parent === path ? path : join(await followed(parent), basename(path));
}

/**
 * Whether a file would be written below a folder. Symbolic links in the folders on the way are followed; the file
 * itself is replaced, so that a link in its place leads nowhere.
 *
 * @param path Relative to `cwd`, or absolute.
 * @param root Likewise; need not exist.
 */
export async function liesBelow(path: string, root: string, cwd: string): Promise<boolean> {
  const file = resolve(cwd, path);
  const inside = relative(await followed(resolve(cwd, root)), join(await followed(dirname(file)), basename(file)));
  return inside !== '' && inside !== '..' && !inside.startsWith(`..${sep}`) && !isAbsolute(inside);
}
