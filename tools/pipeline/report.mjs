// What every check returns, and how it is shown.
import { relative } from 'node:path';
import { stripVTControlCharacters } from 'node:util';

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

const firstLine = (text) => stripVTControlCharacters(String(text)).trim().split('\n', 1)[0];

/**
 * What failed according to a report of Vitest's JSON reporter: one line a test, `file: full name: first line of its
 * message`, and one for each file that failed outside of its tests.
 *
 * @param {string} root Files are named relative to it.
 * @returns {string[]}
 */
export function vitestFailures({ testResults = [] }, root) {
  return testResults.flatMap(({ name, status, message, assertionResults = [] }) => {
    const file = relative(root, name).replaceAll('\\', '/');
    const failed = assertionResults.filter((test) => test.status === 'failed');
    if (failed.length === 0 && status === 'failed') return [`${file}: ${firstLine(message)}`];
    return failed.map((test) => `${file}: ${test.fullName}: ${firstLine(test.failureMessages?.[0] ?? '')}`);
  });
}

/** Errors before there is a page, when nothing of ours has run yet: the browser did not start, or had no page to give. */
const NO_BROWSER = /browserType\.launch|browser\.new(Context|Page)/;

/**
 * What failed according to a report of Playwright's JSON reporter: one line a test, `file: title: first line of its
 * message`, and one for each error outside of the tests. A test that passes only when repeated has failed, unless it had
 * no browser at its first try: then it is among `repeated`.
 *
 * @returns {{ failed: string[], repeated: string[] }}
 */
export function playwrightFailures({ suites = [], errors = [] }) {
  const failed = errors.map(({ message }) => firstLine(message));
  const repeated = [];
  const visit = (suite) => {
    for (const { file, title, tests } of suite.specs ?? [])
      for (const { status, results } of tests)
        if (status === 'unexpected' || status === 'flaky') {
          // Without a browser in a hook, the hooks that follow fail too.
          const messages = results.flatMap(({ errors }) => errors.map(({ message }) => firstLine(message)));
          const cause = messages.find((message) => NO_BROWSER.test(message));
          if (status === 'flaky' && cause) repeated.push(`${file}: ${title}: ${cause}`);
          else failed.push(`${file}: ${title}: ${messages[0] ?? status}`);
        }
    for (const child of suite.suites ?? []) visit(child);
  };
  for (const suite of suites) visit(suite);
  return { failed, repeated };
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
