import address from 'three/examples/jsm/libs/basis/basis_transcoder.wasm?url';

/**
 * The WebAssembly of the Basis Universal transcoder. The build puts a module here that holds the bytes: see
 * scripts/wasm.mjs.
 */
export const wasmBytes = async (): Promise<ArrayBuffer> => (await fetch(address)).arrayBuffer();
