export { FormatError } from './error';
export { readIes, type IesOptions } from './ies';
export { readObj, type ObjOptions } from './obj';
export { readStl, type StlOptions } from './stl';
export type { ImageDecoder, ResourceReader } from './resources';
