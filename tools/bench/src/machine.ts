import { execFileSync } from 'node:child_process';
import { arch, cpus, platform, release, totalmem } from 'node:os';

/** Where and on what a benchmark ran. */
export interface Machine {
  readonly cpu: string;
  readonly cores: number;
  readonly memoryGiB: number;
  readonly os: string;
  readonly node: string;
  /** Commit of the checkout, with `+` for uncommitted changes; absent where there is no checkout. */
  readonly commit?: string;
  /** ISO 8601, UTC. */
  readonly date: string;
}

function commit(): string | undefined {
  const git = (...args: string[]) =>
    execFileSync('git', args, { encoding: 'utf8', stdio: ['ignore', 'pipe', 'ignore'] }).trim();
  try {
    return (
      git('rev-parse', '--short', 'HEAD') + (git('status', '--porcelain', '--untracked-files=no') === '' ? '' : '+')
    );
  } catch {
    return undefined;
  }
}

/** Describes this machine. */
export function machine(): Machine {
  // Packed bundles carry the commit they were built from, as there is no checkout beside them.
  const revision = process.env['GLANZ_COMMIT'] ?? commit();
  return {
    cpu: cpus()[0]?.model.trim() ?? 'unknown',
    cores: cpus().length,
    memoryGiB: Math.round(totalmem() / 2 ** 30),
    os: `${platform()} ${release()} ${arch()}`,
    node: process.version,
    ...(revision === undefined ? {} : { commit: revision }),
    date: new Date().toISOString(),
  };
}
