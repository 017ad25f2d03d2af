/** Sources that oxfmt formats; what Git ignores is skipped. */
const SOURCES = ['*.{ts,mjs}', '{apps,packages,tools}/**/*.{ts,tsx,mts,mjs}'];

/**
 * Arguments of oxfmt for all sources of the repository.
 *
 * @param {boolean} check Only list the files that are not formatted, and fail if there are any.
 * @returns {string[]}
 */
export function formatArguments(check) {
  return [check ? '--list-different' : '--write', ...SOURCES];
}
