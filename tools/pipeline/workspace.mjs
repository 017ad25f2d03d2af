import { existsSync, readFileSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import { root } from './process.mjs';

/**
 * One workspace package.
 * @typedef {{ name: string, short: string, group: 'packages' | 'apps' | 'tools', dir: string, manifest: any }} Package
 */

/** Every package of one group of folders, by name. @returns {Package[]} */
export function listPackages(group, base = root) {
  const folder = join(base, group);
  if (!existsSync(folder)) return [];
  return readdirSync(folder)
    .filter((short) => existsSync(join(folder, short, 'package.json')))
    .sort()
    .map((short) => {
      const dir = join(folder, short);
      const manifest = JSON.parse(readFileSync(join(dir, 'package.json'), 'utf8'));
      return { name: manifest.name, short, group, dir, manifest };
    });
}

/** Packages that run in Node alone, as a whole. */
export const NODE_PACKAGES = ['cli', 'farm', 'create-glanz'];

/** Packages without the scope, because npm looks for them by such a name: `npm create glanz`. */
const UNSCOPED = ['create-glanz'];

/** The name of the package in a folder of `packages`. */
export const packageName = (short) => (UNSCOPED.includes(short) ? short : `@glanz/${short}`);

/** The packages that are published. */
export const publishedPackages = (base = root) =>
  listPackages('packages', base).filter(({ manifest }) => !manifest.private);

/** Packages of the workspace that this one needs at run time. */
export const internalDependencies = ({ manifest }) =>
  Object.keys({ ...manifest.dependencies, ...manifest.peerDependencies }).filter((name) => name.startsWith('@glanz/'));

/** Dependencies first. @param {Package[]} packages */
export function topological(packages) {
  const byName = new Map(packages.map((p) => [p.name, p]));
  const done = new Set();
  const result = [];
  const visit = (p, path) => {
    if (done.has(p)) return;
    if (path.includes(p))
      throw new Error(`packages depend on each other in a circle: ${[...path, p].map((q) => q.short).join(' → ')}`);
    for (const name of internalDependencies(p)) {
      const dependency = byName.get(name);
      if (dependency) visit(dependency, [...path, p]);
    }
    done.add(p);
    result.push(p);
  };
  for (const p of packages) visit(p, []);
  return result;
}

/** The import paths of a package, e.g. `@glanz/bvh/cpu`, and what its export map says of each; package.json apart. */
export function entriesOf({ name, manifest }) {
  return Object.entries(manifest.exports ?? {})
    .filter(([path]) => path !== './package.json')
    .map(([path, conditions]) => ({ path, specifier: path === '.' ? name : `${name}/${path.slice(2)}`, conditions }));
}
