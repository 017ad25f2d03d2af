import { readdirSync, readFileSync } from 'node:fs';
import { expect, it } from 'vitest';

/** The folder whose shaders may index a buffer; others call functions of that folder. */
const OWNERS: Readonly<Record<string, string>> = {
  nodes: 'storage',
  triangles: 'storage',
  instances: 'storage',
  attributes: 'storage',
  materials: 'storage',
  lights: 'lights',
  light_index: 'lights',
};

const src = new URL('../../src/', import.meta.url);
const shaders = readdirSync(src, { recursive: true, encoding: 'utf8' })
  .filter((file) => file.endsWith('.wesl') && !file.endsWith('host.wesl'))
  .map((file) => ({ file: file.replaceAll('\\', '/'), text: readFileSync(new URL(file, src), 'utf8') }));

it.each(Object.entries(OWNERS))('%s are read by shaders of %s/ alone', (buffer, folder) => {
  const readers = shaders.filter(({ text }) => new RegExp(`(?<![.\\w:])${buffer}\\s*\\[|&\\s*${buffer}\\b`).test(text));
  expect(readers.length).toBeGreaterThan(0);
  expect(readers.map(({ file }) => file).filter((file) => !file.startsWith(`${folder}/`))).toEqual([]);
});

it('text that TypeScript makes reads none of them', () => {
  const made = readdirSync(src, { recursive: true, encoding: 'utf8' }).filter((file) => file.endsWith('.ts'));
  for (const file of made) {
    const text = readFileSync(new URL(file, src), 'utf8');
    for (const [, template] of text.matchAll(/\/\* wgsl \*\/ `([^`]*)`/g))
      for (const buffer of Object.keys(OWNERS))
        expect(template, file).not.toMatch(new RegExp(`(?<![.\\w])${buffer}\\s*\\[`));
  }
});
