declare module 'draco3dgltf/draco_decoder_gltf_nodejs.js' {
  /** Starts the decoder; `instantiateWasm` makes the instance and passes it to `done`. */
  const create: (options: {
    readonly instantiateWasm: (imports: WebAssembly.Imports, done: (instance: WebAssembly.Instance) => void) => object;
  }) => Promise<unknown>;
  export default create;
}

declare module 'three/examples/jsm/libs/basis/basis_transcoder.js' {
  /** Starts the transcoder; as above. */
  const create: (options: {
    readonly instantiateWasm: (imports: WebAssembly.Imports, done: (instance: WebAssembly.Instance) => void) => object;
  }) => Promise<unknown>;
  export default create;
}

declare module '*.wasm?url' {
  const address: string;
  export default address;
}
