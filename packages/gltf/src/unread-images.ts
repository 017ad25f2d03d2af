import { headOf, imageType, wrongType } from './image-type';
import type { GltfImage, GltfJson, GltfTexture } from './json';
import type { PrimitiveReader } from './primitive';

/**
 * Checks the images that no material uses by their first bytes, if those are in the document. Other files are not
 * opened; one that no texture names is reported, since it may not exist.
 * @param shown Images that materials use.
 */
export function checkUnreadImages(
  json: GltfJson,
  shown: readonly number[],
  reader: PrimitiveReader,
  warn: (path: string, what: string) => void,
): void {
  const named = new Set([...shown, ...(json.textures ?? []).flatMap(sourcesOf)]);
  const read = new Set([
    ...shown,
    ...(json.extensions?.EXT_lights_image_based?.lights ?? []).flatMap((light) => light?.specularImages.flat() ?? []),
  ]);
  (json.images ?? []).forEach((image, index) => {
    if (read.has(index)) return;
    const path = `/images/${index}`;
    const head = headBytes(image, reader);
    if (!head) {
      const beside = typeof image.uri === 'string' && !/^data:/i.test(image.uri);
      if (beside && !named.has(index))
        warn(path, `names the file "${image.uri.slice(0, 80)}", but no texture uses it; it is not read`);
      return;
    }
    try {
      const type = imageType(head);
      const said = wrongType(image, type);
      if (said !== undefined) warn(path, `is declared as ${said}, but its bytes are ${type}; no material uses it`);
    } catch (error) {
      warn(path, `cannot be decoded: ${(error as Error).message}; no material uses it`);
    }
  });
}

/** The images that a texture may be read from. */
function sourcesOf({ source, extensions }: GltfTexture): unknown[] {
  return [source, ...Object.values(extensions ?? {}).map((extension) => extension?.source)];
}

/** The first bytes of an image that lies in the document; undefined for others and where they cannot be read. */
function headBytes({ uri, bufferView }: GltfImage, { exists, viewBytes }: PrimitiveReader): Uint8Array | undefined {
  if (uri !== undefined) return typeof uri === 'string' && /^data:/i.test(uri) ? headOf(uri) : undefined;
  return typeof bufferView === 'number' && exists(bufferView) ? viewBytes(bufferView) : undefined;
}
