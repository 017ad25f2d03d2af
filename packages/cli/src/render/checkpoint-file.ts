import { createHash } from 'node:crypto';
import { createReadStream } from 'node:fs';
import { rm } from 'node:fs/promises';
import { resolve } from 'node:path';
import { pipeline } from 'node:stream/promises';
import { RENDER_OPTIONS } from '@glanz/renderer/options';
import { isEnvironmentFile } from '../environment';
import { CliError } from '../errors';
import { version } from '../version';
import type { FilmCodec, FilmState } from '../backend';
import { FLAG_OPTIONS, flagOf } from '../render-flags';
import { readFilmFile, settingDifferences, writeFilmFile, type FilmFileOptions } from './film-file';
import type { Shot } from './shots';

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
    '--samples-from': options.samplesFrom,
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

/**
 * The samples of an image in a file: a checkpoint, so that a later run of the same command continues from there, or an
 * output that ends in `.film`.
 */
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
        `"${this.path}" cannot be resumed: ${why}. Delete it to start from the first sample, or set another file with --checkpoint.`,
        cause,
      );
    const foreign = () =>
      this.#error(
        `"${this.path}" is not a checkpoint of glanz and is not changed. Set another file with --checkpoint.`,
      );
    const read = await readFilmFile(this.#file, codec, { foreign, broken }, async (header) => {
      const differing = settingDifferences(header.settings, await this.#ownSettings());
      if (differing.length > 0)
        throw this.#error(
          `The checkpoint "${this.path}" belongs to another image: ${differing.join('; ')}. Repeat the command that wrote it, or set another file with --checkpoint.`,
        );
      const { samples } = this.#shot.options.settings;
      if (header.samples > samples)
        throw this.#error(
          `The checkpoint "${this.path}" has ${header.samples} samples already, more than --samples ${samples}. Request at least as many, or set another file with --checkpoint.`,
        );
    });
    return read?.film;
  }

  /**
   * Replaces the file; it is whole at any time. Gives its bytes.
   *
   * @param options Default: it survives a power failure.
   * @throws {CliError} `cli/output`
   */
  async write(
    state: FilmState,
    codec: () => Promise<FilmCodec>,
    options: FilmFileOptions = { sync: true },
  ): Promise<{ readonly bytes: number; readonly sha256?: string }> {
    return writeFilmFile(this.path, this.#cwd, state, await this.#ownSettings(), codec, options);
  }

  /** The image is finished. */
  async remove(): Promise<void> {
    await rm(this.#file, { force: true });
  }

  async #ownSettings(): Promise<Record<string, string>> {
    return (this.#settings ??= await settingsOf(this.#shot, this.#cwd));
  }
}
