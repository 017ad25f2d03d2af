import type { OpenPbrParameterName } from './types';

/** What each parameter does, in one sentence. */
export const texts: Readonly<Record<OpenPbrParameterName, string>> = {
  base_weight: 'Scales the diffuse lobe, and the reflectance at normal incidence of metal.',
  base_color: 'Albedo of the diffuse lobe; reflectance at normal incidence of metal.',
  base_diffuse_roughness:
    'Roughness of the diffuse lobe (σ of the EON model): 0 is Lambert, 1 flattens the shading like clay or the moon.',
  base_metalness: 'Mix from dielectric (0) to metal (1).',
  specular_weight:
    'Scales the reflectance at normal incidence of the dielectric, by changing its index of refraction; scales the whole metal lobe.',
  specular_color: 'Tint of the dielectric reflection seen from outside; tint near grazing angles (82°) of metal.',
  specular_roughness: 'Perceptual roughness of the base; its square is the GGX slope. 0 is a mirror.',
  specular_roughness_anisotropy: 'Stretches the highlight across the tangent: 0 is round, 1 a line.',
  specular_ior: 'Index of refraction of the dielectric base.',
  specular_haze:
    "Of the draft of 1.2: share of the base's facets that are rougher, as `specular_haze_spread` says: a halo around the highlight.",
  specular_haze_spread:
    'Of the draft of 1.2: how rough the facets of `specular_haze` are, from `specular_roughness` (0) to 1 (1).',
  specular_retroreflectivity:
    "Of the draft of 1.2: share of the base's reflection that returns towards the light, as from reflective tape.",
  transmission_weight: 'Mix from opaque (0) to transparent (1) dielectric.',
  transmission_color:
    'Colour of light that went straight through `transmission_depth` of the interior; with depth 0 a tint at every crossing of the surface.',
  transmission_depth:
    'Depth at which white light has turned into `transmission_color`; 0 switches the interior medium off.',
  transmission_scatter: 'Scattering coefficient of the interior, times `transmission_depth`.',
  transmission_scatter_anisotropy:
    "Henyey–Greenstein g of the interior's scattering: -1 backward, 0 isotropic, 1 forward.",
  transmission_dispersion_scale: 'Strength of dispersion: 0 none, 1 as `transmission_dispersion_abbe_number` says.',
  transmission_dispersion_abbe_number:
    'Abbe number V_d of the interior: the lower, the more its index of refraction varies with the wavelength.',
  subsurface_weight: 'Mix from diffuse (0) to subsurface scattering (1).',
  subsurface_color: 'Colour of the light that returns by multiple scattering below the surface.',
  subsurface_radius: 'Mean free path below the surface, times `subsurface_radius_scale` per channel.',
  subsurface_radius_scale: 'Factor per channel on `subsurface_radius`.',
  subsurface_scatter_anisotropy:
    'Henyey–Greenstein g of subsurface scattering; on a thin wall the split between reflected (-1) and transmitted (1) light.',
  coat_weight: 'Coverage of the coat.',
  coat_color: 'Colour of the coat: what is left of white light after going through it down and up at normal incidence.',
  coat_roughness: 'Perceptual roughness of the coat.',
  coat_roughness_anisotropy: "Anisotropy of the coat's highlight: 0 is round, 1 a line.",
  coat_ior: 'Index of refraction of the coat.',
  coat_darkening: 'How much of the darkening by internal reflections in the coat is kept: 0 none, 1 physical.',
  fuzz_weight: 'Coverage of the fuzz.',
  fuzz_color: 'Colour of the fuzz.',
  fuzz_roughness: 'Roughness of the fuzz: low is velvet at the silhouette, high is dust.',
  emission_luminance: 'Luminance of the emission; radiance is `emission_color × emission_luminance`.',
  emission_color: 'Colour of the emission, not normalised.',
  thin_film_weight: 'Coverage of the thin film.',
  thin_film_thickness: 'Thickness of the thin film.',
  thin_film_ior: 'Index of refraction of the thin film.',
  geometry_opacity: 'Presence of the whole surface: 0 is a hole.',
  geometry_thin_walled:
    'The surface is an infinitely thin sheet with the same medium on both sides, not the boundary of a solid.',
  geometry_normal: "Normal of the base in the surface's frame; `null` is the unperturbed normal.",
  geometry_tangent: "Tangent of the base in the surface's frame; `null` is the unperturbed tangent.",
  geometry_coat_normal: "Normal of the coat in the surface's frame; `null` is the unperturbed normal.",
  geometry_coat_tangent: "Tangent of the coat in the surface's frame; `null` is the unperturbed tangent.",
};
