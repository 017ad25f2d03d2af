export { CadError } from './error';
export { writeGlb, type GlbOptions } from './glb';
export { toGltfMaterial, type WrittenMaterial } from './gltf-material';
export { levelsOfDetail, type LevelOptions } from './levels';
export { checkMaterialMap, hexOf, type CadLook, type CadMaterialMap, type CadRule } from './materials';
export { cadFormat, readCad, type CadColor, type CadModel, type CadOptions, type CadPart } from './read';
export { cadToScene, type CadSceneOptions } from './scene';
