import { createHash, type Hash } from 'node:crypto';
import { open, stat, type FileHandle } from 'node:fs/promises';
import type { FilmCodec, FilmSource, FilmState } from '../backend';
import { writeWhole } from '../output/write';

/** The first line of a film file; a line of JSON follows, and then the film. */
const FIRST_LINE = 'GLANZ CHECKPOINT 1\n';
/** Maximum bytes of the two lines. */
const MAX_HEADER = 2 ** 20;

/** The second line of a film file. */
export interface FilmFileHeader {
  /** Everything that decides the samples, under the names of the options. */
  readonly settings: Readonly<Record<string, string>>;
  readonly samples: number;
  /** Of the film. */
  readonly bytes: number;
}

/** Bytes that one call reads or writes. */
const CALL_BYTES = 2 ** 30;

/** Bytes that are hashed while as many are written. */
const HASH_BYTES = 2 ** 24;

/** How the reader of a film file reports what is wrong with it. */
export interface FilmFileErrors {
  /** It is something else. */
  readonly foreign: () => Error;
  /** It cannot be read, or is damaged. @param why Continues "it cannot be used: …". */
  readonly broken: (why: string, cause?: unknown) => Error;
}

/** A film file that is open. */
export interface OpenFilmFile {
  readonly header: FilmFileHeader;
  /** Its film, for `FilmCodec.merge`, which checks its checksum. */
  readonly source: FilmSource;
  close(): Promise<void>;
}

/**
 * Opens a film file: a checkpoint, or an output that ends in `.film`.
 *
 * @param file Absolute path.
 * @param check Throws if the film is not the one wanted, before the film itself is read.
 * @returns `undefined` if there is no such file.
 */
export async function openFilmFile(
  file: string,
  { foreign, broken }: FilmFileErrors,
  check: (header: FilmFileHeader) => void | Promise<void> = () => undefined,
): Promise<OpenFilmFile | undefined> {
  const found = await stat(file).catch((cause: NodeJS.ErrnoException) => {
    if (cause.code === 'ENOENT') return undefined;
    throw broken(cause.message, cause);
  });
  if (!found) return undefined;
  if (!found.isFile()) throw foreign();
  const handle = await open(file, 'r').catch((cause: Error) => {
    throw broken(cause.message, cause);
  });
  try {
    const head = new Uint8Array(Math.min(MAX_HEADER, found.size));
    await handle.read(head, 0, head.length, 0);
    const text = new TextDecoder('latin1').decode(head);
    if (!text.startsWith(FIRST_LINE)) throw foreign();
    const end = text.indexOf('\n', FIRST_LINE.length) + 1;
    const header = parseHeader(new TextDecoder().decode(head.subarray(FIRST_LINE.length, end)));
    if (end === 0 || !header) throw broken('its header is damaged');
    await check(header);
    if (found.size !== end + header.bytes) throw broken(`it has ${found.size} bytes instead of ${end + header.bytes}`);
    const source: FilmSource = {
      bytes: header.bytes,
      async read(target, position) {
        for (let at = 0; at < target.length;) {
          const count = Math.min(CALL_BYTES, target.length - at);
          const { bytesRead } = await handle.read(target, at, count, end + position + at);
          if (bytesRead === 0) throw broken('it ends early');
          at += bytesRead;
        }
      },
      async onError(cause) {
        return (cause as { code?: unknown }).code === 'renderer/film-state' ? broken(whyOf(cause), cause) : cause;
      },
    };
    return { header, source, close: () => handle.close() };
  } catch (error) {
    await handle.close();
    throw error;
  }
}

const whyOf = (cause: unknown) =>
  (cause as Error).message.includes('of version') ? 'its film is of another version' : 'its content is damaged';

/** Reads a film file as a whole; see {@link openFilmFile}. */
export async function readFilmFile(
  file: string,
  codec: () => Promise<FilmCodec>,
  errors: FilmFileErrors,
  check?: (header: FilmFileHeader) => void | Promise<void>,
): Promise<{ readonly header: FilmFileHeader; readonly film: FilmState } | undefined> {
  const opened = await openFilmFile(file, errors, check);
  if (!opened) return undefined;
  const { header, source } = opened;
  try {
    const bytes = new Uint8Array(header.bytes);
    await source.read(bytes, 0);
    const { decode } = await codec();
    try {
      return { header, film: decode(bytes) };
    } catch (cause) {
      throw errors.broken(whyOf(cause), cause);
    }
  } finally {
    await opened.close();
  }
}

/** How {@link writeFilmFile} writes. */
export interface FilmFileOptions {
  /** Whether it survives a power failure. Default: false. */
  readonly sync?: boolean;
  /** Whether it holds the layer `beauty`, which merging makes again. Default: true. */
  readonly withBeauty?: boolean;
  /** Whether its SHA-256 is computed meanwhile. Default: false. */
  readonly hashed?: boolean;
}

/**
 * Writes a film file, which appears whole or not at all.
 *
 * @param path Relative to `cwd`, or absolute.
 * @returns The number of bytes, and their SHA-256, hexadecimal, if it was asked for.
 * @throws {CliError} `cli/output`
 */
export async function writeFilmFile(
  path: string,
  cwd: string,
  state: FilmState,
  settings: FilmFileHeader['settings'],
  codec: () => Promise<FilmCodec>,
  { sync = false, withBeauty = true, hashed = false }: FilmFileOptions = {},
): Promise<{ readonly bytes: number; readonly sha256?: string }> {
  const pieces = (await codec()).encode(state, withBeauty);
  const bytes = pieces.reduce((sum, { length }) => sum + length, 0);
  const header: FilmFileHeader = { settings, samples: state.samples, bytes };
  const lines = new TextEncoder().encode(`${FIRST_LINE}${JSON.stringify(header)}\n`);
  const hash = hashed ? createHash('sha256') : undefined;
  const write = async (handle: FileHandle) => {
    let at = 0;
    for (const piece of [lines, ...pieces]) {
      await writeAt(handle, piece, at, hash);
      at += piece.length;
    }
  };
  await writeWhole(path, cwd, write, { sync });
  return { bytes: lines.length + bytes, ...(hash ? { sha256: hash.digest('hex') } : {}) };
}

/** @param hash Gets the bytes, in steps, while they are written by another thread. */
async function writeAt(handle: FileHandle, bytes: Uint8Array, position: number, hash: Hash | undefined): Promise<void> {
  for (let at = 0; at < bytes.length;) {
    const count = Math.min(hash ? HASH_BYTES : CALL_BYTES, bytes.length - at);
    const writing = writeAll(handle, bytes.subarray(at, at + count), position + at);
    hash?.update(bytes.subarray(at, at + count));
    await writing;
    at += count;
  }
}

async function writeAll(handle: FileHandle, bytes: Uint8Array, position: number): Promise<void> {
  for (let at = 0; at < bytes.length;)
    at += (await handle.write(bytes, at, bytes.length - at, position + at)).bytesWritten;
}

function parseHeader(text: string): FilmFileHeader | undefined {
  try {
    const { settings, samples, bytes } = JSON.parse(text) as FilmFileHeader;
    const sound =
      typeof settings === 'object' &&
      settings !== null &&
      Number.isSafeInteger(samples) &&
      samples >= 0 &&
      Number.isSafeInteger(bytes) &&
      bytes >= 0;
    return sound ? { settings, samples, bytes } : undefined;
  } catch {
    return undefined;
  }
}

const short = (text: string) => (text === 'null' ? 'not given' : text.length > 60 ? `${text.slice(0, 59)}…` : text);

/** How the settings of a film differ from those wanted, for people. */
export function settingDifferences(
  theirs: FilmFileHeader['settings'],
  ours: FilmFileHeader['settings'],
  here = 'here',
): string[] {
  return Object.keys(ours)
    .filter((key) => theirs[key] !== ours[key])
    .map((key) =>
      key === 'content of the model'
        ? 'it is of another model'
        : key === '--env'
          ? 'its --env is another one'
          : `its ${key} is ${short(String(theirs[key] ?? 'null'))}, ${here} ${short(ours[key] as string)}`,
    );
}
