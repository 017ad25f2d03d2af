import type { Image } from '@glanz/scene';

/**
 * Gives the bytes of a file that a document names, by its path relative to the document, with `/` between folders; or
 * undefined where there is none. It must read nothing outside the document's folder.
 */
export type ResourceReader = (
  path: string,
  signal: AbortSignal | undefined,
) => Promise<Uint8Array<ArrayBuffer> | undefined>;

/** Turns the bytes of a PNG, JPEG or WebP file into pixels: RGBA, 8 bits a channel, straight alpha, top row first. */
export type ImageDecoder = (bytes: Uint8Array<ArrayBuffer>) => Promise<Pick<Image, 'width' | 'height' | 'data'>>;

/** A path below the document's folder without "." and ".."; undefined if it leaves the folder, or is an address. */
export function pathWithin(folder: string, path: string): string | undefined {
  const plain = path.replaceAll('\\', '/');
  if (/^[a-z][a-z0-9+.-]*:|^\//i.test(plain)) return undefined;
  const parts: string[] = [];
  for (const part of `${folder}${plain}`.split('/')) {
    if (part === '' || part === '.') continue;
    if (part !== '..') parts.push(part);
    else if (parts.pop() === undefined) return undefined;
  }
  return parts.join('/');
}
