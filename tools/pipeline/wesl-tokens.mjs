// The tokens of a WESL file.

/** A `.wesl` file that cannot be turned into a module: what is wrong, with file and line. */
export class WeslError extends Error {
  name = 'WeslError';
}

const TOKEN = /\/\/[^\n]*|\/\*|[A-Za-z_]\w*|(?:\d|\.\d)(?:[eEpP][-+]|[\w.])*|::|&&|\|\||\S/g;

/**
 * Tokens with their places. Comments are listed apart.
 *
 * @param {string} text
 * @param {(at: number, message: string) => never} fail
 */
export function tokenize(text, fail) {
  const tokens = [];
  const comments = [];
  TOKEN.lastIndex = 0;
  for (let match; (match = TOKEN.exec(text));) {
    const from = match.index;
    if (match[0] === '/*') {
      // They nest.
      let depth = 0;
      const edge = /\/\*|\*\//g;
      edge.lastIndex = from;
      for (let found; (found = edge.exec(text));) {
        depth += found[0] === '/*' ? 1 : -1;
        if (depth === 0) break;
      }
      if (depth !== 0) fail(from, 'a block comment never ends');
      comments.push({ from, to: edge.lastIndex });
      TOKEN.lastIndex = edge.lastIndex;
    } else if (match[0].startsWith('//')) comments.push({ from, to: TOKEN.lastIndex });
    else tokens.push({ text: match[0], from, to: TOKEN.lastIndex });
  }
  return { tokens, comments };
}
