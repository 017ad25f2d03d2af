/** A constant of a table: see {@link readConstants}. */
export interface WeslConstant {
  readonly name: string;
  /** A number or boolean, or an array of values. */
  readonly value: unknown;
  /** Its type in TypeScript. */
  readonly type: string;
  /** The comment directly above it. */
  readonly doc: string;
  readonly line: number;
}

/**
 * The constants of a file that declares nothing else; `undefined` for any other file.
 * @throws {WeslError}
 */
export function readConstants(text: string, file?: string): WeslConstant[] | undefined;

/** The exports of a module with these constants. */
export function exportedConstants(constants: readonly WeslConstant[]): string;

/**
 * What declares a table of constants to TypeScript.
 * @throws {WeslError}
 */
export function declareConstants(text: string, file: string): string;

/** The file that declares a table to TypeScript. */
export function declarationFile(file: string): string;

/** All tables of constants below the sources of the packages. */
export function constantFiles(root: string): string[];
