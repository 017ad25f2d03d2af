import type { AovName, PathTracerOptions, PixelFilter, RenderOptions } from '../options';

/**
 * What a change of an option costs.
 * - `uniform`: a number in the frame uniforms. The film restarts; no kernel is compiled.
 * - `kernel`: it decides which code the kernels contain. Changed kernels are compiled, and the film restarts.
 * - `film`: it decides how large the film is. The film is allocated again, and changed kernels are compiled.
 * - `layers`: it decides what the film keeps besides the image. Changed kernels are compiled; the film keeps its samples.
 * - `schedule`: it decides when samples are taken and how many, or where a scene is prepared, not their values. The film
 *   keeps its samples.
 */
export type RenderOptionEffect = 'uniform' | 'kernel' | 'film' | 'layers' | 'schedule';

interface Row {
  readonly effect: RenderOptionEffect;
}

/** A number. */
export interface NumberOption extends Row {
  readonly type: 'number' | 'integer';
  /** Lowest and highest value. */
  readonly range: readonly [number, number];
  /** Whether the lowest value itself is excluded. */
  readonly above?: boolean;
  /** Absent: the option is off unless it is set. */
  readonly default?: number;
}

/** `true` or `false`. */
export interface BooleanOption extends Row {
  readonly type: 'boolean';
  readonly default: boolean;
}

/** One of several names. */
export interface EnumOption<T extends string = string> extends Row {
  readonly type: 'enum';
  readonly values: readonly T[];
  readonly default: T;
}

/** A pixel filter by name, or with its radius. */
export interface FilterOption extends Row {
  readonly type: 'filter';
  /** The filters, each with its default radius in pixels. */
  readonly radii: Readonly<Record<Exclude<PixelFilter, object>, number>>;
  /** Range of the radius in pixels. */
  readonly range: readonly [number, number];
  /** The lowest radius itself is excluded. */
  readonly above: true;
  readonly default: Exclude<PixelFilter, object>;
}

/** Limits of several kinds: integers by the name of the kind. */
export interface LimitsOption<T extends string = string> extends Row {
  readonly type: 'limits';
  readonly values: readonly T[];
  /** Lowest and highest value of each. */
  readonly range: readonly [number, number];
  readonly default?: undefined;
}

/** A list of names, each at most once. */
export interface NamesOption extends Row {
  readonly type: 'names';
  readonly values: readonly AovName[];
  readonly default: readonly AovName[];
}

/** A row of {@link RENDER_OPTIONS}. */
export type RenderOption = NumberOption | BooleanOption | EnumOption | FilterOption | LimitsOption | NamesOption;

type RowOf<T> = [T] extends [number]
  ? NumberOption
  : [T] extends [boolean]
    ? BooleanOption
    : [T] extends [string]
      ? EnumOption<T>
      : [T] extends [PixelFilter]
        ? FilterOption
        : [T] extends [readonly AovName[]]
          ? NamesOption
          : LimitsOption<keyof T & string>;

/** Members of the options' interfaces that are no settings: sizes, objects and callbacks. */
type NoSetting = 'width' | 'height' | 'camera' | 'hierarchies' | 'signal' | 'onProgress' | 'onFirstLight' | 'onWarning';

/** The options of `PathTracer.create` and `PathTracer.render` that {@link RENDER_OPTIONS} lists. */
export type RenderSettings = Omit<PathTracerOptions & RenderOptions, NoSetting>;

type Table = { readonly [Name in keyof RenderSettings]-?: RowOf<NonNullable<RenderSettings[Name]>> };

/**
 * Every option of `PathTracer.create` and `PathTracer.render`, with its type, range, default and effect. Validation, the
 * command line, the attributes of `<glanz-viewer>`, the documentation and the playground's panel are derived from it.
 * To add an option: a member with a doc comment in `PathTracerOptions`, a row here, a sentence in
 * `RENDER_OPTION_TEXTS` in texts.ts (both checked by the compiler), and its use.
 */
export const RENDER_OPTIONS = {
  samples: { type: 'integer', range: [1, 2 ** 24], default: 256, effect: 'schedule' },
  noise: { type: 'number', range: [0, 1000], effect: 'schedule' },
  maxSubmitMs: { type: 'number', range: [0.1, 10_000], default: 16, effect: 'schedule' },
  // Paths count edges and scattering events in 16 bits each.
  maxDepth: { type: 'integer', range: [1, 65_535], default: 8, effect: 'uniform' },
  maxVolumeDepth: { type: 'integer', range: [0, 65_535], default: 256, effect: 'uniform' },
  seed: { type: 'integer', range: [0, 2 ** 32 - 1], default: 0, effect: 'uniform' },
  background: { type: 'enum', values: ['environment', 'transparent'], default: 'environment', effect: 'uniform' },
  filter: {
    type: 'filter',
    radii: { box: 0.5, gaussian: 1.5, 'blackman-harris': 1.5 },
    range: [0, 16],
    above: true,
    default: 'box',
    effect: 'kernel',
  },
  lightGroups: { type: 'enum', values: ['off', 'named', 'each'], default: 'named', effect: 'film' },
  aovs: {
    type: 'names',
    values: [
      'albedo',
      'normal',
      'virtualDepth',
      'coverage',
      'depth',
      'position',
      'objectId',
      'materialId',
      'roughness',
      'motion',
    ],
    default: [],
    effect: 'layers',
  },
  backFaceCulling: { type: 'enum', values: ['off', 'camera', 'all'], default: 'off', effect: 'kernel' },
  maxBounces: {
    type: 'limits',
    values: ['diffuse', 'specular', 'transmission', 'volume'],
    range: [0, 65_535],
    effect: 'kernel',
  },
  regularization: { type: 'number', range: [0, 1], default: 0, effect: 'kernel' },
  shadowSoftness: { type: 'number', range: [0, 1], default: 0, effect: 'kernel' },
  clampIndirect: { type: 'number', range: [0, 1e30], above: true, effect: 'kernel' },
  caustics: { type: 'boolean', default: true, effect: 'kernel' },
  lightPaths: { type: 'number', range: [0, 16], default: 0, effect: 'kernel' },
  guiding: { type: 'number', range: [0, 1000], default: 0, effect: 'kernel' },
  multipleScattering: { type: 'boolean', default: true, effect: 'kernel' },
  sampler: { type: 'enum', values: ['blue-noise', 'sobol', 'independent'], default: 'blue-noise', effect: 'kernel' },
  lightSampling: { type: 'enum', values: ['tree', 'power'], default: 'tree', effect: 'kernel' },
  lightCandidates: { type: 'integer', range: [1, 64], default: 1, effect: 'kernel' },
  shadowTerminator: { type: 'enum', values: ['smooth', 'faceted'], default: 'smooth', effect: 'kernel' },
  textureLodBias: { type: 'number', range: [-32, 32], default: -1, effect: 'uniform' },
  bvhBuilder: { type: 'enum', values: ['auto', 'cpu', 'gpu'], default: 'auto', effect: 'schedule' },
  pathsInFlight: { type: 'integer', range: [1, 2 ** 30], effect: 'schedule' },
  // Films of scenes whose textures it reduces differ by the sizes of their images.
  memory: { type: 'limits', values: ['budgetMiB', 'compactAboveMiB'], range: [1, 2 ** 20], effect: 'schedule' },
} as const satisfies Table;

/** Name of an option, as in {@link RENDER_OPTIONS}. */
export type RenderOptionName = keyof typeof RENDER_OPTIONS;

type Defaulted = {
  [Name in RenderOptionName]: (typeof RENDER_OPTIONS)[Name] extends { readonly default: {} } ? Name : never;
}[RenderOptionName];

/** Validated settings, with the defaults of those that have one. */
export type ResolvedSettings = Omit<RenderSettings, Defaulted> & Required<Pick<RenderSettings, Defaulted>>;

/** Maximum number of samples where `noise` is given and `samples` is not. */
export const MAX_ADAPTIVE_SAMPLES = 65_536;

type Missing = {
  [Name in RenderOptionName]: (typeof RENDER_OPTIONS)[Name] extends EnumOption & {
    readonly values: readonly (infer V)[];
  }
    ? Exclude<RenderSettings[Name], V | undefined>
    : never;
}[RenderOptionName];
/** Fails to compile where an enum of the interfaces has a value that its row does not list. */
type Complete<T extends never> = T;
/** @internal */
export type AllValuesListed = Complete<Missing>;
