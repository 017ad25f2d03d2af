import type { Plugin } from 'esbuild';

/** Makes top-level constants droppable and takes comments and indentation out of WGSL templates. */
export function preparePublished(text: string, fileName?: string): string;

/** The esbuild plugin that applies {@link preparePublished} to every source file. */
export const publishedSource: Plugin;
