/** A word to avoid: where it stands, and what to say in its place. */
export interface Word {
  readonly pattern: RegExp;
  readonly say: string;
}

/** Reads the words from the table "avoid | say" of CONTRIBUTING.md. */
export function readWords(markdown: string): Word[];

/** The words to avoid in a text, by lines. */
export function findWords(text: string, words: readonly Word[]): { line: number; word: string; say: string }[];
