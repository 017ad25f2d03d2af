export { fromGltf } from './from-gltf';
export type { GltfMaterialExtensions, GltfMaterialFactors } from './material';
