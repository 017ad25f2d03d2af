/** Checks the sources of a package, emits their declarations, and gives those of its entries, relative to `folder`. */
export function emitDeclarations(folder: string, entries: Readonly<Record<string, string>>): Record<string, string>;
