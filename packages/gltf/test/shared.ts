import { existsSync, readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';

/** Where the test files lie that are not part of the repository: beside it. */
export const sharedPath = (path: string): string =>
  fileURLToPath(new URL(`../../../../shared/${path}`, import.meta.url));

/** Whether they are there, and what to add to a test's name where they are not. */
export const presence = (path: string) => {
  const present = existsSync(sharedPath(path));
  return { present, note: present ? '' : ` (skipped: no ../shared/${path} beside the repository)` };
};

/** An index of test files; empty where there is none. */
export const sharedIndex = <T>(path: string): T[] =>
  existsSync(sharedPath(path)) ? (JSON.parse(readFileSync(sharedPath(path), 'utf8')) as T[]) : [];
