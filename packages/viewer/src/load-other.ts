import { loadPart } from '@glanz/scene';
import type { ImageDecoder } from '@glanz/formats';
import type { Scene } from '@glanz/scene';
import { ViewerError } from './errors';

/** Reads a file by its path from the model's folder; `undefined` where there is none. */
export type ReadFile = (path: string) => Promise<Uint8Array<ArrayBuffer> | undefined>;

/** What {@link loadOther} takes beside the files. */
export interface LoadOtherOptions {
  /** Loads what decodes images. */
  readonly decoder: () => Promise<(bytes: Uint8Array<ArrayBuffer>, type: string) => ReturnType<ImageDecoder>>;
  readonly signal: AbortSignal | undefined;
}

/**
 * Reads a model that is no glTF, by the ending of its name: OBJ with MTL, STL, and USD, whose reader is a file of its
 * own.
 *
 * @param name Of the file in its folder.
 * @throws {ViewerError} `viewer/no-model` if the file cannot be read.
 * @throws {FormatError} for what is no such model.
 */
export async function loadOther(name: string, read: ReadFile, { decoder, signal }: LoadOtherOptions): Promise<Scene> {
  const bytes = await read(name);
  if (!bytes)
    throw new ViewerError(
      'viewer/no-model',
      `The model "${name}" could not be fetched: check the address, and that its server lets this page read it.`,
    );
  const options = {
    name,
    read,
    decodeImage: async (image: Uint8Array<ArrayBuffer>) => (await decoder())(image, 'application/octet-stream'),
    ...(signal ? { signal } : {}),
  };
  if (/\.usd[acz]?$/i.test(name)) return (await loadPart('usd', import('@glanz/formats/usd'))).readUsd(bytes, options);
  const { readObj, readStl } = await loadPart('formats', import('@glanz/formats'));
  return /\.stl$/i.test(name) ? readStl(bytes, { name }) : readObj(bytes, options);
}
