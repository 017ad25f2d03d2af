import { realpath } from 'node:fs/promises';
import { basename, dirname, isAbsolute, join, relative, sep } from 'node:path';

/** The path with symbolic links followed in as much of it as exists. */
async function followed(path: string): Promise<string> {
  const real = await realpath(path).catch(() => undefined);
  if (real !== undefined) return real;
  const parent = dirname(path);
  return parent === path ? path : join(await followed(parent), basename(path));
}

/** Whether a file would be written below a folder, symbolic links followed. Both paths are absolute. */
export async function liesBelow(file: string, root: string): Promise<boolean> {
  const inside = relative(await followed(root), join(await followed(dirname(file)), basename(file)));
  return inside !== '' && inside !== '..' && !inside.startsWith(`..${sep}`) && !isAbsolute(inside);
}
