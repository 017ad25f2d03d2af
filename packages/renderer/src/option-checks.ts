import type { Scene } from '@glanz/scene';
import { DeviceError, RenderError } from './errors';
import type { PathTracerOptions, RenderOptions } from './options';
import {
  MAX_ADAPTIVE_SAMPLES,
  optionFault,
  RENDER_OPTIONS,
  type RenderOptionName,
  type RenderSettings,
} from './render-options';
import { hasInterior } from './materials/interiors';

/** An interior's place in a path's stack has 15 bits, and 0 stands for none. */
const MAX_INTERIORS = 0x7fff;

type Defaulted = {
  [Name in RenderOptionName]: (typeof RENDER_OPTIONS)[Name] extends { readonly default: {} } ? Name : never;
}[RenderOptionName];

/** Validated settings; options without a default may be absent. */
export type ResolvedSettings = Omit<RenderSettings, Defaulted> & Required<Pick<RenderSettings, Defaulted>>;

/** The options of a path tracer, validated, with their defaults. */
export type TracerSettings = PathTracerOptions & ResolvedSettings;

/** @throws {RenderError} `renderer/option`, `renderer/samples`, `renderer/filter` */
function check(name: RenderOptionName, value: unknown): void {
  const fault = optionFault(name, value);
  if (fault === undefined) return;
  const goal = name === 'samples' || name === 'noise' || name === 'maxSubmitMs';
  throw new RenderError(goal ? 'renderer/samples' : name === 'filter' ? 'renderer/filter' : 'renderer/option', fault);
}

/**
 * Validates options by their table and adds the defaults of those that are missing.
 * @throws {RenderError} `renderer/option`, `renderer/samples`, `renderer/filter`
 */
export function resolveOptions<T extends RenderSettings>(options: T): T & ResolvedSettings {
  const resolved: Record<string, unknown> = { ...options };
  for (const [name, row] of Object.entries(RENDER_OPTIONS)) {
    const value = options[name as RenderOptionName];
    if (value !== undefined) check(name as RenderOptionName, value);
    else if ('default' in row) resolved[name] = row.default;
  }
  return resolved as T & ResolvedSettings;
}

/**
 * The goal of a `render()`, with its defaults.
 * @throws {RenderError} `renderer/samples`
 */
export function renderGoal(options: RenderOptions): Required<Pick<ResolvedSettings, 'samples' | 'maxSubmitMs'>> & {
  readonly noise: number | undefined;
} {
  const { samples, noise, maxSubmitMs } = resolveOptions(options);
  return noise
    ? { samples: options.samples ?? MAX_ADAPTIVE_SAMPLES, noise, maxSubmitMs }
    : { samples, noise: undefined, maxSubmitMs };
}

/** @throws {DeviceError} `renderer/limit` where a path has too few bits to say in which of the materials it is. */
export function checkInteriors({ materials }: Scene): void {
  const last = materials.findLastIndex(hasInterior);
  if (last >= MAX_INTERIORS)
    throw new DeviceError(
      'renderer/limit',
      `Material ${last} ("${materials[last]?.name}") lets light into its inside; only the first ${MAX_INTERIORS} materials of a scene may: move it up, or give it geometry_thin_walled.`,
    );
}

/** @throws {RenderError} `renderer/size` */
export function checkSize(width: number, height: number): void {
  if (!Number.isInteger(width) || !Number.isInteger(height) || width < 1 || height < 1) {
    throw new RenderError(
      'renderer/size',
      `A picture of ${width} × ${height} pixels cannot be rendered: both must be whole numbers of at least 1.`,
    );
  }
}
