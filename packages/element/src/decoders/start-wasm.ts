type Create = (options: {
  readonly instantiateWasm: (imports: WebAssembly.Imports, done: (instance: WebAssembly.Instance) => void) => object;
}) => Promise<unknown>;

/**
 * Starts a module that Emscripten made. The bytes are compiled here, so that a content security policy that forbids
 * WebAssembly rejects; Emscripten's own code would only log that.
 */
export async function startWasm(create: Create, bytes: () => Promise<ArrayBuffer>): Promise<unknown> {
  const module = await WebAssembly.compile(await bytes()).catch((cause: Error) => {
    // Browsers name a source that allows more than is needed.
    throw /unsafe-eval/.test(cause.message)
      ? new Error("the page's content security policy forbids WebAssembly: add 'wasm-unsafe-eval' to script-src", {
          cause,
        })
      : cause;
  });
  return new Promise((resolve, reject) => {
    const instantiateWasm = (imports: WebAssembly.Imports, done: (instance: WebAssembly.Instance) => void) => {
      WebAssembly.instantiate(module, imports).then(done, reject);
      return {};
    };
    create({ instantiateWasm }).then(resolve, reject);
  });
}
