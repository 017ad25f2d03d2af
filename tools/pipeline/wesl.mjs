// Shader source in WESL (https://wesl-lang.dev), turned into the modules that @glanz/wgsl composes at run time.
//
// `import package::a::b::name;` becomes a dependency, `@if(FLAG) … @elif(FLAG) … @else …` on declarations, members,
// parameters, statements and imports becomes gates. Nothing else changes, and every line keeps its number: line n of a
// module's text is line n of its file; what is published has no comments and fewer lines. No parser of WESL is in what we publish.
//
// A file of constants is TypeScript's too: see wesl-constants.mjs.
import { existsSync, readFileSync } from 'node:fs';
import { dirname, join, relative, resolve, sep } from 'node:path';
import { exportedConstants, readConstants } from './wesl-constants.mjs';
import { shortenLocals } from './wesl-names.mjs';
import { parseWesl } from './wesl-parse.mjs';
import { shortenPrivate } from './wesl-private.mjs';
import { WeslError } from './wesl-tokens.mjs';

export { parseWesl, WeslError };

const BASE64 = 'ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/';
const OPERATOR = /[-+*/%=<>!&|^~]/;

/**
 * A line of WGSL without the spaces that separate nothing: those beside punctuation. Between two operators they stay,
 * for `a - -b` and `array<f32> = x` mean something else without them. Lines with comments stay as they are.
 */
export function closeUp(line) {
  if (line.includes('//')) return line;
  const closed = line.replace(/(?<=(\S)) +(?=(\S))/g, (spaces, before, after) => {
    const separates = /\w/.test(before) && /\w/.test(after);
    return separates || (OPERATOR.test(before) && OPERATOR.test(after)) ? spaces : '';
  });
  // 1.0 is 1. and 0.5 is .5; what a substitution may continue stays.
  return closed.replace(/(?<=\d\.)0(?=[^\w.])/g, '').replace(/(?<![\w.])0(?=\.\d)/g, '');
}

/** A line with gates, without the spaces that separate nothing. */
const closeUpGated = (line) =>
  line
    .split(/(\/\/#(?:if [\w!&]+|else|endif))/)
    .map((part, i) => {
      if (i % 2) return part;
      const shut = closeUp(part.trim());
      return i > 0 && /^\w/.test(shut) ? ` ${shut}` : shut;
    })
    .join('');

function apply(text, edits) {
  let result = text;
  for (const edit of [...edits].sort((a, b) => b.from - a.from || b.to - a.to))
    result = result.slice(0, edit.from) + edit.text + result.slice(edit.to);
  return result;
}

/**
 * The text with gates for the composer, line by line that of the file. @param {boolean} shrink Without comments and
 * spaces that separate nothing, and with short names for what one function or file alone names.
 */
function gatedText(text, { edits, comments, tokens }, shrink, file, folder) {
  if (!shrink) return apply(text, edits);
  const locals = shortenLocals(tokens);
  const bare = apply(text, [
    ...edits,
    ...locals,
    ...shortenPrivate(tokens, file, folder, locals),
    ...comments.map(({ from, to }) => ({ from, to, text: text.slice(from, to).replace(/[^\n]+/g, '') || ' ' })),
  ]);
  return bare.split('\n').map(closeUpGated).join('\n');
}

/** The nearest folder with a package.json, and its name without the scope. */
function packageOf(file) {
  for (let folder = dirname(file); folder !== dirname(folder); folder = dirname(folder)) {
    const manifest = join(folder, 'package.json');
    if (existsSync(manifest))
      return { folder, short: JSON.parse(readFileSync(manifest, 'utf8')).name.split('/').at(-1) };
  }
  throw new WeslError(`${file}: it lies in no package.`);
}

/**
 * Whether an imported name is a number: those of TypeScript are in capitals. It stands in the text as a literal u32, so
 * that hosts and shaders share one table.
 */
const isNumber = (name) => /^[A-Z][A-Z\d]*(?:_[A-Z\d]+)*$/.test(name);

/** Files that only declare what the host of a library supplies, so that editors know it. */
export const isHost = (path) => path.at(-1) === 'host';

/**
 * The file that an imported module is in.
 * @returns {{ file: string, wesl: boolean }} `wesl` false: TypeScript that exports a module by the imported name.
 * @throws {WeslError}
 */
function resolveModule({ path, name, line }, file, source) {
  const [root, ...rest] = path;
  const folder = root === 'package' ? source : root === 'super' ? dirname(file) : undefined;
  if (folder === undefined) throw new WeslError(`${file}:${line}: "${root}" is no root of a path: package or super.`);
  const base = resolve(folder, ...rest);
  if (existsSync(`${base}.wesl`)) return { file: `${base}.wesl`, wesl: true };
  const typescript = `${join(dirname(base), (rest.at(-1) ?? '').replaceAll('_', '-'))}.ts`;
  if (existsSync(typescript)) return { file: typescript, wesl: false };
  throw new WeslError(
    `${file}:${line}: there is no module ${path.join('::')} to import ${name} from: neither ${base}.wesl nor ${typescript}.`,
  );
}

/** The value of a number that a TypeScript file exports as a literal, or as one that is shifted; `undefined` of others. */
function readLiteral(target, name) {
  const found = new RegExp(`export const ${name} = (\\w+)(?: << (\\d+))?;`).exec(readFileSync(target, 'utf8'));
  const value = found ? Number(found[1]) * 2 ** Number(found[2] ?? 0) : NaN;
  return Number.isInteger(value) ? value : undefined;
}

/** A number ≥ 0 as source maps have it: five bits a digit, the lowest first, after a bit for the sign. */
function base64Vlq(value) {
  let digits = '';
  for (let rest = value * 2; digits === '' || rest > 0; rest >>= 5)
    digits += BASE64[(rest & 31) | (rest > 31 ? 32 : 0)];
  return digits;
}

/**
 * A WESL file as a JavaScript module whose default export is its `WgslModule`. Its name is `<package>/<file>`, with
 * hyphens for underscores. The constants of a file that holds nothing else are exported by their names.
 *
 * @param {string} text
 * @param {string} file Absolute path.
 * @param {{ shrink?: boolean }} options `shrink`: leaves out comments and spaces, joins lines of a block, and shortens names of
 *   one function or file, for what is published.
 * @returns {{ code: string, map: { version: 3, sources: string[], sourcesContent: string[], names: string[], mappings:
 * string } }}
 * @throws {WeslError}
 */
export function compileWesl(text, file, { shrink = false } = {}) {
  const parsed = parseWesl(text, file);
  const { folder, short } = packageOf(file);
  const source = join(folder, 'src');
  const names = new Map();
  const dependencies = new Map();
  const numbers = new Map();
  let computed = false;
  const used = new Set(['wgslModule']);
  let imports = '';
  for (const entry of parsed.imports) {
    if (isHost(entry.path)) continue;
    const { file: target, wesl } = resolveModule(entry, file, source);
    const specifier = `./${relative(dirname(file), target).split(sep).join('/')}`
      .replace(/^\.\/\.\.\//, '../')
      .replace(/\.ts$/, '');
    if (!wesl && isNumber(entry.name)) {
      if (numbers.has(entry.name)) continue;
      const literal = shrink ? readLiteral(target, entry.name) : undefined;
      const variable = `number${numbers.size}`;
      numbers.set(entry.name, literal ?? `\${${variable}}`);
      if (literal !== undefined) continue;
      computed = true;
      imports += `import { ${entry.name} as ${variable} } from ${JSON.stringify(specifier)};`;
      continue;
    }
    const key = wesl ? specifier : `${specifier} ${entry.name}`;
    let name = names.get(key);
    if (name === undefined) {
      names.set(key, (name = `module${names.size}`));
      imports += `import ${wesl ? name : `{ ${entry.name} as ${name} }`} from ${JSON.stringify(specifier)};`;
    }
    if (entry.flag !== undefined) used.add('gated');
    const dependency =
      entry.flag === undefined ? name : `/* @__PURE__ */ gated(${JSON.stringify(entry.flag)}, ${name})`;
    dependencies.set(dependency, dependency);
  }
  const title = `${short}/${file
    .split(/[\\/]/)
    .at(-1)
    .replace(/\.wesl$/, '')
    .replaceAll('_', '-')}`;
  // Lines of the result, with their numbers in the file, from 0.
  const lines = [];
  for (const [number, line] of gatedText(text, parsed, shrink, file, folder).split('\n').entries()) {
    // A bracket that closes alone belongs to the line before it, and the first line of a block to what opens it.
    const joined = shrink && (!/[^)\]};]/.test(line) || lines.at(-1)?.[1].endsWith('{'));
    if (joined && lines.length > 0) lines.at(-1)[1] += line;
    else if (!joined) lines.push([number, line]);
  }
  const template = lines
    .map(([, line]) => line)
    .join('\n')
    .replace(/[\\`]|\$(?=\{)/g, '\\$&')
    .replace(/[A-Za-z_]\w*/g, (name) => (numbers.has(name) ? `${numbers.get(name)}u` : name));
  // Bundlers keep a template that holds a variable, even as an argument of a pure call: the function takes it along.
  // All on the first line, so that lines of the result are those of the template.
  const code = `import { ${[...used].sort().join(', ')} } from "@glanz/wgsl/module";${imports}export default /* @__PURE__ */ ${computed ? '(() => ' : ''}wgslModule(${JSON.stringify(title)}, \`${template}\`${dependencies.size > 0 ? `, [${[...dependencies.values()].join(', ')}]` : ''})${computed ? ')()' : ''};\n`;
  const constants = readConstants(text, file);
  const mappings = lines.map(([number], i) => `AA${base64Vlq(number - (lines[i - 1]?.[0] ?? 0))}A`).join(';');
  return {
    code: constants ? code + exportedConstants(constants) : code,
    map: { version: 3, sources: [file.split(/[\\/]/).at(-1)], sourcesContent: [text], names: [], mappings },
  };
}

/** For esbuild and tsup. @param {{ shrink?: boolean }} options As for {@link compileWesl}. */
export const weslSource = (options = {}) => ({
  name: 'wesl',
  setup(build) {
    build.onLoad({ filter: /\.wesl$/ }, ({ path }) => {
      const { code, map } = compileWesl(readFileSync(path, 'utf8'), path, options);
      return {
        contents: `${code}//# sourceMappingURL=data:application/json;base64,${Buffer.from(JSON.stringify(map)).toString('base64')}`,
        loader: 'js',
        resolveDir: dirname(path),
      };
    });
  },
});

/** For Vite, Vitest and VitePress. What they build is shrunk. */
export const weslModules = () => {
  let shrink = false;
  return {
    name: 'wesl',
    enforce: 'pre',
    configResolved: ({ command }) => void (shrink = command === 'build'),
    transform: (text, id) => {
      if (!id.endsWith('.wesl')) return undefined;
      const { code, map } = compileWesl(text, id, { shrink });
      return { code, map: shrink ? null : map };
    },
  };
};
