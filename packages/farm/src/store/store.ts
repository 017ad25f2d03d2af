import type { Destination, JobResult } from '../job';

/** A file of a bundle: its name within the bundle, and where its bytes are. */
export interface BundleFile {
  /** With slashes, without `..`. */
  readonly name: string;
  readonly path: string;
}

/** Where a store is: plain data, which a worker passes to its renderer's process. */
export interface StoreAddress {
  /** A folder, or `s3://bucket/prefix`. */
  readonly url: string;
  /** Of a store in a bucket: the server, if it is not that of AWS, such as `http://127.0.0.1:9000`. */
  readonly endpoint?: string | undefined;
  /** Of a store in a bucket: the folder on this machine for what was downloaded. Needed there. */
  readonly cache?: string | undefined;
}

/** What {@link FarmStore.clean} has deleted. */
export interface Cleaned {
  readonly entries: number;
  readonly bytes: number;
}

/**
 * Content by its SHA-256, bundles of files, results and checkpoints of jobs, where all machines find them: in a folder
 * that they share (`FolderStore`), or in a bucket (`S3Store`). All paths that a store returns are of this machine.
 *
 * A result appears as a whole, and stays: of two workers that finish the same job, the second one's files are dropped.
 * All methods throw `FarmError` with the codes `farm/store` and `farm/store-access`.
 */
export interface FarmStore {
  readonly address: StoreAddress;
  /** Keeps bytes. Gives their SHA-256. */
  put(content: Uint8Array | string): Promise<string>;
  /** Keeps a copy of a file. Gives its SHA-256. */
  putFile(path: string): Promise<string>;
  /** The bytes of content. @throws {FarmError} `farm/store` if they are not there, or are others */
  read(hash: string): Promise<Uint8Array>;
  /** Keeps files that belong together. Gives the bundle's hash, which depends on names and contents alone. */
  putBundle(files: readonly BundleFile[]): Promise<string>;
  /** A folder with the files of a bundle. They are not to be changed. */
  bundle(hash: string): Promise<string>;
  /** The result of a finished job; `undefined` if it is not finished, or a file of it is missing. */
  result(id: string): Promise<JobResult | undefined>;
  /** The path of a file of a finished job. It is not to be changed. */
  resultFile(id: string, name: string): Promise<string>;
  /** An empty folder for the files of a job that begins. */
  begin(id: string): Promise<string>;
  /**
   * Makes the files of a working folder the result of its job, and deletes the folder.
   *
   * @param names The files.
   * @param hashes SHA-256, hexadecimal, of files that were hashed while they were written; others are hashed here.
   * @returns Whether this is the first result of the job; otherwise the files are dropped.
   */
  commit(
    folder: string,
    result: Omit<JobResult, 'files'>,
    names: readonly string[],
    hashes?: Readonly<Record<string, string>>,
  ): Promise<boolean>;
  /** Path of the samples of a job that was returned to the queue; the file exists if it was returned before. */
  checkpoint(id: string): Promise<string>;
  /** Lets other machines have the samples in the file of {@link checkpoint}, if there is one. */
  keepCheckpoint(id: string): Promise<void>;
  /** Deletes the samples of a job that is finished. */
  dropCheckpoint(id: string): Promise<void>;
  /**
   * Copies the files of a result to their destinations; existing files are not changed.
   *
   * @throws {FarmError} `farm/store` for paths outside of the root, too few paths, and files that cannot be written
   */
  deliver(result: JobResult, destination: Destination): Promise<void>;
  /** Hierarchies by their keys, for a `BlasCache` of `@glanz/bvh/cache`. */
  readonly hierarchies: {
    get(key: string): Promise<Uint8Array | undefined>;
    set(key: string, bytes: ArrayBuffer): Promise<void>;
  };
  /**
   * Deletes what was not used for some time: results, checkpoints, models with their files, hierarchies. What is still
   * needed is made again, except for models and options of jobs that have waited longer in a queue, which then fail and
   * are to be submitted again.
   *
   * @param olderThanMs Milliseconds.
   * @param now Milliseconds since 1970. Default: the time of this machine.
   */
  clean(olderThanMs: number, now?: number): Promise<Cleaned>;
  /** Deletes from this machine what workers that were killed have left. */
  sweep(now?: number): Promise<void>;
}
