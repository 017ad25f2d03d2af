declare module 'draco3dgltf/draco_decoder_gltf_nodejs.js' {
  /** Starts the decoder; `locateFile` gives the address of its WebAssembly. */
  const create: (options: { readonly locateFile: (name: string) => string }) => Promise<unknown>;
  export default create;
}

declare module 'draco3dgltf/draco_decoder_gltf.wasm?url' {
  const address: string;
  export default address;
}
