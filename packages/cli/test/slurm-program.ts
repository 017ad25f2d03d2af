import { execFile } from 'node:child_process';
import { existsSync, mkdirSync, readdirSync, renameSync, rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { promisify } from 'node:util';

const run = promisify(execFile);
const CACHE = fileURLToPath(new URL('../../../.cache/slurm', import.meta.url));
const PACKAGES = ['slurm-client', 'slurm-wlm-basic-plugins', 'libmunge2'];

/** What `sbatch` says of a script. */
export type CheckScript = (script: string) => Promise<string>;

/** Whether `sbatch` accepts a script's options, or why that cannot be found out. */
export type FoundSlurm = { readonly check: CheckScript; readonly missing?: undefined } | { readonly missing: string };

/** Downloads Slurm's client of the distribution without installing it. It checks options before it asks a controller. */
export async function findSlurm(): Promise<FoundSlurm> {
  if (!existsSync(CACHE)) {
    const partial = `${CACHE}.${process.pid}`;
    try {
      mkdirSync(partial, { recursive: true });
      await run('apt-get', ['download', ...PACKAGES], { cwd: partial, timeout: 60_000 });
      for (const name of readdirSync(partial).filter((one) => one.endsWith('.deb')))
        await run('dpkg', ['-x', name, 'root'], { cwd: partial });
      renameSync(join(partial, 'root'), CACHE);
    } catch (cause) {
      const why = ((cause as Error).message.trim().split('\n').at(-1) as string).slice(0, 200);
      return { missing: `there is no sbatch, and apt-get cannot download it: ${why}` };
    } finally {
      rmSync(partial, { recursive: true, force: true });
    }
  }
  const libraries = readdirSync(join(CACHE, 'usr/lib')).map((name) => join(CACHE, 'usr/lib', name));
  const plugins = libraries.map((folder) => join(folder, 'slurm-wlm')).find((folder) => existsSync(folder));
  const settings = join(CACHE, 'slurm.conf');
  writeFileSync(
    settings,
    [
      'ClusterName=glanz',
      'SlurmctldHost=localhost(127.0.0.1)',
      // Nothing listens there.
      'SlurmctldPort=1',
      'MessageTimeout=1',
      `PluginDir=${plugins}`,
      'SelectType=select/cons_tres',
      'GresTypes=gpu',
      'NodeName=localhost',
      'PartitionName=all Nodes=ALL',
      '',
    ].join('\n'),
  );
  const env = {
    ...process.env,
    SLURM_CONF: settings,
    LD_LIBRARY_PATH: [...libraries, plugins].join(':'),
  };
  const sbatch = join(CACHE, 'usr/bin/sbatch');
  try {
    await run(sbatch, ['--version'], { env });
  } catch (cause) {
    return { missing: `the sbatch that apt-get downloaded does not run: ${(cause as Error).message.slice(0, 200)}` };
  }
  return {
    check: (script) =>
      run(sbatch, ['--test-only', script], { env }).then(
        ({ stderr }) => stderr,
        ({ stderr }: { stderr: string }) => stderr,
      ),
  };
}
