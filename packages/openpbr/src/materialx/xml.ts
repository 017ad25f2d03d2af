import { failure, quote } from './error';

/** Maximum size of a document. A larger one is an error, `openpbr/materialx-limit`. */
export interface MaterialXLimits {
  /** Characters of the text. Default 16,777,216. */
  readonly length?: number;
  /** Elements inside each other. Default 32. */
  readonly depth?: number;
  /** Elements in all. Default 100,000. */
  readonly elements?: number;
}

const DEFAULT_LIMITS = { length: 1 << 24, depth: 32, elements: 100_000 } as const;

/** An element of a document. MaterialX keeps everything in attributes; text between elements is not kept. */
export interface XmlElement {
  readonly name: string;
  readonly attributes: ReadonlyMap<string, string>;
  readonly children: readonly XmlElement[];
  readonly parent: XmlElement | undefined;
  readonly line: number;
}

const NAME = /[\p{L}_][\p{L}\p{N}_.:-]*/uy;
const ATTRIBUTE = /\s+([\p{L}_][\p{L}\p{N}_.:-]*)\s*=\s*(?:"([^"<]*)"|'([^'<]*)')/uy;
const TAG_END = /\s*(\/?)>/y;
const PREDEFINED: ReadonlyMap<string, string> = new Map([
  ['lt', '<'],
  ['gt', '>'],
  ['amp', '&'],
  ['quot', '"'],
  ['apos', "'"],
]);

/** The text that an attribute stands for: predefined and numeric references only. */
function unescaped(text: string, line: number): string {
  if (!text.includes('&')) return text;
  return text.replaceAll(/&([^;&]{0,10};?)/g, (_, reference: string) => {
    const known = PREDEFINED.get(reference.slice(0, -1));
    if (known !== undefined && reference.endsWith(';')) return known;
    const [, hexadecimal, decimal] = /^#(?:x([0-9a-f]{1,6})|(\d{1,7}));$/i.exec(reference) ?? [];
    const code = hexadecimal ? parseInt(hexadecimal, 16) : Number(decimal);
    if (!(code > 0 && code <= 0x10ffff))
      throw failure(
        'syntax',
        `${quote(`&${reference}`)} is not a known reference; documents cannot define their own.`,
        line,
      );
    return String.fromCodePoint(code);
  });
}

/**
 * Reads XML as far as MaterialX needs it: elements, attributes, comments, processing instructions. There is no document
 * type, so there are no entities to expand and no other files to fetch.
 *
 * @throws {MaterialXError} `openpbr/materialx-syntax`, `openpbr/materialx-limit`
 */
export function parseXml(text: string, limits: MaterialXLimits = {}): XmlElement {
  const { length, depth, elements } = { ...DEFAULT_LIMITS, ...limits };
  if (text.length > length) throw failure('limit', `it has ${text.length} characters, where ${length} are allowed.`, 1);
  let at = text.startsWith('\ufeff') ? 1 : 0;
  let line = 1,
    lineEnd = text.indexOf('\n');
  const lineAt = (position: number) => {
    while (lineEnd >= 0 && lineEnd < position) {
      line++;
      lineEnd = text.indexOf('\n', lineEnd + 1);
    }
    return line;
  };
  const match = (expression: RegExp) => {
    expression.lastIndex = at;
    const found = expression.exec(text);
    if (found) at = expression.lastIndex;
    return found;
  };
  const skip = (end: string, what: string) => {
    const found = text.indexOf(end, at);
    if (found < 0) throw failure('syntax', `a ${what} does not end.`, lineAt(at));
    at = found + end.length;
  };

  type Open = XmlElement & { readonly children: XmlElement[] };
  const open: Open[] = [];
  let root: XmlElement | undefined;
  let count = 0;
  for (;;) {
    const start = text.indexOf('<', at);
    if (open.length === 0 && text.slice(at, start < 0 ? undefined : start).trim() !== '')
      throw failure('syntax', "there is text outside of the document's element.", lineAt(at));
    if (start < 0) break;
    at = start + 1;
    if (text.startsWith('!--', at)) skip('-->', 'comment');
    else if (text.startsWith('![CDATA[', at)) skip(']]>', 'CDATA section');
    else if (text.startsWith('?', at)) skip('?>', 'processing instruction');
    else if (text.startsWith('!', at)) throw failure('syntax', 'document types and entities are not read.', lineAt(at));
    else if (text.startsWith('/', at)) {
      at++;
      const name = match(NAME)?.[0];
      const closed = open.pop();
      if (!closed || closed.name !== name || match(TAG_END)?.[1] !== '')
        throw failure(
          'syntax',
          `the end ${quote(`</${name ?? ''}>`)} does not belong to ${closed ? quote(`<${closed.name}>`) : 'an element'}.`,
          lineAt(at),
        );
    } else {
      const here = lineAt(at);
      const name = match(NAME)?.[0];
      if (name === undefined) throw failure('syntax', 'there is a "<" without an element.', here);
      const attributes = new Map<string, string>();
      for (let found = match(ATTRIBUTE); found; found = match(ATTRIBUTE)) {
        const key = found[1] as string;
        if (attributes.has(key)) throw failure('syntax', `<${name}> has the attribute ${quote(key)} twice.`, here);
        attributes.set(key, unescaped(found[2] ?? (found[3] as string), here));
      }
      const end = match(TAG_END);
      if (!end) throw failure('syntax', `the attributes of <${name}> are not well formed.`, here);
      if (++count > elements) throw failure('limit', `there are more than ${elements} elements.`, here);
      const parent = open.at(-1);
      if (!parent && root) throw failure('syntax', "there is a second element beside the document's.", here);
      const element: Open = { name, attributes, children: [], parent, line: here };
      if (parent) parent.children.push(element);
      else root = element;
      if (end[1] === '') open.push(element);
      if (open.length > depth) throw failure('limit', `elements lie more than ${depth} deep inside each other.`, here);
    }
  }
  const unclosed = open.at(-1);
  if (unclosed) throw failure('syntax', `<${unclosed.name}> does not end.`, unclosed.line);
  if (!root) throw failure('syntax', 'there is no element.', 1);
  return root;
}
