// The API reference: made by TypeDoc from the packages' sources into api/, again when a source has changed.
import { existsSync, mkdirSync, readFileSync, readdirSync, renameSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { dirname, join, relative, sep } from 'node:path';
import { fileURLToPath } from 'node:url';
import { Application, ReflectionKind, type DeclarationReflection, type TypeDocOptions } from 'typedoc';
import type { PluginOptions } from 'typedoc-plugin-markdown';

const docs = fileURLToPath(new URL('..', import.meta.url));
const root = join(docs, '../..');
const out = join(docs, 'api');
const stamp = join(out, '.stamp');

interface Entry {
  /** `scene/studio` for `@glanz/scene/studio`. */
  readonly name: string;
  /** What is imported, `@glanz/scene/studio`. */
  readonly specifier: string;
  readonly source: string;
}

/** One line of a sidebar. */
export interface ApiPage {
  readonly text: string;
  readonly link: string;
}

/** All entries of the published packages, from their export maps; each package's main one comes first. */
function readEntries(packages: readonly string[]): Entry[] {
  return packages.flatMap((name) => {
    const folder = join(root, 'packages', name);
    const { name: published, exports } = JSON.parse(readFileSync(join(folder, 'package.json'), 'utf8')) as {
      name: string;
      exports: Record<string, string | Record<string, string>>;
    };
    return Object.entries(exports).flatMap(([path, target]) => {
      const source = typeof target === 'object' ? target['@glanz/source'] : undefined;
      const rest = path.slice(1);
      return source ? [{ name: `${name}${rest}`, specifier: `${published}${rest}`, source: join(folder, source) }] : [];
    });
  });
}

function newest(folder: string): number {
  return Math.max(
    0,
    ...readdirSync(folder, { withFileTypes: true }).map((entry) =>
      entry.isDirectory() ? newest(join(folder, entry.name)) : statSync(join(folder, entry.name)).mtimeMs,
    ),
  );
}

/** Makes the reference if it is missing or stale, and lists its pages. */
export async function apiReference(packages: readonly string[]): Promise<ApiPage[]> {
  const entries = readEntries(packages);
  const state = JSON.stringify([
    entries,
    ...packages.map((name) => newest(join(root, 'packages', name, 'src'))),
    statSync(fileURLToPath(import.meta.url)).size,
  ]);
  if (existsSync(stamp)) {
    const made = JSON.parse(readFileSync(stamp, 'utf8')) as { state: string; pages: ApiPage[] };
    if (made.state === state) return made.pages;
  }
  rmSync(out, { recursive: true, force: true });
  mkdirSync(out, { recursive: true });
  const pages = await generate(entries);
  writeFileSync(stamp, JSON.stringify({ state, pages }));
  return pages;
}

async function generate(entries: readonly Entry[]): Promise<ApiPage[]> {
  const options = {
    name: 'API reference',
    entryPoints: entries.map(({ source }) => source),
    tsconfig: join(root, 'tsconfig.base.json'),
    plugin: ['typedoc-plugin-markdown'],
    readme: 'none',
    out,
    entryFileName: 'index',
    modulesFileName: 'index',
    outputFileStrategy: 'modules',
    pageTitleTemplates: {
      module: ({ name }: { name: string }) => entries.find((entry) => entry.name === name)?.specifier ?? name,
    },
    // A symbol is documented under the first entry that exports it: the package's main one.
    sortEntryPoints: false,
    useCodeBlocks: true,
    parametersFormat: 'table',
    interfacePropertiesFormat: 'table',
    classPropertiesFormat: 'table',
    typeDeclarationFormat: 'table',
    hidePageHeader: true,
    hideBreadcrumbs: true,
    disableSources: true,
    excludeInternal: true,
    excludePrivate: true,
    skipErrorChecking: true,
    logLevel: 'Error',
  } as unknown as TypeDocOptions & PluginOptions;
  const app = await Application.bootstrapWithPlugins(options);
  const project = await app.convert();
  if (!project) throw new Error('TypeDoc could not read the packages.');
  const names = new Map(
    entries.map(({ name, source }) => [relative(join(root, 'packages'), source).replace(/(\/index)?\.ts$/, ''), name]),
  );
  for (const module of project.children?.slice() ?? []) {
    module.name = names.get(module.name) ?? module.name;
    // Entries that only narrow a package's main one have nothing of their own to document.
    if ((module.children ?? []).every((child) => child.kind === ReflectionKind.Reference))
      project.removeReflection(module);
  }
  for (const module of project.children ?? []) {
    const source = entries.find(({ name }) => name === module.name)?.source;
    if (source) sortByExports(module, readFileSync(source, 'utf8'));
  }
  const kept = new Set((project.children ?? []).map(({ name }) => name));
  await app.generateOutputs(project);
  nameModules(kept);
  fixAnchors();
  return entries
    .filter(({ name }) => kept.has(name))
    .map(({ name, specifier }) => ({ text: specifier, link: `/api/${name}` }));
}

/** A page begins with what can be called, in the order in which its entry exports it; then errors, then types. */
function sortByExports(module: DeclarationReflection, source: string): void {
  const text = source.replace(/\/\*[\s\S]*?\*\//g, '');
  const values = new Map<string, number>();
  for (const [, list, name] of text.matchAll(
    /^export \{([^}]*)\}|^export (?:async )?(?:function|class|const) (\w+)/gm,
  )) {
    for (const item of name === undefined ? (list ?? '').split(',') : [name]) {
      if (!item.trim().startsWith('type ')) values.set(item.trim().split(/\s+/).at(-1) ?? '', values.size);
    }
  }
  const place = ({ name }: { readonly name: string }) =>
    (values.get(name) ?? 20_000) + (name.endsWith('Error') ? 10_000 : 0);
  const first = ({ children }: { readonly children: readonly { readonly name: string }[] }) =>
    Math.min(...children.map(place));
  module.groups?.sort((a, b) => first(a) - first(b));
  for (const group of module.groups ?? []) group.children.sort((a, b) => place(a) - place(b));
}

/**
 * TypeDoc numbers the page of a module whose name is that of a type but for its case, although types have no pages of
 * their own (`viewer/orbit` and `Orbit` of `viewer`): such pages lose the number, and so do links to them.
 */
function nameModules(names: ReadonlySet<string>): void {
  for (const name of names) {
    const page = join(out, `${name}.md`);
    const numbered = join(out, `${name}-1.md`);
    if (existsSync(page) || !existsSync(numbered)) continue;
    renameSync(numbered, page);
    const [from, to] = [numbered, page].map((path) => path.split(sep).at(-1) as string);
    for (const path of readdirSync(out, { recursive: true, encoding: 'utf8' })) {
      if (!path.endsWith('.md')) continue;
      const text = readFileSync(join(out, path), 'utf8');
      const named = text.replaceAll(from as string, to as string);
      if (named !== text) writeFileSync(join(out, path), named);
    }
  }
}

/** The plugin numbers some anchors that need no number (type aliases beside a class): such links lose it. */
function fixAnchors(): void {
  const pages = new Map(
    readdirSync(out, { recursive: true, encoding: 'utf8' })
      .filter((path) => path.endsWith('.md'))
      .map((path) => [join(out, path), readFileSync(join(out, path), 'utf8')]),
  );
  const headings = (text: string) =>
    text.match(/^#+ .*$/gm)?.map((line) => line.replace(/^#+ /, '').replaceAll('\\', '').toLowerCase()) ?? [];
  for (const [file, text] of pages) {
    const fixed = text.replace(
      /\]\(([^()#\s]*)#([\w-]+)-(\d+)\)/g,
      (link, path: string, name: string, number: string) => {
        const target = pages.get(path ? join(dirname(file), path) : file);
        return target !== undefined && headings(target).filter((heading) => heading === name).length <= Number(number)
          ? `](${path}#${name})`
          : link;
      },
    );
    if (fixed !== text) writeFileSync(file, fixed);
  }
}
