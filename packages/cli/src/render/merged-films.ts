import { resolve } from 'node:path';
import type { Backend, FilmState } from '../backend';
import { CliError } from '../errors';
import type { RenderedImage } from '../output/image';
import { version } from '../version';
import { readFilmFile, settingDifferences, type FilmFileHeader } from './film-file';

/** The setting in which films to be merged may differ. */
export const SAMPLES_FROM = '--samples-from';

/**
 * Reads films of the same image and adds up their samples.
 *
 * @returns The film, and the settings of the first file.
 * @throws {CliError} `cli/film`
 * @throws {RenderError} `renderer/film-state`
 */
export async function readFilms(
  paths: readonly string[],
  cwd: string,
  backend: Backend,
): Promise<{ readonly film: FilmState; readonly settings: FilmFileHeader['settings'] }> {
  const codec = () => backend.filmCodec();
  let settings: FilmFileHeader['settings'] = {};
  const films: FilmState[] = [];
  for (const path of paths) {
    const wrong = (message: string, cause?: unknown) =>
      new CliError('cli/film', message, { cause, location: { file: path } });
    const foreign = () => wrong(`"${path}" is not a film of glanz. Films are written by glanz render -o FILE.film.`);
    const read = await readFilmFile(
      resolve(cwd, path),
      codec,
      { foreign, broken: (why, cause) => wrong(`"${path}" cannot be merged: ${why}. Render it again.`, cause) },
      (header) => {
        if (films.length === 0) settings = header.settings;
        const differing = settingDifferences(
          { ...header.settings, [SAMPLES_FROM]: settings[SAMPLES_FROM] as string },
          settings,
          `in "${paths[0]}"`,
        );
        if (differing.length > 0)
          throw wrong(
            `"${path}" cannot be merged with "${paths[0]}": ${differing.join('; ')}. Films to be merged differ in --samples-from and --samples alone.`,
          );
      },
    );
    if (!read) throw foreign();
    films.push(read.film);
  }
  return { film: (await codec()).merge(films), settings };
}

/** The image of a film: its beauty and its variance. */
export async function imageOfFilm(film: FilmState, backend: Backend): Promise<RenderedImage> {
  const { layer } = await backend.filmCodec();
  return {
    width: film.width,
    height: film.height,
    beauty: layer(film, 'beauty'),
    layers: { variance: layer(film, 'variance') },
    samples: film.samples,
    software: `Glanz ${version()}`,
  };
}
