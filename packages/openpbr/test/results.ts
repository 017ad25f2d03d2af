import { mkdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { afterAll } from 'vitest';

const FOLDER = process.env['GLANZ_RESULTS'];

/**
 * Keeps what a test file measured. With the environment variable GLANZ_RESULTS=FOLDER it is written to
 * FOLDER/<name>.json when the file is through; apps/docs/scripts/openpbr-results.mjs makes the results page of that.
 */
export function resultsOf(name: string): (key: string, value: unknown) => void {
  const results: Record<string, unknown> = {};
  afterAll(() => {
    if (!FOLDER || Object.keys(results).length === 0) return;
    mkdirSync(FOLDER, { recursive: true });
    writeFileSync(join(FOLDER, `${name}.json`), `${JSON.stringify(results, undefined, 1)}\n`);
  });
  return (key, value) => (results[key] = value);
}
