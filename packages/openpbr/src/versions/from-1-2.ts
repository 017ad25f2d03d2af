import { mediumOfAlbedo } from '../color/medium-of-albedo';
import type { OpenPbrColor, OpenPbrParameters } from '../parameters/index';

/**
 * Parameters of the draft of OpenPBR Surface 1.2 (branch `dev_1.2`, as of June 2026). Those that Glanz has too mean the
 * same but for `transmission_scatter`, here the single-scattering albedo, and `emission_luminance`, whose default is
 * 1000 cd/m². Missing ones have the draft's defaults.
 */
export interface OpenPbr12Parameters extends Partial<OpenPbrParameters> {
  /** Factor on `emission_luminance`, 0..1; default 0. */
  readonly emission_weight?: number;
}

/** What {@link fromOpenPbr12} returns. */
export interface FromOpenPbr12 {
  /** Parameters that Glanz draws: of OpenPBR 1.1.1, with the draft's haze and retroreflectivity. */
  readonly parameters: Partial<OpenPbrParameters>;
  /** Parameters whose effect is lost, and why. Empty: the material looks the same. */
  readonly lost: readonly { readonly parameter: keyof OpenPbr12Parameters; readonly reason: string }[];
}

/** The draft's default of `emission_luminance`. */
const LUMINANCE = 1000;

const unit = (value: number): number => Math.min(Math.max(value, 0), 1);
const unitColor = ([r, g, b]: OpenPbrColor): OpenPbrColor => [unit(r), unit(g), unit(b)];

/**
 * Converts a material of the draft of OpenPBR 1.2 to what Glanz draws: 1.1.1, with the draft's haze and
 * retroreflectivity. Pure. `emission_weight` and albedos are clamped to 0..1, as the draft asks; other values are taken
 * as they are, and `validateParameters` checks them.
 *
 * - `emission_weight × emission_luminance` becomes `emission_luminance`: exact.
 * - `transmission_scatter`, an albedo Ω, becomes the coefficient −Ω·ln(transmission_color): exact, with a shorter
 *   `transmission_depth` and a lighter `transmission_color` where it would exceed 1.
 * - `specular_haze`, `specular_haze_spread` and `specular_retroreflectivity` stay as they are.
 * - A `specular_weight` that leaves the refraction alone has no counterpart, and is listed as lost where it acts.
 *
 * @example
 * const { parameters, lost } = fromOpenPbr12({ emission_weight: 0.5, emission_color: [1, 0.8, 0.6] });
 * // parameters.emission_luminance: 500
 */
export function fromOpenPbr12(given: OpenPbr12Parameters): FromOpenPbr12 {
  const {
    emission_weight: emission = 0,
    emission_luminance: luminance = LUMINANCE,
    transmission_scatter: albedo,
    ...rest
  } = given;
  const parameters: { -readonly [Name in keyof OpenPbrParameters]?: OpenPbrParameters[Name] } = rest;
  const lost: { parameter: keyof OpenPbr12Parameters; reason: string }[] = [];
  if (emission > 0 && luminance > 0) parameters.emission_luminance = unit(emission) * luminance;
  const { transmission_depth: depth = 0, transmission_color: transmittance = [1, 1, 1] } = given;
  // Without a depth there is no medium in either version.
  if (albedo && depth > 0) Object.assign(parameters, mediumOfAlbedo(transmittance, depth, unitColor(albedo)));
  if ((given.transmission_weight ?? 0) > 0 && (given.specular_weight ?? 1) !== 1)
    lost.push({
      parameter: 'specular_weight',
      reason: 'OpenPBR 1.1.1 refracts by the index that the weight has changed; the reflection is the same',
    });
  return { parameters, lost };
}
