/** Checks the shader sources of the repository at `base` (default: this repository) against the rules of CONTRIBUTING.md. */
export function checkWesl(base?: string): Promise<{ passed: number; failed: number; lines: string[] }>;
