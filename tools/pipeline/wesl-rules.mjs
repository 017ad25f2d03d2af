// What a reader of a shader source may count on: short functions, few conditions in each, lines that fit.
import { parseWesl } from './wesl.mjs';

/** A function's lines, the conditions in its body, and the columns of a line, at most. */
export const LIMITS = { lines: 120, gates: 5, columns: 120 };

/**
 * What of a WESL file breaks a limit. A chain of `@if`, `@elif`, `@else` counts its conditions, and neighbours of one
 * condition count once, as they make one gate.
 *
 * @param {string} text
 * @param {string} file For messages.
 * @returns {string[]} Messages.
 * @throws {import('./wesl.mjs').WeslError}
 */
export function brokenRules(text, file) {
  const { tokens, edits } = parseWesl(text, file);
  const messages = [];
  const lineOf = (at) => text.slice(0, at).split('\n').length;
  for (const [i, line] of text.split('\n').entries())
    if ([...line].length > LIMITS.columns)
      messages.push(`${file}:${i + 1}: ${[...line].length} columns, at most ${LIMITS.columns}`);
  for (let i = 0; i < tokens.length; i++) {
    if (tokens[i].text !== 'fn') continue;
    const { from } = tokens[i];
    const name = tokens[i + 1].text;
    while (tokens[i].text !== '{') i++;
    const body = tokens[i].from;
    for (let depth = 0; ; i++) {
      if (tokens[i].text === '{') depth++;
      if (tokens[i].text === '}' && --depth === 0) break;
    }
    const { to } = tokens[i];
    const lines = lineOf(to) - lineOf(from) + 1;
    if (lines > LIMITS.lines)
      messages.push(`${file}:${lineOf(from)}: ${name} has ${lines} lines, at most ${LIMITS.lines}`);
    const gates = edits
      .filter((edit) => edit.from > body && edit.from < to)
      .reduce((sum, edit) => sum + edit.text.split('//#if').length - 1, 0);
    if (gates > LIMITS.gates)
      messages.push(`${file}:${lineOf(from)}: ${name} has ${gates} conditions in its body, at most ${LIMITS.gates}`);
  }
  return messages;
}

/** Whether a source begins, turns or ends a gate of the composer. */
export const hasGates = (text) => /\/\/#(if|else|endif)\b/.test(text);
