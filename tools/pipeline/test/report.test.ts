import { spawnSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { afterAll, beforeAll, expect, it } from 'vitest';
import { playwrightFailures, vitestFailures } from '../report.mjs';

const root = fileURLToPath(new URL('../../..', import.meta.url));
const require = createRequire(import.meta.url);
let folder: string;

beforeAll(() => {
  // Inside the repository, so that the files find Vitest and Playwright.
  folder = mkdtempSync(join(root, 'tools/pipeline/.report-'));
});
afterAll(() => rmSync(folder, { recursive: true, force: true }));

function run(script: string, args: string[], env: Record<string, string> = {}) {
  const { status } = spawnSync(process.execPath, [script, ...args], {
    cwd: folder,
    env: { ...process.env, VITEST: '', ...env },
    encoding: 'utf8',
  });
  return status;
}

it("names the failed tests of Vitest's report, and files that do not load", () => {
  writeFileSync(
    join(folder, 'a.test.mjs'),
    `import { describe, expect, it } from 'vitest';
describe('sums', () => {
  it('holds', () => expect(1 + 1).toBe(2));
  it('does not hold', () => expect(1 + 1, 'one and one').toBe(3));
});`,
  );
  writeFileSync(join(folder, 'b.test.mjs'), `throw new RangeError('cannot be loaded');`);
  writeFileSync(join(folder, 'vitest.config.mjs'), 'export default {};');
  const file = join(folder, 'vitest.json');
  const vitest = join(dirname(require.resolve('vitest/package.json')), 'vitest.mjs');
  expect(run(vitest, ['run', '--root', folder, '--reporter=json', `--outputFile.json=${file}`])).toBe(1);
  expect(vitestFailures(JSON.parse(readFileSync(file, 'utf8')), folder).sort()).toEqual([
    'a.test.mjs: sums does not hold: AssertionError: one and one: expected 2 to be 3 // Object.is equality',
    expect.stringMatching(/^b\.test\.mjs: .*cannot be loaded/),
  ]);
});

it("names the failed tests of Playwright's report, and repeated ones unless they had no browser at first", () => {
  writeFileSync(
    join(folder, 'a.spec.mjs'),
    `import { expect, test } from '@playwright/test';
test('holds', () => expect(2).toBe(2));
test('does not hold', () => { throw new Error('the second\\nfails'); });
test('holds when repeated', ({}, { retry }) => expect(retry, 'tries before').toBe(1));
test('has a browser when repeated', ({}, { retry }) => {
  if (retry > 0) return;
  expect.soft(retry, 'a hook that follows').toBe(1);
  throw new Error('browserType.launch: Target page, context or browser has been closed');
});
test('loses its page', async ({}, { retry }) => {
  if (retry === 0) throw new Error('page.evaluate: Target crashed');
});
test('has no browser', () => { throw new Error('browser.newPage: Protocol error'); });`,
  );
  writeFileSync(join(folder, 'playwright.config.mjs'), `export default { testMatch: 'a.spec.mjs', retries: 1 };`);
  const file = join(folder, 'playwright.json');
  const playwright = join(dirname(require.resolve('@playwright/test/package.json')), 'cli.js');
  expect(run(playwright, ['test', '--reporter=json'], { PLAYWRIGHT_JSON_OUTPUT_NAME: file })).toBe(1);
  expect(playwrightFailures(JSON.parse(readFileSync(file, 'utf8')))).toEqual({
    failed: [
      'a.spec.mjs: does not hold: Error: the second',
      'a.spec.mjs: holds when repeated: Error: tries before',
      'a.spec.mjs: loses its page: Error: page.evaluate: Target crashed',
      'a.spec.mjs: has no browser: Error: browser.newPage: Protocol error',
    ],
    repeated: [
      'a.spec.mjs: has a browser when repeated: Error: browserType.launch: Target page, context or browser has been closed',
    ],
  });
});
