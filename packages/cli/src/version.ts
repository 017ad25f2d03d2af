import { readFileSync } from 'node:fs';

/** Version of this package. */
export function version(): string {
  // Both src/ and dist/ lie one below the package.
  return (JSON.parse(readFileSync(new URL('../package.json', import.meta.url), 'utf8')) as { version: string }).version;
}
