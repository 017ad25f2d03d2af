import { parseArgs, type ParseArgsConfig } from 'node:util';
import { TONE_MAPS, isToneMap, type ToneMap } from '@glanz/tonemap';
import type { DenoiseQuality } from '@glanz/denoise/film';
import { CliError } from './errors';
import { parseExposure } from './exposure';
import { formatOf, type OutputTarget } from './output/formats';
import { RENDER_FLAGS, settingsOf, type FlagSettings } from './render-flags';
import { checkPlaceholders } from './output/placeholders';
import { parseView, turntable, type View } from './views';

/** Which moment of the model is shown: names or numbers. */
export interface PoseOptions {
  readonly scene?: string | number;
  readonly animation?: string | number;
  /** Seconds. */
  readonly time?: number;
}

/** Options of an image, or of a matrix of variants and views, checked. */
export interface RenderCommandOptions {
  readonly model: string;
  readonly pose: PoseOptions;
  /** Names or numbers of variants; `all`; none: the model's own look. */
  readonly variants: readonly string[];
  /** At least one. */
  readonly views: readonly View[];
  /** Paths may hold {model}, {variant} and {view}. */
  readonly outputs: readonly OutputTarget[];
  /** `studio`, `none`, a file, or `undefined`: the model's own or the studio. */
  readonly env: string | undefined;
  /** Radians. */
  readonly envRotation: number;
  readonly envIntensity: number;
  readonly width: number;
  readonly height: number;
  /** The options of the renderer. */
  readonly settings: FlagSettings;
  /** Number of the first sample. */
  readonly samplesFrom: number;
  /** Absent: the film is written as it is. */
  readonly denoise?: DenoiseQuality;
  readonly exposure: number;
  readonly toneMap: ToneMap;
  /** Names of parts that catch shadows and reflections. */
  readonly catchers: readonly string[];
}

/** How the command line is answered. */
export interface ReportOptions {
  readonly json: boolean;
  readonly quiet: boolean;
}

/** `glanz render`. */
export interface RenderCommand extends ReportOptions {
  readonly kind: 'render';
  /** One request; `undefined` with a batch file, whose rows are requests. */
  readonly options: RenderCommandOptions | undefined;
  /** A batch file. */
  readonly batch: string | undefined;
  /** The folder below which the batch file may write; default: its own. */
  readonly outputRoot: string | undefined;
  /** What the command line says, for images of a batch that do not say otherwise. */
  readonly values: RenderValues & { readonly model?: string | undefined };
  /** Images that are there already are not made again. */
  readonly resume: boolean;
  /** Where samples are kept for a later run; may hold {model}, {variant} and {view}. */
  readonly checkpoint: string | undefined;
  /** Warnings about the command line itself. */
  readonly warnings: readonly string[];
  /** Names of GPUs that share the work; none: the best one. */
  readonly gpus: readonly string[];
}

/** The options of `glanz render`, and of what renders batches. */
export const OPTIONS = {
  output: { type: 'string', short: 'o', multiple: true },
  env: { type: 'string' },
  'env-rotation': { type: 'string' },
  'env-intensity': { type: 'string' },
  size: { type: 'string' },
  ...RENDER_FLAGS,
  'samples-from': { type: 'string' },
  depth: { type: 'string' },
  camera: { type: 'string' },
  view: { type: 'string', multiple: true },
  turntable: { type: 'string' },
  elevation: { type: 'string' },
  variant: { type: 'string', multiple: true },
  scene: { type: 'string' },
  animation: { type: 'string' },
  time: { type: 'string' },
  batch: { type: 'string' },
  resume: { type: 'boolean' },
  checkpoint: { type: 'string' },
  'output-root': { type: 'string' },
  denoise: { type: 'string' },
  exposure: { type: 'string' },
  'tone-map': { type: 'string' },
  tonemap: { type: 'string' },
  bits: { type: 'string' },
  transparent: { type: 'boolean' },
  catcher: { type: 'string', multiple: true },
  json: { type: 'boolean' },
  quiet: { type: 'boolean', short: 'q' },
  'list-gpus': { type: 'boolean' },
  gpu: { type: 'string', multiple: true },
  help: { type: 'boolean', short: 'h' },
  version: { type: 'boolean', short: 'V' },
} satisfies ParseArgsConfig['options'];

/**
 * Former names of options, with the present ones. They work until the next minor version; using one is warned of.
 */
export const FORMER_NAMES = { tonemap: 'tone-map', depth: 'max-depth' } as const satisfies Partial<
  Record<keyof typeof OPTIONS, keyof typeof OPTIONS>
>;

type FormerName = keyof typeof FORMER_NAMES;
type PresentName = (typeof FORMER_NAMES)[FormerName];

/** The warning about a former name. */
export const formerNameWarning = (name: FormerName): string =>
  `"${name}" is deprecated: the option is called "${FORMER_NAMES[name]}".`;

/**
 * Values under the present names of their options; a value that has its present name too is kept. Warns once for each
 * name.
 */
export function presentNames<T extends RenderValues>(values: T, warn: (text: string) => void): T {
  const present = { ...values };
  for (const [former, name] of Object.entries(FORMER_NAMES) as [FormerName, PresentName][]) {
    const value = present[former];
    if (value === undefined) continue;
    warn(formerNameWarning(former));
    present[name] ??= value;
    delete present[former];
  }
  return present;
}

/** What the command line said of images, not yet checked. */
export type RenderValues = Omit<Partial<ReturnType<typeof parseOptions>['values']>, (typeof NOT_OF_IMAGES)[number]>;

/** Options of the command, not of an image. */
const NOT_OF_IMAGES = [
  'json',
  'quiet',
  'list-gpus',
  'gpu',
  'help',
  'version',
  'batch',
  'resume',
  'checkpoint',
  'output-root',
] as const;

/** Options that an image of a batch may have. */
export const BATCH_KEYS: Readonly<Record<string, 'text' | 'boolean' | 'list'>> = Object.fromEntries(
  Object.entries(OPTIONS).flatMap(([name, option]) =>
    (NOT_OF_IMAGES as readonly string[]).includes(name)
      ? []
      : [[name, option.type === 'boolean' ? 'boolean' : 'multiple' in option ? 'list' : 'text']],
  ),
);

const MAX_SIDE = 65536;

/** The values of `--denoise`, from the fastest to the best. */
export const DENOISE_QUALITIES: readonly DenoiseQuality[] = ['fast', 'balanced', 'best'];
const isQuality = (text: string | undefined): text is DenoiseQuality =>
  DENOISE_QUALITIES.includes(text as DenoiseQuality);

/** The error of a command line that cannot be carried out. */
export const usage = (message: string) => new CliError('cli/usage', message);

/** Number of single-letter edits between two words, for "did you mean". */
function editDistance(a: string, b: string): number {
  let row = Array.from({ length: b.length + 1 }, (_, j) => j);
  for (let i = 1; i <= a.length; i++) {
    const next = [i];
    for (let j = 1; j <= b.length; j++) {
      next.push(
        Math.min(
          (row[j] as number) + 1,
          (next[j - 1] as number) + 1,
          (row[j - 1] as number) + (a[i - 1] === b[j - 1] ? 0 : 1),
        ),
      );
    }
    row = next;
  }
  return row[b.length] as number;
}

/** The word that `word` is probably a misspelling of; empty if there is none. */
export function closest(word: string, words: readonly string[]): string {
  const best = words.map((w) => ({ w, d: editDistance(word, w) })).sort((a, b) => a.d - b.d)[0];
  return best && best.d <= Math.max(1, Math.floor(word.length / 3)) ? best.w : '';
}

/**
 * `--exposure -1` is what people type; parseArgs takes a value that begins with a dash only after `=`. And `--denoise`
 * alone stands for a quality; parseArgs knows no option whose value may be left out.
 */
function completedValues(argv: readonly string[]): string[] {
  const out: string[] = [];
  for (let i = 0; i < argv.length; i++) {
    const [word, next] = [argv[i] as string, argv[i + 1]];
    if (/^--[a-z-]+$/.test(word) && next !== undefined && /^-\.?\d/.test(next)) {
      out.push(`${word}=${next}`);
      i++;
    } else if (word === '--denoise' && !isQuality(next)) out.push('--denoise=balanced');
    else out.push(word);
  }
  return out;
}

/** Splits the command line into options and positional arguments. @throws {CliError} `cli/usage` */
export function parseOptions(argv: readonly string[]) {
  return parseOptionsOf(argv, OPTIONS);
}

/** Likewise, with other options. @throws {CliError} `cli/usage` */
export function parseOptionsOf<T extends NonNullable<ParseArgsConfig['options']>>(
  argv: readonly string[],
  options: T,
): ReturnType<typeof parseArgs<{ args: string[]; options: T; allowPositionals: true; strict: true }>> {
  try {
    return parseArgs({ args: completedValues(argv), options, allowPositionals: true, strict: true });
  } catch (cause) {
    const { code, message } = cause as Error & { code?: string };
    const option = /'([^' ]*)/.exec(message)?.[1] ?? '';
    if (code === 'ERR_PARSE_ARGS_UNKNOWN_OPTION') {
      const guess = closest(
        option.replace(/^-+/, ''),
        Object.keys(options).filter((name) => !Object.hasOwn(FORMER_NAMES, name)),
      );
      throw usage(`Unknown option "${option}".${guess ? ` Did you mean --${guess}?` : ''} See glanz --help.`);
    }
    if (code === 'ERR_PARSE_ARGS_INVALID_OPTION_VALUE')
      throw usage(`${(message.split('\n')[0] as string).replace(/\.?$/, '.')} See glanz --help.`);
    throw cause;
  }
}

/** A number that an option gives. @throws {CliError} `cli/usage` */
export function number(
  name: string,
  text: string | undefined,
  fallback: number,
  check: { readonly whole?: boolean; readonly min: number; readonly max: number },
): number {
  if (text === undefined) return fallback;
  const value = text.trim() === '' ? NaN : Number(text);
  if (!(value >= check.min && value <= check.max) || (check.whole && !Number.isInteger(value))) {
    throw usage(
      `--${name} must be a ${check.whole ? 'whole ' : ''}number from ${check.min} to ${check.max}, not "${text}".`,
    );
  }
  return value;
}

function parseSize(text: string): [number, number] {
  const match = /^(\d{1,6})[xX×](\d{1,6})$/.exec(text.trim());
  if (!match) throw usage(`--size must be like 1024x768, not "${text}".`);
  const [width, height] = [Number(match[1]), Number(match[2])];
  if (width < 1 || height < 1 || width > MAX_SIDE || height > MAX_SIDE)
    throw usage(`--size ${text}: both sides must be from 1 to ${MAX_SIDE} pixels.`);
  return [width, height];
}

function defaultOutput(model: string): string {
  const base = (model.split(/[\\/]/).pop() as string).replace(/\.(glb|gltf|obj|stl|usd[acz]?)$/i, '');
  return `${base || 'image'}.png`;
}

const indexOrName = (text: string): string | number => (/^\d+$/.test(text) ? Number(text) : text);

/** Checks what was said of an image. @throws {CliError} `cli/usage` */
export function renderOptions(values: RenderValues, model: string): RenderCommandOptions {
  const [width, height] = parseSize(values.size ?? '1024x768');
  const toneMap = values['tone-map'] ?? 'neutral';
  if (!isToneMap(toneMap)) throw usage(`There is no tone map "${toneMap}". Known: ${TONE_MAPS.join(', ')}.`);
  const { denoise } = values;
  if (denoise !== undefined && !isQuality(denoise))
    throw usage(`--denoise must be ${DENOISE_QUALITIES.join(', ')}, not "${denoise}".`);
  const bits = values.bits === undefined ? undefined : number('bits', values.bits, 8, { whole: true, min: 8, max: 32 });
  const files = values.output ?? [defaultOutput(model)];
  for (const file of files) checkPlaceholders(file);
  if (values['samples-from'] !== undefined && Number(values.noise ?? 0) !== 0)
    throw usage(
      '--samples-from is for films that are merged later, whose pixels all have the same samples: give --samples, not --noise.',
    );
  const time = values.time === undefined ? undefined : number('time', values.time, 0, { min: -1e9, max: 1e9 });
  return {
    model,
    pose: {
      ...(values.scene === undefined ? {} : { scene: indexOrName(values.scene) }),
      ...(values.animation === undefined ? {} : { animation: indexOrName(values.animation) }),
      ...(time === undefined ? {} : { time }),
    },
    variants: values.variant ?? [],
    views: viewsOf(values),
    outputs: files.map((file) => formatOf(file, bits)),
    env: values.env,
    envRotation: (number('env-rotation', values['env-rotation'], 0, { min: -36000, max: 36000 }) * Math.PI) / 180,
    envIntensity: number('env-intensity', values['env-intensity'], 1, { min: 0, max: 1e6 }),
    width,
    height,
    settings: settingsOf({
      ...values,
      background: values.background ?? (values.transparent ? 'transparent' : undefined),
    }),
    samplesFrom: number('samples-from', values['samples-from'], 0, { whole: true, min: 0, max: 2147483647 }),
    ...(denoise === undefined ? {} : { denoise }),
    exposure: values.exposure === undefined ? 0 : parseExposure(values.exposure),
    toneMap,
    catchers: values.catcher ?? [],
  };
}

/** The views that were asked for; one if nothing was said. */
function viewsOf({ camera, view, turntable: steps, elevation }: RenderValues): View[] {
  if (camera !== undefined && view !== undefined)
    throw usage('--camera is one view and --view any number: give one of the two; --view takes cameras too.');
  if (elevation !== undefined && steps === undefined)
    throw usage('--elevation belongs to --turntable; a view has its own: --view 30,20.');
  const views = [
    ...(view ?? []).map(parseView),
    ...(steps === undefined
      ? []
      : turntable(
          number('turntable', steps, 0, { whole: true, min: 1, max: 3600 }),
          number('elevation', elevation, 20, { min: -89, max: 89 }),
        )),
  ];
  if (views.length === 0 || camera !== undefined) views.unshift({ kind: 'camera', name: 'camera', camera });
  return views;
}
