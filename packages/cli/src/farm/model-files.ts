import { readFile, stat } from 'node:fs/promises';
import { basename, dirname, extname, join, relative, resolve, sep } from 'node:path';
import type { BundleFile } from '@glanz/farm';
import { CliError } from '../errors';

const GLB_MAGIC = 0x46546c67;
const JSON_CHUNK = 0x4e4f534a;

/** The JSON of a .gltf or .glb file; `undefined` where there is none: loading it says what is wrong. */
function jsonOf(bytes: Buffer): unknown {
  try {
    if (bytes.length >= 20 && bytes.readUInt32LE(0) === GLB_MAGIC) {
      if (bytes.readUInt32LE(16) !== JSON_CHUNK) return undefined;
      return JSON.parse(bytes.toString('utf8', 20, 20 + bytes.readUInt32LE(12)));
    }
    return JSON.parse(bytes.toString('utf8'));
  } catch {
    return undefined;
  }
}

/** Each `uri` of a document that names a file, wherever an extension has put it. */
function* urisOf(value: unknown): Generator<string> {
  if (typeof value !== 'object' || value === null) return;
  for (const [key, member] of Object.entries(value)) {
    if (key === 'uri' && typeof member === 'string') {
      if (!/^[a-z][a-z0-9+.-]*:/i.test(member)) yield member;
    } else yield* urisOf(member);
  }
}

const decoded = (uri: string): string => {
  try {
    return decodeURIComponent(uri);
  } catch {
    return uri;
  }
};

/** The names that follow keywords at the beginning of lines: as a whole, and behind options that stand before them. */
function* namesAfter(text: string, keyword: RegExp): Generator<string> {
  for (const line of text.split(/\r?\n/)) {
    const rest = keyword.exec(line.trim())?.[1]?.trim();
    if (!rest) continue;
    yield rest;
    yield rest.split(/\s+/).at(-1) as string;
    yield* rest.split(/\s+/);
  }
}

/** The files that a USD file names; none where it cannot be read: loading it says what is wrong. */
async function usdNames(path: string): Promise<string[]> {
  const { FormatError } = await import('@glanz/formats');
  const { usdFiles } = await import('@glanz/formats/usd');
  try {
    return usdFiles(new Uint8Array(await readFile(path)), basename(path));
  } catch (error) {
    if (error instanceof FormatError) return [];
    throw error;
  }
}

/**
 * The files that a model consists of, the model itself first, under the name `model` with its ending: a bundle's
 * identity does not depend on what the file is called.
 *
 * @param path Absolute.
 * @throws {CliError} `cli/input` for a file outside of the model's folder
 */
export async function modelFiles(path: string): Promise<{ readonly main: string; readonly files: BundleFile[] }> {
  const folder = dirname(path);
  const main = `model${extname(path).toLowerCase()}`;
  const names = new Set<string>();
  const add = async (name: string) => {
    const file = resolve(folder, name.replaceAll('\\', '/'));
    const found = await stat(file).catch(() => undefined);
    // What is missing is a warning of the loader.
    if (!found?.isFile() || file === path) return undefined;
    const inside = relative(folder, file);
    if (inside.startsWith('..'))
      throw new CliError(
        'cli/input',
        `"${basename(path)}" uses "${name}", which lies outside of its folder: workers get only the files of that folder. Pack the model as .glb, or move the file.`,
        { location: { file: path } },
      );
    names.add(inside.split(sep).join('/'));
    return file;
  };
  if (/\.(glb|gltf)$/i.test(path)) {
    for (const uri of urisOf(jsonOf(await readFile(path)))) await add(decoded(uri));
  } else if (/\.obj$/i.test(path)) {
    const libraries: string[] = [];
    for (const name of namesAfter(await readFile(path, 'utf8'), /^mtllib\s+(.*)$/i)) {
      const file = await add(name);
      if (file) libraries.push(file);
    }
    for (const library of libraries)
      for (const name of namesAfter(await readFile(library, 'utf8'), /^(?:map_\w+|bump|disp|norm|refl|decal)\s+(.*)$/i))
        await add(relative(folder, resolve(dirname(library), name)));
  } else if (/\.usd[acz]?$/i.test(path)) {
    for (const name of await usdNames(path)) await add(name);
  }
  return {
    main,
    files: [
      { name: main, path },
      ...[...names].filter((name) => name !== main).map((name) => ({ name, path: join(folder, name) })),
    ],
  };
}
