/** Control characters (C0, DEL, C1) and the marks that reverse the direction of text or break a line. */
const UNPRINTABLE = /[\p{Cc}\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069]/gu;

const hex = (character: string, digits: number) =>
  (character.codePointAt(0) as number).toString(16).padStart(digits, '0');

/**
 * Text for a terminal in which nothing is invisible: control characters appear as `\x1b` or `\u202e`. Names in files
 * can hold escape sequences, which would change colours, move the cursor or set the window's title.
 */
export const visible = (text: string): string =>
  text.replace(UNPRINTABLE, (c) => (c <= '\xff' ? `\\x${hex(c, 2)}` : `\\u${hex(c, 4)}`));

/** One line of JSON; control characters that JSON allows as they are (DEL, C1, direction marks) are escaped too. */
export const jsonLine = (value: unknown): string =>
  `${JSON.stringify(value).replace(UNPRINTABLE, (c) => `\\u${hex(c, 4)}`)}\n`;
