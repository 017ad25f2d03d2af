// Constants that shaders and TypeScript share are written once, in a WESL file that holds nothing else:
//
//   // Samples whose mean is one entry of the sum.
//   const FILM_CHUNK = 16u;
//   const BANDS = array<vec2f, 2>(vec2f(0.5, 1.0), vec2f(1.5, 2.0));
//
// Its module exports each of them by name: a number or boolean, or an array of such. `<file>.wesl.d.ts` beside it
// declares them to TypeScript, with their comments: `node tools/pipeline/wesl-constants.mjs` writes it.
import { existsSync, readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { join, relative } from 'node:path';
import { fileURLToPath } from 'node:url';
import { WeslError, tokenize } from './wesl-tokens.mjs';

const SCALAR = /^(?:i32|u32|f32|f16|bool)$/;
const VECTOR = /^vec([234])([iufh]?)$/;
const NUMBER = /^(?:0[xX][\da-fA-F]+[iu]?|(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?[iufh]?)$/;

/** The value of a literal number as WGSL reads it. */
function numberOf(text) {
  const hex = /^0[xX]/.test(text);
  return Number(text.replace(hex ? /[iu]$/ : /[iufh]$/, ''));
}

/**
 * The constants of a file that declares nothing else, or `undefined` for any other file. A file named `constants` must
 * be one.
 *
 * @param {string} text
 * @param {string} file For messages.
 * @returns {{ name: string, value: number | boolean | readonly unknown[], type: string, doc: string, line: number }[] |
 *   undefined} `type` is TypeScript's, `doc` the lines of the comment right before it.
 * @throws {WeslError}
 */
export function readConstants(text, file = 'constants.wesl') {
  const lineOf = (at) => text.slice(0, at).split('\n').length;
  const fail = (at, message) => {
    throw new WeslError(`${file}:${lineOf(at)}: ${message}.`);
  };
  const { tokens, comments } = tokenize(text, fail);
  const demanded = /(^|[\\/])constants\.wesl$/.test(file);
  if (!demanded && !holdsOnlyConstants(tokens)) return undefined;
  let next = 0;
  const peek = () => tokens[next]?.text;
  const here = () => tokens[next]?.from ?? text.length;
  const take = (expected) => {
    const token = tokens[next];
    if (token === undefined || (expected !== undefined && token.text !== expected))
      return fail(here(), `"${token?.text ?? 'the end'}" stands where "${expected ?? 'more'}" is expected`);
    next++;
    return token;
  };

  /** What a type's name and its brackets say: how many elements, and what each is. */
  const type = () => {
    const at = here();
    const name = take().text;
    if (SCALAR.test(name)) return { kind: 'scalar', scalar: name };
    const vector = VECTOR.exec(name);
    if (vector) {
      let scalar = { i: 'i32', u: 'u32', f: 'f32', h: 'f16' }[vector[2]];
      if (scalar === undefined && peek() === '<') {
        take('<');
        const inner = type();
        if (inner.kind !== 'scalar') fail(at, 'a vector holds numbers');
        scalar = inner.scalar;
        take('>');
      }
      return { kind: 'vector', count: Number(vector[1]), scalar };
    }
    if (name === 'array') {
      if (peek() !== '<') return { kind: 'array' };
      take('<');
      const element = type();
      let count;
      if (peek() === ',') {
        take(',');
        const length = take();
        if (!/^\d+u?$/.test(length.text)) fail(length.from, 'the length of an array is a literal');
        count = numberOf(length.text);
        if (peek() === ',') take(',');
      }
      take('>');
      return { kind: 'array', element, count };
    }
    return fail(at, `"${name}" is no number, boolean, vector or array: a table of constants holds literals`);
  };

  const check = (at, value, written, scalar) => {
    const suffix = /^0[xX]/.test(written) ? /[iu]$/.exec(written)?.[0] : /[iufh]$/.exec(written)?.[0];
    const own = { i: 'i32', u: 'u32', f: 'f32', h: 'f16' }[suffix];
    const is = own ?? scalar;
    if (own !== undefined && scalar !== undefined && own !== scalar) fail(at, `${written} is no ${scalar}`);
    if ((is === 'i32' || is === 'u32') && !Number.isInteger(value)) fail(at, `${written} is no ${is}`);
    if (is === 'bool') fail(at, `${written} is no bool`);
    const [low, high] =
      is === 'u32' ? [0, 2 ** 32 - 1] : is === 'i32' ? [-(2 ** 31), 2 ** 31 - 1] : [-3.4028235e38, 3.4028235e38];
    if (value < low || value > high) fail(at, `${written} is out of range`);
  };

  /** @returns {{ value: unknown, type: string }} */
  const expression = (kind) => {
    const at = here();
    const token = peek();
    if (token === 'true' || token === 'false') {
      if (kind !== undefined && kind.scalar !== 'bool') fail(at, `${token} stands where a number is expected`);
      take();
      return { value: token === 'true', type: 'boolean' };
    }
    if (token === '-' || NUMBER.test(token ?? '')) {
      if (kind !== undefined && kind.kind !== 'scalar') fail(at, 'a number stands where several are expected');
      if (token === '-') take();
      const { text: written, from } = take();
      if (!NUMBER.test(written)) fail(from, `"${written}" is no literal`);
      const value = token === '-' ? -numberOf(written) : numberOf(written);
      check(from, value, written, kind?.scalar);
      return { value, type: 'number' };
    }
    const found = type();
    if (found.kind === 'scalar') fail(at, 'a table of constants converts no values: write the literal');
    if (kind !== undefined && kind.kind !== found.kind) fail(at, 'the value is of another type');
    take('(');
    const of = found.kind === 'vector' ? { kind: 'scalar', scalar: found.scalar } : found.element;
    const elements = [];
    while (peek() !== ')') {
      elements.push(expression(of));
      if (peek() !== ')') take(',');
    }
    take(')');
    const count = found.count ?? (kind?.kind === 'array' ? kind.count : undefined) ?? elements.length;
    if (elements.length === 0 || elements.length !== count)
      fail(at, `${elements.length} values stand where ${count || 'some'} are expected`);
    const element = elements[0].type;
    if (elements.some(({ type: other }) => other !== element)) fail(at, 'the elements are of several types');
    return {
      value: elements.map(({ value }) => value),
      type:
        found.kind === 'vector'
          ? `readonly [${elements.map(() => element).join(', ')}]`
          : `readonly ${/^\w+$/.test(element) ? element : `(${element})`}[]`,
    };
  };

  const constants = [];
  while (next < tokens.length) {
    const at = here();
    if (peek() !== 'const')
      fail(at, `"${peek()}" stands in a table of constants, which holds "const NAME = literal;" alone`);
    take();
    const name = take();
    if (constants.some((other) => other.name === name.text)) fail(name.from, `${name.text} is declared twice`);
    let declared;
    if (peek() === ':') {
      take();
      declared = type();
    }
    take('=');
    const found = expression(declared);
    if (peek() !== ';') fail(here(), `"${peek() ?? 'the end'}" follows the literal: write the value itself`);
    take(';');
    constants.push({ name: name.text, ...found, doc: commentBefore(text, comments, at), line: lineOf(at) });
  }
  if (constants.length === 0) fail(0, 'it holds no constant');
  return constants;
}

/** Whether all declarations are `const`, without imports, gates or attributes. */
function holdsOnlyConstants(tokens) {
  if (tokens.length === 0) return false;
  let begins = true;
  for (const { text } of tokens) {
    if (begins && text !== 'const') return false;
    begins = text === ';';
  }
  return true;
}

/** The lines of `//` directly above a place, without their slashes. */
function commentBefore(text, comments, at) {
  const lines = [];
  let below = text.lastIndexOf('\n', at - 1) + 1;
  for (const { from, to } of [...comments].reverse()) {
    if (from >= at) continue;
    const begin = text.lastIndexOf('\n', from - 1) + 1;
    if (to + 1 !== below || text.slice(begin, from).trim() !== '' || !text.startsWith('//', from)) break;
    lines.unshift(text.slice(from + 2, to).trim());
    below = begin;
  }
  return lines.join('\n');
}

/** The exports of a module with these constants. */
export const exportedConstants = (constants) =>
  `export const ${constants.map(({ name, value }) => `${name} = ${JSON.stringify(value)}`).join(', ')};\n`;

/**
 * What declares a table of constants to TypeScript.
 * @throws {WeslError}
 */
export function declareConstants(text, file) {
  const lines = ["import type { WgslModule } from '@glanz/wgsl';", ''];
  for (const { name, type, doc } of readConstants(text, file)) {
    const docs = doc.split('\n');
    if (doc !== '' && docs.length === 1) lines.push(`/** ${doc} */`);
    else if (doc !== '') lines.push('/**', ...docs.map((line) => ` * ${line}`.trimEnd()), ' */');
    lines.push(`export const ${name}: ${type};`);
  }
  return `${lines.join('\n')}\n\ndeclare const module: WgslModule;\nexport default module;\n`;
}

/** The file that declares a table to TypeScript. */
export const declarationFile = (file) => `${file}.d.ts`;

/** All tables of constants below the sources of the packages. @returns {string[]} */
export function constantFiles(root) {
  return readdirSync(join(root, 'packages'))
    .map((name) => join(root, 'packages', name, 'src'))
    .filter((folder) => existsSync(folder))
    .flatMap((folder) => readdirSync(folder, { recursive: true, encoding: 'utf8' }).map((path) => join(folder, path)))
    .filter((file) => file.endsWith('.wesl') && readConstants(readFileSync(file, 'utf8'), file) !== undefined)
    .sort();
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const root = join(import.meta.dirname, '../..');
  for (const file of constantFiles(root)) {
    writeFileSync(declarationFile(file), declareConstants(readFileSync(file, 'utf8'), file));
    process.stdout.write(`${relative(root, declarationFile(file))}\n`);
  }
}
