import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { compose, wgslModule } from '../../../packages/wgsl/src/index';
import { build } from 'esbuild';
import { afterEach, beforeEach, describe, expect, it } from 'vitest';
import { compileWesl, parseWesl, WeslError } from '../wesl.mjs';

/** The template of a compiled module, and what stands around it. */
function compiled(text: string, shrink = false) {
  const { code, map } = compileWesl(text, join(folder, 'src/shapes/ball_light.wesl'), { shrink });
  const [, head, template, tail] = /^([\s\S]*?)`([\s\S]*)`([\s\S]*)$/.exec(code)!;
  return { code, map, head: head!, tail: tail!, text: template! };
}

/** Lines that a text keeps under flags, without indentation and empty lines. */
function kept(text: string, flags: Record<string, boolean>): string[] {
  const { code } = compose([wgslModule('m', compiled(text).text)], { flags });
  return code
    .split('\n')
    .map((line) => line.trim().replace(/\s+/g, ' '))
    .filter((line) => line !== '');
}

let folder: string;
beforeEach(() => {
  folder = mkdtempSync(join(tmpdir(), 'glanz-wesl-'));
  mkdirSync(join(folder, 'src/shapes'), { recursive: true });
  writeFileSync(join(folder, 'package.json'), '{ "name": "@glanz/scenery" }');
  for (const name of ['circle', 'host', 'long_name']) writeFileSync(join(folder, `src/shapes/${name}.wesl`), '');
  writeFileSync(join(folder, 'src/light-record.ts'), '');
});
afterEach(() => rmSync(folder, { recursive: true, force: true }));

describe('conditions', () => {
  it('on declarations', () => {
    const text = '@if(A) const x = 1;\n@elif(B && !C)\nfn f() { }\n@else struct S { m: f32 }\nconst y = 2;';
    expect(kept(text, { A: true, B: true, C: false })).toEqual(['const x = 1;', 'const y = 2;']);
    expect(kept(text, { A: false, B: true, C: false })).toEqual(['fn f() { }', 'const y = 2;']);
    expect(kept(text, { A: false, B: true, C: true })).toEqual(['struct S { m: f32 }', 'const y = 2;']);
  });

  it('on members and parameters, with commas inside of types', () => {
    const text =
      'struct S {\n@if(A) a: array<vec2<f32>, 4>,\n@align(16) b: f32,\n@if(A) c: u32\n}\nfn f(@if(A) x: array<f32, 2>, y: f32) { }';
    expect(kept(text, { A: true })).toEqual([
      'struct S {',
      'a: array<vec2<f32>, 4>,',
      '@align(16) b: f32,',
      'c: u32',
      '}',
      'fn f( x: array<f32, 2>, y: f32) { }',
    ]);
    expect(kept(text, { A: false })).toEqual(['struct S {', '@align(16) b: f32,', '}', 'fn f( y: f32) { }']);
  });

  it('on statements and blocks: with all their branches, and semicolons in the head of a loop', () => {
    const text = `fn f() {
      @if(A) if (x) { a(); } else if (y) { b(); } else { c(); }
      @else for (var i = 0; i < 3; i++) { d(); }
      @if(A) { e(); @if(!B) g(); }
      @if(B) return h();
    }`;
    expect(kept(text, { A: true, B: false })).toEqual([
      'fn f() {',
      'if (x) { a(); } else if (y) { b(); } else { c(); }',
      '{ e(); g(); }',
      '}',
    ]);
    expect(kept(text, { A: false, B: true })).toEqual([
      'fn f() {',
      'for (var i = 0; i < 3; i++) { d(); }',
      'return h();',
      '}',
    ]);
  });

  it('on clauses of a switch, and beside other attributes', () => {
    const text =
      'fn f() { switch (x) {\n@if(A) case 1u: { a(); }\ndefault: { @if(A) loop { break; } }\n} }\n@if(A) @compute @workgroup_size(8, 8)\nfn main() { }';
    expect(kept(text, { A: true })).toEqual([
      'fn f() { switch (x) {',
      'case 1u: { a(); }',
      'default: { loop { break; } }',
      '} }',
      '@compute @workgroup_size(8, 8)',
      'fn main() { }',
    ]);
    expect(kept(text, { A: false })).toEqual(['fn f() { switch (x) {', 'default: { }', '} }']);
  });

  it('that neighbours share become one gate, but an @else belongs to the last of them alone', () => {
    const text = 'fn f() {\n  @if(A) a();\n  @if(A) b();\n  @else c();\n  @if(A) d();\n  e();\n  @if(A) g();\n}';
    expect(kept(text, { A: true })).toEqual(['fn f() {', 'a();', 'b();', 'd();', 'e();', 'g();', '}']);
    expect(kept(text, { A: false })).toEqual(['fn f() {', 'c();', 'e();', '}']);
    expect(compiled('@if(A) const a = 1;\n@if(A) const b = 2;\n@if(B) const c = 3;', true).text).toBe(
      '//#if A const a=1;\nconst b=2;//#endif\n//#if B const c=3;//#endif',
    );
  });

  it('leave each line at its number', () => {
    const text =
      '// one\nimport package::shapes::circle::{\n  circle,\n};\n@if(A)\nfn f() {\n  @if(B) x(); @else y();\n}\n';
    const module = wgslModule('m', compiled(text).text);
    const { code, locate } = compose([module], { flags: { A: true, B: false } });
    const line = code.split('\n').findIndex((content) => content.includes('y();')) + 1;
    expect(locate(line)).toEqual({ module: 'm', line: 7 });
  });

  it.each([
    ['fn f() {\n @else x();\n}', /:2: @else without @if before it/],
    ['@if(A) const a = 1;\nconst b = 2;\n@elif(B) const c = 3;', /:3: @elif without @if/],
    ['@if(A || B) const a = 1;', /:1: a condition is a flag/],
    ['@if(A) @if(B) const a = 1;', /:1: an element has two conditions/],
    ['fn f() {\n  x(@if(A) 1);\n}', /:2: @if stands where no declaration/],
    ['fn f() {\n  x();\n', /:3: .*missing at the end/],
    ['/* never\n', /:1: a block comment never ends/],
    ['// see //#if A\n', /:1: .*"\/\/#"/],
    [
      '@if(A) import package::shapes::circle::a;\n@else import package::shapes::circle::b;',
      /:2: an import is gated by @if/,
    ],
    ['import package::shapes::circle::a as b;', /:1: imports cannot be renamed/],
    ['\nimport package::shapes::square::a;', /:2: there is no module package::shapes::square to import a from/],
    ['import elsewhere::a;', /:1: "elsewhere" is no root/],
    ['struct S { a: f32', /:1: .*(missing at the end|ends)/],
  ])('that are wrong are errors with file and line: %j', (text, message) => {
    expect(() => compiled(text)).toThrow(WeslError);
    expect(() => compiled(text)).toThrow(message);
  });
});

describe('imports', () => {
  it('are dependencies: each module once, gated ones by their flag, TypeScript by name, hosts not at all', () => {
    const { head, tail, text } = compiled(
      'import package::shapes::{circle::{a, b}, host::c};\n@if(!FLAT) import super::long_name::d;\nimport package::light_record::Light;\n@if(FLAT) import package::light_record::Light;\nfn f() {}',
    );
    expect(head).toBe(
      'import { gated, wgslModule } from "@glanz/wgsl/module";import module0 from "./circle.wesl";import module1 from "./long_name.wesl";import { Light as module2 } from "../light-record";export default /* @__PURE__ */ wgslModule("scenery/ball-light", ',
    );
    expect(tail).toBe(
      ', [module0, /* @__PURE__ */ gated("!FLAT", module1), module2, /* @__PURE__ */ gated("FLAT", module2)]);\n',
    );
    expect(text).toBe('\n\n\n\nfn f() {}');
  });

  it('of numbers in capitals from TypeScript become literals', () => {
    const text =
      'import package::light_record::{LIGHT_SPOT, Light};\nimport package::light_record::LIGHT_SPOT;\nconst a = LIGHT_SPOT + MY_LIGHT_SPOT;';
    const { head, tail, text: template } = compiled(text, true);
    expect(head).toContain('import { LIGHT_SPOT as number0 } from "../light-record";import { Light as module0 }');
    expect(template).toBe('const a=${number0}u+MY_LIGHT_SPOT;');
    // A bundler would keep a template with a variable, but for the function.
    expect(head).toMatch(/export default \/\* @__PURE__ \*\/ \(\(\) => wgslModule\("[^"]*", $/);
    expect(tail).toBe(', [module0]))();\n');
    writeFileSync(join(folder, 'src/light-record.ts'), 'export const LIGHT_SPOT = 1 << 4;\n');
    const literal = compiled(text, true);
    expect([literal.text, literal.tail]).toEqual(['const a=16u+MY_LIGHT_SPOT;', ', [module0]);\n']);
    expect(literal.head).not.toContain('number0');
  });

  it('are listed with their lines', () => {
    expect(parseWesl('\nimport package::a::b;').imports).toEqual([
      { path: ['package', 'a'], name: 'b', flag: undefined, line: 2 },
    ]);
  });
});

describe('the text', () => {
  it('survives in the template: backticks, backslashes and ${', () => {
    const { code } = compiled('// `a` \\ ${b}\nconst x = 1;');
    expect(new Function(`return ${/`[\s\S]*`/.exec(code)![0]}`)()).toBe('// `a` \\ ${b}\nconst x = 1;');
  });

  it('is published without comments and spaces, with fewer lines', () => {
    const text =
      'const a = 1; // why\n/* and\n so */ const b = a - -a;\nfn f() {\n  @if(A && B) x = a; @else x = - b;\n}';
    expect(compiled(text, true).text).toBe('const a=1;\nconst b=a- -a;\nfn f(){//#if A&&B x=a;//#else x= -b;//#endif}');
  });

  it('means the same published, in every combination of flags', () => {
    const text =
      'fn f(@if(A)x: f32,y: f32) -> array<f32, 2> {\n  @if(A && !B) { return g(x) - -y; } @elif(B) return h(y); @else for (;;) { break; }\n}';
    for (const flags of [0, 1, 2, 3].map((bits) => ({ A: (bits & 1) > 0, B: (bits & 2) > 0 }))) {
      const [plain, shrunk] = [false, true].map((shrink) =>
        compose([wgslModule('m', compiled(text, shrink).text)], { flags }).code.replace(/\s+/g, ''),
      );
      expect(shrunk).toBe(plain);
    }
  });

  it('has a source map that leads each line to the same line of the file', () => {
    const text = 'const a = 1;\n\nconst b = 2;';
    expect(compiled(text).map).toEqual({
      version: 3,
      sources: ['ball_light.wesl'],
      sourcesContent: [text],
      names: [],
      mappings: 'AAAA;AACA;AACA',
    });
    // Lines that are left out of what is published lie between two: 2 is E, 17 takes a second digit.
    expect(
      compiled('// why\n\nconst a = 1;\nconst b = 2;\n' + '\n'.repeat(16) + 'const c = 3;', true).map.mappings,
    ).toBe('AAEA;AACA;AAiBA');
  });
});

it('vanishes from a bundle that does not use it', async () => {
  const { weslSource } = await import('../wesl.mjs');
  writeFileSync(join(folder, 'src/shapes/circle.wesl'), '@if(A) import package::shapes::long_name::b;\nfn a() {}');
  const contents =
    "import circle from './src/shapes/circle.wesl'; import name from './src/shapes/long_name.wesl'; export const unused = circle; console.log(name);";
  const { outputFiles } = await build({
    stdin: { contents: "import { x } from './entry'; console.log(x);", resolveDir: folder },
    bundle: true,
    format: 'esm',
    minify: true,
    write: false,
    external: ['@glanz/wgsl/module'],
    plugins: [
      weslSource({ shrink: true }),
      {
        name: 'entry',
        setup: (context) => {
          context.onResolve({ filter: /^\.\/entry$/ }, () => ({ path: 'entry', namespace: 'entry' }));
          context.onLoad({ filter: /.*/, namespace: 'entry' }, () => ({
            contents: `${contents.replace(' console.log(name);', '')} export const x = 1;`,
            resolveDir: folder,
          }));
        },
      },
    ],
  });
  expect(outputFiles[0]!.text).not.toMatch(/fn a|scenery/);
  expect(outputFiles[0]!.text).toMatch(/^(import[^;]*;)*var (\w)=1;console\.log\(\2\);\n$/);
});
