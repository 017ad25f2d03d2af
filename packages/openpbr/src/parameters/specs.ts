import type {
  OpenPbrGroup,
  OpenPbrParameterSpec,
  OpenPbrParameterName,
  OpenPbrParameters,
  OpenPbrParameterType,
  OpenPbrUnit,
} from './types';

type Range = readonly [number, number];
type Specs = { readonly [Name in OpenPbrParameterName]: OpenPbrParameterSpec<Name> };

const UNIT: Range = [0, 1];
const SIGNED: Range = [-1, 1];
const POSITIVE: Range = [0, Infinity];
/** Open at zero: an index of refraction or an Abbe number of 0 means nothing. */
const ABOVE_ZERO: Range = [1e-3, Infinity];

interface Options {
  readonly soft?: Range;
  readonly unit?: OpenPbrUnit;
  readonly uniform?: boolean;
  readonly draft?: boolean;
}

/** No texture drives them: they share a word of the material's record. */
const DRAFT: Options = { uniform: true, draft: true };

function entry<Name extends OpenPbrParameterName>(
  group: OpenPbrGroup,
  name: Name,
  type: OpenPbrParameterType,
  initial: OpenPbrParameters[Name],
  range: Range | undefined,
  { soft, unit = '1', uniform = false, draft = false }: Options = {},
): OpenPbrParameterSpec<Name> {
  const value = Array.isArray(initial) ? (Object.freeze(initial) as unknown as OpenPbrParameters[Name]) : initial;
  return Object.freeze({
    name,
    type,
    default: value,
    ...(range ? { range, softRange: soft ?? range } : {}),
    unit,
    group,
    texturable: !uniform,
    ...(draft ? { draft } : {}),
  });
}

// A function, so that bundlers can drop the table where it is not used.
const table = (): Specs => ({
  base_weight: entry('base', 'base_weight', 'float', 1, UNIT),
  base_color: entry('base', 'base_color', 'color3', [0.8, 0.8, 0.8], UNIT),
  base_diffuse_roughness: entry('base', 'base_diffuse_roughness', 'float', 0, UNIT),
  base_metalness: entry('base', 'base_metalness', 'float', 0, UNIT),
  specular_weight: entry('specular', 'specular_weight', 'float', 1, POSITIVE, { soft: UNIT }),
  specular_color: entry('specular', 'specular_color', 'color3', [1, 1, 1], UNIT),
  specular_roughness: entry('specular', 'specular_roughness', 'float', 0.3, UNIT),
  specular_roughness_anisotropy: entry('specular', 'specular_roughness_anisotropy', 'float', 0, UNIT),
  specular_ior: entry('specular', 'specular_ior', 'float', 1.5, ABOVE_ZERO, { soft: [1, 3] }),
  specular_haze: entry('specular', 'specular_haze', 'float', 0, UNIT, DRAFT),
  specular_haze_spread: entry('specular', 'specular_haze_spread', 'float', 0.3, UNIT, DRAFT),
  specular_retroreflectivity: entry('specular', 'specular_retroreflectivity', 'float', 0, UNIT, DRAFT),
  transmission_weight: entry('transmission', 'transmission_weight', 'float', 0, UNIT),
  transmission_color: entry('transmission', 'transmission_color', 'color3', [1, 1, 1], UNIT),
  transmission_depth: entry('transmission', 'transmission_depth', 'float', 0, POSITIVE, { soft: UNIT, unit: 'length' }),
  transmission_scatter: entry('transmission', 'transmission_scatter', 'color3', [0, 0, 0], UNIT),
  transmission_scatter_anisotropy: entry('transmission', 'transmission_scatter_anisotropy', 'float', 0, SIGNED),
  transmission_dispersion_scale: entry('transmission', 'transmission_dispersion_scale', 'float', 0, UNIT),
  transmission_dispersion_abbe_number: entry(
    'transmission',
    'transmission_dispersion_abbe_number',
    'float',
    20,
    ABOVE_ZERO,
    { soft: [9, 91] },
  ),
  subsurface_weight: entry('subsurface', 'subsurface_weight', 'float', 0, UNIT),
  subsurface_color: entry('subsurface', 'subsurface_color', 'color3', [0.8, 0.8, 0.8], UNIT),
  subsurface_radius: entry('subsurface', 'subsurface_radius', 'float', 1, POSITIVE, { soft: UNIT, unit: 'length' }),
  subsurface_radius_scale: entry('subsurface', 'subsurface_radius_scale', 'color3', [1, 0.5, 0.25], UNIT),
  subsurface_scatter_anisotropy: entry('subsurface', 'subsurface_scatter_anisotropy', 'float', 0, SIGNED),
  coat_weight: entry('coat', 'coat_weight', 'float', 0, UNIT),
  coat_color: entry('coat', 'coat_color', 'color3', [1, 1, 1], UNIT),
  coat_roughness: entry('coat', 'coat_roughness', 'float', 0, UNIT),
  coat_roughness_anisotropy: entry('coat', 'coat_roughness_anisotropy', 'float', 0, UNIT),
  coat_ior: entry('coat', 'coat_ior', 'float', 1.6, ABOVE_ZERO, { soft: [1, 3] }),
  coat_darkening: entry('coat', 'coat_darkening', 'float', 1, UNIT),
  fuzz_weight: entry('fuzz', 'fuzz_weight', 'float', 0, UNIT),
  fuzz_color: entry('fuzz', 'fuzz_color', 'color3', [1, 1, 1], UNIT),
  fuzz_roughness: entry('fuzz', 'fuzz_roughness', 'float', 0.5, UNIT),
  emission_luminance: entry('emission', 'emission_luminance', 'float', 0, POSITIVE, { soft: [0, 1000], unit: 'cd/m²' }),
  emission_color: entry('emission', 'emission_color', 'color3', [1, 1, 1], POSITIVE, { soft: UNIT }),
  thin_film_weight: entry('thin_film', 'thin_film_weight', 'float', 0, UNIT),
  thin_film_thickness: entry('thin_film', 'thin_film_thickness', 'float', 0.5, POSITIVE, { soft: UNIT, unit: 'µm' }),
  thin_film_ior: entry('thin_film', 'thin_film_ior', 'float', 1.4, ABOVE_ZERO, { soft: [1, 3] }),
  geometry_opacity: entry('geometry', 'geometry_opacity', 'float', 1, UNIT),
  geometry_thin_walled: entry('geometry', 'geometry_thin_walled', 'boolean', false, undefined, { uniform: true }),
  geometry_normal: entry('geometry', 'geometry_normal', 'vector3', null, undefined),
  geometry_tangent: entry('geometry', 'geometry_tangent', 'vector3', null, undefined),
  geometry_coat_normal: entry('geometry', 'geometry_coat_normal', 'vector3', null, undefined),
  geometry_coat_tangent: entry('geometry', 'geometry_coat_tangent', 'vector3', null, undefined),
});

/**
 * The parameters of OpenPBR Surface 1.1.1 and three of the draft of 1.2 (`draft`) as data, in the specification's order:
 * `OPENPBR_PARAMETERS` without its texts, which weigh as much as everything else in it.
 */
export const OPENPBR_PARAMETER_SPECS: Specs = /* @__PURE__ */ Object.freeze(/* @__PURE__ */ table());

/** The parameter names in the specification's order. */
export const OPENPBR_PARAMETER_NAMES: readonly OpenPbrParameterName[] = /* @__PURE__ */ Object.freeze(
  /* @__PURE__ */ Object.keys(OPENPBR_PARAMETER_SPECS) as OpenPbrParameterName[],
);
