import type { BounceLimits, PathTracerOptions, PixelFilter, RenderOptions } from '../options';

/**
 * What a change of an option costs.
 * - `uniform`: a number in the frame uniforms. The film restarts; no kernel is compiled.
 * - `kernel`: it decides which code the kernels contain. Changed kernels are compiled, and the film restarts.
 * - `film`: it decides how large the film is. The film is allocated again, and changed kernels are compiled.
 * - `schedule`: it decides when samples are taken and how many, not their values. The film keeps its samples.
 */
export type RenderOptionEffect = 'uniform' | 'kernel' | 'film' | 'schedule';

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
export interface LimitsOption extends Row {
  readonly type: 'limits';
  readonly values: readonly (keyof BounceLimits)[];
  /** Lowest and highest value of each. */
  readonly range: readonly [number, number];
  readonly default?: undefined;
}

/** A row of {@link RENDER_OPTIONS}. */
export type RenderOption = NumberOption | BooleanOption | EnumOption | FilterOption | LimitsOption;

type RowOf<T> = [T] extends [number]
  ? NumberOption
  : [T] extends [boolean]
    ? BooleanOption
    : [T] extends [string]
      ? EnumOption<T>
      : [T] extends [PixelFilter]
        ? FilterOption
        : LimitsOption;

/** Members of the options' interfaces that are no settings: sizes, objects and callbacks. */
type NoSetting = 'width' | 'height' | 'camera' | 'hierarchies' | 'signal' | 'onProgress' | 'onFirstLight';

/** The options of `PathTracer.create` and `PathTracer.render` that {@link RENDER_OPTIONS} lists. */
export type RenderSettings = Omit<PathTracerOptions & RenderOptions, NoSetting>;

type Table = { readonly [Name in keyof RenderSettings]-?: RowOf<NonNullable<RenderSettings[Name]>> };

/**
 * Every option of `PathTracer.create` and `PathTracer.render`, with its type, range, default and effect. Validation, the
 * command line, the attributes of `<glanz-viewer>`, the documentation and the playground's panel are derived from it.
 * To add an option: a member with a doc comment in `PathTracerOptions`, a row here, a sentence in
 * {@link RENDER_OPTION_TEXTS} (both checked by the compiler), and its use.
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
  backFaceCulling: { type: 'enum', values: ['off', 'camera', 'all'], default: 'off', effect: 'kernel' },
  maxBounces: {
    type: 'limits',
    values: ['diffuse', 'specular', 'transmission', 'volume'],
    range: [0, 65_535],
    effect: 'kernel',
  },
  regularization: { type: 'number', range: [0, 1], default: 0, effect: 'kernel' },
  clampIndirect: { type: 'number', range: [0, 1e30], above: true, effect: 'kernel' },
  caustics: { type: 'boolean', default: true, effect: 'kernel' },
  multipleScattering: { type: 'boolean', default: true, effect: 'kernel' },
  sampler: { type: 'enum', values: ['blue-noise', 'sobol', 'independent'], default: 'blue-noise', effect: 'kernel' },
  lightSampling: { type: 'enum', values: ['tree', 'power'], default: 'tree', effect: 'kernel' },
  shadowTerminator: { type: 'enum', values: ['smooth', 'faceted'], default: 'smooth', effect: 'kernel' },
  textureLodBias: { type: 'number', range: [-32, 32], default: -1, effect: 'uniform' },
  pathsInFlight: { type: 'integer', range: [1, 2 ** 30], effect: 'schedule' },
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

/** What people read about an option; apart from the table, so that a page that shows no texts does not load them. */
export interface RenderOptionText {
  /** One or two sentences. */
  readonly doc: string;
  /** Unit of the number. */
  readonly unit?: string;
  /** Whether it makes the result biased: some light is missing or moved, for less noise or time. */
  readonly biased?: boolean;
  /** The part of the range that a slider offers; default: the whole range. */
  readonly softRange?: readonly [number, number];
}

/** The texts of all options of {@link RENDER_OPTIONS}. Literals only: bundlers keep expressions that nobody reads. */
export const RENDER_OPTION_TEXTS: Readonly<Record<RenderOptionName, RenderOptionText>> = {
  samples: {
    doc: 'Samples per pixel. With a noise target it is the maximum, by default 65536.',
    softRange: [1, 4096],
  },
  noise: {
    doc: 'Samples only where there is noise, until the standard error relative to the brightness is everywhere at most this: 0.05 is a preview, 0.01 is hardly visible. 0: no target.',
    softRange: [0, 0.1],
  },
  maxSubmitMs: { doc: 'GPU time that one submission should take at most.', unit: 'ms', softRange: [1, 100] },
  maxDepth: {
    doc: 'Maximum number of edges of a path from the camera to a light: 1 shows only emitters, 2 adds direct light.',
    softRange: [1, 16],
  },
  maxVolumeDepth: {
    doc: 'Maximum number of scattering events of a path inside of media such as subsurface or milky glass.',
    softRange: [0, 1024],
  },
  seed: {
    doc: 'Selects the random numbers: the same seed gives the same image on the same device.',
    softRange: [0, 100],
  },
  background: { doc: 'What is visible behind the scene: the environment, or nothing (alpha is the coverage).' },
  filter: {
    doc: 'Pixel filter: how samples around a pixel are weighted. Its radius is half its width.',
    unit: 'pixels',
  },
  lightGroups: {
    doc: 'Keeps groups of lights apart, as layers of the film: those that the scene names, each light, or none.',
  },
  backFaceCulling: {
    doc: 'Leaves out faces that show the camera their back and are not double-sided: for the camera only, while light still meets them, or for all rays.',
  },
  maxBounces: {
    doc: 'Maximum number of bounces of each kind. What is not listed is not limited.',
    biased: true,
  },
  regularization: {
    doc: 'Widens sharp lobes of paths that have already bounced off rough surfaces: 0 is off, 0.25 removes most fireflies of caustics.',
    biased: true,
  },
  clampIndirect: {
    doc: 'Maximum radiance of light that took two bounces or more. Removes fireflies, and energy with them.',
    biased: true,
    softRange: [0, 100],
  },
  caustics: {
    doc: 'Light that reaches a matte surface through a sharp reflection or refraction.',
    biased: true,
  },
  multipleScattering: {
    doc: 'Compensation of the energy that single-scattering microfacet models lose. Off only for comparisons with such models.',
  },
  sampler: { doc: 'Source of the random numbers. All are unbiased; `independent` converges slower.' },
  lightSampling: {
    doc: 'How lights are chosen: by their contribution at the shaded point (a light tree), or by power alone.',
  },
  shadowTerminator: {
    doc: 'Where smooth normals and triangles disagree: light follows the smooth surface, or the triangles.',
  },
  textureLodBias: { doc: 'Added to the level of detail of textures; lower is sharper.', softRange: [-4, 4] },
  pathsInFlight: {
    doc: 'Maximum number of paths on the GPU at once, about 150 bytes each. Default: 4194304, or 1048576 on devices without buffers of 2 GiB.',
    softRange: [4096, 4_194_304],
  },
};

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
