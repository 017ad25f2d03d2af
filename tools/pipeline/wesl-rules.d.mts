/** A function's lines, the conditions in its body, and the columns of a line, at most. */
export const LIMITS: { readonly lines: number; readonly gates: number; readonly columns: number };

/**
 * What of a WESL file breaks a limit: messages with file and line.
 * @throws {import('./wesl.mjs').WeslError}
 */
export function brokenRules(text: string, file: string): string[];

/** Whether a source begins, turns or ends a gate of the composer. */
export function hasGates(text: string): boolean;
