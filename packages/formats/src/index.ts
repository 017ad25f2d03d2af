export { FormatError } from './error';
export { readObj, type ObjOptions } from './obj';
export { readStl, type StlOptions } from './stl';
export type { PictureDecoder, ResourceReader } from './resources';
