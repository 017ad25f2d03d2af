// The packages as a registry would hold them, and a folder where they are installed as a consumer would have them.
import { existsSync, mkdirSync, readFileSync, realpathSync, rmSync, symlinkSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { TaskError, capture, pnpm, root } from './process.mjs';
import { publishedPackages } from './workspace.mjs';

/** Packs every published package. `pnpm pack` applies publishConfig and turns workspace: and catalog: into versions. */
export async function packAll(folder = join(root, '.cache', 'packed')) {
  rmSync(folder, { recursive: true, force: true });
  mkdirSync(folder, { recursive: true });
  const { command, args, shell } = pnpm(['-r', '--filter', './packages/*', 'pack', '--pack-destination', folder]);
  const { code, output } = await capture(command, args, { shell });
  if (code !== 0) throw new TaskError(`pnpm pack failed:\n${output.trim()}`);
  return publishedPackages().map((p) => {
    const tarball = join(folder, `${p.name.replace('@', '').replace('/', '-')}-${p.manifest.version}.tgz`);
    if (!existsSync(tarball)) throw new TaskError(`pnpm pack made no ${tarball}:\n${output.trim()}`);
    return { ...p, tarball };
  });
}

let installed;

/**
 * Installs the packed packages into `.cache/consumer/node_modules`, each with links to its dependencies and to
 * the peers that it cannot do without, none to its optional ones. Once per process.
 *
 * @returns {Promise<{ folder: string, packages: (import('./workspace.mjs').Package & { tarball: string })[] }>}
 * `manifest` is the published one.
 */
export function installPacked() {
  installed ??= install();
  return installed;
}

async function install() {
  const folder = join(root, '.cache', 'consumer');
  rmSync(folder, { recursive: true, force: true });
  mkdirSync(join(folder, 'node_modules', '@glanz'), { recursive: true });
  writeFileSync(join(folder, 'package.json'), JSON.stringify({ name: 'consumer', private: true, type: 'module' }));
  const packages = [];
  for (const p of await packAll()) {
    const to = join(folder, 'node_modules', p.name);
    mkdirSync(to);
    const { code, output } = await capture('tar', ['-xzf', p.tarball, '-C', to, '--strip-components=1']);
    if (code !== 0) throw new TaskError(`${p.tarball} cannot be unpacked: ${output.trim()}`);
    const manifest = JSON.parse(readFileSync(join(to, 'package.json'), 'utf8'));
    for (const name of Object.keys(manifest.dependencies ?? {})) {
      if (name.startsWith('@glanz/')) continue;
      const link = join(to, 'node_modules', name);
      mkdirSync(dirname(link), { recursive: true });
      symlinkSync(realpathSync(join(p.dir, 'node_modules', name)), link, 'junction');
    }
    // A binding to a library is of no use without it, nor are its declarations without the library's: those that the
    // package cannot do without, and those that entries of it bind to.
    const needed = Object.keys(manifest.peerDependencies ?? {}).filter(
      (name) => !manifest.peerDependenciesMeta?.[name]?.optional || p.manifest.glanz?.bindings?.includes(name),
    );
    for (const name of needed.flatMap((peer) => [peer, `@types/${peer}`])) {
      const link = join(to, 'node_modules', name);
      if (!existsSync(join(p.dir, 'node_modules', name))) continue;
      mkdirSync(dirname(link), { recursive: true });
      symlinkSync(realpathSync(join(p.dir, 'node_modules', name)), link, 'junction');
    }
    packages.push({ ...p, manifest });
  }
  const types = join(folder, 'node_modules', '@webgpu');
  mkdirSync(types);
  symlinkSync(realpathSync(join(root, 'node_modules/@webgpu/types')), join(types, 'types'), 'junction');
  return { folder, packages };
}
