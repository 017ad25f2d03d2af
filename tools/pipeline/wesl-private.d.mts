import type { WeslToken } from './wesl-names.mjs';

/**
 * Short names for what one shader file declares and nothing else of its workspace names.
 *
 * @param tokens Of a WESL file, without comments.
 * @param file Absolute path.
 * @param folder Of the file's package; where it is in no workspace, names stay.
 * @param locals Replacements of local names.
 * @returns Replacements.
 */
export function shortenPrivate(
  tokens: readonly WeslToken[],
  file: string,
  folder: string,
  locals: readonly { readonly from: number }[],
): WeslToken[];

/** The short names of a package, in a text that changes with them: other packages decide which there are. */
export function privateNames(folder: string): string;
