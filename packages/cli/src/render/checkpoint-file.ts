import { createHash } from 'node:crypto';
import { createReadStream } from 'node:fs';
import { open, rm, stat } from 'node:fs/promises';
import { resolve } from 'node:path';
import { pipeline } from 'node:stream/promises';
import { RENDER_OPTIONS } from '@glanz/renderer/options';
import { isEnvironmentFile } from '../environment';
import { CliError } from '../errors';
import { writeWhole } from '../output/write';
import { version } from '../version';
import type { FilmCodec, FilmState } from '../backend';
import { FLAG_OPTIONS, flagOf } from '../render-flags';
import type { Shot } from './shots';

/** The first line of a checkpoint file; a line of JSON follows, and then the film. */
const FIRST_LINE = 'GLANZ CHECKPOINT 1\n';
/** Most bytes of the two lines. */
const MAX_HEADER = 2 ** 20;

interface Header {
  /** Everything that decides the samples, under the names of the options. */
  readonly settings: Readonly<Record<string, string>>;
  readonly samples: number;
  /** Of the film. */
  readonly bytes: number;
  readonly sha256: string;
}

const hashOf = async (file: string): Promise<string> => {
  const hash = createHash('sha256');
  await pipeline(createReadStream(file), hash);
  return hash.digest('hex').slice(0, 32);
};

/** What decides the samples of an image, under the names of the options; files by their content. */
async function settingsOf({ options, variant, view }: Shot, cwd: string): Promise<Record<string, string>> {
  const { model, pose, env, envRotation, envIntensity, width, height, catchers, settings } = options;
  const file = (path: string) => hashOf(resolve(cwd, path));
  const text = (value: unknown) => (typeof value === 'string' ? value : JSON.stringify(value ?? null));
  const { name: _name, ...camera } = view;
  const all: Record<string, unknown> = {
    'version of glanz': version(),
    'content of the model': await file(model),
    '--env': isEnvironmentFile(env) ? await file(env) : env,
    '--env-rotation': envRotation,
    '--env-intensity': envIntensity,
    '--size': `${width}x${height}`,
    '--catcher': catchers,
    '--scene': pose.scene,
    '--animation': pose.animation,
    '--time': pose.time,
    '--variant': variant,
    '--camera or --view': camera,
    ...Object.fromEntries(
      FLAG_OPTIONS.filter((name) => RENDER_OPTIONS[name].effect !== 'schedule').map((name) => [
        `--${flagOf(name)}`,
        settings[name],
      ]),
    ),
  };
  return Object.fromEntries(Object.entries(all).map(([key, value]) => [key, text(value)]));
}

/** The samples of an image in a file, so that a later run of the same command goes on from there. */
export class CheckpointFile {
  readonly path: string;
  readonly #file: string;
  readonly #shot: Shot;
  readonly #cwd: string;
  #settings: Record<string, string> | undefined;

  /** @param path As the user gave it. */
  constructor(path: string, shot: Shot, cwd: string) {
    this.path = path;
    this.#file = resolve(cwd, path);
    this.#shot = shot;
    this.#cwd = cwd;
  }

  #error(message: string, cause?: unknown): CliError {
    return new CliError('cli/checkpoint', message, { cause, location: { file: this.path } });
  }

  /**
   * The film in the file; `undefined` if there is no file.
   *
   * @throws {CliError} `cli/checkpoint` for a file that is something else, is damaged, or belongs to another image. The
   * file stays as it is.
   */
  async read(codec: () => Promise<FilmCodec>): Promise<FilmState | undefined> {
    const broken = (why: string, cause?: unknown) =>
      this.#error(
        `"${this.path}" cannot be resumed: ${why}. Delete it to begin from the first sample, or name another file by --checkpoint.`,
        cause,
      );
    const found = await stat(this.#file).catch((cause: NodeJS.ErrnoException) => {
      if (cause.code === 'ENOENT') return undefined;
      throw broken(cause.message, cause);
    });
    if (!found) return undefined;
    const foreign = () =>
      this.#error(`"${this.path}" is not a checkpoint of glanz; it stays as it is. Name another file by --checkpoint.`);
    if (!found.isFile()) throw foreign();
    const handle = await open(this.#file, 'r');
    try {
      const head = new Uint8Array(Math.min(MAX_HEADER, found.size));
      await handle.read(head, 0, head.length, 0);
      const text = new TextDecoder('latin1').decode(head);
      if (!text.startsWith(FIRST_LINE)) throw foreign();
      const end = text.indexOf('\n', FIRST_LINE.length) + 1;
      const header = parseHeader(new TextDecoder().decode(head.subarray(FIRST_LINE.length, end)));
      if (end === 0 || !header) throw broken('its header is damaged');
      const differing = differences(header.settings, await this.#ownSettings());
      if (differing.length > 0)
        throw this.#error(
          `The checkpoint "${this.path}" belongs to another image: ${differing.join('; ')}. Repeat the command that wrote it, or name another file by --checkpoint.`,
        );
      const { samples } = this.#shot.options.settings;
      if (header.samples > samples)
        throw this.#error(
          `The checkpoint "${this.path}" has ${header.samples} samples already, more than --samples ${samples}. Ask for at least as many, or name another file by --checkpoint.`,
        );
      if (found.size !== end + header.bytes)
        throw broken(`it has ${found.size} bytes instead of ${end + header.bytes}`);
      const bytes = new Uint8Array(header.bytes);
      for (let at = 0; at < bytes.length;) {
        const { bytesRead } = await handle.read(bytes, at, Math.min(2 ** 30, bytes.length - at), end + at);
        if (bytesRead === 0) throw broken('it ends early');
        at += bytesRead;
      }
      if (createHash('sha256').update(bytes).digest('hex') !== header.sha256) throw broken('its content is damaged');
      const { decode } = await codec();
      try {
        return decode(bytes);
      } catch (cause) {
        throw broken('its film is of another version', cause);
      }
    } finally {
      await handle.close();
    }
  }

  /** Replaces the file; it is whole at any time. @throws {CliError} `cli/output` */
  async write(state: FilmState, codec: () => Promise<FilmCodec>): Promise<void> {
    const film = (await codec()).encode(state);
    const header: Header = {
      settings: await this.#ownSettings(),
      samples: state.samples,
      bytes: film.length,
      sha256: createHash('sha256').update(film).digest('hex'),
    };
    await writeWhole(
      this.path,
      this.#cwd,
      [new TextEncoder().encode(`${FIRST_LINE}${JSON.stringify(header)}\n`), film],
      { sync: true },
    );
  }

  /** The image is finished. */
  async remove(): Promise<void> {
    await rm(this.#file, { force: true });
  }

  async #ownSettings(): Promise<Record<string, string>> {
    return (this.#settings ??= await settingsOf(this.#shot, this.#cwd));
  }
}

function parseHeader(text: string): Header | undefined {
  try {
    const { settings, samples, bytes, sha256 } = JSON.parse(text) as Header;
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

function differences(theirs: Readonly<Record<string, string>>, ours: Readonly<Record<string, string>>): string[] {
  return Object.keys(ours)
    .filter((key) => theirs[key] !== ours[key])
    .map((key) =>
      key === 'content of the model'
        ? 'it is of another model'
        : key === '--env'
          ? 'its --env is another one'
          : `its ${key} is ${short(String(theirs[key] ?? 'null'))}, here ${short(ours[key] as string)}`,
    );
}
