/** Checks the repository at `base` (default: this repository). `lines` holds one entry per package with faults. */
export function checkImports(base?: string): Promise<{ passed: number; failed: number; lines: string[] }>;
