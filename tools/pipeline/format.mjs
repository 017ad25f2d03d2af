/** Sources that prettier formats; what Git ignores is skipped. */
const SOURCES = ['*.{ts,mjs}', '{apps,packages,tools}/**/*.{ts,tsx,mts,mjs}'];

/**
 * Arguments of prettier for all sources of the repository. What did not change since the last run is not read again.
 *
 * @param {boolean} check Only list the files that are not formatted, and fail if there are any.
 * @returns {string[]}
 */
export function formatArguments(check) {
  const cache = ['--cache', '--cache-location', '.cache/prettier.json'];
  return [check ? '--check' : '--write', '--log-level', 'warn', ...cache, ...SOURCES];
}
