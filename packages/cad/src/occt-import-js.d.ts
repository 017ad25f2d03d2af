declare module 'occt-import-js' {
  /** Starts OpenCASCADE; `locateFile` gives the address of its WebAssembly, `print` takes its chatter. */
  const create: (options?: {
    readonly locateFile?: (name: string) => string;
    readonly wasmBinary?: Uint8Array;
    readonly print?: (line: string) => void;
    readonly printErr?: (line: string) => void;
  }) => Promise<unknown>;
  export default create;
}
