export { ktx2Decoder } from '@glanz/gltf';
