import type { Scene } from '@glanz/scene';
import { decodeImageFile } from '@glanz/scene/node';
import { FormatError } from './error';
import { readObj, type ObjOptions } from './obj';
import type { ImageDecoder, ResourceReader } from './resources';
import { readStl } from './stl';
import { readUsd } from './usd/read';

/** Options for {@link loadModelFile}. */
export type LoadModelOptions = Omit<ObjOptions, 'read' | 'name'>;

/** Decodes images with the optional package `sharp`. @throws {FormatError} `formats/missing-decoder` without it. */
const decodeImageInNode: ImageDecoder = (bytes) =>
  decodeImageFile(bytes, (message, options) => new FormatError('formats/missing-decoder', message, options));

/**
 * Whether a file's name is one of those that {@link loadModelFile} reads: `.obj`, `.stl`, `.usdz`, `.usdc`, `.usda`,
 * `.usd`.
 */
export const isModelFile = (path: string): boolean => /\.(obj|stl|usd[acz]?)$/i.test(path);

/**
 * Loads an `.obj`, `.stl`, `.usdz`, `.usdc` or `.usda` file in Node, with the materials and images beside it. Files
 * outside its folder are not read. `up` and `unit` apply to OBJ and STL; USD files define both.
 *
 * @throws {FormatError} See its codes.
 * @example
 * const scene = await loadModelFile('models/button.obj');
 */
export async function loadModelFile(path: string | URL, options: LoadModelOptions = {}): Promise<Scene> {
  const { readFile, realpath } = await import('node:fs/promises');
  const { basename, dirname, extname, join, sep } = await import('node:path');
  const { fileURLToPath } = await import('node:url');
  const file = typeof path === 'string' ? path : fileURLToPath(path);
  if (!isModelFile(file))
    throw new FormatError('formats/unknown', `${file} is neither .obj nor .stl nor .usdz, .usdc or .usda.`, {
      location: { file },
    });
  const { signal } = options;
  const name = basename(file);
  let bytes: Uint8Array<ArrayBuffer>;
  try {
    bytes = new Uint8Array(await readFile(file, signal ? { signal } : {}));
  } catch (cause) {
    signal?.throwIfAborted();
    throw new FormatError('formats/missing-resource', `${file} cannot be read: ${(cause as Error).message}.`, {
      cause,
      location: { file },
    });
  }
  if (extname(file).toLowerCase() === '.stl')
    return readStl(bytes, {
      name: basename(file, extname(file)),
      ...(options.up ? { up: options.up } : {}),
      ...(options.unit === undefined ? {} : { unit: options.unit }),
    });
  const folder = await realpath(dirname(file));
  const read: ResourceReader = async (inside) => {
    try {
      const at = await realpath(join(folder, inside));
      return at.startsWith(folder + sep) ? new Uint8Array(await readFile(at)) : undefined;
    } catch {
      return undefined;
    }
  };
  const { decodeImage = decodeImageInNode } = options;
  if (/\.usd[acz]?$/i.test(file)) return readUsd(bytes, { name, read, decodeImage, ...(signal ? { signal } : {}) });
  return readObj(bytes, { ...options, decodeImage, name, read });
}
