/** Numbers as a glTF document holds them. */
type Numbers = readonly number[];

/**
 * A reference to a texture as a glTF document holds it. The mapping reads the transform and the index only to compare
 * them.
 */
export interface GltfTextureReference {
  /** Index into the document's textures. */
  readonly index: number;
  /** UV set; default 0. */
  readonly texCoord?: number;
  readonly extensions?: object;
}

/**
 * A glTF 2.0 material in the shape of the document's JSON: a parsed material can be passed as it is. Missing factors
 * have glTF's defaults; colours are linear, RGB.
 */
export interface GltfMaterialFactors {
  readonly pbrMetallicRoughness?: {
    /** RGBA, linear; default 1, 1, 1, 1. */
    readonly baseColorFactor?: Numbers;
    /** Default 1. */
    readonly metallicFactor?: number;
    /** Default 1. */
    readonly roughnessFactor?: number;
    readonly baseColorTexture?: GltfTextureReference;
    readonly metallicRoughnessTexture?: GltfTextureReference;
  };
  readonly normalTexture?: GltfTextureReference;
  readonly emissiveTexture?: GltfTextureReference;
  /** RGB, linear; default 0, 0, 0. */
  readonly emissiveFactor?: Numbers;
  /** Default `OPAQUE`, which ignores the alpha. */
  readonly alphaMode?: string;
  readonly extensions?: GltfMaterialExtensions;
}

/** The material extensions that {@link fromGltf} and {@link gltfTextures} know; others are ignored. */
export interface GltfMaterialExtensions {
  readonly KHR_materials_anisotropy?: {
    readonly anisotropyStrength?: number;
    readonly anisotropyRotation?: number;
    readonly anisotropyTexture?: GltfTextureReference;
  };
  readonly KHR_materials_clearcoat?: {
    readonly clearcoatFactor?: number;
    readonly clearcoatTexture?: GltfTextureReference;
    readonly clearcoatRoughnessFactor?: number;
    readonly clearcoatRoughnessTexture?: GltfTextureReference;
    readonly clearcoatNormalTexture?: GltfTextureReference;
  };
  readonly KHR_materials_diffuse_transmission?: {
    readonly diffuseTransmissionFactor?: number;
    readonly diffuseTransmissionTexture?: GltfTextureReference;
    readonly diffuseTransmissionColorFactor?: Numbers;
    readonly diffuseTransmissionColorTexture?: GltfTextureReference;
  };
  readonly KHR_materials_dispersion?: { readonly dispersion?: number };
  readonly KHR_materials_emissive_strength?: { readonly emissiveStrength?: number };
  readonly KHR_materials_ior?: { readonly ior?: number };
  readonly KHR_materials_iridescence?: {
    readonly iridescenceFactor?: number;
    readonly iridescenceTexture?: GltfTextureReference;
    readonly iridescenceIor?: number;
    /** Nanometres; default 100. */
    readonly iridescenceThicknessMinimum?: number;
    /** Nanometres; default 400. */
    readonly iridescenceThicknessMaximum?: number;
    readonly iridescenceThicknessTexture?: GltfTextureReference;
  };
  readonly KHR_materials_pbrSpecularGlossiness?: {
    /** RGBA, linear; default 1, 1, 1, 1. */
    readonly diffuseFactor?: Numbers;
    readonly diffuseTexture?: GltfTextureReference;
    readonly specularFactor?: Numbers;
    readonly glossinessFactor?: number;
    readonly specularGlossinessTexture?: GltfTextureReference;
  };
  readonly KHR_materials_sheen?: {
    readonly sheenColorFactor?: Numbers;
    readonly sheenColorTexture?: GltfTextureReference;
    readonly sheenRoughnessFactor?: number;
    readonly sheenRoughnessTexture?: GltfTextureReference;
  };
  readonly KHR_materials_specular?: {
    readonly specularFactor?: number;
    readonly specularTexture?: GltfTextureReference;
    readonly specularColorFactor?: Numbers;
    readonly specularColorTexture?: GltfTextureReference;
  };
  readonly KHR_materials_transmission?: {
    readonly transmissionFactor?: number;
    readonly transmissionTexture?: GltfTextureReference;
  };
  readonly KHR_materials_unlit?: object;
  readonly KHR_materials_volume?: {
    readonly thicknessFactor?: number;
    readonly thicknessTexture?: GltfTextureReference;
    /** Metres; default: infinite, which is no absorption. */
    readonly attenuationDistance?: number;
    readonly attenuationColor?: Numbers;
  };
  /** A draft of Khronos; acts with `KHR_materials_volume` alone. */
  readonly KHR_materials_volume_scatter?: {
    /** Multiple-scattering albedo; default 0, 0, 0. */
    readonly multiscatterColorFactor?: Numbers;
    /** The name of the factor in the drafts before April 2026. */
    readonly multiscatterColor?: Numbers;
    readonly multiscatterColorTexture?: GltfTextureReference;
    /** Henyey and Greenstein's g; default 0. */
    readonly scatterAnisotropy?: number;
  };
}
