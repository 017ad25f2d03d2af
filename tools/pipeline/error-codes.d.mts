/** All codes of a package, from the text of its sources by path: code → `file:line` of each place. */
export function codesIn(packageName: string, files: ReadonlyMap<string, string>): Map<string, string[]>;
/** The codes of the package whose sources lie in `folder`. */
export function errorCodes(packageName: string, folder: string): Map<string, string[]>;
