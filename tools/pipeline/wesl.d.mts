import type { Plugin } from 'esbuild';
import type { WeslToken } from './wesl-names.mjs';

/** A `.wesl` file that cannot be turned into a module: what is wrong, with file and line. */
export class WeslError extends Error {}

/** A name that a WESL file imports. */
export interface WeslImport {
  /** Its module, e.g. `['package', 'wgsl', 'fresnel']`. */
  readonly path: string[];
  readonly name: string;
  /** `FLAG` or `!FLAG` where the import is gated. */
  readonly flag: string | undefined;
  readonly line: number;
}

/** What {@link parseWesl} finds. */
export interface ParsedWesl {
  readonly imports: WeslImport[];
  /** Replacements that turn the text into one with gates. */
  readonly edits: { readonly from: number; readonly to: number; readonly text: string }[];
  readonly comments: { readonly from: number; readonly to: number }[];
  /** All of it but comments. */
  readonly tokens: WeslToken[];
}

/**
 * Reads the imports and conditions of a WESL file.
 * @throws {WeslError}
 */
export function parseWesl(text: string, file?: string): ParsedWesl;

/** Whether a path is that of a file that only declares what a host supplies. */
export function isHost(path: readonly string[]): boolean;

/** A line of WGSL without the spaces that separate nothing. */
export function closeUp(line: string): string;

/** Options for {@link compileWesl}. */
export interface WeslOptions {
  /**
   * Leaves out comments, empty lines, and spaces that separate nothing, and shortens names of one function or file alone.
   * Default false.
   */
  readonly shrink?: boolean;
}

/**
 * A WESL file as a JavaScript module whose default export is its `WgslModule`.
 * @throws {WeslError}
 */
export function compileWesl(
  text: string,
  file: string,
  options?: WeslOptions,
): {
  code: string;
  map: { version: 3; sources: string[]; sourcesContent: string[]; names: string[]; mappings: string };
};

/** For esbuild and tsup. */
export function weslSource(options?: WeslOptions): Plugin;

/** For Vite, Vitest and VitePress; their builds leave out comments and spaces. */
export function weslModules(): {
  readonly name: string;
  readonly enforce: 'pre';
  configResolved(config: { readonly command: 'build' | 'serve' }): void;
  transform(text: string, id: string): { code: string; map: ReturnType<typeof compileWesl>['map'] | null } | undefined;
};
