import { readFileSync } from 'node:fs';
import { expect, test } from 'vitest';
import { customElements } from '../scripts/custom-elements.mjs';
import { RENDER_OPTIONS, type RenderOption } from '@glanz/renderer/options';
import { attributeFault, numberIn } from '../src/attribute-checks';
import { ATTRIBUTES, camel, type AttributeName } from '../src/attributes';

const read = (path: string) => readFileSync(new URL(`../${path}`, import.meta.url), 'utf8');
const element = customElements().modules[0]!.declarations[0]!;

test('the manifest lists every attribute with its property, its type and a sentence', () => {
  expect(element.attributes.map(({ name }) => name)).toEqual(Object.keys(ATTRIBUTES));
  expect(element.attributes.find(({ name }) => name === 'camera-controls')).toMatchObject({
    fieldName: 'cameraControls',
    type: { text: 'boolean' },
  });
  expect(element.attributes.find(({ name }) => name === 'samples')).toMatchObject({
    type: { text: 'number' },
    default: '256',
  });
  expect(element.attributes.find(({ name }) => name === 'exposure')).toHaveProperty(
    'deprecated',
    expect.stringContaining('exposure-ev'),
  );
  expect(element.attributes.filter((attribute) => 'deprecated' in attribute)).toHaveLength(1);
  expect(element.attributes.find(({ name }) => name === 'loading')?.type.text).toBe("'auto' | 'lazy' | 'eager'");
  for (const [name, kind] of Object.entries(ATTRIBUTES))
    expect(
      element.members.filter(({ attribute }) => attribute === name),
      kind,
    ).toHaveLength(1);
});

test('everything in the manifest has a description', () => {
  const { attributes, members, events, slots, cssParts, cssProperties } = element;
  for (const list of [attributes, members, events, slots, cssParts, cssProperties]) {
    expect(list.length).toBeGreaterThan(2);
    for (const { name, description } of list) expect(description, name).toMatch(/\w+.*\.$/);
  }
});

test('slots, parts and CSS properties are those of the shadow tree', () => {
  const shadow = `${read('src/shadow.ts')}${read('src/prompt.ts')}`.replace(/\/\*\*[\s\S]*?\*\//g, '');
  const found = (pattern: RegExp) => [...new Set([...shadow.matchAll(pattern)].map(([, name]) => name))].sort();
  expect(element.cssProperties.map(({ name }) => name).sort()).toEqual(found(/var\((--[\w-]+)/g));
  expect(element.cssParts.map(({ name }) => name).sort()).toEqual(found(/part\.add\('([\w-]+)'\)/g));
  expect(
    element.slots
      .map(({ name }) => name)
      .filter((name) => !name.endsWith('*'))
      .sort(),
  ).toEqual(found(/slot\('([\w-]+)'/g));
});

test('methods and events are those of the README', () => {
  const readme = read('README.md');
  for (const { name } of element.events) expect(readme).toContain(`\`${name}\``);
  for (const { name, kind } of element.members)
    if (kind === 'method') expect(readme).toMatch(new RegExp(`\\b${name}\\(`));
  for (const { name } of element.attributes) expect(readme).toContain(`\`${name}\``);
});

test('attributes of render options have the values, the range and the default of the table', () => {
  const rows: Readonly<Record<string, RenderOption>> = RENDER_OPTIONS;
  const names = (Object.keys(ATTRIBUTES) as AttributeName[]).filter((name) => Object.hasOwn(rows, camel(name)));
  expect(names).toEqual(['samples', 'noise', 'max-depth', 'back-face-culling', 'shadow-softness']);
  for (const name of names) {
    const row = rows[camel(name)]!;
    const attribute = element.attributes.find((one) => one.name === name)!;
    expect(attribute.default, name).toBe(row.default?.toString());
    for (const text of ['NaN', 'Infinity', 'many']) expect(attributeFault(name, text), name).toMatch(/^(a|one of) /);
    if (row.type === 'enum') {
      expect(attribute.type.text).toBe(row.values.map((value) => `'${value}'`).join(' | '));
      for (const value of row.values) expect(attributeFault(name, value)).toBeUndefined();
    } else if (row.type === 'number' || row.type === 'integer') {
      for (const end of row.range) expect(numberIn(name, String(end))).toBe(end);
      for (const beyond of [row.range[0] - 1, row.range[1] + 1]) {
        expect(numberIn(name, String(beyond)), name).toBeUndefined();
        expect(attributeFault(name, String(beyond)), name).toContain(`from ${row.range[0]} to ${row.range[1]}`);
      }
    }
  }
});
