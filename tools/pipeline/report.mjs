// What every check gives back, and how it is shown.

/**
 * @typedef {{ passed: number, failed: number, skipped?: number, lines?: string[], table?: string[] }} CheckResult
 *   `lines`: one per failure; `table`: shown in any case.
 */

/** Collects verdicts. */
export class Verdicts {
  passed = 0;
  failed = 0;
  skipped = 0;
  /** @type {string[]} */
  lines = [];
  /** @type {string[]} */
  table = [];

  /** Counts one verdict; a failing one is reported with `message`. */
  expect(condition, message) {
    if (condition) this.passed++;
    else this.fail(message);
    return condition;
  }

  /** Runs a step; what it throws is one failure more, and the check continues. */
  async attempt(what, step) {
    try {
      await step();
    } catch (error) {
      this.fail(`${what}: ${error?.message ?? error}`);
    }
  }

  fail(message) {
    this.failed++;
    this.lines.push(message);
  }
}

/** Columns lined up; a column of figures is aligned to the right. @param {readonly (readonly string[])[]} rows */
export function columns(rows, rightAligned = []) {
  const widths = [];
  for (const row of rows) row.forEach((cell, i) => (widths[i] = Math.max(widths[i] ?? 0, cell.length)));
  return rows.map((row) =>
    row
      .map((cell, i) => (rightAligned.includes(i) ? cell.padStart(widths[i]) : cell.padEnd(widths[i])))
      .join('  ')
      .trimEnd(),
  );
}

/** Runs one check as a program of its own when its file is the one that Node was started with. */
export async function runAlone(importMeta, check) {
  const { pathToFileURL } = await import('node:url');
  if (process.argv[1] === undefined || pathToFileURL(process.argv[1]).href !== importMeta.url) return;
  const { main } = await import('./process.mjs');
  await main(async () => {
    const result = await check();
    for (const line of result.table ?? []) process.stdout.write(`${line}\n`);
    for (const line of result.lines ?? []) process.stdout.write(`${line}\n`);
    process.stdout.write(`${result.passed} passed, ${result.failed} failed\n`);
    return result.failed > 0 ? 1 : 0;
  });
}
