/** Numbers as a glTF document holds them. */
type Numbers = readonly number[];

/**
 * The factors of a glTF 2.0 material, in the shape of the document's JSON: a parsed material can be passed as it is.
 * Textures are not looked at: where a texture multiplies a factor, it multiplies the mapped parameter just as well.
 * Missing factors have glTF's defaults.
 */
export interface GltfMaterialFactors {
  readonly pbrMetallicRoughness?: {
    /** RGBA, linear; default 1, 1, 1, 1. */
    readonly baseColorFactor?: Numbers;
    /** Default 1. */
    readonly metallicFactor?: number;
    /** Default 1. */
    readonly roughnessFactor?: number;
  };
  /** RGB, linear; default 0, 0, 0. */
  readonly emissiveFactor?: Numbers;
  /** Default `OPAQUE`, which ignores the alpha. */
  readonly alphaMode?: string;
  readonly extensions?: GltfMaterialExtensions;
}

/** The material extensions that {@link fromGltf} knows; others are ignored. */
export interface GltfMaterialExtensions {
  readonly KHR_materials_emissive_strength?: { readonly emissiveStrength?: number };
  readonly KHR_materials_ior?: { readonly ior?: number };
  /** `clearcoatTexture` is only asked whether it is there. */
  readonly KHR_materials_clearcoat?: { readonly clearcoatFactor?: number; readonly clearcoatRoughnessFactor?: number; readonly clearcoatTexture?: unknown };
  readonly KHR_materials_specular?: { readonly specularFactor?: number; readonly specularColorFactor?: Numbers };
}
