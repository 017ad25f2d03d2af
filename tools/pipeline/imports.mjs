// Reads the imports of TypeScript files and checks them against the rules of the repository.
import { existsSync, readFileSync, readdirSync } from 'node:fs';
import { builtinModules } from 'node:module';
import { dirname, join, relative, sep } from 'node:path';
import ts from 'typescript';
import { NODE_PACKAGES, entriesOf } from './workspace.mjs';

/**
 * What one package may import.
 * @typedef {{ typesOnly: boolean, errorOnly: boolean }} Arrow
 */

/**
 * Reads which package may import which from the table in ARCHITECTURE.md, so that the text and the check cannot drift apart.
 * @param {string} markdown
 * @returns {Map<string, Map<string, Arrow>>} package → what it may import
 */
export function readArrows(markdown) {
  const arrows = new Map();
  for (const line of markdown.split('\n')) {
    const cells = line.split('|').map((cell) => cell.trim());
    const name = /^`([a-z-]+)`$/.exec(cells[1] ?? '')?.[1];
    if (!name || cells.length < 5) continue;
    const may = cells[3];
    const row = new Map();
    if (/^every package above$/.test(may))
      for (const above of arrows.keys()) row.set(above, { typesOnly: false, errorOnly: false });
    else if (may !== 'nothing') {
      for (const [, target, note = ''] of may.matchAll(/`([a-z-]+)`(?: \(([^)]*)\))?/g))
        row.set(target, { typesOnly: note.includes('types only'), errorOnly: note.includes('GlanzError') });
    }
    arrows.set(name, row);
  }
  return arrows;
}

/** A chain of packages that leads back to its start, or undefined. @param {Map<string, Map<string, Arrow>>} arrows */
export function findArrowCycle(arrows) {
  return findCycle([...arrows.keys()], (name) => [...(arrows.get(name)?.keys() ?? [])]);
}

/** A path that ends where it begins, or undefined. */
export function findCycle(nodes, next) {
  const done = new Set();
  const path = [];
  const visit = (node) => {
    if (done.has(node)) return undefined;
    const at = path.indexOf(node);
    if (at >= 0) return [...path.slice(at), node];
    path.push(node);
    for (const other of next(node)) {
      const found = visit(other);
      if (found) return found;
    }
    path.pop();
    done.add(node);
    return undefined;
  };
  for (const node of nodes) {
    const found = visit(node);
    if (found) return found;
  }
  return undefined;
}

/**
 * Every module specifier in a file, with its line and whether only types come of it.
 * @returns {{ specifier: string, line: number, typeOnly: boolean }[]}
 */
export function readImports(text, fileName = 'file.ts') {
  const kind = /\.(mjs|js)$/.test(fileName) ? ts.ScriptKind.JS : ts.ScriptKind.TS;
  const source = ts.createSourceFile(fileName, text, ts.ScriptTarget.Latest, true, kind);
  const found = [];
  const add = (literal, typeOnly) => {
    if (literal && ts.isStringLiteralLike(literal))
      found.push({
        specifier: literal.text,
        line: source.getLineAndCharacterOfPosition(literal.getStart(source)).line + 1,
        typeOnly,
      });
  };
  const namedTypesOnly = (bindings) =>
    bindings !== undefined &&
    'elements' in bindings &&
    bindings.elements.length > 0 &&
    bindings.elements.every((element) => element.isTypeOnly);
  const visit = (node) => {
    if (ts.isImportDeclaration(node)) {
      const clause = node.importClause;
      add(
        node.moduleSpecifier,
        clause !== undefined &&
          (clause.isTypeOnly || (clause.name === undefined && namedTypesOnly(clause.namedBindings))),
      );
    } else if (ts.isExportDeclaration(node))
      add(node.moduleSpecifier, node.isTypeOnly || namedTypesOnly(node.exportClause));
    else if (ts.isImportTypeNode(node) && ts.isLiteralTypeNode(node.argument)) add(node.argument.literal, true);
    else if (
      ts.isCallExpression(node) &&
      (node.expression.kind === ts.SyntaxKind.ImportKeyword ||
        (ts.isIdentifier(node.expression) && node.expression.text === 'require'))
    )
      add(node.arguments[0], false);
    ts.forEachChild(node, visit);
  };
  visit(source);
  return found;
}

const builtins = new Set(builtinModules);
export const isBuiltin = (specifier) => specifier.startsWith('node:') || builtins.has(specifier);

/** `@scope/name` or `name` of a bare specifier. */
export const packageOf = (specifier) =>
  specifier
    .split('/')
    .slice(0, specifier.startsWith('@') ? 2 : 1)
    .join('/');

// What is in `templates` belongs to the projects that are made of it.
const SKIP = new Set(['node_modules', 'dist', 'out', '.cache', 'cache', 'api', '.gpu', 'templates']);

/** Source files under a folder. */
export function sourceFiles(folder, extensions = /\.(ts|mts|mjs|vue)$/) {
  if (!existsSync(folder)) return [];
  return readdirSync(folder, { withFileTypes: true })
    .flatMap((entry) => {
      const path = join(folder, entry.name);
      if (entry.isDirectory()) return SKIP.has(entry.name) ? [] : sourceFiles(path, extensions);
      return extensions.test(entry.name) && !entry.name.endsWith('.d.ts') ? [path] : [];
    })
    .sort();
}

/** The file that a relative import means, or undefined. */
export function resolveRelative(from, specifier) {
  const base = join(dirname(from), specifier);
  const candidates = [base, `${base}.ts`, `${base}.mts`, join(base, 'index.ts'), base.replace(/\.js$/, '.ts')];
  return candidates.find((path) => existsSync(path) && !readdirSafe(path));
}

const readdirSafe = (path) => {
  try {
    readdirSync(path);
    return true;
  } catch {
    return false;
  }
};

/** Text of a file, or of the scripts inside a Vue component with the line numbers kept. */
function scriptOf(path) {
  const text = readFileSync(path, 'utf8');
  if (!path.endsWith('.vue')) return text;
  let inside = false;
  return text
    .split('\n')
    .map((line) => {
      const edge = line.startsWith('<script') || line.startsWith('</script>');
      if (edge) inside = line.startsWith('<script');
      return inside && !edge ? line : '';
    })
    .join('\n');
}

/** What a WESL file imports of its own package. */
function weslImports(src, file) {
  return [...readFileSync(file, 'utf8').matchAll(/^\s*import package::([\w:]+)::/gm)].flatMap(([, path]) => {
    const base = join(src, ...path.split('::'));
    const target = [`${base}.wesl`, `${base}.ts`].find((candidate) => existsSync(candidate));
    return target ? [{ target, typeOnly: false }] : [];
  });
}

/**
 * A circle of folders, in words, or undefined. What lies in a folder of `src`, at any depth, counts as one; what lies in
 * `src` itself is entries and what joins the topics, and counts file by file.
 */
function findFolderCycle(src, graph) {
  const nodeOf = (file) => {
    const [first, ...rest] = relative(src, file).split(sep);
    return rest.length > 0 ? `${first}/` : first;
  };
  /** @type {Map<string, Map<string, string>>} node → node that it imports → the first import that shows it */
  const folders = new Map();
  for (const [file, edges] of graph) {
    const from = nodeOf(file);
    if (!folders.has(from)) folders.set(from, new Map());
    for (const { target } of edges) {
      const to = nodeOf(target);
      if (to !== from && !folders.get(from).has(to))
        folders.get(from).set(to, `${relative(src, file)} imports ${relative(src, target)}`);
    }
  }
  const cycle = findCycle([...folders.keys()], (node) => [...(folders.get(node)?.keys() ?? [])]);
  return cycle
    ?.slice(1)
    .map((node, i) => folders.get(cycle[i]).get(node))
    .join(', ');
}

/** Files that may use Node: the thin edge of a library, and packages that are for Node as a whole. */
const isNodeFile = (p, file) =>
  NODE_PACKAGES.includes(p.short) || /^src[\\/](node\.ts$|node[\\/]|.*\.node\.ts$)/.test(relative(p.dir, file));

/**
 * Checks one package.
 *
 * @param {import('./workspace.mjs').Package} p
 * @param {{ arrows: Map<string, Map<string, Arrow>>, all: Map<string, import('./workspace.mjs').Package>, rootManifest:
 * any, base: string }} repository
 * @returns {{ problems: string[], imports: number }}
 */
export function checkPackage(p, { arrows, all, rootManifest, base }) {
  const problems = [];
  const { manifest } = p;
  const published = p.group === 'packages';
  // What a build puts into the package is a development dependency that sources may import.
  const bundled = manifest.glanz?.bundled ?? [];
  for (const name of bundled)
    if (!manifest.devDependencies?.[name])
      problems.push(
        `packages/${p.short}/package.json: glanz.bundled names "${name}", which is not among devDependencies.`,
      );
  const runtime = new Set([...Object.keys({ ...manifest.dependencies, ...manifest.peerDependencies }), ...bundled]);
  const anywhere = new Set([
    ...runtime,
    ...Object.keys({ ...manifest.devDependencies, ...rootManifest.devDependencies }),
  ]);
  const used = new Set();
  const graph = new Map();
  let imports = 0;

  for (const file of sourceFiles(p.dir)) {
    const where = relative(base, file).split(sep).join('/');
    const isSource = relative(p.dir, file).startsWith(`src${sep}`);
    const edges = [];
    for (const { specifier, line, typeOnly } of readImports(scriptOf(file), file)) {
      imports++;
      const complain = (message) => problems.push(`${where}:${line}: ${message}`);
      if (specifier.startsWith('.')) {
        const target = resolveRelative(file, specifier.split('?')[0]);
        if (!target) {
          if (
            !specifier.includes('?') &&
            !/\.(css|json|wasm|vue|data)$/.test(specifier) &&
            existsSync(join(dirname(file), specifier)) === false
          )
            complain(`"${specifier}" is no file.`);
          continue;
        }
        const leaves = relative(p.dir, target).startsWith('..');
        if (leaves && (isSource ? published : /[\\/](packages|apps|tools)[\\/][^\\/]+[\\/]src[\\/]/.test(target)))
          complain(`"${specifier}" reaches outside of its package; import the other package by its name.`);
        if (isSource && relative(p.dir, target).startsWith(`src${sep}`)) edges.push({ target, typeOnly });
        continue;
      }
      if (isBuiltin(specifier)) {
        if (isSource && published && !isNodeFile(p, file))
          complain(
            `"${specifier}": Node's modules belong in node.ts, node/ or the command line; this file must run in a browser too.`,
          );
        continue;
      }
      if (specifier.startsWith('virtual:')) continue;
      const name = packageOf(specifier);
      const internal = all.get(name);
      if (internal === p) {
        if (isSource) complain(`"${specifier}": a package does not import itself by name.`);
        else if (!entriesOf(p).some((entry) => entry.specifier === specifier))
          complain(`"${specifier}" is not exported by ${name}.`);
        continue;
      }
      if (isSource) used.add(name);
      if (!(isSource && published ? runtime : anywhere).has(name))
        complain(`"${name}" is not declared in ${p.short}/package.json.`);
      if (!internal) {
        if (name.startsWith('@glanz/')) complain(`there is no package ${name}.`);
        continue;
      }
      if (!entriesOf(internal).some((entry) => entry.specifier === specifier))
        complain(
          `"${specifier}" is not exported by ${name}; exported: ${entriesOf(internal)
            .map((entry) => entry.specifier)
            .join(', ')}.`,
        );
      if (!isSource || !published) continue;
      const arrow = arrows.get(p.short)?.get(internal.short);
      if (internal.group !== 'packages') complain(`a published package must not import ${name}.`);
      else if (!arrow) complain(`${p.short} → ${internal.short} is not in the table of ARCHITECTURE.md.`);
      else if (arrow.typesOnly && !typeOnly)
        complain(`${p.short} → ${internal.short} is for types only: use import type.`);
      else if (arrow.errorOnly && specifier !== `${name}/error`)
        complain(`${p.short} may import ${name}/error and nothing else of it.`);
    }
    if (isSource) graph.set(file, edges);
  }

  // Types count too: to read one of two files that import each other is to read both.
  for (const file of published ? sourceFiles(join(p.dir, 'src'), /\.wesl$/) : [])
    graph.set(file, weslImports(join(p.dir, 'src'), file));
  const cycle = findCycle([...graph.keys()], (file) => (graph.get(file) ?? []).map((edge) => edge.target));
  if (cycle)
    problems.push(
      `${p.short}: files import each other in a circle: ${cycle.map((file) => relative(p.dir, file)).join(' → ')}`,
    );
  else if (published) {
    const circle = findFolderCycle(join(p.dir, 'src'), graph);
    if (circle) problems.push(`${p.short}: folders import each other in a circle: ${circle}`);
  }

  if (published) {
    // No browser entry may reach a file of the Node edge.
    for (const { specifier, conditions } of entriesOf(p)) {
      const entry = join(p.dir, conditions['@glanz/source'] ?? '');
      if (!existsSync(entry) || isNodeFile(p, entry)) continue;
      const seen = new Set();
      const visit = (file, path) => {
        if (seen.has(file)) return;
        seen.add(file);
        if (isNodeFile(p, file))
          problems.push(
            `${specifier} reaches ${relative(p.dir, file)}, which needs Node: ${path.map((f) => relative(p.dir, f)).join(' → ')}`,
          );
        for (const { target, typeOnly } of graph.get(file) ?? []) if (!typeOnly) visit(target, [...path, target]);
      };
      visit(entry, [entry]);
    }
    for (const name of runtime) {
      const internal = all.get(name);
      if (internal && !arrows.get(p.short)?.has(internal.short))
        problems.push(`packages/${p.short}/package.json: ${name} is not in the table of ARCHITECTURE.md.`);
    }
    // A program supplies the optional peers of the libraries it uses without importing them itself.
    const supplied = new Set(
      [...runtime].flatMap((name) => Object.keys(all.get(name)?.manifest.peerDependencies ?? {})),
    );
    for (const name of Object.keys(manifest.dependencies ?? {}))
      if (!used.has(name) && !supplied.has(name))
        problems.push(`packages/${p.short}/package.json: the dependency ${name} is never imported.`);
  }
  return { problems, imports };
}
