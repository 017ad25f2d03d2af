import { describe, expect, it } from 'vitest';
import { findWords, readWords } from '../words.mjs';

const TABLE = `# Title

| avoid | say |
|---|---|
| \`image…\` | image, texture or frame |
| \`again\`, \`by and by\` | again |
| \`most\`, \`wanted\` as names | max, requested |

| other | table |
|---|---|
| \`word\` | x |
`;
const found = (text: string) => findWords(text, readWords(TABLE)).map(({ line, word, say }) => [line, word, say]);

describe('words to avoid', () => {
  it('are read from their table alone', () => {
    expect(readWords(TABLE).map(({ say }) => say)).toEqual([
      'image, texture or frame',
      'again',
      'again',
      'max, requested',
      'max, requested',
    ]);
    expect(readWords('no table')).toEqual([]);
  });

  it('are found in texts and as parts of names, in each form', () => {
    const say = 'image, texture or frame';
    expect(found('// An image.\nconst imageOf = readImages(images);')).toEqual([
      [1, 'image', say],
      [2, 'image', say],
      [2, 'Image', say],
      [2, 'image', say],
    ]);
    expect(found('Rendered again,\nby\n * and by')).toEqual([[1, 'again', 'again']]);
    expect(found('it goes by  and by')).toEqual([[1, 'by  and by', 'again']]);
  });

  it('are found as names alone where the row says so', () => {
    const say = 'max, requested';
    expect(found('let most = 1;\nconst wanted: u32;\nf({ wanted, most: 1 });\nthis.#most(mostOf, leafMost)')).toEqual([
      [1, 'most', say],
      [2, 'wanted', say],
      [3, 'most', say],
      [3, 'wanted', say],
      [4, 'most', say],
      [4, 'most', say],
      [4, 'Most', say],
    ]);
    expect(found('fn f(a: u32, wanted: u32)\nconst [low, most] = x;').map(([line]) => line)).toEqual([1, 2]);
    expect(found('// At most: the pixel that has most, (most of them), is not wanted. Almost (mostly)')).toEqual([]);
  });

  it('are not found inside of other words, or where they mean something else', () => {
    expect(found('<picture><img></picture> a new one, renewal, depicturer')).toEqual([]);
  });
});
