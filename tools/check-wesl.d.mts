/**
 * Checks the shader sources of the repository at `base` (default: this repository) against the rules of CONTRIBUTING.md.
 *
 * @param options `write`: shortens the list of templates that still hold gates.
 */
export function checkWesl(
  base?: string,
  options?: { readonly write?: boolean },
): Promise<{ passed: number; failed: number; lines: string[] }>;
