/**
 * Where in the user's input an error arose. Every field is optional; the error's message includes those present.
 */
export interface ErrorLocation {
  /** File name or URL, as the user gave it. */
  readonly file?: string;
  /** JSON pointer or a readable path inside the file, e.g. `/meshes/3/primitives/0`. */
  readonly path?: string;
  /** Byte offset inside the file. */
  readonly byteOffset?: number;
  /** Shader module name, for WGSL errors. */
  readonly module?: string;
  /** Line (1-based) inside the file or shader module. */
  readonly line?: number;
}

/** Options for {@link GlanzError}. */
export interface GlanzErrorOptions {
  /** The error that caused this one. */
  readonly cause?: unknown;
  /** Where it happened, if known. */
  readonly location?: ErrorLocation;
}

// Text that builds replace: ours by the address of the page on errors, the user's bundler by its mode.
declare const GLANZ_ERRORS_PAGE: string;
declare const process: { readonly env: { readonly NODE_ENV?: string } };

/**
 * Where a code is explained, in development builds of packages that were built with the address of the documentation.
 */
function explanation(code: string): string {
  try {
    if (process.env.NODE_ENV === 'development') return ` See ${GLANZ_ERRORS_PAGE}#${code.replace('/', '-')}`;
  } catch {
    // Browsers have no `process`, and sources no address.
  }
  return '';
}

/**
 * The base of every error that Glanz throws on purpose. `code` is stable and meant for programs; `message` is one line
 * for people: what was wrong, where, and what to do. In development builds (`process.env.NODE_ENV` is `development`,
 * which bundlers replace) the message ends with the address of the code's paragraph in the documentation.
 *
 * @example
 * try { … } catch (error) { if (error instanceof GlanzError && error.code === 'gltf/truncated') … }
 */
export class GlanzError extends Error {
  /** Stable, machine-readable: `<package>/<what>`, e.g. `bvh/empty-mesh`. */
  readonly code: string;
  /** Where it happened, if known. */
  readonly location: ErrorLocation | undefined;

  constructor(code: string, message: string, options: GlanzErrorOptions = {}) {
    super(message + explanation(code), options.cause === undefined ? undefined : { cause: options.cause });
    this.name = new.target.name;
    this.code = code;
    this.location = options.location;
  }
}

/**
 * Waits for a part of a package that is loaded by `import()` when it is first needed.
 *
 * @param name Of the part, as the message calls it.
 * @throws {GlanzError} `wgsl/chunk` where its file cannot be loaded. A page is reloaded then: after a new deployment,
 * the files that an open page asks for are gone.
 */
export async function loadPart<T>(name: string, part: Promise<T>): Promise<T> {
  try {
    return await part;
  } catch (cause) {
    throw new GlanzError(
      'wgsl/chunk',
      `"${name}" cannot be loaded: ${String(cause)}. In a page, reload it: there may be a new version.`,
      { cause },
    );
  }
}
