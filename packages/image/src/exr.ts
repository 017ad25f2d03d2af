export { encodeExr, type ExrLayer, type ExrSource, type ExrType } from './exr-encode';
export { decodeExr, type ExrChannel, type ExrImage } from './exr-decode';
