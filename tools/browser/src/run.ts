import { mkdirSync, mkdtempSync, rmSync } from 'node:fs';
import { fileURLToPath } from 'node:url';

/** The variable that names the folder of a run of Playwright to its workers. */
export const RUN_FOLDER = 'GLANZ_E2E_RUN';

/** Playwright's global setup: a folder for what is built once in a run. Its teardown removes the folder. */
export default function createRunFolder(): () => void {
  const cache = fileURLToPath(new URL('../../../.cache/', import.meta.url));
  mkdirSync(cache, { recursive: true });
  const folder = mkdtempSync(`${cache}run-`);
  process.env[RUN_FOLDER] = folder;
  return () => rmSync(folder, { recursive: true, force: true });
}
