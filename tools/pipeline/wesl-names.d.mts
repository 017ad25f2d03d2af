/** A token of a WESL file with its place. */
export interface WeslToken {
  readonly text: string;
  readonly from: number;
  readonly to: number;
}

/**
 * Short names for parameters, variables and constants inside of functions; all other names stay.
 *
 * @param tokens Of a WESL file, without comments.
 * @returns Replacements.
 */
export function shortenLocals(tokens: readonly WeslToken[]): WeslToken[];
