import { acescgToLinear } from '../color/acescg';
import { scatteringRadius } from '../color/radius';
import {
  OPENPBR_PARAMETER_SPECS,
  validateParameters,
  type OpenPbrColor,
  type OpenPbrParameterName,
  type OpenPbrParameters,
} from '../parameters/index';
import { examples } from './examples';

/** Names of the specification's example materials. */
export type OpenPbrPresetName = keyof ReturnType<typeof examples>;

type Presets = Readonly<Record<OpenPbrPresetName, Partial<OpenPbrParameters>>>;

/** Options for {@link openPbrPreset}. */
export interface OpenPbrPresetOptions {
  /**
   * Metres per unit of length of the example; default 1. Depths and scattering radii of liquids, skin and stone are
   * plausible as centimetres: 0.01.
   */
  readonly unit?: number;
}

function converted(example: Partial<OpenPbrParameters>): Partial<OpenPbrParameters> {
  const parameters: Partial<Record<OpenPbrParameterName, unknown>> = {};
  for (const [name, value] of Object.entries(example) as [
    OpenPbrParameterName,
    OpenPbrParameters[OpenPbrParameterName],
  ][]) {
    if (name === 'subsurface_radius_scale') {
      // Mean free paths are no colours, but a renderer's channels are those of Rec.709, so they change with the
      // primaries too.
      const { radius, scale } = scatteringRadius(1, acescgToLinear(value as OpenPbrColor));
      if (radius > 1) parameters.subsurface_radius = radius;
      parameters.subsurface_radius_scale = Object.freeze(scale);
    } else
      parameters[name] =
        OPENPBR_PARAMETER_SPECS[name].type === 'color3' ? Object.freeze(acescgToLinear(value as OpenPbrColor)) : value;
  }
  // A few saturated colours lie outside of Rec.709, and edge tints of metals a little above 1.
  return Object.freeze(validateParameters(parameters as Partial<OpenPbrParameters>).parameters);
}

const presets = (): Presets =>
  Object.fromEntries(Object.entries(examples()).map(([name, example]) => [name, converted(example)])) as Presets;

/**
 * The 83 example materials of the OpenPBR specification, by name: metals, glasses, liquids, skin, stone, cloth and
 * more. Only what differs from the defaults; colours are linear Rec.709, converted from ACEScg and clamped to what the
 * parameters take; lengths are as in the examples (see {@link openPbrPreset}).
 *
 * Made from the specification's examples, Copyright Contributors to the OpenPBR project, Apache License 2.0.
 *
 * @example
 * tracer.setMaterial('housing', OPENPBR_PRESETS.gold);
 */
export const OPENPBR_PRESETS: Presets = /* @__PURE__ */ Object.freeze(/* @__PURE__ */ presets());

/** The names in {@link OPENPBR_PRESETS}, in alphabetical order. */
export const OPENPBR_PRESET_NAMES: readonly OpenPbrPresetName[] = /* @__PURE__ */ Object.freeze(
  /* @__PURE__ */ Object.keys(OPENPBR_PRESETS) as OpenPbrPresetName[],
);

/**
 * One of the example materials at the scale of a scene.
 *
 * @example
 * const milk = openPbrPreset('milk', { unit: 0.01 });   // light goes centimetres deep, not metres
 */
export function openPbrPreset(
  name: OpenPbrPresetName,
  { unit = 1 }: OpenPbrPresetOptions = {},
): Partial<OpenPbrParameters> {
  const preset = OPENPBR_PRESETS[name];
  const scaled: { -readonly [Name in keyof OpenPbrParameters]?: OpenPbrParameters[Name] } = { ...preset };
  if (scaled.transmission_depth !== undefined) scaled.transmission_depth *= unit;
  if (scaled.subsurface_weight !== undefined) scaled.subsurface_radius = (scaled.subsurface_radius ?? 1) * unit;
  return scaled;
}
