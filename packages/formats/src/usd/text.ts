import { ARCS, emptyPrim, type UsdAttribute, type UsdLayer, type UsdPrim, type UsdValue } from './layer';
import { UsdTokens } from './text-tokens';

/** How a text layer begins. */
export const TEXT_MAGIC = '#usda';
const SPECIFIERS = ['def', 'over', 'class'];
const LIST_OPS = new Set(['add', 'prepend', 'append', 'delete', 'reorder', 'explicit']);
const VARIABILITY = new Set(['custom', 'uniform', 'varying', 'config']);
/** Deeper prims and values are refused. */
const DEEPEST = 200;

/** A value as it is written: numbers, texts, tuples and lists of them. */
type Written = number | string | boolean | undefined | readonly Written[];

const flat = (value: Written): (number | string | boolean)[] =>
  Array.isArray(value)
    ? (value as readonly Written[]).flatMap(flat)
    : value === undefined
      ? []
      : [value as number | string | boolean];

/** A written value as one of its type: quaternions are written with the real part first, and kept with it last. */
function typed(type: string, written: Written): UsdValue | undefined {
  if (!Array.isArray(written)) return written as UsdValue | undefined;
  const values = flat(written);
  if (values.some((value) => typeof value === 'string')) return values.map(String);
  const numbers = values.map(Number);
  if (type.startsWith('quat')) return numbers.map((_, i) => numbers[i - (i % 4) + (((i % 4) + 1) % 4)] as number);
  return numbers;
}

class TextReader {
  upAxis: string | undefined;
  metersPerUnit: number | undefined;
  defaultPrim: string | undefined;
  subLayers = false;
  readonly #tokens: UsdTokens;

  constructor(text: string) {
    this.#tokens = new UsdTokens(text);
  }

  layer(): UsdPrim {
    const root = emptyPrim('/', '');
    if (this.#tokens.peek() === '(')
      this.#metadata((name, value) => {
        if (name === 'upAxis' && typeof value === 'string') this.upAxis = value;
        if (name === 'metersPerUnit' && typeof value === 'number') this.metersPerUnit = value;
        if (name === 'defaultPrim' && typeof value === 'string') this.defaultPrim = value;
        if (name === 'subLayers') this.subLayers = true;
      });
    while (this.#tokens.peek() !== '') {
      if (SPECIFIERS.includes(this.#tokens.peek())) this.#prim(root, 0);
      else this.#property(emptyPrim('', ''), 0);
    }
    return root;
  }

  #prim(parent: UsdPrim, depth: number): void {
    if (depth > DEEPEST) throw this.#tokens.fail('prims are nested too deep');
    const specifier = this.#tokens.next();
    const type = /^["']/.test(this.#tokens.peek()) ? '' : this.#tokens.next();
    const name = this.#tokens.text();
    const prim = emptyPrim(`${parent.path === '/' ? '' : parent.path}/${name}`, name);
    prim.type = type;
    prim.defined = specifier === 'def';
    if (this.#tokens.peek() === '(')
      this.#metadata((key, value) => {
        if (ARCS.includes(key)) prim.arcs.add(key);
        if (key === 'active' && value === false) prim.active = false;
      });
    this.#tokens.expect('{');
    while (this.#tokens.peek() !== '}') {
      if (SPECIFIERS.includes(this.#tokens.peek())) this.#prim(prim, depth + 1);
      else this.#property(prim, depth);
    }
    this.#tokens.expect('}');
    parent.children.push(prim);
  }

  /** A property, a set of variants, or an order of children, which do not count. */
  #property(prim: UsdPrim, depth: number): void {
    const words: string[] = [];
    while (LIST_OPS.has(this.#tokens.peek()) || VARIABILITY.has(this.#tokens.peek())) words.push(this.#tokens.next());
    if (this.#tokens.peek() === 'variantSet') return this.#variants(depth);
    let type = this.#tokens.next();
    if (words.includes('reorder')) {
      this.#tokens.expect('=');
      this.#value(depth);
      return;
    }
    if (this.#tokens.peek() === '[') {
      this.#tokens.expect('[');
      this.#tokens.expect(']');
      type += '[]';
    }
    const name = this.#tokens.next();
    let value: Written;
    if (this.#tokens.peek() === '=') {
      this.#tokens.expect('=');
      value = name.endsWith('.timeSamples') ? this.#firstSample(depth) : this.#value(depth);
    }
    let interpolation: string | undefined;
    if (this.#tokens.peek() === '(')
      this.#metadata((key, given) => {
        if (key === 'interpolation' && typeof given === 'string') interpolation = given;
      });
    if (words.includes('delete')) return;
    const targets = flat(value).map((target) => String(target));
    if (type === 'rel') {
      if (value !== undefined || !prim.relationships.has(name)) prim.relationships.set(name, targets);
      return;
    }
    const own = name.replace(/\.(connect|timeSamples|spline)$/, '');
    const attribute: UsdAttribute = prim.attributes.get(own) ?? { type };
    if (name.endsWith('.connect')) attribute.connections = targets;
    else if (name === own) attribute.value = typed(type, value) ?? attribute.value;
    else attribute.value ??= typed(type, value);
    attribute.interpolation ??= interpolation;
    prim.attributes.set(own, attribute);
  }

  #variants(depth: number): void {
    this.#tokens.next();
    this.#tokens.text();
    this.#tokens.expect('=');
    this.#tokens.expect('{');
    while (this.#tokens.peek() !== '}') {
      this.#tokens.text();
      const unused = emptyPrim('', '');
      if (this.#tokens.peek() === '(') this.#metadata(() => undefined);
      this.#tokens.expect('{');
      while (this.#tokens.peek() !== '}') {
        if (SPECIFIERS.includes(this.#tokens.peek())) this.#prim(unused, depth + 1);
        else this.#property(unused, depth + 1);
      }
      this.#tokens.expect('}');
    }
    this.#tokens.expect('}');
  }

  #metadata(take: (name: string, value: Written) => void): void {
    this.#tokens.expect('(');
    while (this.#tokens.peek() !== ')') {
      let name = this.#tokens.next();
      // A text alone is a comment.
      if (/^["']/.test(name)) continue;
      while (LIST_OPS.has(name)) name = this.#tokens.next();
      if (this.#tokens.peek() === '=') {
        this.#tokens.expect('=');
        take(name, this.#value(0));
      }
    }
    this.#tokens.expect(')');
  }

  /** A number, text, path, tuple, list or dictionary; the last gives nothing. */
  #value(depth: number): Written {
    if (depth > DEEPEST) throw this.#tokens.fail('values are nested too deep');
    const token = this.#tokens.peek();
    if (token === '(' || token === '[') {
      const end = token === '(' ? ')' : ']';
      const values: Written[] = [];
      this.#tokens.next();
      while (this.#tokens.peek() !== end) {
        values.push(this.#value(depth + 1));
        if (this.#tokens.peek() === ',') this.#tokens.next();
      }
      this.#tokens.expect(end);
      return values;
    }
    if (token === '{') {
      this.#dictionary(depth);
      return undefined;
    }
    if (/^["'<@]/.test(token)) {
      const text = this.#tokens.text();
      // A path within another layer, or with the offset of its times.
      if (token.startsWith('@') && this.#tokens.peek().startsWith('<')) this.#tokens.next();
      return text;
    }
    this.#tokens.next();
    if (token === 'true' || token === 'false') return token === 'true';
    if (token === 'None') return undefined;
    const number = token === 'inf' ? Infinity : token === '-inf' ? -Infinity : Number(token);
    if (Number.isNaN(number) && token !== 'nan') throw this.#tokens.fail(`"${token.slice(0, 40)}" is not a value`);
    return number;
  }

  #dictionary(depth: number): void {
    if (depth > DEEPEST) throw this.#tokens.fail('values are nested too deep');
    this.#tokens.expect('{');
    for (let open = 1; open > 0;) {
      const token = this.#tokens.next();
      open += token === '{' ? 1 : token === '}' ? -1 : 0;
    }
  }

  #firstSample(depth: number): Written {
    this.#tokens.expect('{');
    let first: Written;
    for (let count = 0; this.#tokens.peek() !== '}'; count++) {
      const time = this.#tokens.next();
      if (!time.endsWith(':')) this.#tokens.expect(':');
      const value = this.#value(depth + 1);
      if (count === 0) first = value;
      if (this.#tokens.peek() === ',') this.#tokens.next();
    }
    this.#tokens.expect('}');
    return first;
  }
}

/**
 * Reads a text layer (`.usda`).
 *
 * @throws {RangeError} if the text is not well formed, with its line.
 */
export function readText(text: string): UsdLayer {
  const reader = new TextReader(text);
  const root = reader.layer();
  const { upAxis, metersPerUnit, defaultPrim, subLayers } = reader;
  return { root, upAxis, metersPerUnit, defaultPrim, subLayers };
}
