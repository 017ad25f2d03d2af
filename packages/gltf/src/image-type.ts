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
 * The type of an image by its first bytes. Only these are passed to decoders, which may know others: SVG, for example,
 * can name other files.
 * @throws {Error} if it is none of these formats.
 */
export function imageType(bytes: Uint8Array): string {
  const found = FORMATS.find(([, magic]) => magic.every((byte, at) => byte === undefined || bytes[at] === byte));
  if (!found) throw new Error('it is not a PNG, JPEG, WebP, AVIF or KTX2 file');
  return found[0];
}

/**
 * The declared type of an image if its bytes are of another one; undefined if both agree or none is declared.
 */
export function wrongType({ mimeType, uri }: GltfImage, type: string): string | undefined {
  const declared = mimeType ?? (typeof uri === 'string' ? dataUri(uri)?.type : undefined);
  // checkImages() has reported unknown types.
  return FORMATS.some(([known]) => known === declared && known !== type) ? declared : undefined;
}

/** Characters of a data: uri that hold the first bytes of an image. */
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
