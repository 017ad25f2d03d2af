import { randomBytes } from 'node:crypto';
import { mkdir, readFile, readdir, rename, rm, stat, utimes } from 'node:fs/promises';
import { basename, join, resolve } from 'node:path';
import { FarmError } from '../error';
import type { Destination, JobResult } from '../job';
import { bundleFiles, bundleText, checked, hashOf } from './content';
import { deliverFiles } from './deliver';
import { copyWhole, hashFile, partialOf, writeWhole } from './files';
import type { BundleFile, Cleaned, FarmStore, StoreAddress } from './store';

const DAY_MS = 86_400_000;
/** Uses are noted so often: the unit of `glanz farm clean --older-than`. */
const USE_MS = 60_000;

/**
 * Content by its SHA-256, bundles of files, results and checkpoints of jobs, in a folder that all machines see.
 *
 * | folder | holds |
 * |---|---|
 * | `objects` | content, under its SHA-256 |
 * | `bundles` | models with their files, as renderers read them, made from objects when they are first needed |
 * | `results` | a folder for each finished job: its files and `result.json` |
 * | `working` | files of jobs that are being rendered |
 * | `checkpoints` | films of jobs that were given back |
 * | `hierarchies` | what was built of meshes, under their SHA-256, so that workers do not build it again |
 * | `batches` | what was submitted, a line of JSON for each image |
 *
 * A result appears as a whole, by the renaming of its folder, and stays: of two workers that finish the same job, the
 * second one's files are dropped.
 */
export class FolderStore implements FarmStore {
  /** Absolute. */
  readonly folder: string;

  constructor(folder: string) {
    this.folder = resolve(folder);
  }

  get address(): StoreAddress {
    return { url: this.folder };
  }

  /** Where the content with a hash is. */
  objectPath(hash: string): string {
    return join(this.folder, 'objects', checked(hash).slice(0, 2), hash);
  }

  /** Keeps bytes. Gives their SHA-256. */
  async put(content: Uint8Array | string): Promise<string> {
    const hash = hashOf(content);
    const file = this.objectPath(hash);
    if (!(await used(file))) await writeWhole(file, content);
    return hash;
  }

  /** Keeps a copy of a file. Gives its SHA-256. */
  async putFile(path: string): Promise<string> {
    const hash = await hashFile(path);
    const file = this.objectPath(hash);
    if (!(await used(file))) {
      await copyWhole(path, file);
      // It may have been written to while it was copied.
      if ((await hashFile(file)) !== hash) {
        await rm(file, { force: true });
        throw new FarmError('farm/store', `"${path}" changed while it was copied into the store.`);
      }
    }
    return hash;
  }

  /** The bytes of content. @throws {FarmError} `farm/missing-file` if they are not there, or are others */
  async read(hash: string): Promise<Uint8Array> {
    const file = this.objectPath(hash);
    const bytes = await readFile(file).catch((cause: NodeJS.ErrnoException) => {
      const code = cause.code === 'ENOENT' ? 'farm/missing-file' : 'farm/store';
      throw new FarmError(code, `The store has no object ${hash}: ${cause.message}.`, { cause });
    });
    if (hashOf(bytes) !== hash)
      throw new FarmError('farm/missing-file', `The object ${hash} is damaged: delete "${file}" and submit again.`);
    return bytes;
  }

  /** Keeps files that belong together. Gives the bundle's hash, which depends on names and contents alone. */
  async putBundle(files: readonly BundleFile[]): Promise<string> {
    // Names are checked before anything is copied.
    bundleText(files.map(({ name }) => [name, '']));
    const list: [string, string][] = [];
    for (const { name, path } of files) list.push([name, await this.putFile(path)]);
    return this.put(bundleText(list));
  }

  /** A folder with the files of a bundle. They are not to be changed. */
  async bundle(hash: string): Promise<string> {
    const folder = join(this.folder, 'bundles', checked(hash));
    if (await used(folder)) return folder;
    const list = bundleFiles(await this.read(hash), hash);
    const partial = partialOf(folder);
    await mkdir(partial, { recursive: true });
    try {
      for (const [name, object] of list) {
        if (!(await exists(this.objectPath(object))))
          throw new FarmError('farm/missing-file', `The store has no object ${object}: submit again.`);
        await copyWhole(this.objectPath(object), join(partial, name));
        if ((await hashFile(join(partial, name))) !== object)
          throw new FarmError('farm/missing-file', `The object ${object} is damaged: delete it and submit again.`);
      }
      await renameUnlessThere(partial, folder);
    } finally {
      await rm(partial, { recursive: true, force: true });
    }
    return folder;
  }

  /** The folder of a job's result. */
  resultFolder(id: string): string {
    return join(this.folder, 'results', checked(id).slice(0, 2), id);
  }

  async resultFile(id: string, name: string): Promise<string> {
    return join(this.resultFolder(id), basename(name));
  }

  /** The result of a finished job; `undefined` if it is not finished, or a file of it is missing. */
  async result(id: string): Promise<JobResult | undefined> {
    const folder = this.resultFolder(id);
    const text = await readFile(join(folder, 'result.json'), 'utf8').catch(() => undefined);
    if (text === undefined) return undefined;
    const result = JSON.parse(text) as JobResult;
    const sizes = await Promise.all(
      result.files.map(({ name }) =>
        stat(join(folder, name)).then(
          ({ size }) => size,
          () => -1,
        ),
      ),
    );
    if (result.files.every(({ bytes }, i) => sizes[i] === bytes)) {
      await used(folder);
      return result;
    }
    // A file was taken away by hand: the job is to be done again.
    await rm(folder, { recursive: true, force: true });
    return undefined;
  }

  /** An empty folder for the files of a job that begins. */
  async begin(id: string): Promise<string> {
    const folder = join(this.folder, 'working', `${checked(id)}.${process.pid}-${randomBytes(4).toString('hex')}`);
    await mkdir(folder, { recursive: true });
    return folder;
  }

  /**
   * Makes a working folder the result of its job.
   *
   * @returns Whether this is the first one; otherwise the folder is deleted.
   */
  async commit(
    folder: string,
    result: Omit<JobResult, 'files'>,
    names: readonly string[],
    hashes: Readonly<Record<string, string>> = {},
  ): Promise<boolean> {
    const files = await Promise.all(
      names.map(async (name) => {
        const { size } = await stat(join(folder, name));
        return { name, bytes: size, sha256: hashes[name] ?? (await hashFile(join(folder, name))) };
      }),
    );
    await writeWhole(join(folder, 'result.json'), JSON.stringify({ ...result, files } satisfies JobResult));
    const target = this.resultFolder(result.id);
    await mkdir(join(target, '..'), { recursive: true });
    return renameUnlessThere(folder, target);
  }

  /** Where a job that is given back keeps its samples. */
  async checkpoint(id: string): Promise<string> {
    const folder = join(this.folder, 'checkpoints');
    await mkdir(folder, { recursive: true });
    return join(folder, `${checked(id)}.film`);
  }

  /** Does nothing, since all machines can access the file. */
  async keepCheckpoint(): Promise<void> {}

  async dropCheckpoint(id: string): Promise<void> {
    await rm(await this.checkpoint(id), { force: true });
  }

  /**
   * Copies the files of a result to their destinations; existing files are not changed.
   *
   * @throws {FarmError} `farm/store` for paths outside of the root, too few paths, and files that cannot be written
   */
  deliver(result: JobResult, destination: Destination): Promise<void> {
    return deliverFiles(result, destination, ({ name }, target) =>
      copyWhole(join(this.resultFolder(result.id), name), target),
    );
  }

  /** Hierarchies by their keys, for a `BlasCache` of `@glanz/bvh/cache`. */
  get hierarchies(): {
    get(key: string): Promise<Uint8Array | undefined>;
    set(key: string, bytes: ArrayBuffer): Promise<void>;
  } {
    const path = (key: string) => join(this.folder, 'hierarchies', checked(key).slice(0, 2), key);
    return {
      get: async (key) => ((await used(path(key))) ? readFile(path(key)) : undefined),
      set: async (key, bytes) => {
        if (!(await used(path(key)))) await writeWhole(path(key), new Uint8Array(bytes));
      },
    };
  }

  /**
   * Deletes what was not used for some time: results, checkpoints, models with their files, hierarchies, lists of
   * batches. What is still needed is made again, except for models and options of jobs that have waited longer in a
   * queue, which then fail and are to be submitted again.
   *
   * @param olderThanMs Milliseconds; a use is noted once a minute.
   */
  async clean(olderThanMs: number, now = Date.now()): Promise<Cleaned> {
    const total = { entries: 0, bytes: 0 };
    const before = now - Math.max(0, olderThanMs);
    const remove = async (path: string) => {
      const found = await stat(path).catch(() => undefined);
      if (!found || found.mtimeMs >= before) return;
      total.entries++;
      total.bytes += await sizeOf(path);
      await rm(path, { recursive: true, force: true });
    };
    const names = (folder: string) => readdir(folder).catch(() => []);
    for (const kind of ['bundles', 'checkpoints', 'batches', 'working'])
      for (const name of await names(join(this.folder, kind))) await remove(join(this.folder, kind, name));
    for (const kind of ['results', 'objects', 'hierarchies'])
      for (const group of await names(join(this.folder, kind)))
        for (const name of await names(join(this.folder, kind, group)))
          await remove(join(this.folder, kind, group, name));
    return total;
  }

  /** Deletes what workers that were killed more than a day ago have left. */
  async sweep(now = Date.now()): Promise<void> {
    const folder = join(this.folder, 'working');
    for (const name of await readdir(folder).catch(() => [])) {
      const found = await stat(join(folder, name)).catch(() => undefined);
      if (found && now - found.mtimeMs > DAY_MS) await rm(join(folder, name), { recursive: true, force: true });
    }
  }
}

/** Whether there is such a file or folder. Notes that it was used, once a minute, for {@link FolderStore.clean}. */
async function used(path: string): Promise<boolean> {
  const found = await stat(path).catch(() => undefined);
  const now = Date.now();
  if (found && now - found.mtimeMs > USE_MS) await utimes(path, new Date(now), new Date(now)).catch(() => undefined);
  return found !== undefined;
}

/** Bytes of a file, or of all files of a folder. */
async function sizeOf(path: string): Promise<number> {
  const found = await stat(path).catch(() => undefined);
  if (!found?.isDirectory()) return found?.size ?? 0;
  const names = await readdir(path).catch(() => []);
  const sizes = await Promise.all(names.map((name) => sizeOf(join(path, name))));
  return sizes.reduce((sum, size) => sum + size, 0);
}

const exists = (path: string) =>
  stat(path).then(
    () => true,
    () => false,
  );

/** Renames a folder; where the target is there already, deletes it instead. Gives whether it was renamed. */
async function renameUnlessThere(from: string, to: string): Promise<boolean> {
  try {
    await rename(from, to);
    return true;
  } catch (cause) {
    if (!(await exists(to)))
      throw new FarmError('farm/store', `Cannot write "${to}": ${(cause as Error).message}.`, { cause });
    await rm(from, { recursive: true, force: true });
    return false;
  }
}
