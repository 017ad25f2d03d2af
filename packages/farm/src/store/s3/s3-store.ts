import { mkdir, rename, rm, stat } from 'node:fs/promises';
import { dirname, join } from 'node:path';
import { FarmError } from '../../error';
import type { Destination, JobResult } from '../../job';
import { bundleFiles, bundleText, checked, hashOf } from '../content';
import { deliverFiles } from '../deliver';
import { copyWhole, hashFile } from '../files';
import { FolderStore } from '../folder-store';
import type { BundleFile, Cleaned, FarmStore, StoreAddress } from '../store';
import { Bucket } from './bucket';
import type { S3Module } from './s3-module';

/** Uses are noted so often. */
const USE_MS = 3_600_000;
/** What was downloaded is kept on this machine for so long after its last use. */
const CACHE_MS = 30 * 86_400_000;
/** Requests to delete at the same time. */
const PARALLEL = 8;

const exists = (path: string) =>
  stat(path).then(
    () => true,
    () => false,
  );

/**
 * A store in a bucket of S3, or of a server that is compatible with it. What was read or written is kept in a folder of
 * this machine, so that the next job of the same scene downloads nothing.
 *
 * | key | holds |
 * |---|---|
 * | `objects/XX/SHA-256` | content: files of models and of results |
 * | `results/XX/ID.json` | a finished job, with the hashes of its files; written last |
 * | `checkpoints/ID.film` | films of jobs that were given back |
 * | `hierarchies/XX/KEY` | what was built of meshes |
 *
 * A result counts when its `.json` is there, and the first one stays where the server knows `If-None-Match`; otherwise
 * one of those that are written at the same moment. Its files are content by SHA-256, so that it is never a mixture.
 */
export class S3Store implements FarmStore {
  readonly address: StoreAddress;
  readonly #bucket: Bucket;
  /** What this machine has of it. */
  readonly #local: FolderStore;
  /** When the use of a key was noted last by this process. */
  readonly #noted = new Map<string, number>();

  private constructor(address: StoreAddress, bucket: Bucket, local: FolderStore) {
    this.address = address;
    this.#bucket = bucket;
    this.#local = local;
  }

  /**
   * Connects to a bucket.
   *
   * @param address With `cache`.
   * @param s3 `@aws-sdk/client-s3`. Default: imported.
   * @throws {FarmError} `farm/missing-package`, `farm/option`, `farm/store-access` (there is no such bucket, or access is
   * denied), `farm/store`
   */
  static async open(address: StoreAddress, s3?: S3Module): Promise<S3Store> {
    const { url, endpoint, cache } = address;
    if (cache === undefined)
      throw new FarmError('farm/option', 'A store in a bucket needs a folder on this machine: name it by cache.');
    // Each bucket has its own, whatever the folder is called.
    const local = new FolderStore(join(cache, hashOf(JSON.stringify([url, endpoint])).slice(0, 16)));
    return new S3Store(address, await Bucket.open(url, endpoint, s3), local);
  }

  /** Whether there is an object. Notes that it was used, once an hour, for {@link clean}. */
  async #used(key: string): Promise<boolean> {
    const now = Date.now();
    if (now - (this.#noted.get(key) ?? -Infinity) < USE_MS) return true;
    const found = await this.#bucket.head(key);
    if (!found || (now - found.modified > USE_MS && !(await this.#bucket.touch(key, found)))) return false;
    this.#noted.set(key, now);
    return true;
  }

  async put(content: Uint8Array | string): Promise<string> {
    const bytes = typeof content === 'string' ? new TextEncoder().encode(content) : content;
    const hash = await this.#local.put(bytes);
    const key = objectKey(hash);
    if (!(await this.#used(key))) {
      await this.#bucket.put(key, bytes);
      this.#noted.set(key, Date.now());
    }
    return hash;
  }

  async putFile(path: string): Promise<string> {
    const hash = await this.#local.putFile(path);
    await this.#upload(hash);
    return hash;
  }

  /** Uploads an object that this machine has. */
  async #upload(hash: string): Promise<void> {
    const key = objectKey(hash);
    if (await this.#used(key)) return;
    await this.#bucket.putFile(key, this.#local.objectPath(hash));
    this.#noted.set(key, Date.now());
  }

  /** Downloads an object unless this machine has it. Gives its path. */
  async #object(hash: string): Promise<string> {
    const path = this.#local.objectPath(hash);
    const key = objectKey(hash);
    if (await exists(path)) {
      await this.#used(key);
      return path;
    }
    if (!(await this.#bucket.download(key, path, hash)))
      throw new FarmError('farm/missing-file', `${this.address.url} has no object ${hash}.`);
    await this.#used(key);
    return path;
  }

  async read(hash: string): Promise<Uint8Array> {
    const path = await this.#object(hash);
    return this.#local.read(hash).catch(async () => {
      // The copy on this machine is damaged.
      await rm(path, { force: true });
      await this.#object(hash);
      return this.#local.read(hash);
    });
  }

  async putBundle(files: readonly BundleFile[]): Promise<string> {
    bundleText(files.map(({ name }) => [name, '']));
    const list: [string, string][] = [];
    for (const { name, path } of files) list.push([name, await this.putFile(path)]);
    return this.put(bundleText(list));
  }

  async bundle(hash: string): Promise<string> {
    for (const [, object] of bundleFiles(await this.read(hash), hash)) await this.#object(object);
    return this.#local.bundle(hash);
  }

  async result(id: string): Promise<JobResult | undefined> {
    const key = resultKey(id);
    const found = await this.#bucket.get(key);
    if (!found) return undefined;
    const result = JSON.parse(new TextDecoder().decode(found.content)) as JobResult;
    if (Date.now() - found.modified < USE_MS) return result;
    // Files first: they are not older than what lists them.
    for (const { sha256 } of result.files) {
      if (await this.#used(objectKey(sha256))) continue;
      await this.#bucket.remove(key);
      return undefined;
    }
    await this.#bucket.touch(key, found);
    return result;
  }

  async resultFile(id: string, name: string): Promise<string> {
    const file = (await this.result(id))?.files.find((one) => one.name === name);
    if (!file) throw new FarmError('farm/missing-file', `${this.address.url} has no file "${name}" of the job ${id}.`);
    return this.#object(file.sha256);
  }

  begin(id: string): Promise<string> {
    return this.#local.begin(id);
  }

  async commit(
    folder: string,
    result: Omit<JobResult, 'files'>,
    names: readonly string[],
    hashes: Readonly<Record<string, string>> = {},
  ): Promise<boolean> {
    const files: JobResult['files'][number][] = [];
    for (const name of names) {
      const path = join(folder, name);
      const sha256 = hashes[name] ?? (await hashFile(path));
      files.push({ name, bytes: (await stat(path)).size, sha256 });
      const object = this.#local.objectPath(sha256);
      await mkdir(dirname(object), { recursive: true });
      await rename(path, object);
      // What is there may be old: it must not be deleted before the result that lists it.
      const there = await this.#bucket.head(objectKey(sha256));
      if (!there || !(await this.#bucket.touch(objectKey(sha256), there)))
        await this.#bucket.putFile(objectKey(sha256), object);
    }
    const content = new TextEncoder().encode(JSON.stringify({ ...result, files } satisfies JobResult));
    const first = await this.#bucket.putFirst(resultKey(result.id), content);
    await rm(folder, { recursive: true, force: true });
    return first;
  }

  async checkpoint(id: string): Promise<string> {
    const path = await this.#local.checkpoint(id);
    const [there, here] = await Promise.all([this.#bucket.head(checkpointKey(id)), stat(path).catch(() => undefined)]);
    if (there && (!here || here.mtimeMs < there.modified)) await this.#bucket.download(checkpointKey(id), path);
    return path;
  }

  async keepCheckpoint(id: string): Promise<void> {
    const path = await this.#local.checkpoint(id);
    if (await exists(path)) await this.#bucket.putFile(checkpointKey(id), path);
  }

  async dropCheckpoint(id: string): Promise<void> {
    await this.#local.dropCheckpoint(id);
    await this.#bucket.remove(checkpointKey(id));
  }

  deliver(result: JobResult, destination: Destination): Promise<void> {
    return deliverFiles(result, destination, async ({ name, sha256 }, target) => {
      const path = this.#local.objectPath(sha256);
      if (await exists(path)) return copyWhole(path, target);
      // Not kept here: a manifest of all images would fill the disk twice.
      if (!(await this.#bucket.download(objectKey(sha256), target, sha256)))
        throw new FarmError('farm/missing-file', `${this.address.url} has no file "${name}" of ${result.label}.`);
    });
  }

  get hierarchies(): FarmStore['hierarchies'] {
    const key = (hash: string) => `hierarchies/${checked(hash).slice(0, 2)}/${hash}`;
    return {
      get: async (hash) => {
        const here = await this.#local.hierarchies.get(hash);
        if (here) {
          await this.#used(key(hash));
          return here;
        }
        const there = await this.#bucket.get(key(hash));
        if (!there) return undefined;
        const { content } = there;
        await this.#local.hierarchies.set(hash, new Uint8Array(content).buffer);
        await this.#used(key(hash));
        return content;
      },
      set: async (hash, bytes) => {
        await this.#local.hierarchies.set(hash, bytes);
        if (await this.#used(key(hash))) return;
        await this.#bucket.put(key(hash), new Uint8Array(bytes));
        this.#noted.set(key(hash), Date.now());
      },
    };
  }

  /**
   * See `FarmStore.clean`. A use is noted once an hour, so that what is deleted was not used for the time and up to an
   * hour more. Deletes from the bucket, and from what this machine has of it.
   */
  async clean(olderThanMs: number, now = Date.now()): Promise<Cleaned> {
    const before = now - Math.max(0, olderThanMs) - USE_MS;
    let entries = 0;
    let bytes = 0;
    const old: string[] = [];
    for (const kind of ['results', 'objects', 'hierarchies', 'checkpoints'])
      for await (const entry of this.#bucket.list(`${kind}/`)) {
        if (entry.modified >= before) continue;
        old.push(entry.key);
        entries++;
        bytes += entry.bytes;
      }
    const remove = async () => {
      for (let key = old.shift(); key !== undefined; key = old.shift()) {
        await this.#bucket.remove(key);
        this.#noted.delete(key);
      }
    };
    await Promise.all(Array.from({ length: PARALLEL }, remove));
    await this.#local.clean(olderThanMs, now);
    return { entries, bytes };
  }

  /** Also deletes what this machine has downloaded and not used for 30 days. */
  async sweep(now = Date.now()): Promise<void> {
    await this.#local.sweep(now);
    await this.#local.clean(CACHE_MS, now);
  }
}

const objectKey = (hash: string) => `objects/${checked(hash).slice(0, 2)}/${hash}`;
const resultKey = (id: string) => `results/${checked(id).slice(0, 2)}/${id}.json`;
const checkpointKey = (id: string) => `checkpoints/${checked(id)}.film`;
