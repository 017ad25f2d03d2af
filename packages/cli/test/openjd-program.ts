import { execFile } from 'node:child_process';
import { existsSync, rmSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { promisify } from 'node:util';

const run = promisify(execFile);
const CACHE = fileURLToPath(new URL('../../../.cache/openjd', import.meta.url));
const VERSION = '0.8.0';

const works = (file: string): Promise<boolean> =>
  run(file, ['--version']).then(
    () => true,
    () => false,
  );

/** The `openjd` command: `GLANZ_OPENJD`, the PATH's, or what pip installs into `.cache/openjd`; or why there is none. */
export async function findOpenJd(): Promise<{ readonly file?: string; readonly missing?: string }> {
  const named = process.env.GLANZ_OPENJD;
  if (named) return (await works(named)) ? { file: named } : { missing: `GLANZ_OPENJD: "${named}" does not run` };
  if (await works('openjd')) return { file: 'openjd' };
  const file = `${CACHE}/bin/openjd`;
  if (existsSync(file) && (await works(file))) return { file };
  try {
    await run('python3', ['-m', 'venv', CACHE], { timeout: 60_000 });
    await run(`${CACHE}/bin/pip`, ['install', '-q', `openjd-cli==${VERSION}`], { timeout: 120_000 });
  } catch (cause) {
    rmSync(CACHE, { recursive: true, force: true });
    const why = ((cause as Error).message.trim().split('\n').at(-1) as string).slice(0, 200);
    return { missing: `there is no openjd, and pip cannot install it: ${why}` };
  }
  return (await works(file)) ? { file } : { missing: 'the openjd that pip installed does not run' };
}
