import { readFileSync } from 'node:fs';
import { expect, test } from 'vitest';
import { othersNote, sortFiles } from '../src/input/sort-files';

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

test('models that come with the one that is shown are named; files that it may refer to are not', () => {
  const given = (...paths: string[]) => sortFiles(new Map(paths.map((path) => [path, new File([''], path)])));
  const two = given('b.glb', 'a.gltf', 'a.bin');
  expect([two.model?.entry, two.others]).toEqual(['a.gltf', ['b.glb']]);
  expect(othersNote('a.gltf', two.others!)).toBe('Of these models, "a.gltf" is shown. Open "b.glb" separately.');
  expect(given('c.glb', 'b.glb', 'a.glb').others).toEqual(['b.glb', 'c.glb']);
  expect(othersNote('a.glb', ['b.glb', 'c.glb'])).toContain('Open the other 2 separately.');
  // Folders keep variants of one model below it, and USD its layers beside it.
  expect(given('Duck/Duck.gltf', 'Duck/embedded/Duck.gltf').others).toBeUndefined();
  expect(given('chair.usda', 'legs.usda').others).toBeUndefined();
});
