import address from 'draco3dgltf/draco_decoder_gltf.wasm?url';

/** The WebAssembly of Draco's decoder. The build puts a module here that holds the bytes: see scripts/wasm.mjs. */
export const wasmBytes = async (): Promise<ArrayBuffer> => (await fetch(address)).arrayBuffer();
