import { parseArgs } from 'node:util';
import { TONE_MAPS, isToneMap } from '@glanz/tonemap';
import type { Backend } from '../backend';
import { CliError, EXIT } from '../errors';
import { parseExposure } from '../exposure';
import { checkInput } from '../input';
import type { CliIo } from '../io';
import type { ReportOptions } from '../options';
import { formatOf, type OutputTarget } from '../output/formats';
import type { DisplayOptions } from '../output/png';
import { checkWritable, isImage, writeImage, type WrittenFile } from '../output/write';
import { writeFilmFile } from '../render/film-file';
import { areImagesOnly, imageOfFilm, readFilms, SAMPLES_FROM } from '../render/merged-films';
import { version } from '../version';
import { jsonLine, visible } from '../visible';

/** `glanz merge`. */
export interface MergeCommand extends ReportOptions {
  readonly kind: 'merge';
  /** Film files, at least one. */
  readonly films: readonly string[];
  readonly outputs: readonly OutputTarget[];
  readonly display: DisplayOptions;
}

const usage = (message: string) => new CliError('cli/usage', message);

/**
 * Reads the arguments after `merge`.
 * @throws {CliError} `cli/usage`
 */
export function parseMerge(argv: readonly string[]): MergeCommand {
  let parsed;
  try {
    parsed = parseArgs({
      args: [...argv],
      allowPositionals: true,
      strict: true,
      options: {
        output: { type: 'string', short: 'o', multiple: true },
        bits: { type: 'string' },
        exposure: { type: 'string' },
        'tone-map': { type: 'string' },
        json: { type: 'boolean' },
        quiet: { type: 'boolean', short: 'q' },
      },
    });
  } catch (cause) {
    throw usage(`${((cause as Error).message.split('\n')[0] as string).replace(/\.?$/, '.')} See glanz help merge.`);
  }
  const { values, positionals: films } = parsed;
  if (films.length === 0) throw usage('No films given. Use glanz merge A.film B.film -o IMAGE.png.');
  if (!values.output) throw usage('No output given. Use glanz merge A.film B.film -o IMAGE.png.');
  const toneMap = values['tone-map'] ?? 'neutral';
  if (!isToneMap(toneMap)) throw usage(`There is no tone map "${toneMap}". Known: ${TONE_MAPS.join(', ')}.`);
  const bits = values.bits === undefined ? undefined : Number(values.bits);
  if (bits !== undefined && ![8, 16, 32].includes(bits))
    throw usage(`--bits must be 8, 16 or 32, not "${values.bits}".`);
  return {
    kind: 'merge',
    json: values.json ?? false,
    quiet: values.quiet ?? false,
    films,
    outputs: values.output.map((path) => formatOf(path, bits)),
    display: {
      toneMap,
      exposure: values.exposure === undefined ? 0 : parseExposure(values.exposure),
      transparent: false,
    },
  };
}

/** `glanz merge`: adds up the samples of films and writes the image, or a film again. Gives the exit code. */
export async function mergeCommand(
  { films: paths, outputs, display, json, quiet }: MergeCommand,
  io: CliIo,
  backend: Backend,
): Promise<number> {
  const start = io.now();
  for (const path of paths) await checkInput(path, io.cwd, 'the film', Infinity);
  for (const { path } of outputs) await checkWritable(path, io.cwd);
  const codec = () => backend.filmCodec();
  const merged = await readFilms(paths, io.cwd, backend, areImagesOnly(outputs));
  const { film, settings } = merged;
  const [first] = film.ranges[0] as readonly [number, number];
  const transparent = settings['--transparent'] === 'true' || settings['--background'] === 'transparent';
  const image = await imageOfFilm(merged, outputs, backend);
  const files: WrittenFile[] = [];
  for (const target of outputs) {
    if (isImage(target)) files.push(await writeImage(image, target, { ...display, transparent }, io.cwd));
    else {
      const all = { ...settings, [SAMPLES_FROM]: String(first) };
      files.push({ ...target, ...(await writeFilmFile(target.path, io.cwd, film, all, codec)) });
    }
  }
  const { width, height, samples, ranges } = film;
  if (json) {
    const result = { ok: true, version: version(), films: paths, files, width, height, samples, ranges };
    io.stdout(jsonLine({ ...result, totalMs: io.now() - start }));
  } else if (!quiet) {
    const numbers = ranges.map(([from, end]) => `${from}–${end - 1}`).join(', ');
    const names = files.map(({ path }) => visible(path)).join(', ');
    io.stderr(`${names}: ${width}×${height}, ${samples} samples (${numbers}) of ${paths.length} films\n`);
  }
  return EXIT.ok;
}
