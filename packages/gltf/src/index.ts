export type { GltfDecoders } from './document';
export { decodeImageInBrowser, imageOfBitmap } from './browser-images';
export { GltfError } from './error';
export type { GltfLimits } from './limits';
export type { CompressedFormats, DecodedImage, ImageDecoder, Ktx2Decoder } from './decoded-image';
export { ktx2Decoder } from './ktx2';
export { loadGltf, type GltfOptions, type GltfProgress, type LoadGltfOptions } from './load';
export type { GltfFiles, GltfInput } from './source';
