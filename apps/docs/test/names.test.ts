import { readFileSync } from 'node:fs';
import ts from 'typescript';
import { expect, test } from 'vitest';
import { ATTRIBUTES } from '@glanz/element';
import { RENDER_OPTION_TEXTS, RENDER_OPTIONS } from '@glanz/renderer/options';
import { isToneMap } from '@glanz/tonemap';
import { optionRows } from '../src/option-rows';
import { readExport } from '../src/read-export';

/** The manual of the command line. */
const help = (await readExport('../../../packages/cli/src/help.ts', 'HELP')) as string;

const read = (path: string) => readFileSync(new URL(`../../../${path}`, import.meta.url), 'utf8');
const camel = (name: string) => name.replace(/-([a-z])/g, (_, letter: string) => letter.toUpperCase());
const page = read('apps/docs/guide/names.md');

/** Cells of the rows of all tables with six columns of names. */
const rows = page
  .split('\n')
  .filter((line) => line.startsWith('| ') && line.split('|').length === 9 && !line.includes('| viewer |'))
  .map((line) => line.split('|').slice(1, -1));
const column = (index: number) =>
  rows.flatMap((cells) => [...cells[index]!.matchAll(/`([^`]+)`/g)].map(([, name]) => name!));
const [viewer, element, react, commandLine, query] = [1, 2, 3, 4, 5].map(column) as [
  string[],
  string[],
  string[],
  string[],
  string[],
];

/** Names of the members of an interface or of a class, and their comments' tags. */
function members(path: string, of: string): Map<string, string[]> {
  const source = ts.createSourceFile(path, read(path), ts.ScriptTarget.Latest, true);
  const found = source.statements.find(
    (one) => (ts.isInterfaceDeclaration(one) || ts.isClassDeclaration(one)) && one.name?.text === of,
  ) as ts.InterfaceDeclaration | ts.ClassDeclaration;
  return new Map(
    [...found.members].flatMap((one) =>
      one.name ? [[one.name.getText(), ts.getJSDocTags(one).map(({ tagName }) => tagName.text)] as const] : [],
    ),
  );
}
const VIEWER = 'packages/viewer/src/';
const options = members(`${VIEWER}options.ts`, 'ViewerOptions');
const inViewer = [options, members(`${VIEWER}viewer.ts`, 'Viewer')];
const inElement = members('packages/element/src/api.ts', 'GlanzViewerElement');

test('the page lists every setting of the viewer, every attribute, and every name of the playground', () => {
  const present = Object.keys(ATTRIBUTES).filter((name) => name !== 'exposure');
  const address = read('apps/playground/src/state/address.ts');
  const queries = [...address.matchAll(/query(?:\.get\(|, )'([\w-]+)'/g)].map(([, name]) => name);
  expect(queries.length).toBeGreaterThan(10);
  expect(
    [...options.keys()].filter((name) => !viewer.includes(name)),
    'options of the viewer',
  ).toEqual([]);
  expect(
    present.filter((name) => !element.includes(name)),
    'attributes',
  ).toEqual([]);
  expect(
    present.map(camel).filter((name) => !react.includes(name)),
    'props',
  ).toEqual([]);
  expect([...new Set(query)].sort()).toEqual([...new Set(queries)].sort());
});

test('every name on the page exists', () => {
  const bare = (name: string) => name.replace(/\(\)$/, '');
  expect(
    viewer.map(bare).filter((name) => !inViewer.some((known) => known.has(name))),
    'viewer',
  ).toEqual([]);
  expect(
    element.map(bare).filter((name) => !(name in ATTRIBUTES) && !inElement.has(name)),
    'element',
  ).toEqual([]);
  expect(
    react.filter((name) => !Object.keys(ATTRIBUTES).map(camel).includes(name)),
    'React',
  ).toEqual([]);
  expect(
    commandLine.filter(
      (name) => !(name.startsWith('--') ? new RegExp(`^\\s+(-\\w, )?${name} `, 'm') : new RegExp(name)).test(help),
    ),
    'command line',
  ).toEqual([]);
  const tones = [...rows.find(([what]) => what!.trim() === 'tone map')![6]!.matchAll(/`(\w+)`/g)].map(
    ([, name]) => name!,
  );
  expect([tones.length, tones.every(isToneMap)]).toEqual([5, true]);
});

test('former names are marked as deprecated where editors look, and are no longer in the tables', () => {
  expect(inElement.get('exposure')).toContain('deprecated');
  expect(members('packages/react/src/glanz-viewer.ts', 'GlanzViewerProps').get('exposure')).toContain('deprecated');
  expect([...element, ...react, ...commandLine, ...query.filter((name) => name !== 'exposure')]).not.toEqual(
    expect.arrayContaining([expect.stringMatching(/^(exposure|--tonemap|tonemap|--depth)$/)]),
  );
});

test('the default time of a submission is the same in the renderer, in the viewer and on the pages', () => {
  const pages = ['performance.md', 'progressive.md'].map((file) => `apps/docs/guide/${file}`);
  expect(/GPU time of one submission.*default (\d+)/.exec(page)?.[1]).toBe(String(RENDER_OPTIONS.maxSubmitMs.default));
  for (const file of [...pages, 'packages/renderer/README.md'])
    expect(/`maxSubmitMs`(?: of GPU time)?,? \(?(\d+)/.exec(read(file))?.[1], file).toBe(
      String(RENDER_OPTIONS.maxSubmitMs.default),
    );
});

test('the page of render options lists every row of the table, with its names on the command line and the element', () => {
  const listed = optionRows(RENDER_OPTIONS, RENDER_OPTION_TEXTS, Object.keys(ATTRIBUTES), help);
  expect(listed.map(({ name }) => name)).toEqual(Object.keys(RENDER_OPTIONS));
  for (const row of listed) {
    expect(row.doc.length, row.name).toBeGreaterThan(20);
    expect(`${row.type}${row.values}${row.default}`, row.name).not.toMatch(/undefined|\[object|NaN/);
  }
  expect(listed.filter(({ flag }) => flag === '').map(({ name }) => name)).toEqual(['maxSubmitMs', 'aovs']);
  expect(listed.filter(({ attribute }) => attribute !== '').map(({ attribute }) => attribute)).toEqual(
    Object.keys(ATTRIBUTES).filter((name) => Object.hasOwn(RENDER_OPTIONS, camel(name))),
  );
  expect(listed.find(({ name }) => name === 'maxDepth')).toMatchObject({
    type: 'integer',
    values: '1 … 65,535',
    default: '8',
    flag: '--max-depth',
    attribute: 'max-depth',
    effect: 'uniform',
    biased: false,
  });
});
