// node tools/check-published.mjs — what the registry would get: publint and attw on the tarballs, and the declarations
// as consumers see them, with every module resolution that can read an export map, and the directives that frameworks
// read.
import { copyFileSync, cpSync, existsSync, readFileSync, readdirSync, realpathSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join, relative } from 'node:path';
import { pathToFileURL } from 'node:url';
import { bin, root } from './pipeline/process.mjs';
import { installPacked } from './pipeline/packed.mjs';
import { Verdicts, runAlone } from './pipeline/report.mjs';
import { entriesOf } from './pipeline/workspace.mjs';

async function lintPackage(p, verdicts) {
  const { publint } = await import('publint');
  const { formatMessage } = await import('publint/utils');
  const bytes = readFileSync(p.tarball);
  const { messages } = await publint({
    level: 'warning',
    pack: { tarball: bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength) },
  });
  verdicts.expect(
    messages.length === 0,
    `publint ${p.name}: ${messages.map((message) => formatMessage(message, p.manifest)).join('; ')}`,
  );
}

/** What "are the types wrong" is not asked, as in its command's profile "esm-only": by whom ESM is read as CommonJS. */
const NOT_ESM = ['node10', 'node16-cjs'];

/** In this process: for each package the command would load the compiler again. */
async function checkTypesResolve(p, verdicts) {
  const command = realpathSync(bin('@arethetypeswrong/cli', 'package.json'));
  const core = createRequire(command).resolve('@arethetypeswrong/core');
  const { checkPackage, createPackageFromTarballData } = await import(pathToFileURL(core).href);
  const analysis = await checkPackage(createPackageFromTarballData(new Uint8Array(readFileSync(p.tarball))));
  const problems = (analysis.types ? analysis.problems : []).filter(
    ({ resolutionKind }) => !NOT_ESM.includes(resolutionKind),
  );
  verdicts.expect(
    problems.length === 0,
    `attw ${p.name}:\n${problems.map((problem) => JSON.stringify(problem)).join('\n')}`,
  );
}

/**
 * Imports every entry from a consumer's file and checks all declarations of ours, not only what the consumer uses.
 * @param {{ name: string, module: string, resolution: string, types: string[] }} variant
 */
async function checkConsumer(variant, { folder, packages }, verdicts) {
  const specifiers = packages.flatMap((p) => entriesOf(p).map(({ specifier }) => specifier));
  const file = join(folder, `consumer-${variant.name}.mts`);
  writeFileSync(
    file,
    `${specifiers.map((specifier, i) => `import * as entry${i} from '${specifier}';`).join('\n')}\nexport const entries: object[] = [${specifiers.map((_, i) => `entry${i}`).join(', ')}];\n`,
  );
  await compile(variant, [file], folder, verdicts, `${specifiers.length} entries`);
}

/** Compiles what consumers write, `tools/consumers`, against the packed declarations. */
async function checkSnippets(variant, files, { folder }, verdicts) {
  const copies = files.map((file) => join(folder, `${variant.name}-${file}`));
  files.forEach((file, i) => copyFileSync(join(root, 'tools', 'consumers', file), copies[i]));
  await compile(variant, copies, folder, verdicts, files.join(', '));
}

/**
 * Compiles the projects that `npm create glanz` makes against the packed declarations, but for the one of Next.js, which is not
 * installed.
 */
async function checkTemplates(bundler, { folder }, verdicts) {
  const at = (path) => realpathSync(join(root, path));
  const paths = {
    react: [at('packages/react/node_modules/@types/react')],
    'react/*': [`${at('packages/react/node_modules/@types/react')}/*`],
    'react-dom/*': [`${at('packages/react/node_modules/@types/react-dom')}/*`],
    three: [at('packages/three/node_modules/@types/three')],
    'three/addons/*.js': [`${at('packages/three/node_modules/@types/three')}/examples/jsm/*`],
  };
  for (const name of ['vanilla', 'react', 'three', 'configurator']) {
    const to = join(folder, `template-${name}`);
    cpSync(join(folder, 'node_modules/create-glanz/templates', name, 'src'), to, { recursive: true });
    writeFileSync(join(to, 'styles.d.ts'), "declare module '*.css';\n");
    const files = readdirSync(to).filter((file) => /\.tsx?$/.test(file));
    await compile(
      // As their tsconfig.json has it.
      {
        ...bundler,
        name: `template-${name}`,
        options: { jsx: 'react-jsx', exactOptionalPropertyTypes: false, noUncheckedIndexedAccess: false, paths },
      },
      files.map((file) => join(to, file)),
      folder,
      verdicts,
      files.join(', '),
    );
  }
}

/** Declarations that a program before has parsed and bound, by what that depends on. */
const declarations = new Map();

/** A host whose programs share their declarations, as projects of an editor do: to parse them took most of the time. */
function sharingHost(ts, options) {
  const made = ts.createCompilerHost(options);
  const { getSourceFile } = made;
  made.getSourceFile = (fileName, settings, ...rest) => {
    if (!/\.d\.[cm]?ts$/.test(fileName)) return getSourceFile(fileName, settings, ...rest);
    const key = [options.moduleResolution, settings.impliedNodeFormat, fileName].join(' ');
    if (!declarations.has(key)) declarations.set(key, getSourceFile(fileName, settings, ...rest));
    return declarations.get(key);
  };
  return made;
}

async function compile(variant, files, folder, verdicts, what) {
  const { default: ts } = await import('typescript');
  const { options, errors } = ts.convertCompilerOptionsFromJson(
    {
      target: 'ES2022',
      module: variant.module,
      moduleResolution: variant.resolution,
      lib: ['ES2023', 'DOM'],
      types: variant.types,
      strict: true,
      exactOptionalPropertyTypes: true,
      noUncheckedIndexedAccess: true,
      verbatimModuleSyntax: true,
      skipLibCheck: false,
      noEmit: true,
      ...variant.options,
    },
    folder,
  );
  if (errors.length > 0) throw new Error(ts.formatDiagnostics(errors, host(ts, folder)));
  const program = ts.createProgram(files, options, sharingHost(ts, options));
  // TypeScript's own DOM declarations and @webgpu/types overlap; only what is ours is judged.
  const ours = program
    .getSourceFiles()
    .filter(
      ({ fileName }) =>
        fileName.startsWith(folder) &&
        !/node_modules\/(?!(?:@glanz\/[^/]+|create-glanz)\/dist\/)/.test(fileName.slice(folder.length)),
    );
  const diagnostics = ours.flatMap((source) => [
    ...program.getSyntacticDiagnostics(source),
    ...program.getSemanticDiagnostics(source),
  ]);
  verdicts.expect(
    diagnostics.length === 0,
    `declarations under ${variant.name}:\n${ts.formatDiagnostics(diagnostics, host(ts, folder)).trim()}`,
  );
  verdicts.table.push(`declarations, ${variant.name}: ${what}, ${ours.length} files, ${diagnostics.length} errors`);
}

const host = (ts, folder) => ({
  getCanonicalFileName: (name) => relative(folder, name),
  getCurrentDirectory: () => folder,
  getNewLine: () => ts.sys.newLine,
});

/** `text` without the blank space and comments that it begins with. */
const pastComments = (text) => text.replace(/^(?:\s+|\/\/.*|\/\*[\s\S]*?\*\/)+/, '');

/**
 * Under server components, files with hooks say that they belong to the client: `'use client'`, before any other
 * statement. Without it `next build` fails with "useRef is not a function".
 */
function checkDirectives(p, { folder }, verdicts) {
  if (!p.manifest.peerDependencies?.react) return;
  for (const { specifier, conditions } of entriesOf(p)) {
    const file = join(folder, 'node_modules', p.name, conditions.default);
    const text = readFileSync(file, 'utf8');
    // Where React is an optional peer, entries without it run on servers too.
    if (p.manifest.peerDependenciesMeta?.react?.optional && !/from\s*['"]react['"]/.test(text)) continue;
    const starts = /^(['"])use client\1\s*;/.test(pastComments(text));
    verdicts.expect(starts, `${specifier}: ${relative(folder, file)} does not begin with 'use client'.`);
  }
}

/** Where a package says whose files it has, if not in licenses/NOTICE.txt. */
const LICENCES = { 'denoise-weights': 'weights/ORIGIN.md' };

/** The files that every tarball has, and source maps that lead to sources inside the package alone. */
function checkFiles(p, { folder }, verdicts) {
  const dir = join(folder, 'node_modules', p.name);
  for (const file of ['README.md', 'LICENSE', 'CHANGELOG.md'])
    verdicts.expect(existsSync(join(dir, file)), `${p.name}: the tarball has no ${file}.`);
  // Decoders and weights of others, which are under other licences.
  const others = readdirSync(dir, { recursive: true }).filter(
    (file) => !file.startsWith('node_modules') && /\.(wasm|tza)$|[/.](draco|basis)[.-]\w+\.js$/.test(file),
  );
  const said =
    /Apache-2\.0/.test(p.manifest.license) && existsSync(join(dir, LICENCES[p.short] ?? 'licenses/NOTICE.txt'));
  verdicts.expect(
    others.length === 0 || said,
    `${p.name}: the tarball has ${others[0]}, and neither "license" nor licenses/NOTICE.txt says whose it is.`,
  );
  for (const { specifier, conditions } of entriesOf(p)) {
    const map = join(dir, `${conditions.default}.map`);
    if (!verdicts.expect(existsSync(map), `${specifier}: the tarball has no source map of ${conditions.default}.`))
      continue;
    const { sources, sourcesContent } = JSON.parse(readFileSync(map, 'utf8'));
    const outside = sources.filter(
      (source, i) => !source.startsWith('../src/') || typeof sourcesContent?.[i] !== 'string',
    );
    verdicts.expect(
      outside.length === 0,
      `${specifier}: its source map names ${outside.slice(0, 3).join(', ')}, which is not in it.`,
    );
  }
  // Who installs the package must install its peers: only what it imports may be one.
  const texts = entriesOf(p).map(({ conditions }) => readFileSync(join(dir, conditions.default), 'utf8'));
  for (const peer of Object.keys(p.manifest.peerDependencies ?? {})) {
    if (p.manifest.peerDependenciesMeta?.[peer]?.optional) continue;
    verdicts.expect(
      texts.some((text) => text.includes(`"${peer}"`) || text.includes(`'${peer}'`)),
      `${p.name}: the peer ${peer} is required, and no entry imports it.`,
    );
  }
  for (const field of ['unpkg', 'jsdelivr']) {
    const file = p.manifest[field];
    if (file === undefined) continue;
    // It stands alone: what it imports lies beside it.
    const text = existsSync(join(dir, file)) ? readFileSync(join(dir, file), 'utf8') : undefined;
    const lost = [...(text ?? '').matchAll(/(?:from|import\()\s*"([^"]+)"/g)]
      .map(([, path]) => path)
      .filter((path) => !existsSync(join(dir, dirname(file), path)) && !path.startsWith('node:'));
    verdicts.expect(
      text !== undefined && lost.length === 0,
      `${p.name}: "${field}" names ${file}, which ${text === undefined ? 'the tarball lacks' : `imports ${lost.join(', ')}`}.`,
    );
  }
  const { customElements } = p.manifest;
  if (customElements === undefined) return;
  const [module] = JSON.parse(readFileSync(join(dir, customElements), 'utf8')).modules;
  verdicts.expect(
    existsSync(join(dir, module.path)),
    `${p.name}: ${customElements} names ${module.path}, which the tarball lacks.`,
  );
  verdicts.expect(module.declarations[0].attributes.length > 20, `${p.name}: ${customElements} lists no attributes.`);
}

/**
 * A page that imports the address of an archive of weights has that archive in its output, and no other: Vite copies what
 * the files that it reads name, whether the page uses it or not.
 */
async function checkWeightFiles(p, { folder }, verdicts) {
  if (p.name !== '@glanz/denoise-weights') return;
  const { build } = await import('vite');
  const emitted = [];
  for (const { path, specifier } of entriesOf(p)) {
    if (path === '.' || path === './node') continue;
    const page = join(folder, 'weights.js');
    writeFileSync(
      page,
      `import * as weights from '${specifier}';\nfor (const url of Object.values(weights)) console.log(url().href);\n`,
    );
    const { output } = await build({
      root: folder,
      configFile: false,
      logLevel: 'silent',
      build: { write: false, rollupOptions: { input: page } },
    });
    const files = output.flatMap(({ fileName, names }) => (fileName.endsWith('.tza') ? names : []));
    const one = path.startsWith('./rt_') ? [`${path.slice(2)}.tza`] : undefined;
    verdicts.expect(
      one ? String(files) === String(one) : files.length === (path === './large' ? 3 : 1),
      `${specifier}: Vite emits ${files.join(', ') || 'no archive'}.`,
    );
    emitted.push(...files);
  }
  const archives = readdirSync(join(folder, 'node_modules', p.name, 'weights')).filter((name) => name.endsWith('.tza'));
  verdicts.expect(
    String(emitted.sort()) === String(archives.sort()),
    `${p.name}: its entries lead to ${emitted.length} archives, and it has ${archives.length}.`,
  );
  verdicts.table.push(`Vite, ${p.name}: ${emitted.length} archives, each with an entry that emits no other but /large`);
}

export async function checkPublished() {
  const verdicts = new Verdicts();
  const consumer = await installPacked();
  for (const p of consumer.packages) {
    await lintPackage(p, verdicts);
    await checkTypesResolve(p, verdicts);
    checkFiles(p, consumer, verdicts);
    checkDirectives(p, consumer, verdicts);
    await checkWeightFiles(p, consumer, verdicts);
  }
  await checkConsumer(
    { name: 'nodenext', module: 'NodeNext', resolution: 'NodeNext', types: ['@webgpu/types'] },
    consumer,
    verdicts,
  );
  await checkConsumer(
    { name: 'bundler', module: 'ESNext', resolution: 'Bundler', types: ['@webgpu/types'] },
    consumer,
    verdicts,
  );
  // The WebGPU types that TypeScript 6 brings itself must do as well.
  await checkConsumer(
    { name: 'bundler-without-webgpu-types', module: 'ESNext', resolution: 'Bundler', types: [] },
    consumer,
    verdicts,
  );
  const bundler = { module: 'ESNext', resolution: 'Bundler', types: ['@webgpu/types'] };
  await checkSnippets({ ...bundler, name: 'element' }, ['element.mts'], consumer, verdicts);
  for (const [name, types] of [
    ['react-18', '@types/react-18'],
    ['react-19', '@types/react'],
  ]) {
    // Of @glanz/react's own file too: a project has one version.
    const at = realpathSync(join(root, 'packages/react/node_modules', types));
    await checkSnippets(
      { ...bundler, name, options: { jsx: 'react-jsx', paths: { react: [at], 'react/*': [`${at}/*`] } } },
      ['react.tsx'],
      consumer,
      verdicts,
    );
  }
  await checkTemplates(bundler, consumer, verdicts);
  return verdicts;
}

await runAlone(import.meta, checkPublished);
