import { existsSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { PNPM_VERSION, TaskError, pnpm, root, stream } from './process.mjs';

/** True if node_modules holds what the lockfile says: pnpm leaves the lockfile it installed beside its store. */
export function isInstalled(folder = root) {
  const required = join(folder, 'pnpm-lock.yaml');
  const installed = join(folder, 'node_modules', '.pnpm', 'lock.yaml');
  if (!existsSync(installed) || !existsSync(join(folder, 'node_modules', '.modules.yaml'))) return false;
  return readFileSync(required).equals(readFileSync(installed));
}

/** Installs the workspace's dependencies if they are missing or older than the lockfile. */
export async function ensureInstalled({ force = false } = {}) {
  const major = Number(process.versions.node.split('.')[0]);
  if (major < 20)
    throw new TaskError(`Node ${process.versions.node} is too old; Glanz needs Node 20 or newer (https://nodejs.org).`);
  if (!force && isInstalled()) return false;
  process.stderr.write(`glanz: installing dependencies (pnpm ${PNPM_VERSION} through npx)\n`);
  const { command, args, shell } = pnpm(['install', '--frozen-lockfile']);
  // CI: never ask questions.
  const code = await stream(command, args, { stdout: 'stderr', shell, env: { CI: 'true' } });
  if (code !== 0) {
    throw new TaskError(
      `the installation of dependencies ended with code ${code}. The messages above say why: usually no network, or a package.json that the lockfile does not match (then: npx -y pnpm@${PNPM_VERSION} install).`,
    );
  }
  return true;
}
