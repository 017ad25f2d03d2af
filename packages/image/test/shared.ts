import { existsSync, readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';

/** The folder of test assets beside the repository; not everybody has it. */
export const SHARED = fileURLToPath(new URL('../../../../shared/', import.meta.url));
export const hasShared = existsSync(SHARED);
export const shared = (path: string) => new Uint8Array(readFileSync(SHARED + path));

/** Deterministic numbers in 0..1. */
export function randomNumbers(seed: number): () => number {
  let state = seed >>> 0;
  return () => (state = (Math.imul(state, 1664525) + 1013904223) >>> 0) / 2 ** 32;
}
