import { createHash } from 'node:crypto';
import { open, stat } from 'node:fs/promises';
import type { FilmCodec, FilmState } from '../backend';
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
  readonly sha256: string;
}

/** Bytes that `update` takes at once: it refuses 2 GiB, which a film of two light groups has at 7680 × 4320. */
const HASHED_AT_ONCE = 2 ** 30;

function sha256Of(bytes: Uint8Array): string {
  const hash = createHash('sha256');
  for (let at = 0; at < bytes.length; at += HASHED_AT_ONCE) hash.update(bytes.subarray(at, at + HASHED_AT_ONCE));
  return hash.digest('hex');
}

/** How the reader of a film file reports what is wrong with it. */
export interface FilmFileErrors {
  /** It is something else. */
  readonly foreign: () => Error;
  /** It cannot be read, or is damaged. @param why Continues "it cannot be used: …". */
  readonly broken: (why: string, cause?: unknown) => Error;
}

/**
 * Reads a film file: a checkpoint, or an output that ends in `.film`.
 *
 * @param file Absolute path.
 * @param check Throws if the film is not the one wanted, before the film itself is read.
 * @returns `undefined` if there is no such file.
 */
export async function readFilmFile(
  file: string,
  codec: () => Promise<FilmCodec>,
  { foreign, broken }: FilmFileErrors,
  check: (header: FilmFileHeader) => void | Promise<void> = () => undefined,
): Promise<{ readonly header: FilmFileHeader; readonly film: FilmState } | undefined> {
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
    const bytes = new Uint8Array(header.bytes);
    for (let at = 0; at < bytes.length;) {
      const { bytesRead } = await handle.read(bytes, at, Math.min(2 ** 30, bytes.length - at), end + at);
      if (bytesRead === 0) throw broken('it ends early');
      at += bytesRead;
    }
    if (sha256Of(bytes) !== header.sha256) throw broken('its content is damaged');
    const { decode } = await codec();
    try {
      return { header, film: decode(bytes) };
    } catch (cause) {
      throw broken('its film is of another version', cause);
    }
  } finally {
    await handle.close();
  }
}

/**
 * Writes a film file, which appears whole or not at all, and survives a power failure.
 *
 * @param path Relative to `cwd`, or absolute.
 * @returns The number of bytes.
 * @throws {CliError} `cli/output`
 */
export async function writeFilmFile(
  path: string,
  cwd: string,
  state: FilmState,
  settings: FilmFileHeader['settings'],
  codec: () => Promise<FilmCodec>,
): Promise<number> {
  const film = (await codec()).encode(state);
  const header: FilmFileHeader = {
    settings,
    samples: state.samples,
    bytes: film.length,
    sha256: sha256Of(film),
  };
  const lines = new TextEncoder().encode(`${FIRST_LINE}${JSON.stringify(header)}\n`);
  await writeWhole(path, cwd, [lines, film], { sync: true });
  return lines.length + film.length;
}

function parseHeader(text: string): FilmFileHeader | undefined {
  try {
    const { settings, samples, bytes, sha256 } = JSON.parse(text) as FilmFileHeader;
    const sound =
      typeof settings === 'object' &&
      settings !== null &&
      Number.isSafeInteger(samples) &&
      samples >= 0 &&
      Number.isSafeInteger(bytes) &&
      bytes >= 0 &&
      typeof sha256 === 'string';
    return sound ? { settings, samples, bytes, sha256 } : undefined;
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
