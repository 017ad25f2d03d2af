export { encodeExr, type ExrLayer, type ExrSource } from './exr-encode';
export type { ExrType } from './exr-block';
export { decodeExr, type ExrChannel, type ExrImage } from './exr-decode';
