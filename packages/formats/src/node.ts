import type { Scene } from '@glanz/scene';
import { FormatError } from './error';
import { readObj, type ObjOptions } from './obj';
import type { ImageDecoder } from './resources';
import { readStl } from './stl';

/** Options for {@link loadModelFile}. */
export type LoadModelOptions = Omit<ObjOptions, 'read' | 'name'>;

/** Decodes images with the optional package `sharp`. */
const decodeWithSharp: ImageDecoder = async (bytes) => {
  const { default: sharp } = await import('sharp').catch((cause: unknown) => {
    throw new FormatError(
      'formats/missing-decoder',
      'Decoding images in Node needs the package "sharp": npm install sharp.',
      { cause },
    );
  });
  const { data, info } = await sharp(bytes, { ignoreIcc: true, limitInputPixels: 16384 * 16384 })
    .toColourspace('srgb')
    .ensureAlpha()
    .raw({ depth: 'uchar' })
    .toBuffer({ resolveWithObject: true });
  return {
    width: info.width,
    height: info.height,
    data: new Uint8Array(data.buffer as ArrayBuffer, data.byteOffset, data.byteLength),
  };
};

/** Whether a file's name is one of those that {@link loadModelFile} reads: `.obj`, `.stl`. */
export const isModelFile = (path: string): boolean => /\.(obj|stl)$/i.test(path);

/**
 * Loads an `.obj` or `.stl` file in Node, with the materials and images beside it. Files outside its folder are not
 * read.
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
    throw new FormatError('formats/unknown', `${file} is neither .obj nor .stl.`, { location: { file } });
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
  return readObj(bytes, {
    decodeImage: decodeWithSharp,
    ...options,
    name,
    read: async (inside) => {
      try {
        const at = await realpath(join(folder, inside));
        return at.startsWith(folder + sep) ? new Uint8Array(await readFile(at)) : undefined;
      } catch {
        return undefined;
      }
    },
  });
}
