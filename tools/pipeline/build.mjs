import { createHash } from 'node:crypto';
import { existsSync, mkdirSync, readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { join, relative } from 'node:path';
import { errorsPage } from './manifest.mjs';
import { TaskError, bin, capture, root } from './process.mjs';
import { privateNames } from './wesl-private.mjs';
import { entriesOf, internalDependencies, publishedPackages, topological } from './workspace.mjs';

const cache = join(root, '.cache', 'build');

/** All files under a folder, sorted. */
function filesUnder(folder) {
  return readdirSync(folder, { recursive: true, withFileTypes: true })
    .filter((entry) => entry.isFile())
    .map((entry) => join(entry.parentPath ?? entry.path, entry.name))
    .sort();
}

const rootManifest = JSON.parse(readFileSync(join(root, 'package.json'), 'utf8'));

/**
 * A hash of all that a package's build reads; contents, not times, so that a fresh clone or a changed branch is judged
 * right.
 */
function fingerprint(p, dependencies) {
  const hash = createHash('sha256');
  const scripts = join(p.dir, 'scripts');
  const inputs = [
    ...filesUnder(join(p.dir, 'src')),
    ...(existsSync(scripts) ? filesUnder(scripts) : []),
    join(p.dir, 'package.json'),
    join(p.dir, 'tsup.config.ts'),
    join(root, 'tsup.base.ts'),
    join(root, 'tools/pipeline/declarations.mjs'),
    join(root, 'tools/pipeline/published-source.mjs'),
    join(root, 'tools/pipeline/wesl.mjs'),
    join(root, 'tools/pipeline/wesl-constants.mjs'),
    join(root, 'tools/pipeline/wesl-names.mjs'),
    join(root, 'tools/pipeline/wesl-parse.mjs'),
    join(root, 'tools/pipeline/wesl-private.mjs'),
    join(root, 'tools/pipeline/wesl-tokens.mjs'),
    join(root, 'tsconfig.base.json'),
    join(root, 'pnpm-lock.yaml'),
  ];
  // The command brings the playground along.
  const playground = join(root, 'apps/playground');
  if (p.short === 'cli' && existsSync(playground))
    inputs.push(
      ...filesUnder(join(playground, 'src')),
      join(playground, 'index.html'),
      join(playground, 'vite.config.ts'),
    );
  // The element brings a sample model along, made by the tools.
  if (p.short === 'element') inputs.push(...filesUnder(join(root, 'tools/models/src')));
  for (const file of inputs) {
    if (existsSync(file)) hash.update(relative(root, file)).update('\0').update(readFileSync(file)).update('\0');
  }
  hash.update(errorsPage(rootManifest) ?? '');
  hash.update(privateNames(p.dir));
  for (const dependency of dependencies) hash.update(dependency);
  return hash.digest('hex');
}

const stampOf = (p) => join(cache, `${p.short}.sha256`);

function isBuilt(p, print) {
  if (!existsSync(stampOf(p)) || readFileSync(stampOf(p), 'utf8') !== print) return false;
  const files = [
    ...entriesOf(p).flatMap(({ conditions }) => [conditions.types, conditions.default]),
    ...Object.values(p.manifest.bin ?? {}),
    // Folders beside dist that the build fills.
    ...(p.manifest.files ?? []),
  ];
  return files.every((file) => typeof file !== 'string' || existsSync(join(p.dir, file)));
}

/** One build at a time in a checkout: two would empty each other's dist. */
async function withLock(task) {
  const lock = join(root, '.cache', 'build.lock');
  const deadline = Date.now() + 600_000;
  mkdirSync(join(root, '.cache'), { recursive: true });
  for (;;) {
    try {
      writeFileSync(lock, String(process.pid), { flag: 'wx' });
      break;
    } catch (error) {
      if (error.code !== 'EEXIST') throw error;
      const owner = existsSync(lock) ? Number(readFileSync(lock, 'utf8')) : 0;
      if (owner > 0 && !isAlive(owner)) rmSync(lock, { force: true });
      else if (Date.now() > deadline)
        throw new TaskError(
          `another build (process ${owner}) holds .cache/build.lock for ten minutes; delete that file if it is stale.`,
        );
      else await new Promise((resolve) => setTimeout(resolve, 200));
    }
  }
  try {
    return await task();
  } finally {
    rmSync(lock, { force: true });
  }
}

function isAlive(pid) {
  try {
    process.kill(pid, 0);
    return true;
  } catch (error) {
    return error.code === 'EPERM';
  }
}

/**
 * Builds the published packages whose sources changed, dependencies first, two at a time.
 *
 * @param {{ only?: string[], force?: boolean, log?: (line: string) => void }} options `only`: short names; what they
 * depend on is built too.
 * @returns {Promise<{ built: string[], fresh: string[] }>} short names.
 */
export function ensureBuilt({ only, force = false, log = (line) => process.stderr.write(`${line}\n`) } = {}) {
  return withLock(async () => {
    const order = topological(publishedPackages());
    const requested = new Set(only ?? order.map((p) => p.short));
    for (const p of [...order].reverse())
      if (requested.has(p.short))
        for (const name of internalDependencies(p)) requested.add(name.slice('@glanz/'.length));
    const packages = order.filter((p) => requested.has(p.short));
    const prints = new Map();
    for (const p of packages)
      prints.set(
        p.name,
        fingerprint(
          p,
          internalDependencies(p).map((name) => prints.get(name)),
        ),
      );

    const built = [];
    const fresh = [];
    const running = new Map();
    const build = async (p) => {
      // Declarations are bundled against those of the packages it needs.
      await Promise.all(internalDependencies(p).map((name) => running.get(name)));
      const print = prints.get(p.name);
      if (!force && isBuilt(p, print)) return void fresh.push(p.short);
      const from = performance.now();
      rmSync(stampOf(p), { force: true });
      const { code, output } = await limited(() =>
        capture(process.execPath, [bin('tsup', 'dist/cli-default.js')], { cwd: p.dir }),
      );
      if (code !== 0) throw new TaskError(`the build of ${p.name} failed:\n${output.trim()}`);
      mkdirSync(cache, { recursive: true });
      writeFileSync(stampOf(p), print);
      built.push(p.short);
      log(`built ${p.name} in ${((performance.now() - from) / 1000).toFixed(1)} s`);
    };
    for (const p of packages) running.set(p.name, build(p));
    const results = await Promise.allSettled(running.values());
    const failure = results.find((result) => result.status === 'rejected');
    if (failure) throw failure.reason;
    return { built, fresh };
  });
}

const AT_ONCE = 2;
let active = 0;
const waiting = [];

/** Runs at most {@link AT_ONCE} tasks at a time. */
async function limited(task) {
  while (active >= AT_ONCE) await new Promise((resolve) => waiting.push(resolve));
  active++;
  try {
    return await task();
  } finally {
    active--;
    waiting.shift()?.();
  }
}
