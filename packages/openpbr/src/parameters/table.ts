import type {
  OpenPbrGroup,
  OpenPbrParameterInfo,
  OpenPbrParameterName,
  OpenPbrParameters,
  OpenPbrParameterType,
  OpenPbrUnit,
} from './types';

type Range = readonly [number, number];
type Table = { readonly [Name in OpenPbrParameterName]: OpenPbrParameterInfo<Name> };

const UNIT: Range = [0, 1];
const SIGNED: Range = [-1, 1];
const POSITIVE: Range = [0, Infinity];
/** Open at zero: an index of refraction or an Abbe number of 0 means nothing. */
const ABOVE_ZERO: Range = [1e-3, Infinity];

interface Options {
  readonly soft?: Range;
  readonly unit?: OpenPbrUnit;
  readonly uniform?: boolean;
}

function entry<Name extends OpenPbrParameterName>(
  group: OpenPbrGroup,
  name: Name,
  type: OpenPbrParameterType,
  initial: OpenPbrParameters[Name],
  range: Range | undefined,
  doc: string,
  { soft, unit = '1', uniform = false }: Options = {},
): OpenPbrParameterInfo<Name> {
  const value = Array.isArray(initial) ? (Object.freeze(initial) as unknown as OpenPbrParameters[Name]) : initial;
  return Object.freeze({
    name,
    type,
    default: value,
    ...(range ? { range, softRange: soft ?? range } : {}),
    unit,
    group,
    doc,
    texturable: !uniform,
  });
}

// A function, so that bundlers can drop the table where it is not used.
const table = (): Table => ({
  base_weight: entry(
    'base',
    'base_weight',
    'float',
    1,
    UNIT,
    'Scales the diffuse lobe, and the reflectance at normal incidence of metal.',
  ),
  base_color: entry(
    'base',
    'base_color',
    'color3',
    [0.8, 0.8, 0.8],
    UNIT,
    'Albedo of the diffuse lobe; reflectance at normal incidence of metal.',
  ),
  base_diffuse_roughness: entry(
    'base',
    'base_diffuse_roughness',
    'float',
    0,
    UNIT,
    'Roughness of the diffuse lobe (σ of the EON model): 0 is Lambert, 1 flattens the shading like clay or the moon.',
  ),
  base_metalness: entry('base', 'base_metalness', 'float', 0, UNIT, 'Mix from dielectric (0) to metal (1).'),
  specular_weight: entry(
    'specular',
    'specular_weight',
    'float',
    1,
    POSITIVE,
    'Scales the reflectance at normal incidence of the dielectric, by changing its index of refraction; scales the whole metal lobe.',
    { soft: UNIT },
  ),
  specular_color: entry(
    'specular',
    'specular_color',
    'color3',
    [1, 1, 1],
    UNIT,
    'Tint of the dielectric reflection seen from outside; tint near grazing angles (82°) of metal.',
  ),
  specular_roughness: entry(
    'specular',
    'specular_roughness',
    'float',
    0.3,
    UNIT,
    'Perceptual roughness of the base; its square is the GGX slope. 0 is a mirror.',
  ),
  specular_roughness_anisotropy: entry(
    'specular',
    'specular_roughness_anisotropy',
    'float',
    0,
    UNIT,
    'Stretches the highlight across the tangent: 0 is round, 1 a line.',
  ),
  specular_ior: entry(
    'specular',
    'specular_ior',
    'float',
    1.5,
    ABOVE_ZERO,
    'Index of refraction of the dielectric base.',
    { soft: [1, 3] },
  ),
  transmission_weight: entry(
    'transmission',
    'transmission_weight',
    'float',
    0,
    UNIT,
    'Mix from opaque (0) to transparent (1) dielectric.',
  ),
  transmission_color: entry(
    'transmission',
    'transmission_color',
    'color3',
    [1, 1, 1],
    UNIT,
    'Colour of light that went straight through `transmission_depth` of the interior; with depth 0 a tint at every crossing of the surface.',
  ),
  transmission_depth: entry(
    'transmission',
    'transmission_depth',
    'float',
    0,
    POSITIVE,
    'Depth at which white light has turned into `transmission_color`; 0 switches the interior medium off.',
    { soft: UNIT, unit: 'length' },
  ),
  transmission_scatter: entry(
    'transmission',
    'transmission_scatter',
    'color3',
    [0, 0, 0],
    UNIT,
    'Scattering coefficient of the interior, times `transmission_depth`.',
  ),
  transmission_scatter_anisotropy: entry(
    'transmission',
    'transmission_scatter_anisotropy',
    'float',
    0,
    SIGNED,
    "Henyey–Greenstein g of the interior's scattering: -1 backward, 0 isotropic, 1 forward.",
  ),
  transmission_dispersion_scale: entry(
    'transmission',
    'transmission_dispersion_scale',
    'float',
    0,
    UNIT,
    'Strength of dispersion: 0 none, 1 as `transmission_dispersion_abbe_number` says.',
  ),
  transmission_dispersion_abbe_number: entry(
    'transmission',
    'transmission_dispersion_abbe_number',
    'float',
    20,
    ABOVE_ZERO,
    'Abbe number V_d of the interior: the lower, the more its index of refraction varies with the wavelength.',
    { soft: [9, 91] },
  ),
  subsurface_weight: entry(
    'subsurface',
    'subsurface_weight',
    'float',
    0,
    UNIT,
    'Mix from diffuse (0) to subsurface scattering (1).',
  ),
  subsurface_color: entry(
    'subsurface',
    'subsurface_color',
    'color3',
    [0.8, 0.8, 0.8],
    UNIT,
    'Colour that multiple scattering below the surface gives back.',
  ),
  subsurface_radius: entry(
    'subsurface',
    'subsurface_radius',
    'float',
    1,
    POSITIVE,
    'Mean free path below the surface, times `subsurface_radius_scale` per channel.',
    { soft: UNIT, unit: 'length' },
  ),
  subsurface_radius_scale: entry(
    'subsurface',
    'subsurface_radius_scale',
    'color3',
    [1, 0.5, 0.25],
    UNIT,
    'Factor per channel on `subsurface_radius`.',
  ),
  subsurface_scatter_anisotropy: entry(
    'subsurface',
    'subsurface_scatter_anisotropy',
    'float',
    0,
    SIGNED,
    'Henyey–Greenstein g of subsurface scattering; on a thin wall the split between reflected (-1) and transmitted (1) light.',
  ),
  coat_weight: entry('coat', 'coat_weight', 'float', 0, UNIT, 'Coverage of the coat.'),
  coat_color: entry(
    'coat',
    'coat_color',
    'color3',
    [1, 1, 1],
    UNIT,
    'Colour of the coat: what is left of white light after going through it down and up at normal incidence.',
  ),
  coat_roughness: entry('coat', 'coat_roughness', 'float', 0, UNIT, 'Perceptual roughness of the coat.'),
  coat_roughness_anisotropy: entry(
    'coat',
    'coat_roughness_anisotropy',
    'float',
    0,
    UNIT,
    "Anisotropy of the coat's highlight: 0 is round, 1 a line.",
  ),
  coat_ior: entry('coat', 'coat_ior', 'float', 1.6, ABOVE_ZERO, 'Index of refraction of the coat.', { soft: [1, 3] }),
  coat_darkening: entry(
    'coat',
    'coat_darkening',
    'float',
    1,
    UNIT,
    'How much of the darkening by internal reflections in the coat is kept: 0 none, 1 physical.',
  ),
  fuzz_weight: entry('fuzz', 'fuzz_weight', 'float', 0, UNIT, 'Coverage of the fuzz.'),
  fuzz_color: entry('fuzz', 'fuzz_color', 'color3', [1, 1, 1], UNIT, 'Colour of the fuzz.'),
  fuzz_roughness: entry(
    'fuzz',
    'fuzz_roughness',
    'float',
    0.5,
    UNIT,
    'Roughness of the fuzz: low is velvet at the silhouette, high is dust.',
  ),
  emission_luminance: entry(
    'emission',
    'emission_luminance',
    'float',
    0,
    POSITIVE,
    'Luminance of the emission; radiance is `emission_color × emission_luminance`.',
    { soft: [0, 1000], unit: 'cd/m²' },
  ),
  emission_color: entry(
    'emission',
    'emission_color',
    'color3',
    [1, 1, 1],
    POSITIVE,
    'Colour of the emission, not normalised.',
    { soft: UNIT },
  ),
  thin_film_weight: entry('thin_film', 'thin_film_weight', 'float', 0, UNIT, 'Coverage of the thin film.'),
  thin_film_thickness: entry(
    'thin_film',
    'thin_film_thickness',
    'float',
    0.5,
    POSITIVE,
    'Thickness of the thin film.',
    { soft: UNIT, unit: 'µm' },
  ),
  thin_film_ior: entry(
    'thin_film',
    'thin_film_ior',
    'float',
    1.4,
    ABOVE_ZERO,
    'Index of refraction of the thin film.',
    { soft: [1, 3] },
  ),
  geometry_opacity: entry(
    'geometry',
    'geometry_opacity',
    'float',
    1,
    UNIT,
    'Presence of the whole surface: 0 is a hole.',
  ),
  geometry_thin_walled: entry(
    'geometry',
    'geometry_thin_walled',
    'boolean',
    false,
    undefined,
    'The surface is an infinitely thin sheet with the same medium on both sides, not the boundary of a solid.',
    { uniform: true },
  ),
  geometry_normal: entry(
    'geometry',
    'geometry_normal',
    'vector3',
    null,
    undefined,
    "Normal of the base in the surface's frame; `null` is the unperturbed normal.",
  ),
  geometry_tangent: entry(
    'geometry',
    'geometry_tangent',
    'vector3',
    null,
    undefined,
    "Tangent of the base in the surface's frame; `null` is the unperturbed tangent.",
  ),
  geometry_coat_normal: entry(
    'geometry',
    'geometry_coat_normal',
    'vector3',
    null,
    undefined,
    "Normal of the coat in the surface's frame; `null` is the unperturbed normal.",
  ),
  geometry_coat_tangent: entry(
    'geometry',
    'geometry_coat_tangent',
    'vector3',
    null,
    undefined,
    "Tangent of the coat in the surface's frame; `null` is the unperturbed tangent.",
  ),
});

/**
 * The parameter table of OpenPBR Surface 1.1 as data: names, types, defaults, hard and soft ranges, units, groups and
 * documentation, in the specification's order. Everything else (validation, user interfaces, importers) reads it from
 * here.
 *
 * @example
 * for (const info of Object.values(OPENPBR_PARAMETERS)) addSlider(info.name, info.softRange, info.doc);
 */
export const OPENPBR_PARAMETERS: Table = /* @__PURE__ */ Object.freeze(/* @__PURE__ */ table());

/** The parameter names in the specification's order. */
export const OPENPBR_PARAMETER_NAMES: readonly OpenPbrParameterName[] = /* @__PURE__ */ Object.freeze(
  /* @__PURE__ */ Object.keys(OPENPBR_PARAMETERS) as OpenPbrParameterName[],
);
