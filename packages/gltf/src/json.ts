/** The material extensions that are read. */
export const MATERIAL_EXTENSIONS = [
  'KHR_materials_anisotropy',
  'KHR_materials_clearcoat',
  'KHR_materials_diffuse_transmission',
  'KHR_materials_dispersion',
  'KHR_materials_emissive_strength',
  'KHR_materials_ior',
  'KHR_materials_iridescence',
  'KHR_materials_pbrSpecularGlossiness',
  'KHR_materials_sheen',
  'KHR_materials_specular',
  'KHR_materials_transmission',
  'KHR_materials_unlit',
  'KHR_materials_volume',
  'KHR_materials_volume_scatter',
] as const;
/** The parts of a glTF 2.0 document that are read, as they are once the document has been checked. */
export interface GltfJson {
  readonly asset: {
    readonly version: string;
    readonly minVersion?: string;
    readonly copyright?: string;
    readonly generator?: string;
  };
  readonly buffers?: readonly { readonly uri?: string; readonly byteLength: number; readonly extensions?: unknown }[];
  readonly bufferViews?: readonly GltfBufferView[];
  readonly accessors?: readonly GltfAccessor[];
  readonly meshes?: readonly GltfMesh[];
  readonly nodes?: readonly GltfNode[];
  readonly skins?: readonly { readonly joints: readonly number[]; readonly inverseBindMatrices?: number }[];
  readonly cameras?: readonly GltfCamera[];
  readonly animations?: readonly GltfAnimation[];
  readonly scene?: number;
  readonly scenes?: readonly {
    readonly name?: string;
    readonly nodes?: readonly number[];
    readonly extensions?: { readonly EXT_lights_image_based?: { readonly light: number } };
  }[];
  readonly extensions?: {
    readonly KHR_lights_punctual?: { readonly lights: readonly GltfLight[] };
    readonly KHR_materials_variants?: { readonly variants: readonly { readonly name?: string }[] };
    readonly EXT_lights_image_based?: { readonly lights: readonly (GltfImageLight | undefined)[] };
    readonly KHR_xmp_json_ld?: { readonly packets: readonly unknown[] };
  };
  readonly images?: readonly GltfImage[];
  readonly textures?: readonly GltfTexture[];
  readonly samplers?: readonly GltfSampler[];
  readonly materials?: readonly GltfMaterial[];
  readonly extensionsRequired?: readonly string[];
  readonly extensionsUsed?: readonly string[];
}

export interface GltfBufferView {
  readonly buffer: number;
  readonly byteOffset?: number;
  readonly byteLength: number;
  readonly byteStride?: number;
  readonly extensions?: {
    readonly EXT_meshopt_compression?: GltfMeshopt;
    readonly KHR_meshopt_compression?: GltfMeshopt;
  };
}

/** What a compressed buffer view is unpacked from. */
export interface GltfMeshopt {
  readonly buffer: number;
  readonly byteOffset?: number;
  readonly byteLength: number;
  readonly byteStride: number;
  readonly count: number;
  readonly mode: string;
  readonly filter?: string;
}

export interface GltfAccessor {
  readonly bufferView?: number;
  readonly byteOffset?: number;
  readonly componentType: number;
  readonly normalized?: boolean;
  readonly count: number;
  readonly type: string;
  readonly sparse?: {
    readonly count: number;
    readonly indices: { readonly bufferView: number; readonly byteOffset?: number; readonly componentType: number };
    readonly values: { readonly bufferView: number; readonly byteOffset?: number };
  };
}

export interface GltfPrimitive {
  readonly attributes: { readonly [semantic: string]: number };
  readonly indices?: number;
  readonly material?: number;
  readonly mode?: number;
  readonly targets?: readonly { readonly [semantic: string]: number }[];
  readonly extensions?: {
    readonly KHR_draco_mesh_compression?: {
      readonly bufferView: number;
      readonly attributes: { readonly [semantic: string]: number };
    };
    readonly KHR_materials_variants?: {
      readonly mappings: readonly { readonly material: number; readonly variants: readonly number[] }[];
    };
  };
}

export interface GltfMesh {
  readonly name?: string;
  readonly primitives: readonly GltfPrimitive[];
  readonly weights?: readonly number[];
}

export interface GltfNode {
  readonly name?: string;
  readonly children?: readonly number[];
  readonly mesh?: number;
  readonly skin?: number;
  readonly camera?: number;
  readonly matrix?: readonly number[];
  readonly translation?: readonly number[];
  readonly rotation?: readonly number[];
  readonly scale?: readonly number[];
  readonly weights?: readonly number[];
  readonly extensions?: {
    readonly KHR_lights_punctual?: { readonly light: number };
    readonly KHR_node_visibility?: { readonly visible?: boolean };
    /** `count` is put in when the document is checked: the entries of its attributes. */
    readonly EXT_mesh_gpu_instancing?: {
      readonly attributes: { readonly [semantic: string]: number };
      readonly count: number;
    };
  };
}

export interface GltfCamera {
  readonly name?: string;
  readonly type: string;
  readonly perspective?: { readonly yfov: number; readonly aspectRatio?: number };
  readonly orthographic?: { readonly xmag: number; readonly ymag: number };
}

export interface GltfLight {
  readonly name?: string;
  readonly type: 'point' | 'spot' | 'directional';
  readonly color?: readonly [number, number, number];
  readonly intensity: number;
  readonly spot?: { readonly innerConeAngle?: number; readonly outerConeAngle?: number };
}

/** A light of EXT_lights_image_based. */
export interface GltfImageLight {
  readonly name?: string;
  /** Unit quaternion, xyzw. */
  readonly rotation?: readonly number[];
  readonly intensity?: number;
  readonly specularImageSize?: number;
  /** Levels of six images each. */
  readonly specularImages: readonly (readonly number[])[];
}

export interface GltfAnimation {
  readonly name?: string;
  readonly channels: readonly {
    readonly sampler: number;
    readonly target: { readonly node: number; readonly path: string };
  }[];
  readonly samplers: readonly { readonly input: number; readonly output: number; readonly interpolation: string }[];
  /** KHR_animation_pointer: what moves, as the parts of a JSON pointer. */
  readonly pointers?: readonly { readonly sampler: number; readonly path: readonly string[] }[];
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
  readonly extensions?: {
    readonly KHR_texture_transform?: {
      readonly offset?: readonly number[];
      readonly rotation?: number;
      readonly scale?: readonly number[];
      readonly texCoord?: number;
    };
  };
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
