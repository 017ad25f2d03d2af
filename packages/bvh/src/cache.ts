import type { Blas, BlasOptions } from './blas';
import type { TriangleMesh } from './layout';
import { deserializeBlas, serializeBlas, SERIALIZED_VERSION } from './serialize';

/**
 * Storage for hierarchies: IndexedDB (`@glanz/bvh/indexed-db`), a file (`@glanz/bvh/node`), your server.
 */
export interface BlasStore {
  /** The bytes last set for a key; undefined if there are none. */
  get(key: string): Promise<ArrayBuffer | Uint8Array | undefined>;
  /** Stores bytes; may evict older ones. */
  set(key: string, bytes: ArrayBuffer): Promise<void>;
}

/** What a {@link BlasCache} passes on, besides the options of `buildBlas`. */
export interface CacheBuildOptions extends BlasOptions {
  /** Cancels: the promise rejects with the signal's reason. */
  readonly signal?: AbortSignal | undefined;
  /** Called with the completed fraction, 0 to 1. */
  readonly onProgress?: ((done: number) => void) | undefined;
}

/** Builds what is not in the cache: `BvhWorkers` of `@glanz/bvh/workers`, or `{ buildBlas }`. */
export interface BlasSource {
  buildBlas(mesh: TriangleMesh, options: CacheBuildOptions): Promise<Blas> | Blas;
}

/** Options for {@link BlasCache}. */
export interface BlasCacheOptions {
  /** Meshes with fewer triangles are built each time, which takes no longer than looking them up. Default 20,000. */
  readonly minTriangles?: number;
  /** Called with every error of the store; builds continue without it. Default: errors are ignored. */
  readonly onError?: ((error: unknown) => void) | undefined;
}

/**
 * The key of a mesh's hierarchy: SHA-256 of the positions, the indices, the options and the version of the format, as
 * hex digits. Undefined where there is no Web Crypto (insecure contexts).
 */
export async function blasKey(mesh: TriangleMesh, options: BlasOptions = {}): Promise<string | undefined> {
  const subtle = globalThis.crypto?.subtle;
  if (!subtle) return undefined;
  const digest = async (bytes: Uint8Array) =>
    new Uint8Array(
      await subtle.digest(
        'SHA-256',
        bytes.buffer instanceof ArrayBuffer ? (bytes as Uint8Array<ArrayBuffer>) : new Uint8Array(bytes),
      ),
    );
  const raw = (array: Float32Array | Uint32Array | Uint16Array) =>
    new Uint8Array(array.buffer, array.byteOffset, array.byteLength);
  const { positions, indices } = mesh;
  // A builder from an entry of its own is an object with a name.
  const named = { ...options, builder: typeof options.builder === 'object' ? options.builder.name : options.builder };
  const own = Object.entries(named)
    .filter(([, value]) => value !== undefined && typeof value !== 'object' && typeof value !== 'function')
    .sort(([a], [b]) => (a < b ? -1 : 1));
  const text = JSON.stringify([SERIALIZED_VERSION, positions.length, indices?.length, indices?.BYTES_PER_ELEMENT, own]);
  const parts = await Promise.all([
    digest(raw(positions)),
    digest(indices ? raw(indices) : new Uint8Array(0)),
    digest(new TextEncoder().encode(text)),
  ]);
  const all = new Uint8Array(96);
  parts.forEach((part, i) => all.set(part, 32 * i));
  return Array.from(await digest(all), (byte) => byte.toString(16).padStart(2, '0')).join('');
}

/**
 * Caches hierarchies in a store: one that was built before for the same mesh and options is read instead. It has the
 * `buildBlas` of `BvhWorkers` and can replace it, for example as the `hierarchies` of `PathTracer.create`. Stored bytes
 * are validated; where they are damaged or the store fails, the hierarchy is built.
 *
 * @example
 * const workers = await BvhWorkers.create();
 * const hierarchies = new BlasCache(await openIndexedDbStore(), workers);
 * const tracer = await PathTracer.create(device, scene, { width, height, hierarchies });
 */
export class BlasCache {
  /** Hierarchies read from the store so far. */
  hits = 0;
  /** Hierarchies built so far, small ones included. */
  misses = 0;
  readonly #store: BlasStore;
  readonly #builder: BlasSource;
  readonly #minTriangles: number;
  readonly #onError: ((error: unknown) => void) | undefined;
  readonly #writing = new Set<Promise<void>>();

  constructor(store: BlasStore, builder: BlasSource, { minTriangles = 20_000, onError }: BlasCacheOptions = {}) {
    this.#store = store;
    this.#builder = builder;
    this.#minTriangles = minTriangles;
    this.#onError = onError;
  }

  /**
   * The hierarchy of a mesh, read or built. The mesh must not change until the promise settles. Options are passed to
   * the builder.
   *
   * @throws What the builder throws, or the signal's reason when aborted.
   */
  async buildBlas(mesh: TriangleMesh, options: CacheBuildOptions = {}): Promise<Blas> {
    const { signal, onProgress, ...own } = options;
    signal?.throwIfAborted();
    const triangles = Math.floor((mesh.indices?.length ?? mesh.positions.length / 3) / 3);
    const key = triangles < this.#minTriangles ? undefined : await this.#attempt(() => blasKey(mesh, own));
    signal?.throwIfAborted();
    if (key !== undefined) {
      const kept = await this.#attempt(async () => {
        const bytes = await this.#store.get(key);
        return bytes && deserializeBlas(bytes, mesh);
      });
      signal?.throwIfAborted();
      if (kept) {
        this.hits++;
        onProgress?.(1);
        return kept;
      }
    }
    const blas = await this.#builder.buildBlas(mesh, options);
    this.misses++;
    if (key !== undefined) this.#keep(key, blas);
    return blas;
  }

  /**
   * Resolves when every hierarchy built so far has been written, or its write has failed. Await it before a process
   * ends.
   */
  async written(): Promise<void> {
    while (this.#writing.size > 0) await Promise.all(this.#writing);
  }

  #keep(key: string, blas: Blas): void {
    const bytes = serializeBlas(blas);
    const writing: Promise<void> = this.#attempt(() => this.#store.set(key, bytes)).then(
      () => void this.#writing.delete(writing),
    );
    this.#writing.add(writing);
  }

  async #attempt<T>(step: () => Promise<T>): Promise<T | undefined> {
    try {
      return await step();
    } catch (error) {
      this.#onError?.(error);
      return undefined;
    }
  }
}
