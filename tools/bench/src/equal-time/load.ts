import { createHash } from 'node:crypto';
import { existsSync, readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { gunzipSync, gzipSync } from 'node:zlib';
import { loadGltf } from '@glanz/gltf';
import type { Scene } from '@glanz/scene';
import { BenchError } from '../error';

/** Name of the folder beside a packed bundle that holds what it reads. */
export const DATA_FOLDER = 'equal-time-data';

/**
 * Longest edge of textures, texels: larger ones are halved in size for all contestants, so that a bundle stays small.
 */
const LARGEST = 1024;

/** Decoded pixels: RGBA, stride 4, 8 bits. */
export interface Pixels {
  readonly width: number;
  readonly height: number;
  readonly data: Uint8Array<ArrayBuffer>;
}

/** The folder of a packed bundle's data, if this is one. */
export function packedFolder(name = DATA_FOLDER): string | undefined {
  const folder = join(dirname(fileURLToPath(import.meta.url)), name);
  return existsSync(folder) ? folder : undefined;
}

/** Makes the packed reference set the one that is read, where there is one and no other was asked for. */
export function usePackedReferences(): void {
  const folder = packedFolder();
  if (folder) process.env['GLANZ_GROUNDTRUTH'] ??= join(folder, 'groundtruth');
}

/**
 * A file of the sample assets: from the packed data, from the folder that GLANZ_ASSETS names, or from `shared/assets`
 * beside the checkout.
 */
export function assetFile(path: string): string | undefined {
  const packed = packedFolder();
  const places = [packed && join(packed, 'assets'), process.env['GLANZ_ASSETS']];
  for (let folder = dirname(fileURLToPath(import.meta.url)); folder !== dirname(folder); folder = dirname(folder))
    places.push(join(folder, 'shared/assets'));
  return places
    .filter((place) => place)
    .map((place) => join(place as string, path))
    .find((file) => existsSync(file));
}

/** Name under which the packed data keeps an encoded image's pixels. */
export const pixelsName = (bytes: Uint8Array) => `${createHash('sha1').update(bytes).digest('hex')}.rgba.gz`;

/** Pixels as the packed data keeps them: width and height as 32-bit words, then RGBA, compressed. */
export function packPixels({ width, height, data }: Pixels): Uint8Array {
  return gzipSync(Buffer.concat([new Uint8Array(Uint32Array.of(width, height).buffer), data]), { level: 9 });
}

function unpackPixels(file: string): Pixels {
  const bytes = new Uint8Array(gunzipSync(readFileSync(file)));
  const [width, height] = new Uint32Array(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + 8));
  return { width: width as number, height: height as number, data: bytes.slice(8) };
}

/** Options for {@link decodePixels}. */
export interface DecodeOptions {
  /** Of the packed data, if there is any; default: that of `equal-time`. */
  readonly folder?: string | undefined;
  /** Longest edge, texels; default 1024. */
  readonly largest?: number;
}

/** Decodes a texture, the same way for all contestants. */
export async function decodePixels(
  bytes: Uint8Array,
  { folder = packedFolder(), largest = LARGEST }: DecodeOptions = {},
): Promise<Pixels> {
  if (folder) {
    const file = join(folder, 'images', pixelsName(bytes));
    if (!existsSync(file)) throw new BenchError('bench/missing-data', `${file} is missing: pack again.`);
    return unpackPixels(file);
  }
  const { default: sharp } = await import('sharp');
  const { data, info } = await sharp(bytes, { ignoreIcc: true })
    .resize({ width: largest, height: largest, fit: 'inside', withoutEnlargement: true })
    .toColourspace('srgb')
    .ensureAlpha()
    .raw({ depth: 'uchar' })
    .toBuffer({ resolveWithObject: true });
  return { width: info.width, height: info.height, data: new Uint8Array(data) };
}

/** The encoded images inside a .glb file, in the order of its list of images. */
export function glbImages(glb: Uint8Array): Uint8Array[] {
  const view = new DataView(glb.buffer, glb.byteOffset, glb.byteLength);
  const length = view.getUint32(12, true);
  const json = JSON.parse(new TextDecoder().decode(glb.subarray(20, 20 + length))) as {
    images?: { bufferView: number }[];
    bufferViews?: { byteOffset?: number; byteLength: number }[];
  };
  const binary = glb.subarray(28 + length);
  return (json.images ?? []).map(({ bufferView }) => {
    const { byteOffset = 0, byteLength } = json.bufferViews![bufferView]!;
    return binary.subarray(byteOffset, byteOffset + byteLength);
  });
}

/** A .glb file as a scene. */
export const loadGltfBytes = (glb: Uint8Array<ArrayBuffer>, textures?: DecodeOptions): Promise<Scene> =>
  loadGltf(glb, { decodeImage: (bytes) => decodePixels(bytes, textures) });
