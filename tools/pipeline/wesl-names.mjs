// Short names for what is local to the functions of a shader, for what is published: parameters, variables and
// constants inside of functions. Names that other modules, hosts or users' own WGSL may use stay: those of functions,
// structs, members, constants of a module.

/** Names that are never given: the keywords of WGSL with at most two letters, and `_`. */
const KEYWORDS = new Set(['_', 'do', 'fn', 'if', 'as', 'is', 'of']);

/** a, b, … z, A, … Z, aa, ab, … */
function* shortNames() {
  const letters = 'abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ';
  for (const letter of letters) yield letter;
  for (const first of letters) for (const second of letters) yield first + second;
}

/**
 * @param {{ text: string, from: number, to: number }[]} tokens Of a WESL file, without comments.
 * @returns {{ from: number, to: number, text: string }[]} Replacements of names, each line in its place.
 */
export function shortenLocals(tokens) {
  const edits = [];
  const identifiers = new Set(tokens.map(({ text }) => text));
  const text = (i) => tokens[i]?.text;
  let i = 0;

  /** The place after the bracket that opens at `at`. */
  const afterBracket = (at) => {
    let depth = 0;
    do {
      if ('([{'.includes(text(at))) depth++;
      if (')]}'.includes(text(at))) depth--;
      at++;
    } while (depth > 0 && at < tokens.length);
    return at;
  };

  const functionAt = () => {
    const names = new Map();
    const candidates = shortNames();
    const shortFor = (name) => {
      let short = names.get(name);
      while (short === undefined) {
        const { value } = candidates.next();
        if (value === undefined) short = name;
        else if (!identifiers.has(value) && !KEYWORDS.has(value)) short = value;
      }
      names.set(name, short);
      return short;
    };
    // Names by the block that declares them, the innermost last.
    const scopes = [new Set()];
    const declare = (name) => scopes.at(-1).add(name);
    const replace = (at) => {
      const { text: name, from, to } = tokens[at];
      const short = shortFor(name);
      if (short.length < name.length) edits.push({ from, to, text: short });
    };
    /** An attribute with its arguments, which are no names of ours. */
    const skipAttribute = () => {
      i += 2;
      if (text(i) === '(') i = afterBracket(i);
    };

    i += 2;
    // Parameters: a name before a colon, outside of types.
    for (let depth = 0; ;) {
      const token = text(i);
      if (token === '@') {
        skipAttribute();
        continue;
      }
      if (token === '(' || token === '<') depth++;
      if (token === ')' || token === '>') depth--;
      if (depth === 1 && text(i + 1) === ':' && /^[A-Za-z_]/.test(token)) {
        declare(token);
        replace(i);
      }
      i++;
      if (depth === 0) break;
    }
    while (text(i) !== '{') i += 1;

    // What a statement declares is known after it: `let x = f(x);` reads another x.
    let pending = [];
    // Depths of brackets at which the heads of loops began: their variables live as long as the block after it.
    const heads = [];
    let round = 0;
    const settle = () => {
      pending.forEach(declare);
      pending = [];
    };
    let depth = 0;
    do {
      const token = text(i);
      if (token === '@') {
        skipAttribute();
        continue;
      }
      if (token === 'for') {
        scopes.push(new Set());
        heads.push({ depth, round });
      } else if (token === '(') round++;
      else if (token === ')') round--;
      else if (token === ';') settle();
      else if (token === '{') {
        settle();
        depth++;
        scopes.push(new Set());
      } else if (token === '}') {
        settle();
        depth--;
        scopes.pop();
        if (heads.at(-1)?.depth === depth && heads.at(-1).round === round) {
          heads.pop();
          scopes.pop();
        }
      } else if (/^(let|var|const)$/.test(token)) {
        let at = i + 1;
        if (text(at) === '<') while (text(at++) !== '>');
        pending.push(text(at));
        // Up to the name; it is replaced here, since it is not known yet.
        replace(at);
        i = at;
      } else if (/^[A-Za-z_]/.test(token) && text(i - 1) !== '.' && scopes.some((scope) => scope.has(token)))
        replace(i);
      i++;
    } while (depth > 0);
  };

  while (i < tokens.length) {
    if (text(i) === 'fn') functionAt();
    else i++;
  }
  return edits;
}
