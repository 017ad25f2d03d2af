import { execFileSync } from 'node:child_process';
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { expect, it } from 'vitest';
import { checkWesl } from '../../check-wesl.mjs';
import { brokenRules, hasGates } from '../wesl-rules.mjs';

const broken = (text: string) => brokenRules(text, 'a.wesl');
const lines = (count: number, line: string) => `${line}\n`.repeat(count);

it('a function has at most 120 lines', () => {
  expect(broken(`fn f() {\n${lines(118, '  g();')}}`)).toEqual([]);
  expect(broken(`\nfn f() {\n${lines(119, '  g();')}}\nfn g() {}`)).toEqual(['a.wesl:2: f has 121 lines, at most 120']);
});

it('a function has at most five conditions in its body; neighbours of one condition are one', () => {
  const five = '@if(A) a(); @if(A) b(); c(); @if(A) { if (x) { @if(B) d(); } } @if(C) e(); @elif(D) f(); @else g();';
  expect(broken(`@if(Z) fn f(@if(Y) a: u32) {\n${five} }\nfn g() {\n${five} }`)).toEqual([]);
  expect(broken(`fn f() {\n${five} @if(E) h(); }`)).toEqual(['a.wesl:1: f has 6 conditions in its body, at most 5']);
});

it('a line has at most 120 columns, of characters', () => {
  expect(broken(`// ${'√'.repeat(117)}`)).toEqual([]);
  expect(broken(`\n// ${'x'.repeat(118)}`)).toEqual(['a.wesl:2: 121 columns, at most 120']);
});

it('gates are recognised', () => {
  expect(hasGates('const a = `\n  //#if A\n`;')).toBe(true);
  expect(hasGates('const a = `x //#else y`;')).toBe(true);
  expect(hasGates('// if\n//# if\n//#elsewhere')).toBe(false);
});

it('files that break a rule are named; gates belong to the composer', async () => {
  const base = mkdtempSync(join(tmpdir(), 'glanz-wesl-'));
  try {
    const put = (file: string, text: string) => {
      mkdirSync(dirname(join(base, file)), { recursive: true });
      writeFileSync(join(base, file), text);
    };
    execFileSync('git', ['init', '-q', base]);
    put('packages/a/src/a.wesl', 'fn a() {}');
    put('packages/a/src/a.ts', '`fn a() {}`');
    put('packages/wgsl/src/compose.ts', '// //#if is read');
    expect((await checkWesl(base)).lines).toEqual([]);

    put('packages/a/test/new.ts', '`//#if A\n`');
    put('packages/a/src/wrong.wesl', 'fn a( {}');
    const { lines: found } = await checkWesl(base);
    expect(found).toHaveLength(2);
    expect(found.join('\n')).toMatch(/wrong\.wesl:1: /);
    expect(found.join('\n')).toMatch(/test\/new\.ts: gates/);
  } finally {
    rmSync(base, { recursive: true, force: true });
  }
});
