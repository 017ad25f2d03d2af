import { dirname, isAbsolute, join } from 'node:path';
import { isEnvironmentFile } from './environment';
import { CliError } from './errors';
import { MAX_SETTINGS_BYTES, readInput } from './input';
import { liesBelow } from './output/confine';
import { BATCH_KEYS, presentNames, renderOptions, type RenderCommandOptions, type RenderValues } from './options';

const wrong = (file: string, message: string) =>
  new CliError('cli/batch', `${file}: ${message}`, { location: { file } });

/** Rows of a CSV file (RFC 4180): fields in quotes may hold commas, line breaks and doubled quotes. */
export function parseCsv(text: string): string[][] {
  const rows: string[][] = [];
  let row: string[] = [],
    field = '',
    quoted = false,
    wasQuoted = false;
  const endField = () => {
    row.push(wasQuoted ? field : field.trim());
    field = '';
    wasQuoted = false;
  };
  const endRow = () => {
    endField();
    if (row.some((cell) => cell !== '')) rows.push(row);
    row = [];
  };
  for (let i = 0; i < text.length; i++) {
    const c = text[i] as string;
    if (quoted) {
      if (c !== '"') field += c;
      else if (text[i + 1] === '"') {
        field += '"';
        i++;
      } else quoted = false;
    } else if (c === '"' && field.trim() === '') {
      quoted = wasQuoted = true;
      field = '';
    } else if (c === ',') endField();
    else if (c === '\n') endRow();
    else if (c !== '\r') field += c;
  }
  endRow();
  return rows;
}

/** A row as the command line would have said it. */
function valuesOf(
  row: Readonly<Record<string, unknown>>,
  file: string,
  where: string,
): { values: RenderValues; model: string | undefined } {
  const values: Record<string, unknown> = {};
  let model: string | undefined;
  for (const [key, value] of Object.entries(row)) {
    if (value === undefined || value === null || value === '') continue;
    if (key === 'model') {
      if (typeof value !== 'string') throw wrong(file, `${where}: "model" must be a path.`);
      model = value;
      continue;
    }
    const kind = Object.hasOwn(BATCH_KEYS, key) ? BATCH_KEYS[key as keyof typeof BATCH_KEYS] : undefined;
    if (kind === undefined)
      throw wrong(file, `${where}: "${key}" is unknown. Known: model, ${Object.keys(BATCH_KEYS).join(', ')}.`);
    const text = (one: unknown) => {
      if (typeof one === 'string' || (typeof one === 'number' && Number.isFinite(one))) return String(one);
      // Cameras may stand there as they are.
      if ((key === 'camera' || key === 'view') && typeof one === 'object' && one !== null && !Array.isArray(one))
        return JSON.stringify(one);
      throw wrong(
        file,
        `${where}: "${key}" must be a string or a number${kind === 'list' ? ', or a list of them' : ''}.`,
      );
    };
    if (kind === 'boolean') {
      if (value !== true && value !== false && !/^(true|false|yes|no|1|0)$/i.test(String(value)))
        throw wrong(file, `${where}: "${key}" must be true or false.`);
      if (/^(true|yes|1)$/i.test(String(value))) values[key] = true;
    } else if (kind === 'list')
      values[key] = Array.isArray(value)
        ? value.map(text)
        : typeof value === 'string' && !value.trimStart().startsWith('{')
          ? value
              .split(';')
              .map((part) => part.trim())
              .filter((part) => part !== '')
          : [text(value)];
    else values[key] = text(value);
  }
  return { values: values as RenderValues, model };
}

/** What a row of a batch file asks for. */
export interface BatchRequest {
  readonly options: RenderCommandOptions;
  /** Whether the file, not the command line, says where to write. */
  readonly ownOutput: boolean;
  /** For messages: `image 3`. */
  readonly where: string;
}

/**
 * Makes sure that a batch file, which may be untrusted, writes below a folder only.
 *
 * @param paths With the names of variants and views in them.
 * @param root Default: the folder of the batch file.
 * @throws {CliError} `cli/batch`
 */
export async function checkBatchOutputs(
  paths: readonly string[],
  { where }: BatchRequest,
  file: string,
  cwd: string,
  root = dirname(file),
): Promise<void> {
  for (const path of paths) {
    if (await liesBelow(path, root, cwd)) continue;
    throw wrong(
      file,
      `${where}: "${path}" lies outside the folder "${root}", and a batch writes only in that folder. Change the path, or set another folder with --output-root.`,
    );
  }
}

/**
 * The images that a batch file asks for. JSON: a list of objects, or `{ "defaults": {…}, "images": […] }`; CSV: a
 * line of names, then a line for each image. Names are those of the options of `glanz render`, and `model`; several
 * variants, views and outputs are a list, or stand with semicolons between them. What an image does not say is taken
 * from the defaults and from the command line. Paths are relative to the file.
 *
 * @param warn Gets a warning for each image that uses a former name of an option.
 * @throws {CliError} `cli/input`, `cli/batch`, `cli/usage`
 */
export const readBatch = async (...args: Parameters<typeof openBatch>): Promise<BatchRequest[]> => [
  ...(await openBatch(...args))(),
];

/**
 * Opens a batch file. See {@link readBatch}.
 *
 * @returns The images, checked as they come, from the first one again with each call.
 * @throws {CliError} `cli/input`, `cli/batch`; while it iterates `cli/batch`, `cli/usage`
 */
export async function openBatch(
  file: string,
  cwd: string,
  given: RenderValues & { readonly model?: string | undefined },
  warn: (text: string) => void = () => undefined,
): Promise<() => Generator<BatchRequest>> {
  const text = new TextDecoder()
    .decode(await readInput(file, cwd, 'the batch', { maxBytes: MAX_SETTINGS_BYTES }))
    .replace(/^\uFEFF/, '');
  let rows: readonly (readonly [where: string, row: Readonly<Record<string, unknown>>])[];
  if (/\.csv$/i.test(file)) {
    const [names = [], ...lines] = parseCsv(text);
    rows = lines.map((line, i) => {
      if (line.length > names.length)
        throw wrong(
          file,
          `image ${i + 1} has ${line.length} fields, but there are ${names.length} names in the first line.`,
        );
      return [`image ${i + 1}`, Object.fromEntries(names.map((name, k) => [name, line[k]]))];
    });
  } else {
    let json: unknown;
    try {
      json = JSON.parse(text);
    } catch (cause) {
      throw new CliError('cli/batch', `${file}: it is not valid JSON: ${(cause as Error).message.split('\n')[0]}.`, {
        cause,
        location: { file },
      });
    }
    const isObject = (value: unknown): value is Record<string, unknown> =>
      typeof value === 'object' && value !== null && !Array.isArray(value);
    const list = isObject(json) ? json['images'] : json;
    const defaults = isObject(json) ? (json['defaults'] ?? {}) : {};
    if (!Array.isArray(list) || !list.every(isObject) || !isObject(defaults))
      throw wrong(file, 'it must be a list of objects, or { "defaults": {…}, "images": […] }.');
    rows = (list as Record<string, unknown>[]).map((row, i) => [`image ${i + 1}`, { ...defaults, ...row }]);
  }
  if (rows.length === 0) throw wrong(file, 'it contains no images.');
  const folder = dirname(file);
  const near = (path: string) => (isAbsolute(path) || folder === '.' ? path : join(folder, path));
  const request = ([where, row]: (typeof rows)[number]): BatchRequest => {
    const { values: said, model = given.model } = valuesOf(row, file, where);
    const values = presentNames(said, warn);
    if (model === undefined) throw wrong(file, `${where}: "model" is missing.`);
    // Files that the batch names lie beside it; those of the command line, where one is.
    const placed: RenderValues = {
      ...values,
      ...(values.output ? { output: values.output.map(near) } : {}),
      ...(isEnvironmentFile(values.env) ? { env: near(values.env) } : {}),
    };
    try {
      const options = renderOptions(
        { ...given, ...placed },
        row['model'] === undefined || row['model'] === '' ? model : near(model),
      );
      // A name that the model gives has no folder; that of the command line is the user's own word.
      return { options, ownOutput: values.output !== undefined, where };
    } catch (error) {
      throw error instanceof CliError
        ? new CliError(error.code, `${file}, ${where}: ${error.message}`, { cause: error, location: { file } })
        : error;
    }
  };
  return function* () {
    for (const row of rows) yield request(row);
  };
}
