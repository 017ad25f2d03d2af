import type { Scene } from '@glanz/scene';
import { DeviceError, RenderError } from './errors';
import type { PathTracerOptions, RenderOptions } from './options';
import { hasInterior } from './materials/interiors';

/** Default of `RenderOptions.maxSubmitMs`: a frame at 60 Hz. */
export const DEFAULT_SUBMIT_MS = 16;

/** Paths count edges and scattering events in 16 bits each. */
const MOST_EVENTS = 0xffff;
/** An interior's place in a path's stack has 15 bits, and 0 stands for none. */
const MOST_INTERIORS = 0x7fff;

/**
 * The samples that are asked for.
 * @throws {RenderError} `renderer/samples`
 */
export function checkedSamples({
  noise,
  samples = noise === undefined ? 64 : 65536,
  maxSubmitMs = DEFAULT_SUBMIT_MS,
}: RenderOptions): number {
  if (!(maxSubmitMs > 0)) throw new RenderError('renderer/samples', `maxSubmitMs must be above 0, not ${maxSubmitMs}.`);
  if (!Number.isInteger(samples) || samples < 1)
    throw new RenderError(
      'renderer/samples',
      `The number of samples must be a whole number of at least 1, not ${samples}.`,
    );
  if (noise !== undefined && !(noise > 0))
    throw new RenderError('renderer/samples', `The noise to reach must be above 0, not ${noise}.`);
  return samples;
}

/** The values that an option with a choice of them can have, the default first. */
export const CHOICES: { readonly [Name in keyof PathTracerOptions]?: readonly PathTracerOptions[Name][] } = {
  background: ['environment', 'transparent'],
  lightGroups: ['off', 'named', 'each'],
  sampler: ['blue-noise', 'sobol', 'independent'],
  lightSampling: ['tree', 'power'],
  shadowTerminator: ['smooth', 'faceted'],
  backFaceCulling: ['off', 'camera', 'all'],
};

/**
 * Checks the choices among the options, and those that are plain numbers.
 * @throws {RenderError} `renderer/option`
 */
export function checkOptions(options: Partial<PathTracerOptions>): void {
  for (const [name, choices] of Object.entries(CHOICES)) {
    const value = options[name as keyof PathTracerOptions];
    if (value === undefined || (choices as readonly unknown[]).includes(value)) continue;
    throw new RenderError(
      'renderer/option',
      `${name} must be one of ${choices.map((choice) => `"${String(choice)}"`).join(', ')}, not ${JSON.stringify(value)}.`,
    );
  }
  const { seed = 0, textureLodBias = 0, pathsInFlight = 1 } = options;
  for (const [name, value] of Object.entries({ seed, textureLodBias })) {
    if (!Number.isFinite(value)) throw new RenderError('renderer/option', `${name} must be finite, not ${value}.`);
  }
  if (!(pathsInFlight >= 1))
    throw new RenderError('renderer/option', `pathsInFlight must be at least 1, not ${pathsInFlight}.`);
}

/** @throws {RenderError} `renderer/option` */
export function checkDepth(maxDepth: number): void {
  if (!Number.isInteger(maxDepth) || maxDepth < 1 || maxDepth > MOST_EVENTS)
    throw new RenderError(
      'renderer/option',
      `maxDepth must be a whole number of at least 1 and at most ${MOST_EVENTS}, not ${maxDepth}.`,
    );
}

/** @throws {RenderError} `renderer/option` */
export function checkVolumeDepth(maxVolumeDepth: number): void {
  if (!Number.isInteger(maxVolumeDepth) || maxVolumeDepth < 0 || maxVolumeDepth > MOST_EVENTS)
    throw new RenderError(
      'renderer/option',
      `maxVolumeDepth must be a whole number of at most ${MOST_EVENTS}, not ${maxVolumeDepth}.`,
    );
}

/** @throws {DeviceError} `renderer/limit` where a path has too few bits to say in which of the materials it is. */
export function checkInteriors({ materials }: Scene): void {
  const last = materials.findLastIndex(hasInterior);
  if (last >= MOST_INTERIORS)
    throw new DeviceError(
      'renderer/limit',
      `Material ${last} ("${materials[last]?.name}") lets light into its inside; only the first ${MOST_INTERIORS} materials of a scene may: move it up, or give it geometry_thin_walled.`,
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
