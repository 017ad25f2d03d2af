/** Where in the user's input an error arose. Every field is optional; the error's message already spells out those present. */
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

/** What a {@link GlanzError} may carry besides its code and message. */
export interface GlanzErrorOptions {
  /** The error that led to this one. */
  readonly cause?: unknown;
  /** Where it happened, as far as it is known. */
  readonly location?: ErrorLocation;
}

/**
 * The base of every error that Glanz throws on purpose. `code` is stable and meant for programs; `message` is one line
 * for people: what was wrong, where, and what to do.
 *
 * @example
 * try { … } catch (error) { if (error instanceof GlanzError && error.code === 'gltf/truncated') … }
 */
export class GlanzError extends Error {
  /** Stable, machine-readable: `<package>/<what>`, e.g. `bvh/empty-mesh`. */
  readonly code: string;
  /** Where it happened, as far as it is known. */
  readonly location: ErrorLocation | undefined;

  constructor(code: string, message: string, options: GlanzErrorOptions = {}) {
    super(message, options.cause === undefined ? undefined : { cause: options.cause });
    this.name = new.target.name;
    this.code = code;
    this.location = options.location;
  }
}
