export { MaterialXError } from './error';
export type { MaterialXMaterial, MaterialXTexture, MaterialXWarning } from './material';
export { readMaterialX, type MaterialXDocument, type ReadMaterialXOptions } from './read';
export { writeMaterialX, type WrittenMaterialX } from './write';
export type { MaterialXLimits } from './xml';
