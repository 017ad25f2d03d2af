import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, relative, resolve } from 'node:path';
import { build } from 'esbuild';
import { describe, expect, it } from 'vitest';
import { compileWesl, weslSource, WeslError } from '../wesl.mjs';
import { constantFiles, declarationFile, declareConstants, readConstants } from '../wesl-constants.mjs';

const root = resolve(import.meta.dirname, '../../..');
const read = (text: string, file?: string) => readConstants(text, file);
const values = (text: string) => Object.fromEntries(read(text)!.map(({ name, value }) => [name, value]));

describe('a table of constants', () => {
  it('has numbers, booleans, vectors and arrays', () => {
    expect(
      values(`// A comment.
        const COUNT = 16u; const MASK: u32 = 0xff00ffffu;
        const LOW: i32 = -3; const HALF = .5; const STEP = 1.25e-3f; const ON = true;
        const AXIS = vec3f(0.0, -1.0, 2.5);
        const NODES: array<vec2<f32>, 2> = array<vec2<f32>, 2>(vec2<f32>(0.5, 1), vec2<f32>(1.5, 2.0),);
        const PRIMES = array(2u, 3u, 5u);`),
    ).toEqual({
      COUNT: 16,
      MASK: 0xff00ffff,
      LOW: -3,
      HALF: 0.5,
      STEP: 1.25e-3,
      ON: true,
      AXIS: [0, -1, 2.5],
      NODES: [
        [0.5, 1],
        [1.5, 2],
      ],
      PRIMES: [2, 3, 5],
    });
  });

  it('is a file that holds nothing else', () => {
    for (const text of ['', 'const X = 1;\nfn f() {}', 'import package::a::X;\nconst Y = 1;', '@if(A) const X = 1;'])
      expect(read(text, '/src/lights.wesl')).toBeUndefined();
  });

  it.each([
    ['const A = 1;\nfn f() {}', /src\/constants\.wesl:2: "fn" stands in a table of constants/],
    ['@if(A) const A = 1;', /:1: "@" stands in a table/],
    ['', /:1: it holds no constant/],
    ['const A = 1;\nconst A = 2;', /:2: A is declared twice/],
    ['const A = 2.0\n * B;', /:2: "\*" follows the literal/],
    ['const A = B;', /:1: "B" is no number/],
    ['const A = f32(1);', /:1: a table of constants converts no values/],
    ['const A = - B;', /:1: "B" is no literal/],
    ['const A = array<u32, 3>(\n1u, 2u);', /:1: 2 values stand where 3 are expected/],
    ['const A = vec3f(1.0);', /:1: 1 values stand where 3 are expected/],
    ['const A = array<f32, N>(1.0);', /:1: the length of an array is a literal/],
    ['const A = array(1, true);', /:1: the elements are of several types/],
    ['const A: u32 = -1;', /:1: -?1 is out of range/],
    ['const A = 4294967296u;', /:1: 4294967296u is out of range/],
    ['const A: i32 = 1.5;', /:1: 1\.5 is no i32/],
    ['const A: i32 = 1u;', /:1: 1u is no i32/],
    ['const A: bool = 1;', /:1: 1 is no bool/],
    ['const A: vec2f = 1.0;', /:1: a number stands where several/],
    ['const A = 1', /:1: "the end" follows/],
  ])('with anything else is an error with file and line: %j', (text, message) => {
    expect(() => read(text, '/src/constants.wesl')).toThrow(WeslError);
    expect(() => read(text, '/src/constants.wesl')).toThrow(message);
  });

  it('is declared to TypeScript with its comments', () => {
    expect(
      declareConstants(
        '// Not it.\n\n// How many,\n// at most.\nconst A = 1u;\n// Where.\nconst B = array(vec2f(1.0, 2.0));',
        'constants.wesl',
      ),
    ).toBe(`import type { WgslModule } from '@glanz/wgsl';

/**
 * How many,
 * at most.
 */
export const A: number;
/** Where. */
export const B: readonly (readonly [number, number])[];

declare const module: WgslModule;
export default module;
`);
  });

  const files = constantFiles(root);
  it('there is one', () => expect(files.length).toBeGreaterThan(0));
  it.each(files.map((file) => relative(root, file)))(
    '%s is declared: node tools/pipeline/wesl-constants.mjs',
    (name) => {
      const file = join(root, name);
      expect(readFileSync(declarationFile(file), 'utf8')).toBe(declareConstants(readFileSync(file, 'utf8'), file));
    },
  );
});

describe('its module', () => {
  /** The bundle of a page that imports from a table. */
  async function bundled(page: string): Promise<string> {
    const folder = mkdtempSync(join(tmpdir(), 'glanz-wesl-'));
    try {
      writeFileSync(join(folder, 'package.json'), '{ "name": "@glanz/scenery" }');
      writeFileSync(join(folder, 'constants.wesl'), 'const A = 1234u;\nconst B = vec2f(5678.0, 1.0);');
      const { outputFiles } = await build({
        stdin: { contents: page, resolveDir: folder },
        bundle: true,
        format: 'esm',
        minify: true,
        write: false,
        external: ['@glanz/wgsl/module'],
        plugins: [weslSource({ shrink: true })],
      });
      return outputFiles[0]!.text;
    } finally {
      rmSync(folder, { recursive: true, force: true });
    }
  }

  it('exports each constant, and its text keeps its lines', () => {
    const { code } = compileWesl('\nconst A = 1234u;\n', join(root, 'packages/openpbr/src/tables/constants.wesl'));
    expect(code.split('\n')[1]).toBe('const A = 1234u;');
    expect(code).toMatch(/\nexport const A = 1234;\n$/);
  });

  it('costs what is used of it', async () => {
    const one = await bundled("import { A } from './constants.wesl'; console.log(A);");
    expect(one).toContain('1234');
    expect(one).not.toMatch(/5678|const A|wgslModule\(/);
    const text = await bundled("import table from './constants.wesl'; console.log(table);");
    expect(text.match(/1234/g)).toHaveLength(1);
    expect(text.match(/5678/g)).toHaveLength(1);
    expect(await bundled("import * as all from './constants.wesl'; export const x = 1;")).not.toMatch(/1234|5678/);
  });
});
