// Apart from load.ts: bundlers that keep all of a module that import() names then still drop what is not exported here.
export { decodeImageInBrowser, loadGltf } from '@glanz/gltf';
