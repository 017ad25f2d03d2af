/** A regular file in a tar archive. */
export interface TarEntry {
  readonly name: string;
  readonly data: Uint8Array;
}

const BLOCK = 512;

/**
 * Lists the regular files of a tar archive (ustar). Names that need long-name extensions are not looked for: the
 * archives read here have short ones.
 *
 * @param bytes The whole archive, uncompressed.
 * @throws {RangeError} when the archive is cut short or a size is not a number.
 */
export function readTar(bytes: Uint8Array): TarEntry[] {
  const text = (from: number, length: number) => {
    const field = bytes.subarray(from, from + length);
    const end = field.indexOf(0);
    return new TextDecoder().decode(end < 0 ? field : field.subarray(0, end));
  };
  const entries: TarEntry[] = [];
  for (let at = 0; at + BLOCK <= bytes.length;) {
    const name = text(at, 100);
    if (name === '') break;
    const size = Number.parseInt(text(at + 124, 12).trim(), 8);
    const type = bytes[at + 156];
    const start = at + BLOCK;
    if (!Number.isFinite(size) || start + size > bytes.length)
      throw new RangeError(`tar: entry "${name}" is cut short`);
    if (type === 0 || type === 0x30)
      entries.push({ name: name.replace(/^\.\//, ''), data: bytes.subarray(start, start + size) });
    at = start + Math.ceil(size / BLOCK) * BLOCK;
  }
  return entries;
}
