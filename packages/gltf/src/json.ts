/** The parts of a glTF 2.0 document that are read from its JSON; meshes, nodes and accessors come through glTF-Transform. */
export interface GltfJson {
  readonly asset: { readonly version: string; readonly minVersion?: string };
  readonly buffers?: readonly { readonly uri?: string; readonly byteLength: number }[];
  readonly bufferViews?: readonly { readonly buffer: number; readonly byteOffset?: number; readonly byteLength: number }[];
  readonly images?: readonly GltfImage[];
  readonly textures?: readonly GltfTexture[];
  readonly samplers?: readonly GltfSampler[];
  readonly materials?: readonly GltfMaterial[];
  readonly extensionsRequired?: readonly string[];
  readonly extensionsUsed?: readonly string[];
}

export interface GltfImage {
  readonly name?: string;
  readonly uri?: string;
  readonly bufferView?: number;
  readonly mimeType?: string;
}

export interface GltfSampler {
  readonly magFilter?: number;
  readonly minFilter?: number;
  readonly wrapS?: number;
  readonly wrapT?: number;
}

export interface GltfTexture {
  readonly name?: string;
  readonly sampler?: number;
  readonly source?: number;
  readonly extensions?: { readonly [name: string]: { readonly source?: number } | undefined };
}

export interface GltfTextureInfo {
  readonly index: number;
  readonly texCoord?: number;
  /** Normal textures. */
  readonly scale?: number;
  readonly extensions?: { readonly KHR_texture_transform?: { readonly offset?: readonly number[]; readonly rotation?: number; readonly scale?: readonly number[]; readonly texCoord?: number } };
}

export interface GltfMaterial {
  readonly name?: string;
  readonly pbrMetallicRoughness?: {
    readonly baseColorFactor?: readonly number[];
    readonly baseColorTexture?: GltfTextureInfo;
    readonly metallicFactor?: number;
    readonly roughnessFactor?: number;
    readonly metallicRoughnessTexture?: GltfTextureInfo;
  };
  readonly normalTexture?: GltfTextureInfo;
  readonly emissiveTexture?: GltfTextureInfo;
  readonly emissiveFactor?: readonly number[];
  readonly alphaMode?: string;
  readonly alphaCutoff?: number;
  readonly doubleSided?: boolean;
  readonly extensions?: {
    readonly KHR_materials_emissive_strength?: { readonly emissiveStrength?: number };
    readonly KHR_materials_ior?: { readonly ior?: number };
    readonly KHR_materials_clearcoat?: {
      readonly clearcoatFactor?: number;
      readonly clearcoatTexture?: GltfTextureInfo;
      readonly clearcoatRoughnessFactor?: number;
      readonly clearcoatRoughnessTexture?: GltfTextureInfo;
      readonly clearcoatNormalTexture?: GltfTextureInfo;
    };
    readonly KHR_materials_specular?: {
      readonly specularFactor?: number;
      readonly specularTexture?: GltfTextureInfo;
      readonly specularColorFactor?: readonly number[];
      readonly specularColorTexture?: GltfTextureInfo;
    };
  };
  readonly extras?: unknown;
}
