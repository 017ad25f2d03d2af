import type { Plugin } from 'vite';

/** A plugin for Vitest that makes imports of tested sources as fast to read as elsewhere. */
export function fastExports(): Plugin;
