import type { BlasStore } from './cache';

/** Options for {@link openIndexedDbStore}. */
export interface IndexedDbStoreOptions {
  /** Name of the database. Default `glanz-bvh`. */
  readonly name?: string;
  /** Beyond this many bytes, the least recently used hierarchies are evicted. Default 256 MiB. */
  readonly maxBytes?: number;
  /** Default: the browser's. */
  readonly indexedDB?: IDBFactory;
}

/** A {@link BlasStore} in the browser's database. */
export interface IndexedDbStore extends BlasStore {
  /** Deletes all entries. */
  clear(): Promise<void>;
  /** Closes the connection; the store cannot be used afterwards. */
  close(): void;
}

interface Entry {
  readonly key: string;
  readonly bytes: number;
  /** Grows with each use. */
  readonly used: number;
}

const TREES = 'trees',
  ENTRIES = 'entries';

const done = <T>(request: IDBRequest<T>): Promise<T> =>
  new Promise((resolve, reject) => {
    request.onsuccess = () => resolve(request.result);
    request.onerror = () => reject(request.error as Error);
  });

const finished = (transaction: IDBTransaction): Promise<void> =>
  new Promise((resolve, reject) => {
    transaction.oncomplete = () => resolve();
    transaction.onabort = transaction.onerror = () => reject(transaction.error as Error);
  });

/**
 * Opens a store of hierarchies in the browser's database, for `BlasCache` of `@glanz/bvh/cache`. Works in pages and
 * workers.
 *
 * @throws the database's error where there is none or it may not be used (some private windows).
 */
export async function openIndexedDbStore({
  name = 'glanz-bvh',
  maxBytes = 256 * 2 ** 20,
  indexedDB = globalThis.indexedDB,
}: IndexedDbStoreOptions = {}): Promise<IndexedDbStore> {
  const opening = indexedDB.open(name, 1);
  opening.onupgradeneeded = () => {
    opening.result.createObjectStore(TREES);
    opening.result.createObjectStore(ENTRIES, { keyPath: 'key' });
  };
  const database = await done(opening);
  // Another page may want to delete or change the database.
  database.onversionchange = () => database.close();
  return {
    async get(key) {
      const transaction = database.transaction([TREES, ENTRIES], 'readwrite');
      const entries = transaction.objectStore(ENTRIES);
      const [bytes, entry] = await Promise.all([
        done(transaction.objectStore(TREES).get(key) as IDBRequest<ArrayBuffer | undefined>),
        done(entries.get(key) as IDBRequest<Entry | undefined>),
      ]);
      if (entry) entries.put({ ...entry, used: Date.now() });
      return bytes;
    },
    async set(key, bytes) {
      const transaction = database.transaction([TREES, ENTRIES], 'readwrite');
      const trees = transaction.objectStore(TREES),
        entries = transaction.objectStore(ENTRIES);
      const end = finished(transaction);
      const others = ((await done(entries.getAll())) as Entry[])
        .filter((entry) => entry.key !== key)
        .sort((a, b) => a.used - b.used);
      let total = bytes.byteLength + others.reduce((sum, entry) => sum + entry.bytes, 0);
      for (const entry of others) {
        if (total <= maxBytes) break;
        trees.delete(entry.key);
        entries.delete(entry.key);
        total -= entry.bytes;
      }
      if (total <= maxBytes) {
        trees.put(bytes, key);
        entries.put({ key, bytes: bytes.byteLength, used: Date.now() } satisfies Entry);
      }
      await end;
    },
    async clear() {
      const transaction = database.transaction([TREES, ENTRIES], 'readwrite');
      transaction.objectStore(TREES).clear();
      transaction.objectStore(ENTRIES).clear();
      await finished(transaction);
    },
    close: () => database.close(),
  };
}
