import type { Scene } from '@glanz/scene';
import { DeviceError, RenderError } from './errors';
import type { PathTracerOptions, RenderOptions } from './options';
import {
  MAX_ADAPTIVE_SAMPLES,
  optionFault,
  RENDER_OPTIONS,
  type RenderOptionName,
  type RenderSettings,
  type ResolvedSettings,
} from './render-options';
import { hasInterior } from './materials/interiors';

/** An interior's place in a path's stack has 15 bits, and 0 stands for none. */
const MAX_INTERIORS = 0x7fff;

/** The options of a path tracer, validated, with their defaults. */
export type TracerSettings = PathTracerOptions &
  ResolvedSettings & {
    /** See `PathTracer.setLightReuse`. */
    readonly lightReuse?: boolean | undefined;
  };

/**
 * Validates options by their table and adds the defaults of those that are missing.
 * @throws {RenderError} `renderer/option`, `renderer/samples`, `renderer/filter`
 */
export function resolveOptions<T extends RenderSettings>(options: T): T & ResolvedSettings {
  const resolved: Record<string, unknown> = { ...options };
  for (const [name, row] of Object.entries(RENDER_OPTIONS)) {
    const fault = resolved[name] === undefined ? undefined : optionFault(name as RenderOptionName, resolved[name]);
    if (fault)
      throw new RenderError(
        name === 'filter'
          ? 'renderer/filter'
          : /^(samples|noise|maxSubmitMs)$/.test(name)
            ? 'renderer/samples'
            : 'renderer/option',
        fault,
      );
    resolved[name] ??= 'default' in row ? row.default : undefined;
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

/** @throws {RenderError} `renderer/samples` */
export function checkFirstSample(firstSample: number): void {
  if (!Number.isInteger(firstSample) || firstSample < 0 || firstSample > 0x7fffffff)
    throw new RenderError(
      'renderer/samples',
      `firstSample must be an integer from 0 to ${0x7fffffff}, not ${firstSample}.`,
    );
}

/** @throws {DeviceError} `renderer/limit` where a path has too few bits to say in which of the materials it is. */
export function checkInteriors({ materials }: Scene): void {
  const last = materials.findLastIndex(hasInterior);
  if (last >= MAX_INTERIORS)
    throw new DeviceError(
      'renderer/limit',
      `Material ${last} ("${materials[last]?.name}") has an interior; only the first ${MAX_INTERIORS} may: move it up, or set geometry_thin_walled.`,
    );
}

/** @throws {RenderError} `renderer/size` */
export function checkRenderScale(scale: number): void {
  if (!(typeof scale === 'number' && scale > 0 && scale <= 1))
    throw new RenderError('renderer/size', `A render scale is above 0 and at most 1, not ${String(scale)}.`);
}

export function checkSize(width: number, height: number): void {
  if (!Number.isInteger(width) || !Number.isInteger(height) || width < 1 || height < 1) {
    throw new RenderError(
      'renderer/size',
      `An image of ${width} × ${height} pixels: both must be whole numbers of at least 1.`,
    );
  }
}
