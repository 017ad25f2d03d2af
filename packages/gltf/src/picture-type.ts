import { fromBase64, fromPercents } from './data-bytes';
import type { GltfImage } from './json';
import { dataUri } from './uri';

const FORMATS = [
  ['image/png', [0x89, 0x50, 0x4e, 0x47]],
  ['image/jpeg', [0xff, 0xd8, 0xff]],
  ['image/webp', [0x52, 0x49, 0x46, 0x46]],
  ['image/ktx2', [0xab, 0x4b, 0x54, 0x58, 0x20, 0x32, 0x30, 0xbb, 0x0d, 0x0a, 0x1a, 0x0a]],
  // After the length of the first box: "ftypavif" or "ftypavis".
  ['image/avif', [undefined, undefined, undefined, undefined, 0x66, 0x74, 0x79, 0x70, 0x61, 0x76, 0x69]],
] as const;

/**
 * The type of a picture by its first bytes. Decoders know more formats than glTF: SVG, for one, may name other files.
 * @throws {Error} if it has none of them.
 */
export function pictureType(bytes: Uint8Array): string {
  const found = FORMATS.find(([, magic]) => magic.every((byte, at) => byte === undefined || bytes[at] === byte));
  if (!found) throw new Error('it is no PNG, JPEG, WebP, AVIF or KTX2');
  return found[0];
}

/**
 * What the document says of an image's type where its bytes say otherwise; undefined if both agree or it says nothing.
 */
export function wrongType({ mimeType, uri }: GltfImage, type: string): string | undefined {
  const said = mimeType ?? (typeof uri === 'string' ? dataUri(uri)?.type : undefined);
  // Types of no picture have been reported when the document was checked.
  return FORMATS.some(([known]) => known === said && known !== type) ? said : undefined;
}

/** Characters of a data: uri that hold the first bytes of a picture. */
const HEAD = 64;

/** The first bytes of a data: uri; undefined if it has none that can be decoded. */
export function headOf(uri: string): Uint8Array | undefined {
  const found = dataUri(uri);
  if (!found) return undefined;
  try {
    return found.base64 ? fromBase64(found.data.slice(0, HEAD)) : fromPercents(found.data.slice(0, 3 * HEAD));
  } catch {
    return undefined;
  }
}
