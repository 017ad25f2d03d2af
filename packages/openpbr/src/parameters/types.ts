/** A colour: linear, Rec.709/sRGB primaries. */
export type OpenPbrColor = readonly [r: number, g: number, b: number];

/** A direction in the frame of the surface: +x tangent, +y bitangent, +z normal. */
export type OpenPbrVector = readonly [x: number, y: number, z: number];

/**
 * Every parameter of OpenPBR Surface 1.1.1, and three of the draft of 1.2, under the specification's names. Colours are
 * linear with Rec.709/sRGB primaries (the specification's own examples are in ACEScg), lengths are metres unless the
 * parameter says otherwise.
 * The same text, with ranges and defaults, is data in {@link OPENPBR_PARAMETERS}.
 */
export interface OpenPbrParameters {
  /** Scales the diffuse lobe, and the reflectance at normal incidence of metal. */
  readonly base_weight: number;
  /** Albedo of the diffuse lobe; reflectance at normal incidence of metal. */
  readonly base_color: OpenPbrColor;
  /** Roughness of the diffuse lobe (σ of the EON model): 0 is Lambert, 1 flattens the shading like clay or the moon. */
  readonly base_diffuse_roughness: number;
  /** Mix from dielectric (0) to metal (1). */
  readonly base_metalness: number;
  /**
   * Scales the reflectance at normal incidence of the dielectric, by changing its index of refraction; scales the whole
   * metal lobe.
   */
  readonly specular_weight: number;
  /** Tint of the dielectric reflection seen from outside; tint near grazing angles (82°) of metal. */
  readonly specular_color: OpenPbrColor;
  /** Perceptual roughness of the base; its square is the GGX slope. 0 is a mirror. */
  readonly specular_roughness: number;
  /** Stretches the highlight across the tangent: 0 is round, 1 a line. */
  readonly specular_roughness_anisotropy: number;
  /** Index of refraction of the dielectric base. */
  readonly specular_ior: number;
  /**
   * Of the draft of 1.2: share of the base's facets that are rougher, as `specular_haze_spread` says: a halo around the
   * highlight.
   */
  readonly specular_haze: number;
  /** Of the draft of 1.2: how rough the facets of `specular_haze` are, from `specular_roughness` (0) to 1 (1). */
  readonly specular_haze_spread: number;
  /** Of the draft of 1.2: share of the base's reflection that returns towards the light, as from reflective tape. */
  readonly specular_retroreflectivity: number;
  /** Mix from opaque (0) to transparent (1) dielectric. */
  readonly transmission_weight: number;
  /**
   * Colour of light that went straight through `transmission_depth` of the interior; with depth 0 a tint at every
   * crossing of the surface.
   */
  readonly transmission_color: OpenPbrColor;
  /** Depth at which white light has turned into `transmission_color`; 0 switches the interior medium off. */
  readonly transmission_depth: number;
  /** Scattering coefficient of the interior, times `transmission_depth`. */
  readonly transmission_scatter: OpenPbrColor;
  /** Henyey–Greenstein g of the interior's scattering: -1 backward, 0 isotropic, 1 forward. */
  readonly transmission_scatter_anisotropy: number;
  /** Strength of dispersion: 0 none, 1 as `transmission_dispersion_abbe_number` says. */
  readonly transmission_dispersion_scale: number;
  /** Abbe number V_d of the interior: the lower, the more its index of refraction varies with the wavelength. */
  readonly transmission_dispersion_abbe_number: number;
  /** Mix from diffuse (0) to subsurface scattering (1). */
  readonly subsurface_weight: number;
  /** Colour of the light that returns by multiple scattering below the surface. */
  readonly subsurface_color: OpenPbrColor;
  /** Mean free path below the surface, times `subsurface_radius_scale` per channel. */
  readonly subsurface_radius: number;
  /** Factor per channel on `subsurface_radius`. */
  readonly subsurface_radius_scale: OpenPbrColor;
  /**
   * Henyey–Greenstein g of subsurface scattering; on a thin wall the split between reflected (-1) and transmitted (1)
   * light.
   */
  readonly subsurface_scatter_anisotropy: number;
  /** Coverage of the coat. */
  readonly coat_weight: number;
  /** Colour of the coat: what is left of white light after going through it down and up at normal incidence. */
  readonly coat_color: OpenPbrColor;
  /** Perceptual roughness of the coat. */
  readonly coat_roughness: number;
  /** Anisotropy of the coat's highlight: 0 is round, 1 a line. */
  readonly coat_roughness_anisotropy: number;
  /** Index of refraction of the coat. */
  readonly coat_ior: number;
  /** How much of the darkening by internal reflections in the coat is kept: 0 none, 1 physical. */
  readonly coat_darkening: number;
  /** Coverage of the fuzz. */
  readonly fuzz_weight: number;
  /** Colour of the fuzz. */
  readonly fuzz_color: OpenPbrColor;
  /** Roughness of the fuzz: low is velvet at the silhouette, high is dust. */
  readonly fuzz_roughness: number;
  /** Luminance of the emission; radiance is `emission_color × emission_luminance`. */
  readonly emission_luminance: number;
  /** Colour of the emission, not normalised. */
  readonly emission_color: OpenPbrColor;
  /** Coverage of the thin film. */
  readonly thin_film_weight: number;
  /** Thickness of the thin film. */
  readonly thin_film_thickness: number;
  /** Index of refraction of the thin film. */
  readonly thin_film_ior: number;
  /** Presence of the whole surface: 0 is a hole. */
  readonly geometry_opacity: number;
  /** The surface is an infinitely thin sheet with the same medium on both sides, not the boundary of a solid. */
  readonly geometry_thin_walled: boolean;
  /** Normal of the base in the surface's frame; `null` is the unperturbed normal. */
  readonly geometry_normal: OpenPbrVector | null;
  /** Tangent of the base in the surface's frame; `null` is the unperturbed tangent. */
  readonly geometry_tangent: OpenPbrVector | null;
  /** Normal of the coat in the surface's frame; `null` is the unperturbed normal. */
  readonly geometry_coat_normal: OpenPbrVector | null;
  /** Tangent of the coat in the surface's frame; `null` is the unperturbed tangent. */
  readonly geometry_coat_tangent: OpenPbrVector | null;
}

/** Name of an OpenPBR parameter. */
export type OpenPbrParameterName = keyof OpenPbrParameters;

/** The parameter groups of the specification. */
export type OpenPbrGroup =
  | 'base'
  | 'specular'
  | 'transmission'
  | 'subsurface'
  | 'coat'
  | 'fuzz'
  | 'emission'
  | 'thin_film'
  | 'geometry';

/**
 * `float` is a number, `color3` an {@link OpenPbrColor}, `vector3` an {@link OpenPbrVector} or `null`, `boolean` a
 * boolean.
 */
export type OpenPbrParameterType = 'float' | 'color3' | 'vector3' | 'boolean';

/** `1` has no unit; `length` is a scene length (metres); `cd/m²` luminance; `µm` micrometres. */
export type OpenPbrUnit = '1' | 'length' | 'cd/m²' | 'µm';

/** A parameter as data, without its text. */
export interface OpenPbrParameterSpec<Name extends OpenPbrParameterName = OpenPbrParameterName> {
  readonly name: Name;
  readonly type: OpenPbrParameterType;
  readonly default: OpenPbrParameters[Name];
  /**
   * Values outside of it mean nothing and are clamped, per component; an infinite end is open. Absent for booleans and
   * vectors.
   */
  readonly range?: readonly [min: number, max: number];
  /**
   * What a slider should offer. Equal to `range` unless the specification names another; absent for booleans and
   * vectors.
   */
  readonly softRange?: readonly [min: number, max: number];
  readonly unit: OpenPbrUnit;
  readonly group: OpenPbrGroup;
  /** Whether a texture may drive it. */
  readonly texturable: boolean;
  /** True for those of the draft of OpenPBR 1.2; absent for those of 1.1.1. */
  readonly draft?: boolean;
}

/** What is known of one parameter. */
export interface OpenPbrParameterInfo<
  Name extends OpenPbrParameterName = OpenPbrParameterName,
> extends OpenPbrParameterSpec<Name> {
  /** One sentence: what it does. */
  readonly doc: string;
}
