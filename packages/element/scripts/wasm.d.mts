import type { Plugin } from 'esbuild';

/** A plugin of esbuild for the modules of the decoders. @param folder The package's. */
export function packedWasm(folder: string): Plugin;
