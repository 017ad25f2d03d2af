import { readFile, rename, rm, writeFile } from 'node:fs/promises';
import type { BlasStore } from './cache';

const MAGIC = 0x4c564247; // "GBVL" in little-endian bytes

/**
 * A {@link BlasStore} in one file beside a model, for `BlasCache` of `@glanz/bvh/cache`. The file is read on first
 * use and written as a whole, first under another name, so that it is never incomplete. Two processes may use it: the
 * last one to write wins. A file that is damaged counts as empty, or as what can still be read.
 *
 * @param path E.g. `model.glb.bvh`.
 * @param options `maxBytes`: beyond this many bytes, the least recently used hierarchies are evicted. Default 256
 * MiB.
 * @example
 * const hierarchies = new BlasCache(fileStore('model.glb.bvh'), await BvhWorkers.create());
 */
export function fileStore(path: string, { maxBytes = 256 * 2 ** 20 }: { readonly maxBytes?: number } = {}): BlasStore {
  let reading: Promise<Map<string, Uint8Array>> | undefined;
  let writing: Promise<void> | undefined;
  let waiting: Promise<void> | undefined;
  const entries = () =>
    (reading ??= readFile(path).then(unpack, (error: NodeJS.ErrnoException) => {
      if (error.code === 'ENOENT') return new Map<string, Uint8Array>();
      reading = undefined;
      throw error;
    }));
  const write = async () => {
    const temporary = `${path}.${process.pid}.tmp`;
    try {
      const kept = await entries();
      let total = [...kept.values()].reduce((sum, { length }) => sum + length, 0);
      for (const [key, { length }] of kept) {
        if (total <= maxBytes) break;
        kept.delete(key);
        total -= length;
      }
      await writeFile(temporary, pack(kept));
      await rename(temporary, path);
    } catch (error) {
      await rm(temporary, { force: true });
      throw error;
    }
  };
  return {
    async get(key) {
      const kept = await entries();
      const bytes = kept.get(key);
      // The order is that of the last use.
      if (bytes && kept.delete(key)) kept.set(key, bytes);
      return bytes;
    },
    async set(key, bytes) {
      const kept = await entries();
      kept.delete(key);
      kept.set(key, new Uint8Array(bytes));
      // Entries that arrive during a write are combined into the next one.
      waiting ??= (writing ?? Promise.resolve())
        .catch(() => undefined)
        .then(() => {
          waiting = undefined;
          writing = write();
          return writing;
        });
      await waiting;
    },
  };
}

/** Magic, length of the list, the list as JSON, then the bytes of each entry. */
function pack(entries: ReadonlyMap<string, Uint8Array>): Uint8Array {
  const list = new TextEncoder().encode(JSON.stringify(Array.from(entries, ([key, bytes]) => [key, bytes.length])));
  const all = new Uint8Array(8 + list.length + [...entries.values()].reduce((sum, { length }) => sum + length, 0));
  const view = new DataView(all.buffer);
  view.setUint32(0, MAGIC, true);
  view.setUint32(4, list.length, true);
  all.set(list, 8);
  let at = 8 + list.length;
  for (const bytes of entries.values()) {
    all.set(bytes, at);
    at += bytes.length;
  }
  return all;
}

function unpack(all: Uint8Array): Map<string, Uint8Array> {
  const entries = new Map<string, Uint8Array>();
  try {
    const view = new DataView(all.buffer, all.byteOffset, all.byteLength);
    if (view.getUint32(0, true) !== MAGIC) return entries;
    let at = 8 + view.getUint32(4, true);
    const list: unknown = JSON.parse(new TextDecoder().decode(all.subarray(8, at)));
    for (const [key, length] of list as [string, number][]) {
      if (at + length > all.length) break;
      entries.set(key, all.subarray(at, (at += length)));
    }
  } catch {
    // Damaged: what was understood so far is kept, and each entry is checked again when it is used.
  }
  return entries;
}
