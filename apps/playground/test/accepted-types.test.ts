import { readFileSync } from 'node:fs';
import { expect, test } from 'vitest';
import { sortFiles } from '../src/input/sort-files';

const page = readFileSync(new URL('../index.html', import.meta.url), 'utf8');
const named = (pattern: RegExp) =>
  Object.fromEntries(
    [...page.matchAll(pattern)].map(([, kind, text]) => [kind, [...text!.matchAll(/\.[a-z]+/g)].map(([type]) => type)]),
  );
const types = named(/<dt>(\w+)<\/dt><dd>([^<]+)<\/dd>/g);

test('what the page names when files are over it, it opens as that', () => {
  expect(Object.keys(types)).toEqual(['Model', 'Environment', 'Material', 'Texture']);
  for (const [kind, part] of [
    ['Model', 'model'],
    ['Environment', 'environment'],
    ['Material', 'material'],
  ] as const) {
    expect(types[kind]!.length).toBeGreaterThan(0);
    for (const type of types[kind]!) {
      const given = sortFiles(new Map([[`a${type}`, new File([''], `a${type}`)]]));
      expect(Object.keys(given), type).toEqual([part]);
    }
  }
});

test('the file picker offers all of them', () => {
  const [, accepted] = /id="files"[^>]*accept="([^"]+)"/.exec(page)!;
  for (const type of Object.values(types).flat()) expect(accepted!.split(',')).toContain(type);
});
