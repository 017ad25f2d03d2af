import { parseArgs, type ParseArgsConfig } from 'node:util';
import { TONE_MAPS, isToneMap, type ToneMap } from '@glanz/tonemap';
import { parseConvert } from './commands/convert';
import { CliError } from './errors';
import { parseExposure } from './exposure';
import { formatOf, type OutputTarget } from './output/formats';
import { parseBounces, parseFilter, parseLightGroups, type QualityOptions } from './quality';

/** Everything `glanz render` can be told, checked. */
export interface RenderCommandOptions {
  readonly model: string;
  readonly outputs: readonly OutputTarget[];
  /** `studio`, `none`, a file, or `undefined`: the model's own or the studio. */
  readonly env: string | undefined;
  /** Radians. */
  readonly envRotation: number;
  readonly envIntensity: number;
  readonly width: number;
  readonly height: number;
  readonly samples: number;
  /** Relative error to stop at; `undefined`: all samples everywhere. */
  readonly noise: number | undefined;
  readonly depth: number;
  readonly seed: number;
  /** As given: name, number, JSON, or a .json file. */
  readonly camera: string | undefined;
  readonly exposure: number;
  readonly toneMap: ToneMap;
  readonly transparent: boolean;
  /** Names of parts that catch shadows and reflections. */
  readonly catchers: readonly string[];
  readonly quality: QualityOptions;
  readonly gpu: string | undefined;
}

/** How the command line is answered. */
export interface ReportOptions {
  readonly json: boolean;
  readonly quiet: boolean;
}

/** What the command line asks for. */
export type Command =
  | { readonly kind: 'help' }
  | { readonly kind: 'version' }
  | ({ readonly kind: 'list-gpus' } & ReportOptions)
  | ReturnType<typeof parseConvert>
  | ({ readonly kind: 'render'; readonly options: RenderCommandOptions } & ReportOptions);

const OPTIONS = {
  output: { type: 'string', short: 'o', multiple: true },
  env: { type: 'string' },
  'env-rotation': { type: 'string' },
  'env-intensity': { type: 'string' },
  size: { type: 'string' },
  samples: { type: 'string' },
  noise: { type: 'string' },
  depth: { type: 'string' },
  seed: { type: 'string' },
  camera: { type: 'string' },
  filter: { type: 'string' },
  'light-groups': { type: 'string' },
  'max-bounces': { type: 'string' },
  'clamp-indirect': { type: 'string' },
  regularization: { type: 'string' },
  'no-caustics': { type: 'boolean' },
  exposure: { type: 'string' },
  tonemap: { type: 'string' },
  bits: { type: 'string' },
  transparent: { type: 'boolean' },
  catcher: { type: 'string', multiple: true },
  json: { type: 'boolean' },
  quiet: { type: 'boolean', short: 'q' },
  'list-gpus': { type: 'boolean' },
  gpu: { type: 'string' },
  help: { type: 'boolean', short: 'h' },
  version: { type: 'boolean', short: 'V' },
} satisfies ParseArgsConfig['options'];

const MAX_SIDE = 65536;

const usage = (message: string) => new CliError('cli/usage', message);

/** Number of single-letter edits between two words, for "did you mean". */
function editDistance(a: string, b: string): number {
  let row = Array.from({ length: b.length + 1 }, (_, j) => j);
  for (let i = 1; i <= a.length; i++) {
    const next = [i];
    for (let j = 1; j <= b.length; j++) {
      next.push(Math.min((row[j] as number) + 1, (next[j - 1] as number) + 1, (row[j - 1] as number) + (a[i - 1] === b[j - 1] ? 0 : 1)));
    }
    row = next;
  }
  return row[b.length] as number;
}

function closest(word: string, words: readonly string[]): string {
  const best = words.map((w) => ({ w, d: editDistance(word, w) })).sort((a, b) => a.d - b.d)[0];
  return best && best.d <= Math.max(1, Math.floor(word.length / 3)) ? best.w : '';
}

/** `--exposure -1` is what people type; parseArgs takes a value that begins with a dash only after `=`. */
function joinNegativeNumbers(argv: readonly string[]): string[] {
  const out: string[] = [];
  for (let i = 0; i < argv.length; i++) {
    const [word, next] = [argv[i] as string, argv[i + 1]];
    if (/^--[a-z-]+$/.test(word) && next !== undefined && /^-\.?\d/.test(next)) {
      out.push(`${word}=${next}`);
      i++;
    } else out.push(word);
  }
  return out;
}

function parse(argv: readonly string[]) {
  try {
    return parseArgs({ args: joinNegativeNumbers(argv), options: OPTIONS, allowPositionals: true, strict: true });
  } catch (cause) {
    const { code, message } = cause as Error & { code?: string };
    const option = /'([^' ]*)/.exec(message)?.[1] ?? '';
    if (code === 'ERR_PARSE_ARGS_UNKNOWN_OPTION') {
      const guess = closest(option.replace(/^-+/, ''), Object.keys(OPTIONS));
      throw usage(`Unknown option "${option}".${guess ? ` Did you mean --${guess}?` : ''} See glanz --help.`);
    }
    if (code === 'ERR_PARSE_ARGS_INVALID_OPTION_VALUE') throw usage(`${(message.split('\n')[0] as string).replace(/\.?$/, '.')} See glanz --help.`);
    throw cause;
  }
}

function number(name: string, text: string | undefined, fallback: number, check: { readonly whole?: boolean; readonly min: number; readonly max: number }): number {
  if (text === undefined) return fallback;
  const value = text.trim() === '' ? NaN : Number(text);
  if (!(value >= check.min && value <= check.max) || (check.whole && !Number.isInteger(value))) {
    throw usage(`--${name} must be a ${check.whole ? 'whole ' : ''}number from ${check.min} to ${check.max}, not "${text}".`);
  }
  return value;
}

function parseSize(text: string): [number, number] {
  const match = /^(\d{1,6})[xX×](\d{1,6})$/.exec(text.trim());
  if (!match) throw usage(`--size must be like 1024x768, not "${text}".`);
  const [width, height] = [Number(match[1]), Number(match[2])];
  if (width < 1 || height < 1 || width > MAX_SIDE || height > MAX_SIDE) throw usage(`--size ${text}: both sides must be from 1 to ${MAX_SIDE} pixels.`);
  return [width, height];
}

function defaultOutput(model: string): string {
  const base = (model.split(/[\\/]/).pop() as string).replace(/\.(glb|gltf|obj|stl)$/i, '');
  return `${base || 'picture'}.png`;
}

/**
 * Reads the command line.
 *
 * @throws {CliError} `cli/usage`, with what to do about it.
 */
export function parseCommand(argv: readonly string[]): Command {
  if (argv[0] === 'convert' && !argv.includes('--help') && !argv.includes('-h')) return parseConvert(argv.slice(1));
  const { values, positionals } = parse(argv);
  if (values.help) return { kind: 'help' };
  if (values.version) return { kind: 'version' };
  const report: ReportOptions = { json: values.json ?? false, quiet: values.quiet ?? false };
  if (values['list-gpus']) return { kind: 'list-gpus', ...report };
  const [command, model, ...rest] = positionals;
  if (command === undefined || command === 'help') {
    if (argv.length === 0 || command === 'help') return { kind: 'help' };
    throw usage('No command given. Use glanz render MODEL; see glanz --help.');
  }
  if (command !== 'render') throw usage(`Unknown command "${command}". Use glanz render MODEL; see glanz --help.`);
  if (model === undefined) throw usage('No model given. Use glanz render MODEL, a .glb or .gltf file.');
  if (rest.length > 0) throw usage(`One model at a time: what is "${rest[0]}"?`);

  const [width, height] = parseSize(values.size ?? '1024x768');
  const toneMap = values.tonemap ?? 'neutral';
  if (!isToneMap(toneMap)) throw usage(`There is no tone map "${toneMap}". Known: ${TONE_MAPS.join(', ')}.`);
  const bits = values.bits === undefined ? undefined : number('bits', values.bits, 8, { whole: true, min: 8, max: 32 });
  const files = values.output ?? [defaultOutput(model)];
  return {
    kind: 'render',
    ...report,
    options: {
      model,
      outputs: files.map((file) => formatOf(file, bits)),
      env: values.env,
      envRotation: (number('env-rotation', values['env-rotation'], 0, { min: -36000, max: 36000 }) * Math.PI) / 180,
      envIntensity: number('env-intensity', values['env-intensity'], 1, { min: 0, max: 1e6 }),
      width,
      height,
      noise: values.noise === undefined ? undefined : number('noise', values.noise, 0, { min: 1e-5, max: 10 }),
      samples: number('samples', values.samples, values.noise === undefined ? 256 : 65536, { whole: true, min: 1, max: 16777216 }),
      depth: number('depth', values.depth, 8, { whole: true, min: 1, max: 1024 }),
      seed: number('seed', values.seed, 0, { whole: true, min: 0, max: 4294967295 }),
      camera: values.camera,
      exposure: values.exposure === undefined ? 0 : parseExposure(values.exposure),
      toneMap,
      transparent: values.transparent ?? false,
      catchers: values.catcher ?? [],
      quality: {
        ...(values.filter === undefined ? {} : { filter: parseFilter(values.filter) }),
        ...(values['max-bounces'] === undefined ? {} : { maxBounces: parseBounces(values['max-bounces']) }),
        ...(values['clamp-indirect'] === undefined ? {} : { clampIndirect: number('clamp-indirect', values['clamp-indirect'], 0, { min: 1e-6, max: 1e30 }) }),
        ...(values.regularization === undefined ? {} : { regularization: number('regularization', values.regularization, 0, { min: 0, max: 1 }) }),
        ...(values['no-caustics'] ? { caustics: false } : {}),
        ...(values['light-groups'] === undefined ? {} : { lightGroups: parseLightGroups(values['light-groups']) }),
      },
      gpu: values.gpu,
    },
  };
}
