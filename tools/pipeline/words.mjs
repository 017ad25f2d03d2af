/**
 * A word to avoid: where it stands, and what to say in its place.
 * @typedef {{ pattern: RegExp, say: string }} Word
 */

/**
 * Reads the words from the table "avoid | say" of CONTRIBUTING.md, so that the text and the check cannot drift apart.
 * Each entry between backquotes in the first column is a word or phrase, found in comments, texts and as a part of
 * names (`image` in `readImageOf`), with any ending of `…`. In a row that says "as names" they are common words, which
 * are found where something is declared by that name, alone or with others (as in `uniqueNameOf`).
 *
 * @param {string} markdown
 * @returns {Word[]}
 */
export function readWords(markdown) {
  const rows = markdown.split('\n');
  const head = rows.findIndex((row) => /^\| *avoid *\| *say *\|/.test(row));
  const words = [];
  for (let i = head + 2; head >= 0 && rows[i]?.startsWith('|'); i++) {
    const [, avoid, say] = rows[i].split('|').map((cell) => cell.trim());
    for (const [, phrase] of avoid.matchAll(/`([^`]+)`/g))
      words.push({ pattern: /\bas names$/.test(avoid) ? namePatternOf(phrase) : patternOf(phrase), say });
  }
  return words;
}

/** @param {string} phrase Words; one that ends in `…` may have any ending. */
function patternOf(phrase) {
  const open = phrase.endsWith('…');
  const stem = phrase.replace(/…$/, '').replaceAll(' ', '\\s+');
  const capital = stem[0].toUpperCase() + stem.slice(1);
  // A word by itself or at the start of a name, or with a capital inside of a name; `<picture>` is HTML.
  return new RegExp(`(?<![A-Za-z]|</?)${stem}${open ? '' : '(?![a-z])'}|${capital}${open ? '' : '(?![a-z])'}`, 'g');
}

/** @param {string} name What stands before it must declare a name: a keyword, a bracket, a comma or a `#`. */
function namePatternOf(name) {
  const capital = name[0].toUpperCase() + name.slice(1);
  const declared = `(?<=\\b(?:const|let|var|fn|function|readonly|class|interface|type)\\s+[[{]?\\s*|[({,]\\s*|#)${name}(?=\\??\\s*[:=(,}\\]])`;
  return new RegExp(`${declared}|\\b${name}(?=[A-Z_]\\w)|(?<=[a-z])${capital}(?![a-z])`, 'g');
}

/** @param {string} text @param {readonly Word[]} words */
export function findWords(text, words) {
  const found = [];
  for (const { pattern, say } of words)
    for (const { 0: word, index } of text.matchAll(pattern))
      found.push({ line: text.slice(0, index).split('\n').length, word, say });
  return found.sort((a, b) => a.line - b.line);
}
