import { resolve } from 'node:path';
import type { Backend, FilmState } from '../backend';
import { CliError } from '../errors';
import type { OutputTarget } from '../output/formats';
import type { RenderedImage } from '../output/image';
import { version } from '../version';
import { openFilmFile, settingDifferences, type FilmFileHeader, type OpenFilmFile } from './film-file';

/** The setting in which films to be merged may differ. */
export const SAMPLES_FROM = '--samples-from';

/** Whether outputs show the beauty alone, so that a film's other sums need not be kept. */
export const areImagesOnly = (outputs: readonly OutputTarget[]): boolean =>
  outputs.every(({ format }) => format === 'png' || format === 'hdr');

/** What {@link readFilms} gives. */
export interface MergedFilms {
  readonly film: FilmState;
  readonly settings: FilmFileHeader['settings'];
  /** Whether the beauty in the film was made of its sums here; the one of a single file may be missing. */
  readonly isComposed: boolean;
}

/**
 * Reads films of the same image and adds up their samples.
 *
 * @param imageOnly Whether the film's image is all that is wanted, see `mergeFilmSources`. Default: false.
 * @returns The film, the settings of the first file, and whether merging has made the film's beauty.
 * @throws {CliError} `cli/film`
 * @throws {RenderError} `renderer/film-state`
 */
export async function readFilms(
  paths: readonly string[],
  cwd: string,
  backend: Backend,
  imageOnly = false,
): Promise<MergedFilms> {
  const codec = () => backend.filmCodec();
  let settings: FilmFileHeader['settings'] = {};
  const files: OpenFilmFile[] = [];
  try {
    for (const path of paths) {
      const wrong = (message: string, cause?: unknown) =>
        new CliError('cli/film', message, { cause, location: { file: path } });
      const foreign = () => wrong(`"${path}" is not a film of glanz. Films are written by glanz render -o FILE.film.`);
      const opened = await openFilmFile(
        resolve(cwd, path),
        { foreign, broken: (why, cause) => wrong(`"${path}" cannot be merged: ${why}. Render it again.`, cause) },
        (header) => {
          if (files.length === 0) settings = header.settings;
          const differing = settingDifferences(
            { ...header.settings, [SAMPLES_FROM]: settings[SAMPLES_FROM] as string },
            settings,
            `in "${paths[0]}"`,
          );
          if (differing.length > 0)
            throw wrong(
              `"${path}" cannot be merged with "${paths[0]}": ${differing.join('; ')}. Films to be merged may differ only in --samples-from and --samples.`,
            );
        },
      );
      if (!opened) throw foreign();
      files.push(opened);
    }
    const { merge } = await codec();
    const film = await merge(
      files.map(({ source }) => source),
      { imageOnly },
    );
    return { film, settings, isComposed: files.filter(({ header }) => header.samples > 0).length > 1 };
  } finally {
    for (const { close } of files) await close();
  }
}

/** The image of a film: its beauty, and its variance where an output has it. */
export async function imageOfFilm(
  { film, isComposed }: Pick<MergedFilms, 'film' | 'isComposed'>,
  outputs: readonly OutputTarget[],
  backend: Backend,
): Promise<RenderedImage> {
  const { layer } = await backend.filmCodec();
  return {
    width: film.width,
    height: film.height,
    beauty: isComposed ? film.sums.beauty : layer(film, 'beauty'),
    ...(outputs.some(({ format }) => format === 'exr') ? { layers: { variance: layer(film, 'variance') } } : {}),
    samples: film.samples,
    software: `Glanz ${version()}`,
  };
}
