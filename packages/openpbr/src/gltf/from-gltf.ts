import type { OpenPbrColor, OpenPbrParameters } from '../parameters/index';
import type { GltfMaterialFactors } from './material';

/** What a mapping step may change. */
type MutableParameters = { -readonly [Name in keyof OpenPbrParameters]?: OpenPbrParameters[Name] };

/** One step of the mapping: a core block or one extension. Later steps see what earlier ones set. */
type GltfMappingStep = (material: GltfMaterialFactors, parameters: MutableParameters) => void;

const color = (values: readonly number[] | undefined, initial: number): OpenPbrColor => [values?.[0] ?? initial, values?.[1] ?? initial, values?.[2] ?? initial];
const lerp = (a: number, b: number, t: number): number => a + (b - a) * t;

/** Metallic-roughness. Exact: glTF's metal is Schlick's formula, which is OpenPBR's with a white specular_color. */
const core: GltfMappingStep = ({ pbrMetallicRoughness: pbr = {}, alphaMode = 'OPAQUE' }, parameters) => {
  parameters.base_color = color(pbr.baseColorFactor, 1);
  parameters.base_metalness = pbr.metallicFactor ?? 1;
  parameters.specular_roughness = pbr.roughnessFactor ?? 1;
  if (alphaMode !== 'OPAQUE') parameters.geometry_opacity = pbr.baseColorFactor?.[3] ?? 1;
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
  if (value !== undefined) parameters.specular_ior = value === 0 ? 1000 : value;
};

/**
 * Reflectance at normal incidence min(F0·color, 1)·factor becomes specular_weight × F0 times the tint specular_color.
 * Exact at normal incidence; at grazing angles glTF reflects white × factor, here the tint stays. The extension does not
 * touch metal, but both OpenPBR parameters do, so they fade out with the metalness; fractional metalness is inexact.
 */
const specular: GltfMappingStep = ({ extensions }, parameters) => {
  const extension = extensions?.KHR_materials_specular;
  if (!extension) return;
  const factor = extension.specularFactor ?? 1;
  const tint = color(extension.specularColorFactor, 1);
  const brightest = Math.max(...tint);
  const index = parameters.specular_ior ?? 1.5;
  const f0 = ((index - 1) / (index + 1)) ** 2;
  const metalness = parameters.base_metalness ?? 1;
  const limit = f0 > 0 ? Math.min(brightest, 1 / f0) : brightest;
  parameters.specular_weight = lerp(factor * limit, 1, metalness);
  parameters.specular_color = brightest > 0 ? (tint.map((c) => lerp(c / brightest, 1, metalness)) as unknown as OpenPbrColor) : [1, 1, 1];
};

/**
 * glTF's coat has index 1.5, no colour and no reflections inside, and the base keeps the reflectance that it has in air.
 * Below OpenPBR's coat that takes a higher index; where a texture thins the coat the index would be too high, so there the
 * base loses part of its reflectance, as it really does. Comes last: it changes the index that the others start from.
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
  if (extension.clearcoatTexture === undefined && index >= 1.5) parameters.specular_ior = index;
};

const STEPS: readonly GltfMappingStep[] = [core, emission, ior, specular, clearcoat];

/**
 * Maps a glTF 2.0 material to OpenPBR. Pure: the answer holds the parameters that differ from, or are determined apart
 * from, OpenPBR's defaults, and nothing of the material is changed.
 *
 * | glTF | OpenPBR | lost |
 * |---|---|---|
 * | baseColor rgb | base_color | nothing |
 * | alpha (MASK, BLEND) | geometry_opacity | the sorting of BLEND; the threshold of MASK is the host's |
 * | metallic | base_metalness | nothing |
 * | roughness | specular_roughness | nothing; rough surfaces are brighter, since glTF's lose energy |
 * | emissive × KHR_materials_emissive_strength | emission_color, emission_luminance | nothing |
 * | KHR_materials_ior | specular_ior | glTF approximates Fresnel's equations by Schlick's |
 * | KHR_materials_specular | specular_weight, specular_color | the white edge of a tinted reflection |
 * | KHR_materials_clearcoat | coat_weight, coat_roughness, coat_ior 1.5, coat_darkening 0, a higher specular_ior | the coat's own normal map; the base looks rougher through the coat; below a coat with a texture the base reflects less |
 *
 * Textures multiply: a texture on a factor goes with the parameter in the same row (base colour with base_color, the
 * blue channel of metallic-roughness with base_metalness, the green one with specular_roughness, alpha with
 * geometry_opacity, emissive with emission_color, specular with specular_weight, specular colour with specular_color,
 * the red channel of clearcoat with coat_weight, the green one of clearcoat roughness with coat_roughness).
 *
 * @example
 * const parameters = fromGltf(json.materials[0]);   // { base_color: […], base_metalness: 0, specular_roughness: 0.4 }
 */
export function fromGltf(material: GltfMaterialFactors): Partial<OpenPbrParameters> {
  const parameters: MutableParameters = {};
  for (const step of STEPS) step(material, parameters);
  return parameters;
}
