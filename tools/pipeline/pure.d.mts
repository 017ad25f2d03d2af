import type { Plugin } from 'esbuild';

/** Wraps the computed initializers of a module's top-level constants into pure calls. */
export function annotatePure(text: string, fileName?: string): string;

/** The esbuild plugin that applies {@link annotatePure} to every source file. */
export const pureConstants: Plugin;
