import { execFile } from 'node:child_process';
import { existsSync, rmSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { promisify } from 'node:util';

const run = promisify(execFile);
const cache = (name: string): string => fileURLToPath(new URL(`../../../.cache/${name}`, import.meta.url));

const works = (file: string): Promise<boolean> =>
  run(file, ['--version']).then(
    () => true,
    () => false,
  );

/** A command, or why there is none. */
export interface FoundProgram {
  readonly file?: string;
  readonly missing?: string;
}

/**
 * A command that a Python package has: what the environment's `variable` names, that of the PATH, or what pip installs
 * into `.cache/NAME`.
 */
async function findPythonProgram(name: string, variable: string, requirement: string): Promise<FoundProgram> {
  const named = process.env[variable];
  if (named) return (await works(named)) ? { file: named } : { missing: `${variable}: "${named}" does not run` };
  if (await works(name)) return { file: name };
  const folder = cache(name);
  const file = `${folder}/bin/${name}`;
  if (existsSync(file) && (await works(file))) return { file };
  try {
    await run('python3', ['-m', 'venv', folder], { timeout: 60_000 });
    await run(`${folder}/bin/pip`, ['install', '-q', requirement], { timeout: 120_000 });
  } catch (cause) {
    rmSync(folder, { recursive: true, force: true });
    const why = ((cause as Error).message.trim().split('\n').at(-1) as string).slice(0, 200);
    return { missing: `there is no ${name}, and pip cannot install it: ${why}` };
  }
  return (await works(file)) ? { file } : { missing: `the ${name} that pip installed does not run` };
}

/** The `openjd` command. */
export const findOpenJd = (): Promise<FoundProgram> => findPythonProgram('openjd', 'GLANZ_OPENJD', 'openjd-cli==0.8.0');

/** The `kubernetes-validate` command, which has the schemas of the versions of Kubernetes. */
export const findKubernetesValidate = (): Promise<FoundProgram> =>
  findPythonProgram('kubernetes-validate', 'GLANZ_KUBERNETES_VALIDATE', 'kubernetes-validate==1.34.1');
