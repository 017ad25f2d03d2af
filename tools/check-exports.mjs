// node tools/check-exports.mjs — each package's manifest agrees with itself and with its build: the export map of the
// workspace, the one that is published, the entries that tsup builds, and the files that are there.
import { existsSync, mkdirSync, readdirSync, readFileSync, rmSync } from 'node:fs';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { root } from './pipeline/process.mjs';
import { Verdicts, runAlone } from './pipeline/report.mjs';
import { entriesOf, packageName, publishedPackages } from './pipeline/workspace.mjs';

/** The entries of a package's tsup.config.ts. */
async function tsupEntries(p) {
  const { build } = await import('esbuild');
  const folder = join(root, '.cache', 'tsup-config');
  mkdirSync(folder, { recursive: true });
  const outfile = join(folder, `${p.short}-${process.pid}.mjs`);
  try {
    await build({
      entryPoints: [join(p.dir, 'tsup.config.ts')],
      outfile,
      bundle: true,
      platform: 'node',
      format: 'esm',
      external: ['tsup', 'typescript', 'esbuild', 'vite'],
      logLevel: 'silent',
    });
    const { default: config } = await import(pathToFileURL(outfile).href);
    return (Array.isArray(config) ? config : [config]).reduce((all, { entry }) => ({ ...all, ...entry }), {});
  } finally {
    rmSync(outfile, { force: true });
  }
}

/** Files of a package's build that its sources run in threads, by `new URL('./NAME.js', import.meta.url)`. */
function threadsOf({ dir }) {
  const sources = readdirSync(join(dir, 'src'), { recursive: true }).filter((file) => file.endsWith('.ts'));
  const texts = sources.map((file) => readFileSync(join(dir, 'src', file), 'utf8')).join('\n');
  return [...texts.matchAll(/new URL\('\.\/([\w-]+)\.js', import\.meta\.url\)/g)].map(([, name]) => name);
}

/**
 * Everything that is wrong with one manifest.
 *
 * @param {Record<string, string>} built name → source, from tsup.
 * @param {readonly string[]} threads Names that need not be exported.
 */
export function manifestProblems({ name, short, manifest }, built, fileExists, threads = []) {
  const problems = [];
  const say = (message) => problems.push(`packages/${short}: ${message}`);
  const same = (a, b) => JSON.stringify(a) === JSON.stringify(b);
  const published = manifest.publishConfig?.exports ?? {};

  if (name !== packageName(short)) say(`is called ${name}, not ${packageName(short)}.`);
  for (const [key, value] of Object.entries({ type: 'module', license: manifest.glanz?.license ?? 'MIT' }))
    if (manifest[key] !== value) say(`"${key}" must be ${JSON.stringify(value)}.`);
  // Entries that do something when they are imported are named, file by file; nothing else may.
  const effects = manifest.sideEffects;
  const named = Object.values(manifest.exports ?? {}).flatMap((conditions) => [
    conditions['@glanz/source'],
    conditions.default,
  ]);
  if (effects !== false && !(Array.isArray(effects) && effects.every((file) => named.includes(file))))
    say('"sideEffects" must be false, or list entries that are for their effect alone.');
  if (!manifest.description) say('has no description.');
  if (!manifest.engines?.node) say('has no engines.node.');
  if (manifest.publishConfig?.access !== 'public') say('publishConfig.access must be "public".');
  if (!manifest.files?.includes('dist')) say('"files" must hold "dist".');
  if (!fileExists('README.md')) say('has no README.md.');
  if (manifest.exports?.['./package.json'] !== './package.json') say('does not export ./package.json.');
  if (!same(Object.keys(manifest.exports ?? {}), Object.keys(published)))
    say(
      `exports and publishConfig.exports differ in their paths: ${Object.keys(manifest.exports ?? {}).join(' ')} against ${Object.keys(published).join(' ')}.`,
    );

  const outputs = new Set();
  for (const [path, conditions] of Object.entries(manifest.exports ?? {})) {
    if (path === './package.json') continue;
    if (!same(Object.keys(conditions), ['@glanz/source', 'types', 'default'])) {
      say(`exports["${path}"] must have the conditions @glanz/source, types, default, in this order.`);
      continue;
    }
    const { '@glanz/source': source, types, default: file } = conditions;
    if (!same(published[path], { types, default: file }))
      say(`publishConfig.exports["${path}"] must be the workspace's without @glanz/source.`);
    const output = /^\.\/dist\/(.+)\.js$/.exec(file)?.[1];
    if (!output || types !== `./dist/${output}.d.ts`)
      say(`exports["${path}"] must name ./dist/x.d.ts and ./dist/x.js of one x.`);
    else {
      outputs.add(output);
      if (!built[output]) say(`tsup.config.ts does not build "${output}", which exports["${path}"] names.`);
      else if (`./${built[output]}` !== source)
        say(`exports["${path}"] has its source in ${source}, but tsup builds "${output}" from ${built[output]}.`);
    }
    if (!fileExists(source)) say(`exports["${path}"] names ${source}, which does not exist.`);
  }
  for (const [command, file] of Object.entries(manifest.bin ?? {})) {
    const output = /^\.\/dist\/(.+)\.js$/.exec(file)?.[1];
    if (!output || !built[output]) say(`bin.${command} names ${file}, which tsup does not build.`);
    else outputs.add(output);
  }
  for (const output of Object.keys(built))
    if (!outputs.has(output) && !threads.includes(output)) say(`tsup builds "${output}", which nothing exports.`);
  for (const [dependency, range] of Object.entries({ ...manifest.dependencies, ...manifest.peerDependencies })) {
    const peer = manifest.dependencies?.[dependency] === undefined;
    // Changesets publishes a major version where a peer leaves its range, which "^0.1.0" does at 0.2.0.
    const inside = peer ? /^workspace:>=\d/ : /^workspace:\^$/;
    if (dependency.startsWith('@glanz/') ? !inside.test(range) : range !== 'catalog:' && !/^([\^~]|>=)?\d/.test(range))
      say(`dependency ${dependency}: "${range}" (workspace:^ inside, workspace:>=… for a peer; catalog: outside).`);
  }
  // A binding to a library needs that library; all other peers are for those who want them.
  for (const peer of Object.keys(manifest.peerDependencies ?? {}))
    if (peer !== short && !peer.startsWith('@glanz/') && !manifest.peerDependenciesMeta?.[peer]?.optional)
      say(`the peer ${peer} must be optional.`);
  return problems;
}

export async function checkExports() {
  const verdicts = new Verdicts();
  for (const p of publishedPackages()) {
    const problems = manifestProblems(p, await tsupEntries(p), (file) => existsSync(join(p.dir, file)), threadsOf(p));
    verdicts.expect(problems.length === 0, problems.join('\n'));
  }
  verdicts.table.push(
    `${publishedPackages().length} packages, ${publishedPackages().flatMap(entriesOf).length} entries`,
  );
  return verdicts;
}

await runAlone(import.meta, checkExports);
