import type { Plugin } from 'esbuild';

/** Makes top-level constants droppable and takes comments and indentation out of WGSL templates. */
export function preparePublished(text: string, fileName?: string): string;

/** The esbuild plugin that applies {@link preparePublished} to every source file. */
export const publishedSource: Plugin;

/**
 * The same for pages that Vite, of whatever version, builds from the packages' sources; where it serves them, sources
 * stay as they are.
 */
export const publishedModules: () => {
  readonly name: string;
  readonly apply: 'build';
  readonly enforce: 'pre';
  transform(code: string, id: string): { code: string; map: null } | undefined;
};
