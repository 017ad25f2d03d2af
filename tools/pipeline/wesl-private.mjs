// Short names for what one shader file declares and nothing else names: functions, structs, constants and private
// variables of a module that stand in no other source, page, example or tool of the workspace. Names that other
// modules, hosts or users' own WGSL may use are in some other file, or in what documents them.
import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { dirname, join, sep } from 'node:path';
import { shortenLocals } from './wesl-names.mjs';
import { parseWesl } from './wesl-parse.mjs';

const DECLARES = new Set(['fn', 'struct', 'const', 'alias']);
const SOURCES = /\.(?:wesl|[cm]?[jt]sx?|vue|svelte|html|md)$/;
const SKIPPED = new Set(['node_modules', 'dist', 'test', '.cache', 'cache', 'public', 'api']);

/** Files that may name what a shader declares. */
function* sourceFiles(folder) {
  for (const entry of readdirSync(folder, { withFileTypes: true })) {
    if (entry.isDirectory()) {
      if (!SKIPPED.has(entry.name)) yield* sourceFiles(join(folder, entry.name));
    } else if (SOURCES.test(entry.name)) yield join(folder, entry.name);
  }
}

/** Files of packages' shaders, by the package's folder. */
const shaders = new Map();
/** By the workspace's folder: names with the only file that has them, `null` where there are several. */
const indices = new Map();

function namesOf(workspace) {
  let index = indices.get(workspace);
  if (index) return index;
  index = new Map();
  for (const folder of ['packages', 'apps', 'tools'].filter((name) => existsSync(join(workspace, name))))
    for (const file of sourceFiles(join(workspace, folder)))
      for (const name of new Set(readFileSync(file, 'utf8').match(/\b[A-Za-z_]\w{3,}/g)))
        index.set(name, index.has(name) ? null : file);
  indices.set(workspace, index);
  return index;
}

/** Names that a module declares; not those of bindings, which hosts give. */
function* declared(tokens) {
  const text = (i) => tokens[i]?.text;
  let depth = 0;
  for (let i = 0; i < tokens.length; i++) {
    if (text(i) === '{') depth++;
    if (text(i) === '}') depth--;
    if (depth > 0) continue;
    if (DECLARES.has(text(i))) yield text(i + 1);
    if (text(i) === 'var' && text(i + 1) === '<' && /^(?:private|workgroup)$/.test(text(i + 2))) yield text(i + 4);
  }
}

/** A, B, … Z, BA, BB, … */
const letters = (i) => (i < 26 ? '' : letters(Math.floor(i / 26))) + String.fromCharCode(65 + (i % 26));

function shadersOf(folder) {
  let files = shaders.get(folder);
  if (!files) {
    const source = join(folder, 'src');
    files = existsSync(source) ? [...sourceFiles(source)].filter((one) => one.endsWith('.wesl')).sort() : [];
    shaders.set(folder, files);
  }
  return files;
}

/**
 * What no other file's names begin with: programs are composed of files of several packages. The package's first
 * letters, and the file's number among its shaders.
 */
const prefixOf = (file, folder) => folder.split(sep).at(-1).slice(0, 2) + shadersOf(folder).indexOf(file).toString(36);

/**
 * Short names by the names of a file's tokens.
 *
 * @param {{ text: string, from: number }[]} tokens Of a WESL file, without comments.
 * @param {{ from: number }[]} locals Replacements of local names.
 */
function shortNames(tokens, file, folder, locals) {
  const workspace = dirname(dirname(folder));
  if (!existsSync(join(workspace, 'pnpm-workspace.yaml'))) return new Map();
  const index = namesOf(workspace);
  const local = new Set(locals.map(({ from }) => from));
  const own = new Set([...declared(tokens)].filter((name) => index.get(name) === file));
  tokens.forEach(({ text, from }, i) => {
    const before = tokens[i - 1]?.text;
    // A colon follows the names of members and parameters, and those of constants and variables with a type.
    const member = tokens[i + 1]?.text === ':' && before !== 'const' && before !== '>';
    if (own.has(text) && (local.has(from) || before === '.' || member)) own.delete(text);
  });
  return new Map([...own].sort().map((name, i) => [name, prefixOf(file, folder) + letters(i)]));
}

/**
 * @param {{ text: string, from: number, to: number }[]} tokens Of a WESL file, without comments.
 * @param {string} file Absolute path.
 * @param {string} folder Of the file's package; where it is in no workspace, names stay.
 * @param {{ from: number }[]} locals Replacements of local names.
 * @returns {{ from: number, to: number, text: string }[]} Replacements of names, each line in its place.
 */
export function shortenPrivate(tokens, file, folder, locals) {
  const short = shortNames(tokens, file, folder, locals);
  return tokens.flatMap(({ text, from, to }) => {
    const name = short.get(text);
    return name !== undefined && name.length < text.length ? [{ from, to, text: name }] : [];
  });
}

/** The short names of a package, in a text that changes with them: other packages decide which there are. */
export function privateNames(folder) {
  return shadersOf(folder)
    .map((file) => {
      const { tokens } = parseWesl(readFileSync(file, 'utf8'), file);
      return [...shortNames(tokens, file, folder, shortenLocals(tokens))].join();
    })
    .join('\n');
}
