import { mediumOfAlbedo } from '../color/medium-of-albedo';
import type { OpenPbrColor, OpenPbrParameters } from '../parameters/index';
import {
  anisotropicRoughness,
  fuzzRoughness,
  iorOf,
  LARGEST_REFLECTANCE,
  reflectanceOf,
  singleScatteringAlbedo,
} from './conversions';
import type { GltfMaterialFactors } from './material';

/** What a mapping step may change. */
type MutableParameters = { -readonly [Name in keyof OpenPbrParameters]?: OpenPbrParameters[Name] };

/** One step of the mapping: a core block or one extension. Later steps see what earlier ones set. */
type GltfMappingStep = (material: GltfMaterialFactors, parameters: MutableParameters) => void;

const color = (values: readonly number[] | undefined, initial: number): OpenPbrColor => [
  values?.[0] ?? initial,
  values?.[1] ?? initial,
  values?.[2] ?? initial,
];
const lerp = (a: number, b: number, t: number): number => a + (b - a) * t;
const tint = (values: OpenPbrColor, brightest: number): OpenPbrColor =>
  brightest > 0 ? [values[0] / brightest, values[1] / brightest, values[2] / brightest] : [1, 1, 1];

/** Metallic-roughness. Exact: glTF's metal is Schlick's formula, which is OpenPBR's with a white specular_color. */
const core: GltfMappingStep = ({ pbrMetallicRoughness: pbr = {}, alphaMode = 'OPAQUE' }, parameters) => {
  parameters.base_color = color(pbr.baseColorFactor, 1);
  parameters.base_metalness = pbr.metallicFactor ?? 1;
  parameters.specular_roughness = pbr.roughnessFactor ?? 1;
  if (alphaMode !== 'OPAQUE') parameters.geometry_opacity = pbr.baseColorFactor?.[3] ?? 1;
};

/** The archived second workflow: a dielectric whose index gives the brightest channel of the specular colour. */
const specularGlossiness: GltfMappingStep = ({ extensions, alphaMode = 'OPAQUE' }, parameters) => {
  const extension = extensions?.KHR_materials_pbrSpecularGlossiness;
  if (!extension) return;
  const specular = color(extension.specularFactor, 1);
  const brightest = Math.max(...specular);
  parameters.base_color = color(extension.diffuseFactor, 1);
  parameters.base_metalness = 0;
  parameters.specular_roughness = 1 - (extension.glossinessFactor ?? 1);
  parameters.specular_ior = iorOf(Math.min(brightest, LARGEST_REFLECTANCE));
  parameters.specular_color = tint(specular, brightest);
  if (alphaMode !== 'OPAQUE') parameters.geometry_opacity = extension.diffuseFactor?.[3] ?? 1;
};

/** emissiveFactor × emissiveStrength is radiance in cd/m², as emission_color × emission_luminance is. */
const emission: GltfMappingStep = ({ emissiveFactor, extensions }, parameters) => {
  const factor = color(emissiveFactor, 0);
  if (!factor.some((c) => c > 0)) return;
  parameters.emission_color = factor;
  parameters.emission_luminance = extensions?.KHR_materials_emissive_strength?.emissiveStrength ?? 1;
};

/** glTF's ior 0 asks for a reflectance of 1 at every angle: an index so high that it comes near. */
const ior: GltfMappingStep = ({ extensions }, parameters) => {
  const value = extensions?.KHR_materials_ior?.ior;
  if (value !== undefined && !extensions?.KHR_materials_pbrSpecularGlossiness)
    parameters.specular_ior = value === 0 ? 1000 : value;
};

/**
 * A surface with or without a volume. Without thickness it is a thin wall; with it, absorption follows Beer's law as in
 * glTF. OpenPBR tints either the surface or the interior: where glTF's volume absorbs, the base colour does not tint
 * the transmission.
 */
const transmission: GltfMappingStep = ({ extensions }, parameters) => {
  const weight = extensions?.KHR_materials_transmission?.transmissionFactor ?? 0;
  const volume = extensions?.KHR_materials_volume;
  const solid = (volume?.thicknessFactor ?? 0) > 0;
  if (!(weight > 0)) return;
  parameters.transmission_weight = weight;
  parameters.geometry_thin_walled = !solid;
  const distance = volume?.attenuationDistance ?? Infinity;
  const left = color(volume?.attenuationColor, 1);
  if (solid && Number.isFinite(distance) && distance > 0 && left.some((c) => c < 1)) {
    parameters.transmission_depth = distance;
    parameters.transmission_color = left;
  } else parameters.transmission_color = parameters.base_color ?? [1, 1, 1];
};

/** glTF's dispersion is 20 / V_d, OpenPBR's Abbe number V_d = abbe_number / scale with a scale up to 1. */
const dispersion: GltfMappingStep = ({ extensions }, parameters) => {
  const value = extensions?.KHR_materials_dispersion?.dispersion ?? 0;
  if (!(value > 0)) return;
  parameters.transmission_dispersion_scale = Math.min(value, 1);
  parameters.transmission_dispersion_abbe_number = 20 / Math.max(value, 1);
};

/**
 * On a sheet, glTF splits the diffuse lobe into a reflected and a transmitted part, which is OpenPBR's thin-walled
 * subsurface with everything scattered forward. In a volume it stands for scattering: its mean free path is that of the
 * absorption, or the thickness where nothing is absorbed.
 */
const diffuseTransmission: GltfMappingStep = ({ extensions }, parameters) => {
  const extension = extensions?.KHR_materials_diffuse_transmission;
  const weight = extension?.diffuseTransmissionFactor ?? 0;
  if (!extension || !(weight > 0)) return;
  parameters.subsurface_weight = weight;
  parameters.subsurface_color = color(extension.diffuseTransmissionColorFactor, 1);
  const volume = extensions?.KHR_materials_volume;
  const thickness = volume?.thicknessFactor ?? 0;
  parameters.geometry_thin_walled = !(thickness > 0);
  if (!(thickness > 0)) {
    parameters.subsurface_scatter_anisotropy = 1;
    return;
  }
  const distance = volume?.attenuationDistance ?? Infinity;
  const paths = color(volume?.attenuationColor, 1).map((c) =>
    Math.min(
      Number.isFinite(distance) ? -distance / Math.log(Math.min(Math.max(c, 1e-6), 1 - 1e-6)) : Infinity,
      1e3 * thickness,
    ),
  );
  const longest = Math.max(...paths);
  const free = paths.every((path) => path >= 1e3 * thickness);
  parameters.subsurface_radius = free ? thickness : longest;
  parameters.subsurface_radius_scale = free ? [1, 1, 1] : tint(paths as unknown as OpenPbrColor, longest);
};

/**
 * The medium of a volume that scatters. Its attenuation is then that by absorption and scattering together, as the
 * extinction of OpenPBR's interior is. A dense one is entered by diffuse transmission, and is OpenPBR's subsurface.
 */
const volumeScatter: GltfMappingStep = ({ extensions }, parameters) => {
  const extension = extensions?.KHR_materials_volume_scatter;
  if (!extension || !((extensions.KHR_materials_volume?.thicknessFactor ?? 0) > 0)) return;
  const albedo = color(extension.multiscatterColorFactor ?? extension.multiscatterColor, 0);
  const anisotropy = extension.scatterAnisotropy ?? 0;
  const { transmission_depth: depth, transmission_color: left, subsurface_color: tinted } = parameters;
  if (depth !== undefined && left) {
    const [r, g, b] = albedo;
    const single: OpenPbrColor = [singleScatteringAlbedo(r), singleScatteringAlbedo(g), singleScatteringAlbedo(b)];
    Object.assign(parameters, mediumOfAlbedo(left, depth, single));
    parameters.transmission_scatter_anisotropy = anisotropy;
  }
  if (tinted) {
    parameters.subsurface_color = [tinted[0] * albedo[0], tinted[1] * albedo[1], tinted[2] * albedo[2]];
    parameters.subsurface_scatter_anisotropy = anisotropy;
  }
};

/**
 * Reflectance at normal incidence min(F0·color, 1)·factor becomes specular_weight × F0 times the tint specular_color.
 * Exact at normal incidence; at grazing angles glTF reflects white × factor, here the tint stays. The extension does
 * not touch metal, but both OpenPBR parameters do, so they fade out with the metalness; fractional metalness is
 * inexact. Where light goes through, the factor is part of the tint, since specular_weight would also change how it is
 * refracted.
 */
const specular: GltfMappingStep = ({ extensions }, parameters) => {
  const extension = extensions?.KHR_materials_specular;
  if (!extension || extensions?.KHR_materials_pbrSpecularGlossiness) return;
  const factor = extension.specularFactor ?? 1;
  const given = color(extension.specularColorFactor, 1);
  const brightest = Math.max(...given);
  const f0 = reflectanceOf(parameters.specular_ior ?? 1.5);
  const metalness = parameters.base_metalness ?? 1;
  const limit = f0 > 0 ? Math.min(brightest, 1 / f0) : brightest;
  const refracts = (parameters.transmission_weight ?? 0) > 0;
  parameters.specular_weight = lerp(refracts ? limit : factor * limit, 1, metalness);
  parameters.specular_color = tint(given, brightest).map((c) =>
    lerp(refracts ? factor * c : c, 1, metalness),
  ) as unknown as OpenPbrColor;
};

/** Exact: both models have GGX with two slopes. */
const anisotropy: GltfMappingStep = ({ extensions }, parameters) => {
  const extension = extensions?.KHR_materials_anisotropy;
  const strength = extension?.anisotropyStrength ?? 0;
  if (!extension || !(strength > 0)) return;
  const { roughness, anisotropy: stretch } = anisotropicRoughness(parameters.specular_roughness ?? 1, strength);
  parameters.specular_roughness = roughness;
  parameters.specular_roughness_anisotropy = stretch;
  const rotation = extension.anisotropyRotation ?? 0;
  if (rotation !== 0 || extension.anisotropyTexture)
    parameters.geometry_tangent = [Math.cos(rotation), Math.sin(rotation), 0];
};

/** glTF's film tints the reflection only and lies in air; OpenPBR's tints the transmission too. */
const iridescence: GltfMappingStep = ({ extensions }, parameters) => {
  const extension = extensions?.KHR_materials_iridescence;
  const weight = extension?.iridescenceFactor ?? 0;
  if (!extension || !(weight > 0)) return;
  parameters.thin_film_weight = weight;
  parameters.thin_film_thickness = (extension.iridescenceThicknessMaximum ?? 400) / 1000;
  parameters.thin_film_ior = extension.iridescenceIor ?? 1.3;
};

/** Two models of cloth, fitted: see {@link fuzzRoughness}. Black sheen is no sheen. */
const sheen: GltfMappingStep = ({ extensions }, parameters) => {
  const extension = extensions?.KHR_materials_sheen;
  const given = color(extension?.sheenColorFactor, 0);
  const brightest = Math.max(...given);
  if (!extension || !(brightest > 0)) return;
  parameters.fuzz_weight = Math.min(brightest, 1);
  parameters.fuzz_color = tint(given, brightest);
  parameters.fuzz_roughness = fuzzRoughness(extension.sheenRoughnessFactor ?? 0);
};

/**
 * glTF's coat has index 1.5, no colour and no reflections inside, and the base keeps the reflectance that it has in
 * air. Below OpenPBR's coat that takes a higher index; where a texture thins the coat the index would be too high, so
 * there the base loses part of its reflectance, as it really does, and where light goes through the index says how it
 * is refracted. Comes late: it changes the index that the others start from.
 */
const clearcoat: GltfMappingStep = ({ extensions }, parameters) => {
  const extension = extensions?.KHR_materials_clearcoat;
  const weight = extension?.clearcoatFactor ?? 0;
  if (!extension || !(weight > 0)) return;
  parameters.coat_weight = weight;
  parameters.coat_roughness = extension.clearcoatRoughnessFactor ?? 0;
  parameters.coat_ior = 1.5;
  parameters.coat_darkening = 0;
  const index = (parameters.specular_ior ?? 1.5) / lerp(1, 1 / 1.5, weight);
  if (extension.clearcoatTexture === undefined && index >= 1.5 && !((parameters.transmission_weight ?? 0) > 0))
    parameters.specular_ior = index;
};

/** Unlit: the base colour is shown as it is. OpenPBR can only emit it, so it also lights other surfaces. */
const unlit: GltfMappingStep = ({ extensions, pbrMetallicRoughness }, parameters) => {
  if (!extensions?.KHR_materials_unlit) return;
  const { geometry_opacity: opacity } = parameters;
  for (const name of Object.keys(parameters)) delete parameters[name as keyof OpenPbrParameters];
  if (opacity !== undefined) parameters.geometry_opacity = opacity;
  parameters.base_weight = 0;
  parameters.specular_weight = 0;
  parameters.emission_color = color(pbrMetallicRoughness?.baseColorFactor, 1);
  parameters.emission_luminance = 1;
};

const STEPS: readonly GltfMappingStep[] = [
  core,
  specularGlossiness,
  emission,
  ior,
  transmission,
  dispersion,
  diffuseTransmission,
  volumeScatter,
  specular,
  anisotropy,
  iridescence,
  sheen,
  clearcoat,
  unlit,
];

/**
 * Maps a glTF 2.0 material to OpenPBR. Pure: the result has the parameters that differ from OpenPBR's defaults or that
 * the material sets, and the material is not changed. {@link gltfTextures} maps its textures.
 *
 * | glTF | OpenPBR | lost |
 * |---|---|---|
 * | baseColor rgb | base_color | nothing |
 * | alpha (MASK, BLEND) | geometry_opacity | the sorting of BLEND; the threshold of MASK is the host's |
 * | metallic | base_metalness | nothing |
 * | roughness | specular_roughness | nothing; rough surfaces are brighter, since glTF's lose energy |
 * | occlusion | | all of it: light finds its way by itself |
 * | emissive × KHR_materials_emissive_strength | emission_color, emission_luminance | nothing |
 * | KHR_materials_ior | specular_ior | glTF approximates Fresnel's equations by Schlick's; ior 0 becomes 1000 |
 * | KHR_materials_specular | specular_weight, specular_color | the white edge of a tinted reflection |
 * | KHR_materials_transmission | transmission_weight, transmission_color = base colour, geometry_thin_walled | a sheet reflects on both sides here, F and 2F/(1 + F); its tint deepens at grazing angles |
 * | KHR_materials_volume | transmission_color, transmission_depth | the thickness, which a path tracer measures itself; where the volume absorbs, the tint by the base colour |
 * | KHR_materials_dispersion | transmission_dispersion_scale, _abbe_number | nothing |
 * | KHR_materials_diffuse_transmission | subsurface_weight, subsurface_color; a thin wall with subsurface_scatter_anisotropy 1 | nothing for sheets; in volumes the scattering is a guess by the absorption |
 * | KHR_materials_volume_scatter (draft) | transmission_scatter, _scatter_anisotropy; with diffuse transmission subsurface_color, subsurface_scatter_anisotropy | the texture; scattering without an attenuation distance, which has no density; a dense medium is entered through a smooth or rough interface, not a diffuse one |
 * | KHR_materials_clearcoat | coat_weight, coat_roughness, coat_ior 1.5, coat_darkening 0, a higher specular_ior | the base looks rougher through the coat; below a coat with a texture, or where light goes through, the base reflects less |
 * | KHR_materials_sheen | fuzz_weight = brightest channel, fuzz_color, fuzz_roughness by a fit | other models of cloth: albedos differ by 0.05 to 0.15 for roughness 0.3 to 1, more below; the fuzz lies over a clearcoat, not below it |
 * | KHR_materials_iridescence | thin_film_weight, _thickness, _ior | the film also colours what goes through, and is seen through a coat |
 * | KHR_materials_anisotropy | specular_roughness, specular_roughness_anisotropy, geometry_tangent | nothing |
 * | KHR_materials_pbrSpecularGlossiness | base_color, specular_roughness, specular_ior, specular_color | the white edge of a tinted reflection; reflectances above 0.98 |
 * | KHR_materials_unlit | emission_color, base_weight 0, specular_weight 0 | it is a light, which shines on others |
 *
 * @example
 * const parameters = fromGltf(json.materials[0]);   // { base_color: […], base_metalness: 0, specular_roughness: 0.4 }
 */
export function fromGltf(material: GltfMaterialFactors): Partial<OpenPbrParameters> {
  const parameters: MutableParameters = {};
  for (const step of STEPS) step(material, parameters);
  return parameters;
}
