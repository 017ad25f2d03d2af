import { createHash } from 'node:crypto';
import { createWriteStream } from 'node:fs';
import { open } from 'node:fs/promises';
import { Readable } from 'node:stream';
import { pipeline } from 'node:stream/promises';
import { FarmError } from '../../error';
import { replaced } from '../files';
import { isMissing, isThere, isUnknown, s3Error } from './s3-error';
import { importS3, type S3Answer, type S3Module } from './s3-module';

/** An object without its content. */
export interface S3Entry {
  readonly bytes: number;
  /** Milliseconds since 1970, by the server's clock. */
  readonly modified: number;
}

/** Larger files are uploaded in parts of this size. At most 10,000 parts are allowed: 320 GB. */
const PART_BYTES = 32 * 2 ** 20;
/** Parts that are uploaded at the same time. */
const PARALLEL = 4;
/** The largest object that one request copies. */
const MAX_COPY_BYTES = 5 * 2 ** 30;
const TRIES = 3;
const RETRY_MS = 200;

const md5 = (bytes: Uint8Array) => createHash('md5').update(bytes).digest('base64');

interface Place {
  readonly bucket: string;
  /** Empty, or ends in a slash. */
  readonly prefix: string;
}

/** @throws {FarmError} `farm/option` */
function placeOf(url: string, endpoint: string | undefined): Place {
  const [, bucket, path = ''] = /^s3:\/\/([a-z0-9][a-z0-9.-]{1,61}[a-z0-9])(?:\/(.*))?$/.exec(url) ?? [];
  if (bucket === undefined || path.length > 800 || /[\p{Cc}\\]|(^|\/)\.{1,2}(\/|$)/u.test(path))
    throw new FarmError('farm/option', `A store in a bucket is s3://bucket or s3://bucket/prefix, not "${url}".`);
  if (endpoint !== undefined && !/^https?:\/\/[^/]/.test(endpoint))
    throw new FarmError(
      'farm/option',
      `The endpoint of S3 must be like https://s3.example.com or http://127.0.0.1:9000, not "${endpoint}".`,
    );
  const folder = path.replace(/\/+$/, '');
  return { bucket, prefix: folder === '' ? '' : `${folder}/` };
}

/** The requests of a store to a bucket. All keys lie below the prefix of its address. */
export class Bucket {
  readonly url: string;
  readonly #endpoint: string | undefined;
  readonly #bucket: string;
  readonly #prefix: string;
  readonly #s3: S3Module;
  readonly #client: { send(command: never): Promise<unknown> };

  /** See {@link Bucket.open}. */
  private constructor(url: string, endpoint: string | undefined, { bucket, prefix }: Place, s3: S3Module) {
    this.url = url;
    this.#endpoint = endpoint;
    this.#bucket = bucket;
    this.#prefix = prefix;
    this.#s3 = s3;
    this.#client = new s3.S3Client({
      // Servers other than that of AWS may not know newer checksums; content is checked by its SHA-256.
      requestChecksumCalculation: 'WHEN_REQUIRED',
      responseChecksumValidation: 'WHEN_REQUIRED',
      ...(endpoint === undefined
        ? {}
        : { endpoint, forcePathStyle: true, region: process.env['AWS_REGION'] ?? 'us-east-1' }),
    } as never);
  }

  /**
   * Connects to a bucket, and asks for keys that no store has: that it exists and may be read.
   *
   * @throws {FarmError} `farm/missing-package`, `farm/option`, `farm/store-access`, `farm/store`
   */
  static async open(url: string, endpoint: string | undefined, s3?: S3Module): Promise<Bucket> {
    const place = placeOf(url, endpoint);
    const bucket = new Bucket(url, endpoint, place, s3 ?? (await importS3()));
    await bucket.#run('list it', bucket.#s3.ListObjectsV2Command, {
      Prefix: `${bucket.#prefix}connected`,
      MaxKeys: 1,
    });
    return bucket;
  }

  /** @param key Of the object; `undefined` for requests about the bucket. */
  async #send(Command: new (input: never) => unknown, input: object, key?: string): Promise<S3Answer> {
    const all = { Bucket: this.#bucket, ...(key === undefined ? {} : { Key: this.#prefix + key }), ...input };
    return (await this.#client.send(new Command(all as never) as never)) as S3Answer;
  }

  async #run(what: string, Command: new (input: never) => unknown, input: object, key?: string): Promise<S3Answer> {
    return this.#send(Command, input, key).catch((cause: unknown) => {
      throw s3Error(cause, what, this.url, this.#endpoint);
    });
  }

  /** What is known of an object; `undefined` if there is none. */
  async head(key: string): Promise<S3Entry | undefined> {
    try {
      return entryOf(await this.#send(this.#s3.HeadObjectCommand, {}, key));
    } catch (cause) {
      if (isMissing(cause)) return undefined;
      throw s3Error(cause, `read "${key}"`, this.url, this.#endpoint);
    }
  }

  /** Sets the time of an object to now, by copying it onto itself. Gives whether it is there. */
  async touch(key: string, { bytes }: Pick<S3Entry, 'bytes'>): Promise<boolean> {
    if (bytes > MAX_COPY_BYTES) return true;
    const path = encodeURIComponent(`${this.#bucket}/${this.#prefix}${key}`).replaceAll('%2F', '/');
    try {
      const input = { CopySource: path, MetadataDirective: 'REPLACE', Metadata: { used: String(Date.now()) } };
      await this.#send(this.#s3.CopyObjectCommand, input, key);
      return true;
    } catch (cause) {
      if (isMissing(cause)) return false;
      throw s3Error(cause, `note the use of "${key}"`, this.url, this.#endpoint);
    }
  }

  /** Writes an object, which appears whole or not at all. */
  async put(key: string, content: Uint8Array): Promise<void> {
    await this.#run(
      `write "${key}"`,
      this.#s3.PutObjectCommand,
      { Body: content, ContentLength: content.length, ContentMD5: md5(content) },
      key,
    );
  }

  /**
   * Writes an object unless there is one. Servers that do not know the condition are asked first, so that of two
   * writers at the same moment the later one may win.
   *
   * @returns Whether it was written.
   */
  async putFirst(key: string, content: Uint8Array): Promise<boolean> {
    if (await this.head(key)) return false;
    const input = { Body: content, ContentLength: content.length, ContentMD5: md5(content) };
    try {
      await this.#send(this.#s3.PutObjectCommand, { ...input, IfNoneMatch: '*' }, key);
      return true;
    } catch (cause) {
      if (isThere(cause)) return false;
      if (!isUnknown(cause)) throw s3Error(cause, `write "${key}"`, this.url, this.#endpoint);
    }
    await this.put(key, content);
    return true;
  }

  /** Writes the content of a file to an object, which appears whole or not at all. */
  async putFile(key: string, path: string): Promise<void> {
    const file = await open(path, 'r');
    try {
      const { size } = await file.stat();
      const read = async (at: number) => {
        const bytes = new Uint8Array(Math.min(PART_BYTES, size - at));
        for (let done = 0; done < bytes.length;) {
          const { bytesRead } = await file.read(bytes, done, bytes.length - done, at + done);
          if (bytesRead === 0) throw new FarmError('farm/store', `"${path}" changed while it was uploaded.`);
          done += bytesRead;
        }
        return bytes;
      };
      if (size <= PART_BYTES) await this.put(key, await read(0));
      else await this.#putParts(key, size, read);
    } finally {
      await file.close();
    }
  }

  async #putParts(key: string, size: number, read: (at: number) => Promise<Uint8Array>): Promise<void> {
    const what = `write "${key}"`;
    const { UploadId } = await this.#run(what, this.#s3.CreateMultipartUploadCommand, {}, key);
    const parts: { PartNumber: number; ETag: string | undefined }[] = [];
    const count = Math.ceil(size / PART_BYTES);
    let next = 0;
    const upload = async () => {
      for (let i = next++; i < count; i = next++) {
        const bytes = await read(i * PART_BYTES);
        const input = { UploadId, PartNumber: i + 1, Body: bytes, ContentLength: bytes.length, ContentMD5: md5(bytes) };
        const { ETag } = await this.#run(what, this.#s3.UploadPartCommand, input, key);
        parts[i] = { PartNumber: i + 1, ETag };
      }
    };
    try {
      const ends = await Promise.allSettled(Array.from({ length: PARALLEL }, upload));
      for (const end of ends) if (end.status === 'rejected') throw end.reason;
      await this.#run(
        what,
        this.#s3.CompleteMultipartUploadCommand,
        { UploadId, MultipartUpload: { Parts: parts } },
        key,
      );
    } catch (error) {
      // Its parts would be kept, and cost.
      await this.#send(this.#s3.AbortMultipartUploadCommand, { UploadId }, key).catch(() => undefined);
      throw error;
    }
  }

  /** The content of a small object and its time; `undefined` if there is none. */
  async get(key: string): Promise<(S3Entry & { readonly content: Uint8Array }) | undefined> {
    return this.#received(key, async (answer) => {
      const chunks: Uint8Array[] = [];
      for await (const chunk of answer.Body ?? []) chunks.push(chunk);
      const content = Buffer.concat(chunks);
      const entry = entryOf(answer);
      if (content.length !== entry.bytes) throw new Error(`${content.length} of ${entry.bytes} bytes came`);
      return { ...entry, content };
    });
  }

  /**
   * Downloads an object to a file, which appears whole or not at all.
   *
   * @param hash The SHA-256 that the content must have. Default: any.
   * @returns Whether there is such an object.
   */
  async download(key: string, file: string, hash?: string): Promise<boolean> {
    const done = await this.#received(key, async (answer) => {
      const sha256 = createHash('sha256');
      let bytes = 0;
      const hashed = async function* () {
        for await (const chunk of answer.Body ?? []) {
          sha256.update(chunk);
          bytes += chunk.length;
          yield chunk;
        }
      };
      await replaced(file, async (partial) => {
        await pipeline(Readable.from(hashed()), createWriteStream(partial, { flags: 'wx' }));
        if (bytes !== answer.ContentLength) throw new Error(`${bytes} of ${answer.ContentLength} bytes came`);
        if (hash !== undefined && sha256.digest('hex') !== hash)
          throw new Error(`the object "${key}" is damaged; delete it and submit again`);
      });
      return true;
    });
    return done ?? false;
  }

  /** Requests an object, and again if its content does not come to the end. */
  async #received<T>(key: string, receive: (answer: S3Answer) => Promise<T>): Promise<T | undefined> {
    for (let tries = 1; ; tries++) {
      let answer: S3Answer;
      try {
        answer = await this.#send(this.#s3.GetObjectCommand, {}, key);
      } catch (cause) {
        if (isMissing(cause)) return undefined;
        throw s3Error(cause, `read "${key}"`, this.url, this.#endpoint);
      }
      try {
        return await receive(answer);
      } catch (cause) {
        if (tries >= TRIES) throw s3Error(cause, `read "${key}"`, this.url, this.#endpoint);
        await new Promise((done) => setTimeout(done, RETRY_MS * tries));
      }
    }
  }

  /** All objects whose keys begin with a text. */
  async *list(prefix: string): AsyncGenerator<S3Entry & { readonly key: string }> {
    for (let token: string | undefined; ;) {
      const { Contents = [], NextContinuationToken } = await this.#run('list it', this.#s3.ListObjectsV2Command, {
        Prefix: this.#prefix + prefix,
        ...(token === undefined ? {} : { ContinuationToken: token }),
      });
      for (const { Key = '', Size = 0, LastModified } of Contents)
        yield { key: Key.slice(this.#prefix.length), bytes: Size, modified: LastModified?.getTime() ?? Date.now() };
      token = NextContinuationToken;
      if (token === undefined) return;
    }
  }

  /** Deletes an object; not an error if there is none. */
  async remove(key: string): Promise<void> {
    await this.#run(`delete "${key}"`, this.#s3.DeleteObjectCommand, {}, key);
  }
}

const entryOf = ({ ContentLength = 0, LastModified }: S3Answer): S3Entry => ({
  bytes: ContentLength,
  modified: LastModified?.getTime() ?? Date.now(),
});
