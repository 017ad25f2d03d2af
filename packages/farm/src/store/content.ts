import { createHash } from 'node:crypto';
import { FarmError } from '../error';

const ID = /^[0-9a-f]{40,64}$/;

/** Refuses what is no identity, so that no id of a queue leads out of a store. @throws {FarmError} `farm/store` */
export function checked(id: string): string {
  if (!ID.test(id)) throw new FarmError('farm/store', `"${id}" is not the identity of anything in the store.`);
  return id;
}

const isName = (name: string) =>
  name !== '' && !name.startsWith('/') && !/[\\\0:]/.test(name) && !name.split('/').some((p) => p === '..' || p === '');

/** The SHA-256 of bytes, hexadecimal. */
export const hashOf = (content: Uint8Array | string): string => createHash('sha256').update(content).digest('hex');

/** The object that lists a bundle's files, which depends on names and contents alone. @param files Names and hashes. */
export function bundleText(files: readonly (readonly [name: string, hash: string])[]): string {
  for (const [name] of files)
    if (!isName(name)) throw new FarmError('farm/store', `"${name}" cannot be the name of a file in a bundle.`);
  return JSON.stringify([...files].sort(([a], [b]) => (a < b ? -1 : 1)));
}

/** Names and hashes of a bundle's files. @throws {FarmError} `farm/store` for a name that leads out of the bundle */
export function bundleFiles(text: Uint8Array, hash: string): [name: string, hash: string][] {
  const list = JSON.parse(new TextDecoder().decode(text)) as [string, string][];
  if (!list.every(([name]) => isName(name)))
    throw new FarmError('farm/store', `The bundle ${hash} names a file outside of itself.`);
  return list;
}
