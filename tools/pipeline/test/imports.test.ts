import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { afterEach, describe, expect, it } from 'vitest';
import { checkImports } from '../../check-imports.mjs';
import { findCycle, readArrows, readImports } from '../imports.mjs';

const ARCHITECTURE = `| package | holds | may import |
|---|---|---|
| \`wgsl\` | x | nothing |
| \`image\` | x | \`wgsl\` (\`GlanzError\` only) |
| \`openpbr\` | x | \`wgsl\` |
| \`scene\` | x | \`openpbr\` (types only), \`wgsl\` (\`GlanzError\` only) |
| \`cli\` | x | every package above |
`;

const manifest = (name: string, dependencies: string[] = []) =>
  JSON.stringify({
    name: `@glanz/${name}`,
    exports: {
      '.': { '@glanz/source': './src/index.ts' },
      './error': { '@glanz/source': './src/error.ts' },
      './node': { '@glanz/source': './src/node.ts' },
    },
    dependencies: Object.fromEntries(dependencies.map((dependency) => [dependency, 'workspace:^'])),
  });

/** A repository in which everything is right. */
const GOOD: Record<string, string> = {
  'ARCHITECTURE.md': ARCHITECTURE,
  'package.json': '{ "devDependencies": { "vitest": "1" } }',
  'packages/wgsl/package.json': manifest('wgsl'),
  'packages/wgsl/src/index.ts': `export * from './error';\nexport * from './compose';`,
  'packages/wgsl/src/error.ts': `export class E {}`,
  'packages/wgsl/src/compose.ts': `import type { E } from './error';\nexport type C = E;`,
  'packages/image/package.json': manifest('image', ['@glanz/wgsl', 'fflate']),
  'packages/image/src/index.ts': `import { E } from '@glanz/wgsl/error';\nimport { zlibSync } from 'fflate';\nexport { E, zlibSync };`,
  'packages/openpbr/package.json': manifest('openpbr', ['@glanz/wgsl']),
  'packages/openpbr/src/index.ts': `export { compose } from '@glanz/wgsl';`,
  'packages/scene/package.json': manifest('scene', ['@glanz/openpbr', '@glanz/wgsl']),
  'packages/scene/src/index.ts': `import type { P } from '@glanz/openpbr';\nexport { E } from '@glanz/wgsl/error';\nexport type Q = P;`,
  'packages/scene/src/node.ts': `import { readFile } from 'node:fs/promises';\nexport { readFile };`,
  'packages/scene/test/scene.test.ts': `import { it } from 'vitest';\nimport '../src/index';\nimport 'node:fs';\nit;`,
  'packages/cli/package.json': manifest('cli', ['@glanz/scene']),
  'packages/cli/src/index.ts': `import 'node:fs';\nimport '@glanz/scene';\nawait import('@glanz/scene/node');`,
};

const folders: string[] = [];
afterEach(() => folders.splice(0).forEach((folder) => rmSync(folder, { recursive: true })));

async function judge(changes: Record<string, string>) {
  const base = mkdtempSync(join(tmpdir(), 'glanz-imports-'));
  folders.push(base);
  for (const [file, text] of Object.entries({ ...GOOD, ...changes })) {
    mkdirSync(dirname(join(base, file)), { recursive: true });
    writeFileSync(join(base, file), text);
  }
  const { lines } = await checkImports(base);
  return lines.join('\n');
}

describe('the import check', () => {
  it('lets sources import what the build puts into the package, which must be installed for it', async () => {
    const source = {
      'packages/image/src/index.ts': `import { E } from '@glanz/wgsl/error';\nimport { zlibSync } from 'fflate';\nimport decode from 'draco';\nexport { E, zlibSync, decode };`,
    };
    const bundled = (more: object) => ({
      ...source,
      'packages/image/package.json': JSON.stringify({
        ...JSON.parse(manifest('image', ['@glanz/wgsl', 'fflate'])),
        ...more,
      }),
    });
    expect(await judge(source)).toContain('"draco" is not declared');
    expect(await judge(bundled({ glanz: { bundled: ['draco'] }, devDependencies: { draco: '1' } }))).toBe('');
    expect(await judge(bundled({ glanz: { bundled: ['draco'] } }))).toContain('not among devDependencies');
  });

  it('has nothing to say about a repository without faults', async () => {
    expect(await judge({})).toBe('');
  });

  it.each<[string, Record<string, string>, RegExp]>([
    [
      'an import that the table does not allow',
      {
        'packages/openpbr/src/bad.ts': `import '@glanz/scene';`,
        'packages/openpbr/package.json': manifest('openpbr', ['@glanz/wgsl', '@glanz/scene']),
      },
      /openpbr\/src\/bad.ts:1: openpbr → scene is not in the table/,
    ],
    [
      'a dependency that the table does not allow',
      { 'packages/openpbr/package.json': manifest('openpbr', ['@glanz/wgsl', '@glanz/image']) },
      /@glanz\/image is not in the table/,
    ],
    [
      'values where only types may come',
      { 'packages/scene/src/bad.ts': `\nimport { P } from '@glanz/openpbr';` },
      /bad.ts:2: scene → openpbr is for types only/,
    ],
    [
      'more than the errors',
      { 'packages/image/src/bad.ts': `import '@glanz/wgsl';` },
      /image may import @glanz\/wgsl\/error and nothing else/,
    ],
    [
      'an entry that does not exist',
      { 'packages/openpbr/src/bad.ts': `import '@glanz/wgsl/src/compose';` },
      /not exported by @glanz\/wgsl/,
    ],
    [
      'a reach into another package',
      { 'packages/openpbr/src/bad.ts': `import '../../wgsl/src/compose';` },
      /reaches outside of its package/,
    ],
    [
      'a reach from a test',
      { 'packages/openpbr/test/bad.test.ts': `import '../../wgsl/src/compose';` },
      /reaches outside of its package/,
    ],
    ['an undeclared package', { 'packages/openpbr/src/bad.ts': `import 'fflate';` }, /"fflate" is not declared/],
    [
      'a declared package that nobody uses',
      { 'packages/openpbr/package.json': manifest('openpbr', ['@glanz/wgsl', 'fflate']) },
      /the dependency fflate is never imported/,
    ],
    [
      'Node in a browser file',
      { 'packages/image/src/bad.ts': `export const f = () => import('fs');` },
      /Node's modules belong/,
    ],
    [
      'a browser entry that leads to Node',
      { 'packages/scene/src/error.ts': `export * from './node';` },
      /@glanz\/scene\/error reaches src\/node.ts/,
    ],
    [
      'a circle of files',
      {
        'packages/wgsl/src/error.ts': `import { c } from './compose';\nexport class E { c = c }`,
        'packages/wgsl/src/compose.ts': `import { E } from './error';\nexport const c = E;`,
      },
      /circle: src\/compose.ts → src\/error.ts → src\/compose.ts/,
    ],
    [
      'a circle of types',
      { 'packages/wgsl/src/error.ts': `import type { C } from './compose';\nexport class E { c?: C }` },
      /circle: src\/compose.ts → src\/error.ts → src\/compose.ts/,
    ],
    [
      'a circle of folders',
      {
        'packages/wgsl/src/a/one.ts': `import '../b/two';`,
        'packages/wgsl/src/b/two.ts': `export {};`,
        'packages/wgsl/src/b/three.wesl': `import package::a::four::{f};\n`,
        'packages/wgsl/src/a/four.wesl': `fn f() {}\n`,
      },
      /wgsl: folders.*a\/one.ts imports b\/two.ts, b\/three.wesl imports a\/four.wesl/,
    ],
    [
      'a circle of packages',
      { 'ARCHITECTURE.md': ARCHITECTURE.replace('| nothing |', '| `scene` |') },
      /packages import each other in a circle/,
    ],
    ['a package without a row', { 'packages/new/package.json': manifest('new') }, /packages\/new has no row/],
    [
      'a row without a package',
      { 'ARCHITECTURE.md': `${ARCHITECTURE}| \`gone\` | x | nothing |\n` },
      /packages\/gone, which does not exist/,
    ],
  ])('reports %s', async (_what, changes, message) => {
    expect(await judge(changes)).toMatch(message);
  });
});

describe('its parts', () => {
  it('reads every kind of import, and whether types only come of it', () => {
    const text = `import a from 'a';
import type { b } from 'b';
import { type c, type d } from 'c';
import { type e, f } from 'd';
export * from 'e';
export type { g } from 'f';
const h = await import('g');
type I = import('h').I;
import 'i';
const text = "import 'not this'";`;
    expect(readImports(text).map(({ specifier, line, typeOnly }) => [specifier, line, typeOnly])).toEqual([
      ['a', 1, false],
      ['b', 2, true],
      ['c', 3, true],
      ['d', 4, false],
      ['e', 5, false],
      ['f', 6, true],
      ['g', 7, false],
      ['h', 8, true],
      ['i', 9, false],
    ]);
  });

  it('reads the arrows of the real table', async () => {
    const { readFileSync } = await import('node:fs');
    const arrows = readArrows(readFileSync(new URL('../../../ARCHITECTURE.md', import.meta.url), 'utf8'));
    expect(Object.fromEntries([...arrows].map(([name, row]) => [name, [...row.keys()].sort()]))).toMatchObject({
      wgsl: [],
      bvh: ['wgsl'],
      gltf: ['openpbr', 'scene'],
      renderer: ['bvh', 'openpbr', 'scene', 'tonemap', 'wgsl'],
    });
    expect(arrows.get('scene')?.get('openpbr')).toEqual({ typesOnly: true, errorOnly: false });
    // "Every package above", and none below.
    expect([...(arrows.get('cli')?.keys() ?? [])].sort()).toEqual(
      [...arrows.keys()].slice(0, [...arrows.keys()].indexOf('cli')).sort(),
    );
  });

  it('finds circles, and only circles', () => {
    const graph: Record<string, string[]> = { a: ['b', 'c'], b: ['d'], c: ['d'], d: [] };
    expect(findCycle(Object.keys(graph), (node: string) => graph[node] ?? [])).toBeUndefined();
    graph['d'] = ['b'];
    expect(findCycle(Object.keys(graph), (node: string) => graph[node] ?? [])).toEqual(['b', 'd', 'b']);
  });
});
