// The official linker of WESL and ours agree: each shader source, linked by both under many sets of flags, has the same
// declarations, token by token. So the dialect cannot drift from the language that editors and other tools know.
import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { basename, dirname, join, relative, resolve, sep } from 'node:path';
import { link } from 'wesl';
import { describe, expect, it } from 'vitest';
import { requiredFeatures } from '../../../packages/openpbr/src/wgsl/features';
import { LOBES } from '../../../packages/openpbr/test/lobes';
import { compose, wgslModule, type WgslModule } from '../../../packages/wgsl/src/index';
import { wgslDeclarations } from '../../bench/src/hashes/digest';
import { isHost, parseWesl } from '../wesl.mjs';

type Flags = Readonly<Record<string, boolean>>;

const root = resolve(import.meta.dirname, '../../..');

/** The `src` folder of a file. */
const sourceOf = (file: string) => file.slice(0, file.indexOf(`${sep}src${sep}`) + 4);

/** What the official linker is given: texts by their paths from the `src` folder. */
type Sources = Record<string, string>;

const key = (file: string) => `./${relative(sourceOf(file), file).split(sep).join('/')}`;

/** Literals of the numbers that shaders import from TypeScript. */
const numbers = new Map<string, string>();

/** What files of TypeScript make for shaders: the modules of each, by the names that are imported. */
const made = new Map<string, Map<string, WgslModule>>();

const translated = new Map<WgslModule, WgslModule>();

/** A module that TypeScript makes, in WESL: gates in it hold members of structs. */
function inWesl(module: WgslModule): WgslModule {
  const known = translated.get(module);
  if (known) return known;
  const code = module.code.replace(/\/\/#if (\w+)\n *(.*)\n\/\/#endif/g, '  @if($1) $2');
  const result = { ...module, code, deps: module.deps.map((dep) => inWesl('flag' in dep ? dep.module : dep)) };
  translated.set(module, result);
  return result;
}

/** A file with all that it imports; modules that TypeScript makes are given as the text that they compose to. */
async function collect(file: string, sources: Sources = {}): Promise<Sources> {
  if (sources[key(file)] !== undefined) return sources;
  const text = (sources[key(file)] = readFileSync(file, 'utf8'));
  for (const { path, name } of parseWesl(text, file).imports) {
    const target = resolve(path[0] === 'package' ? sourceOf(file) : dirname(file), ...path.slice(1));
    if (existsSync(`${target}.wesl`)) {
      await collect(`${target}.wesl`, sources);
      continue;
    }
    const typescript = join(dirname(target), `${basename(target).replaceAll('_', '-')}.ts`);
    const value = ((await import(/* @vite-ignore */ typescript)) as Record<string, WgslModule | number>)[name]!;
    const modules = made.get(typescript) ?? new Map<string, WgslModule>();
    made.set(typescript, modules);
    if (typeof value === 'number') numbers.set(name, `${value}u`);
    if (!modules.has(name))
      modules.set(name, typeof value === 'number' ? wgslModule(name, `const ${name} = ${value}u;`) : value);
    sources[key(`${target}.wesl`)] = compose([...modules.values()].map(inWesl)).code;
  }
  return sources;
}

/** Names of the flags in these texts. */
const flagsOf = (sources: Sources) =>
  [
    ...new Set(
      Object.values(sources).flatMap((text) =>
        [...text.matchAll(/@(?:if|elif)\(([^)]*)\)/g)].flatMap(([, condition]) => condition!.match(/\w+/g)!),
      ),
    ),
  ].sort();

/** What materials ask for: flags of OpenPBR depend on each other. Steps of the golden ratio choose 400 of them. */
const materials: Flags[] = Array.from({ length: 400 }, (_, i) => {
  const chance = (j: number) => ((i * 0.618034 + j * 0.754878 + i * j * 0.56984) * 7) % 1;
  const chosen = Object.entries(LOBES).flatMap(([name, values], j) =>
    i > 0 && chance(j) < 0.4 ? [[name, values[(i >> 3) % values.length]]] : [],
  );
  return {
    ...requiredFeatures([{ ...Object.fromEntries(chosen), thin_film_thickness: 0.5 }], {
      multipleScattering: i % 5 !== 4,
    }),
  };
});

/** How many sets of those that materials ask for are linked: with GLANZ_FULL as many as there are, up to this. */
const MOST = process.env['GLANZ_FULL'] === undefined ? 30 : 100;

/**
 * Those that materials ask for, or all sets of flags where they are few, else none, all, each alone and without each.
 */
function flagSets(names: readonly string[]): Flags[] {
  if (names.length > 0 && names.every((name) => name.startsWith('OPENPBR_'))) {
    const sets = materials.map((flags) => Object.fromEntries(names.map((name) => [name, flags[name] ?? false])));
    return [...new Map(sets.map((flags) => [JSON.stringify(flags), flags])).values()].slice(0, MOST);
  }
  const set = (isOn: (index: number) => boolean): Flags =>
    Object.fromEntries(names.map((name, index) => [name, isOn(index)]));
  if (names.length <= 6)
    return Array.from({ length: 2 ** names.length }, (_, bits) => set((index) => ((bits >> index) & 1) === 1));
  return [
    set(() => false),
    set(() => true),
    ...names.flatMap((_, at) => [set((index) => index === at), set((index) => index !== at)]),
  ];
}

/** Declarations by name. */
function byName(code: string): Map<string, string> {
  return new Map(
    wgslDeclarations(code).map((declaration) => {
      const name = /^(?:@ \w+ (?:\( [^)]*\) )?)*(?:fn|struct|const|override|alias|var(?: < [^>]* >)?) (\w+)/.exec(
        declaration,
      )?.[1];
      // Directives have none.
      if (name === undefined && /^enable \w+ ;$/.test(declaration)) return [declaration, declaration];
      if (name === undefined) throw new Error(`This declaration has no name: ${declaration.slice(0, 80)}`);
      // The official linker writes no comma after the last of a list.
      return [name, declaration.replace(/ ,(?= [)\]}])/g, '')];
    }),
  );
}

const files = readdirSync(join(root, 'packages'))
  .flatMap((name) =>
    readdirSync(join(root, 'packages', name, 'src'), { recursive: true, encoding: 'utf8' }).map((path) =>
      join(root, 'packages', name, 'src', path),
    ),
  )
  .filter((file) => file.endsWith('.wesl') && !isHost([basename(file, '.wesl')]))
  .sort();

it('materials switch each flag of OpenPBR on and off within the sets that are linked', () => {
  const names = Object.keys(materials[0]!);
  const sets = flagSets(names);
  const on = names.filter((name) => materials.some((flags) => flags[name]));
  const off = names.filter((name) => materials.some((flags) => !flags[name]));
  expect(on.length).toBeGreaterThan(10);
  expect(on.filter((name) => !sets.some((flags) => flags[name]))).toEqual([]);
  expect(off.filter((name) => !sets.some((flags) => !flags[name]))).toEqual([]);
});

it('there are shader sources', () => {
  expect(files.length).toBeGreaterThan(10);
});

describe.each(files.map((file) => ({ name: relative(root, file), file })))('$name', ({ file }) => {
  it('is the same by both linkers, under every set of flags', async () => {
    const sources = await collect(file);
    const module = ((await import(/* @vite-ignore */ file)) as { default: WgslModule }).default;
    const supplied = new Set(
      Object.entries(sources).flatMap(([path, text]) =>
        isHost([basename(path, '.wesl')]) ? [...byName(text.replace(/^import .*;$/gm, '')).keys()] : [],
      ),
    );
    let links = 0;
    const linkOnce = async (weslSrc: Sources, conditions: Flags) =>
      byName((await link({ weslSrc, rootModuleName: key(file), conditions })).dest);
    /** The official linker looks for the types of members that are left out: it may have them then. */
    const linked = async (from: Sources, flags: Flags) => {
      try {
        return await linkOnce(from, flags);
      } catch {
        return linkOnce(
          Object.fromEntries(
            Object.entries(from).map(([path, text]) => [path, text.replace(/^@if\([^)]*\) import/gm, 'import')]),
          ),
          flags,
        );
      }
    };
    for (const flags of flagSets(flagsOf(sources))) {
      const ours = byName(compose([module], { flags }).code);
      let official: Map<string, string>;
      try {
        official = await linked(sources, flags);
        links++;
      } catch (error) {
        // Flags that exclude each other, or ask for each other: the program lacks a name by our linker too.
        const missing = /(?:unresolved identifier|no exported) '(\w+)'/.exec(String(error))?.[1];
        expect(missing, String(error)).toBeDefined();
        expect(ours.has(missing!), `${missing} under ${JSON.stringify(flags)}`).toBe(false);
        continue;
      }
      official = withNumbers(official);
      // Without what the host supplies, unless the program has its own under these flags.
      for (const name of supplied) if (!ours.has(name)) official.delete(name);
      const own = byName(compose([{ ...module, deps: [] }], { flags }).code);
      for (const [name, declaration] of own)
        expect(official.get(name), `${name} under ${JSON.stringify(flags)}`).toBe(declaration);
      const reached = reachable(own.keys(), ours);
      for (const [name, declaration] of official) {
        if (ours.has(name)) expect(declaration, `${name} under ${JSON.stringify(flags)}`).toBe(ours.get(name));
      }
      // What the file's own declarations need is in both.
      expect(
        [...reached].filter((name) => !official.has(name)),
        JSON.stringify(flags),
      ).toEqual([]);
    }
    expect(links).toBeGreaterThan(0);
  });
});

/** With the literals that our linker writes for TypeScript's numbers, and without their declarations. */
const withNumbers = (declarations: ReadonlyMap<string, string>): Map<string, string> =>
  new Map(
    [...declarations]
      .filter(([name]) => !numbers.has(name))
      .map(([name, text]) => [name, text.replace(/\w+/g, (word) => numbers.get(word) ?? word)]),
  );

/** Names that some declarations need, directly or not. */
function reachable(from: Iterable<string>, declarations: ReadonlyMap<string, string>): Set<string> {
  const found = new Set<string>();
  const visit = (name: string) => {
    const declaration = declarations.get(name);
    if (found.has(name) || declaration === undefined) return;
    found.add(name);
    // A member may have the name of a function.
    for (const token of declaration.replace(/\. \w+/g, '').split(' ')) visit(token);
  };
  for (const name of from) visit(name);
  return found;
}
