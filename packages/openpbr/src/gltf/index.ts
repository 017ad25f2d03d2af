export { anisotropicRoughness, fuzzRoughness } from './conversions';
export { fromGltf } from './from-gltf';
export type { GltfMaterialExtensions, GltfMaterialFactors, GltfTextureReference } from './material';
export { gltfTextures, type GltfImageConversion, type GltfTextureMapping, type GltfTextureUse } from './textures';
