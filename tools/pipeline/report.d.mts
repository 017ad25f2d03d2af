/** What failed according to a report of Vitest's JSON reporter, one line a failure. */
export function vitestFailures(report: object, root: string): string[];

/** What failed, or passed only when repeated, according to a report of Playwright's JSON reporter, one line a failure. */
export function playwrightFailures(report: object): string[];
