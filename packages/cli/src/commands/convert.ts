import { parseArgs } from 'node:util';
import { isAbsolute, relative, resolve } from 'node:path';
import type { ConvertCadOptions, ConvertedFile } from '@glanz/cad/node';
import { CliError, EXIT } from '../errors';
import { checkInput } from '../input';
import type { CliIo } from '../io';
import type { ReportOptions } from '../options';
import { checkWritable } from '../output/write';
import { jsonLine, visible } from '../visible';

/** Options of `glanz convert`, checked. */
export interface ConvertCommandOptions {
  readonly input: string;
  readonly output: string;
  readonly levels: number;
  readonly materials: string | undefined;
  readonly strip: boolean;
  /** Metres; `undefined`: a thousandth of the model's size. */
  readonly tolerance: number | undefined;
}

const usage = (message: string) => new CliError('cli/usage', message);

/**
 * Reads the arguments behind `convert`.
 *
 * @throws {CliError} `cli/usage`, with what to do about it.
 */
export function parseConvert(
  argv: readonly string[],
): { readonly kind: 'convert'; readonly options: ConvertCommandOptions } & ReportOptions {
  let parsed;
  try {
    parsed = parseArgs({
      args: [...argv],
      allowPositionals: true,
      strict: true,
      options: {
        output: { type: 'string', short: 'o' },
        lod: { type: 'string' },
        materials: { type: 'string' },
        strip: { type: 'boolean' },
        tolerance: { type: 'string' },
        json: { type: 'boolean' },
        quiet: { type: 'boolean', short: 'q' },
      },
    });
  } catch (cause) {
    throw usage(`${((cause as Error).message.split('\n')[0] as string).replace(/\.?$/, '.')} See glanz --help.`);
  }
  const { values, positionals } = parsed;
  const [input, ...rest] = positionals;
  if (input === undefined) throw usage('No model given. Use glanz convert PART.step -o PART.glb.');
  if (rest.length > 0) throw usage(`One model at a time: unexpected argument "${rest[0]}".`);
  const levels = Number(values.lod ?? 1);
  if (!(Number.isInteger(levels) && levels >= 1 && levels <= 8))
    throw usage(`--lod must be a whole number from 1 to 8, not "${values.lod}".`);
  const tolerance = values.tolerance === undefined ? undefined : Number(values.tolerance) / 1000;
  if (tolerance !== undefined && !(tolerance > 0 && tolerance < 1000))
    throw usage(`--tolerance must be a number of millimetres, not "${values.tolerance}".`);
  const output = values.output ?? `${(input.split(/[\\/]/).pop() as string).replace(/\.[^.]*$/, '') || 'part'}.glb`;
  if (!/\.glb$/i.test(output)) throw usage(`--output must end in .glb, not "${output}".`);
  return {
    kind: 'convert',
    json: values.json ?? false,
    quiet: values.quiet ?? false,
    options: { input, output, levels, materials: values.materials, strip: values.strip ?? false, tolerance },
  };
}

/** Converts a file; by default the optional package `@glanz/cad` does. */
export type Converter = (input: string, output: string, options: ConvertCadOptions) => Promise<ConvertedFile[]>;

const convertByPackage: Converter = async (input, output, options) => {
  const { convertCadFile } = await import('@glanz/cad/node').catch((cause: unknown) => {
    throw new CliError(
      'cli/missing-package',
      'Converting CAD files needs the package "@glanz/cad": npm install @glanz/cad.',
      { cause },
    );
  });
  return convertCadFile(input, output, options);
};

/** `glanz convert`: CAD in, GLB out. Gives the exit code. */
export async function convertCommand(
  { options, json, quiet }: ReturnType<typeof parseConvert>,
  io: CliIo,
  convert: Converter = convertByPackage,
): Promise<number> {
  const { input, output, levels, materials, strip, tolerance } = options;
  await checkInput(input, io.cwd, 'the model');
  if (materials !== undefined) await checkInput(materials, io.cwd, 'the material map');
  await checkWritable(output, io.cwd);
  const start = io.now();
  const made = await convert(resolve(io.cwd, input), resolve(io.cwd, output), {
    levels,
    strip,
    ...(materials === undefined ? {} : { materials: resolve(io.cwd, materials) }),
    ...(tolerance === undefined ? {} : { tolerance: { metres: tolerance } }),
  });
  // Paths as the user gives them.
  const files = made.map((file) => ({ ...file, path: isAbsolute(output) ? file.path : relative(io.cwd, file.path) }));
  if (json) io.stdout(jsonLine({ ok: true, model: input, files, totalMs: io.now() - start }));
  else if (!quiet)
    for (const { path, bytes, triangles, parts, materials: looks } of files)
      io.stderr(
        `${visible(path)}: ${triangles} triangles, ${parts} parts, ${looks} materials, ${(bytes / 1000).toFixed(1)} kB\n`,
      );
  return EXIT.ok;
}
