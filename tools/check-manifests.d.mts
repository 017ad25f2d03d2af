/** Compares every package's manifest with the root's; `write` makes them agree. */
export function checkManifests(options?: {
  readonly base?: string;
  readonly write?: boolean;
}): Promise<{ readonly failed: number; readonly lines: readonly string[] }>;
