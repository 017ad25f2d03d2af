export type Manifest = Record<string, unknown>;
/** What a stability label promises; CONTRIBUTING.md explains each. */
export const STABILITY: readonly string[];
export function webAddress(rootManifest: Manifest): string | undefined;
export function errorsPage(rootManifest: object): string | undefined;
export function completeManifest(manifest: Manifest, rootManifest: Manifest, folder: string): Manifest;
export function absoluteLinks(markdown: string, web: string, folder: string): string;
