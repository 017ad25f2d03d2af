/**
 * Builds the element into one file, with files beside it for what only some models need.
 *
 * @param folder The package's.
 * @param to Where the files go.
 * @returns Their names, that of the single file first.
 */
export function buildSingleFile(folder: string, to: string): Promise<string[]>;
