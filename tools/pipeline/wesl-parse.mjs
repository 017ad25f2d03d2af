// Reads WESL: its imports, the edits that turn its conditions into gates, its comments and tokens.
import { WeslError, tokenize } from './wesl-tokens.mjs';

const CLOSING = { '(': ')', '[': ']', '{': '}', '<': '>' };

/**
 * Reads a WESL file.
 *
 * @param {string} text
 * @param {string} file For messages.
 * @returns {{ imports: { path: string[], name: string, flag: string | undefined, line: number }[], edits: { from:
 *   number, to: number, text: string }[], comments: { from: number, to: number }[], tokens: { text: string,
 *   from: number, to: number }[] }} `edits` turn the text into one with gates. `path` is the module of an imported name.
 * @throws {WeslError}
 */
export function parseWesl(text, file = 'module.wesl') {
  const fail = (at, message) => {
    throw new WeslError(`${file}:${text.slice(0, at).split('\n').length}: ${message}.`);
  };
  const { tokens, comments } = tokenize(text, fail);
  const imports = [];
  const edits = [];
  let next = 0;
  const peek = () => tokens[next]?.text;
  const here = () => tokens[next]?.from ?? text.length;
  const take = (expected) => {
    const token = tokens[next];
    if (!token) return fail(text.length, expected ? `"${expected}" is missing at the end` : 'the file ends too soon');
    if (expected !== undefined && token.text !== expected)
      fail(token.from, `"${token.text}" stands where "${expected}" is expected`);
    next++;
    return token;
  };
  const endOfLast = () => tokens[next - 1].to;

  /** Skips the bracket that is next, with all that it encloses. */
  const skipBracket = () => {
    const open = take();
    for (const close = CLOSING[open.text]; peek() !== close;) skipToken();
    take();
  };
  const skipToken = () => {
    if (peek() === undefined) fail(text.length, 'the file ends inside of a bracket');
    if (peek() === '@' && /^(if|elif|else)$/.test(tokens[next + 1]?.text ?? ''))
      fail(
        here(),
        `@${tokens[next + 1].text} stands where no declaration, member, parameter, statement or import begins`,
      );
    if (peek() in CLOSING && peek() !== '<') skipBracket();
    else take();
  };
  const skipTo = (...ends) => {
    while (!ends.includes(peek())) skipToken();
  };

  /** `(A && !B)` as the composer reads it, `A&&!B`. */
  const condition = () => {
    const from = take('(').from;
    const parts = [];
    do {
      if (parts.length > 0) take('&&');
      let negated = false;
      while (peek() === '!') {
        take();
        negated = !negated;
      }
      const flag = take();
      if (!/^[A-Za-z_]\w*$/.test(flag.text))
        fail(
          flag.from,
          'a condition is a flag, !flag, or several of them with && between; for || use a flag that stands for both',
        );
      parts.push(`${negated ? '!' : ''}${flag.text}`);
    } while (peek() === '&&');
    if (peek() !== ')')
      fail(
        from,
        'a condition is a flag, !flag, or several of them with && between; for || use a flag that stands for both',
      );
    take(')');
    return parts.join('&&');
  };

  /** The attributes before an element; at most one of them is a gate. */
  const attributes = () => {
    let gate;
    while (peek() === '@') {
      const { from } = take('@');
      const name = take();
      if (/^(if|elif|else)$/.test(name.text)) {
        if (gate) fail(from, 'an element has two conditions: join them by &&');
        gate = { kind: name.text, from, condition: name.text === 'else' ? undefined : condition(), to: 0 };
        gate.to = endOfLast();
      } else if (peek() === '(') skipBracket();
    }
    return gate;
  };

  const importTree = (path) => {
    const found = [];
    const branch = (before) => {
      if (peek() === '{') {
        take('{');
        while (peek() !== '}') {
          branch(before);
          if (peek() !== '}') take(',');
        }
        take('}');
        return;
      }
      const name = take();
      if (!/^[A-Za-z_]\w*$/.test(name.text)) fail(name.from, `"${name.text}" is no name to import`);
      if (peek() === '::') {
        take('::');
        branch([...before, name.text]);
      } else if (peek() === 'as') fail(here(), 'imports cannot be renamed: names are unique in all of the project');
      else found.push({ path: before, name: name.text, at: name.from });
    };
    branch(path);
    return found;
  };

  const importStatement = (from, gate) => {
    if (gate && (gate.kind !== 'if' || gate.condition.includes('&')))
      fail(from, 'an import is gated by @if(FLAG) or @if(!FLAG)');
    take('import');
    for (const { path, name, at } of importTree([])) {
      if (path.length === 0) fail(at, `"import ${name}" names no module`);
      imports.push({ path, name, flag: gate?.condition, line: text.slice(0, at).split('\n').length });
    }
    take(';');
    // Line breaks stay.
    edits.push({ from, to: endOfLast(), text: text.slice(from, endOfLast()).replace(/[^\n]+/g, '') });
  };

  const block = () => {
    take('{');
    sequence(statement, '}');
    take('}');
  };

  const declaration = () => {
    if (peek() === 'fn') {
      take();
      take();
      take('(');
      sequence(listed(')'), ')');
      take(')');
      skipTo('{');
      block();
    } else if (peek() === 'struct') {
      take();
      take();
      take('{');
      sequence(listed('}'), '}');
      take('}');
      if (peek() === ';') take();
    } else {
      if (peek() !== ';') skipTo(';');
      take(';');
    }
  };

  /** A member of a struct or a parameter. */
  const listed = (close) => () => {
    let depth = 0;
    while (depth > 0 || (peek() !== ',' && peek() !== close)) {
      if (peek() === '<') depth++;
      if (peek() === '>') depth--;
      skipToken();
    }
    if (peek() === ',') take();
  };

  const clause = () => {
    if (peek() !== 'case' && peek() !== 'default') fail(here(), `"${peek()}" stands where a case is expected`);
    skipTo('{');
    block();
  };

  const statement = () => {
    switch (peek()) {
      case '{':
        return block();
      case 'if':
      case 'for':
      case 'while':
        take();
        skipTo('{');
        block();
        while (peek() === 'else') {
          take();
          skipTo('{');
          block();
        }
        return undefined;
      case 'loop':
      case 'continuing':
        take();
        skipTo('{');
        return block();
      case 'switch':
        take();
        skipTo('{');
        take('{');
        sequence(clause, '}');
        take('}');
        return undefined;
      default:
        skipTo(';', '}');
        take(';');
        return undefined;
    }
  };

  /** Elements up to a closing bracket, or to the end of the file, with their chains of conditions. */
  const sequence = (element, close) => {
    // How many gates of the chain are open, and the condition of a chain that is one @if alone.
    let open = 0;
    let end = 0;
    let alone;
    const closeChain = () => {
      if (open > 0)
        edits.push({ from: end, to: end, text: `${'//#endif'.repeat(open)}${/\w/.test(text[end] ?? '') ? ' ' : ''}` });
      open = 0;
      alone = undefined;
    };
    while (peek() !== close) {
      if (peek() === undefined) fail(text.length, `"${close}" is missing at the end`);
      const from = here();
      const gate = attributes();
      // Neighbours of one condition share a gate.
      const shared = gate?.kind === 'if' && gate.condition === alone && peek() !== 'import';
      if ((!gate || gate.kind === 'if') && !shared) closeChain();
      if (peek() === 'import' && close === undefined) {
        importStatement(from, gate);
        continue;
      }
      if (gate) {
        if (gate.kind !== 'if' && open === 0) fail(gate.from, `@${gate.kind} without @if before it`);
        const start = gate.kind === 'if' ? '' : '//#else';
        const gap = /\s/.test(text[gate.to] ?? ' ') ? '' : ' ';
        const marks = shared ? '' : `${start}${gate.condition === undefined ? '' : `//#if ${gate.condition}`}`;
        edits.push({ from: gate.from, to: gate.to, text: `${marks}${gap}` });
        if (gate.condition !== undefined && !shared) open++;
        alone = gate.kind === 'if' ? gate.condition : undefined;
      }
      element();
      end = endOfLast();
      if (gate?.kind === 'else') closeChain();
    }
    closeChain();
  };

  sequence(declaration, undefined);
  for (const { from, to } of comments)
    if (text.slice(from, to).includes('//#')) fail(from, 'a comment must not hold "//#", which marks gates');
  return { imports, edits, comments, tokens };
}
