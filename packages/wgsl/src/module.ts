/**
 * A piece of WGSL with a name and what it needs. Modules are plain frozen values: they can be exported from any file,
 * composed by {@link compose}, and dropped by a bundler when unused.
 *
 * Inside `code`, gates keep or leave out text. They nest, on separate lines or within a line:
 * ```wgsl
 * //#if COAT          keeps what follows when the flag COAT is true; `//#if COAT && !FUZZ` requires two
 * //#else
 * //#endif
 * ```
 */
export interface WgslModule {
  /** Unique name; appears in error messages, e.g. `openpbr/coat`. */
  readonly name: string;
  /**
   * WGSL text: functions, structs, constants. Library modules hold no storage pointers, and only bindings whose
   * numbers the host gives.
   */
  readonly code: string;
  /** Modules whose declarations this one uses. A gated dependency counts only when its flag is set. */
  readonly deps: readonly (WgslModule | GatedDependency)[];
}

/** A dependency that is included only if `flag` has the value `value`. */
export interface GatedDependency {
  /** The module to include. */
  readonly module: WgslModule;
  /** Name of the flag, without `!`. */
  readonly flag: string;
  /** The value that the flag must have. */
  readonly value: boolean;
}

/**
 * Makes a {@link WgslModule}.
 *
 * @param name Unique name, `<package>/<topic>`.
 * @param code WGSL text; a tagged `/* wgsl *\/` template gets highlighted by editors.
 * @param deps Modules it uses.
 */
export function wgslModule(
  name: string,
  code: string,
  deps: readonly (WgslModule | GatedDependency)[] = [],
): WgslModule {
  return Object.freeze({ name, code, deps: Object.freeze([...deps]) });
}

/**
 * Makes a dependency that counts only under a flag, so that the text of an unused feature never reaches the compiler.
 *
 * @param flag Flag name; a leading `!` requires the flag to be false.
 */
export function gated(flag: string, module: WgslModule): GatedDependency {
  const negative = flag.startsWith('!');
  return Object.freeze({ module, flag: negative ? flag.slice(1) : flag, value: !negative });
}
