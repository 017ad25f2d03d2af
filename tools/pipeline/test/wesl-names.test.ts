import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { describe, expect, it } from 'vitest';
import { parseWesl } from '../wesl.mjs';
import { shortenLocals } from '../wesl-names.mjs';

const root = fileURLToPath(new URL('../../..', import.meta.url));

function shortened(text: string): string {
  let result = text;
  for (const { from, to, text: name } of shortenLocals(parseWesl(text).tokens).sort((a, b) => b.from - a.from))
    result = result.slice(0, from) + name + result.slice(to);
  return result;
}

describe('names inside of functions', () => {
  it('are short: parameters, variables, constants, variables of loops', () => {
    expect(
      shortened(
        'fn area(width: f32, height: f32) -> f32 { const half = 0.5; var sum: f32 = half; for (var step = 0u; step < 2u; step++) { let part = width * height; sum += part; } return sum; }',
      ),
    ).toBe(
      'fn area(a: f32, b: f32) -> f32 { const c = 0.5; var d: f32 = c; for (var e = 0u; e < 2u; e++) { let g = a * b; d += g; } return d; }'.replaceAll(
        /\bg\b/g,
        'f',
      ),
    );
  });

  it('stay where they mean something else: members, types, functions, values of the module, arguments of attributes', () => {
    const text =
      '@compute @workgroup_size(lanes) fn main(@builtin(position) position: vec3u) { let normal = normal(position.xy); let lane = normal.position + lanes; }';
    expect(shortened(text)).toBe(
      '@compute @workgroup_size(lanes) fn main(@builtin(position) a: vec3u) { let b = normal(a.xy); let c = b.position + lanes; }',
    );
  });

  it('are not those of something that the function uses, nor of a member, nor keywords', () => {
    expect(shortened('fn f(first: A) -> u32 { let second = a(first.b, c); return second + e; }')).toBe(
      'fn f(d: A) -> u32 { let g = a(d.b, c); return g + e; }',
    );
  });

  it('mean what is outside of a block again, after it', () => {
    expect(shortened('fn f() { { let weight = 1.0; g(weight); } g(weight); }')).toContain('} g(weight); }');
    expect(shortened('fn f() { for (var index = 0u; index < 2u; index++) { g(index); } g(index); }')).toMatch(
      /\} g\(index\); \}$/,
    );
    expect(shortened('fn f() { let value = value * 2.0; g(value); }')).toMatch(/let (\w) = value \* 2\.0; g\(\1\)/);
  });

  it('that are declared under either of two conditions are the same', () => {
    expect(shortened('fn f() { @if(A) let weight = 1.0; @else let weight = 2.0; g(weight); }')).toBe(
      'fn f() { @if(A) let a = 1.0; @else let a = 2.0; g(a); }',
    );
  });
});

describe('the shaders of all packages', () => {
  const files = execFileSync('git', ['ls-files', '--cached', '--others', '--exclude-standard', '*.wesl'], {
    cwd: root,
    encoding: 'utf8',
  })
    .trim()
    .split('\n');

  it('exist', () => expect(files.length).toBeGreaterThan(20));

  it.each(files)('%s: another name for each local name, and no name that is used already', (file) => {
    const { tokens } = parseWesl(readFileSync(`${root}/${file}`, 'utf8'), file);
    const renamed = new Map(shortenLocals(tokens).map(({ from, text }) => [from, text]));
    for (const [start, { text: keyword }] of tokens.entries()) {
      if (keyword !== 'fn') continue;
      let depth = 0;
      const end = tokens.findIndex(
        ({ text }, i) =>
          i > start && ((depth += text === '{' ? 1 : text === '}' ? -1 : 0), text === '}' && depth === 0),
      );
      const words = tokens.slice(start, end).filter(({ text }) => /^[A-Za-z_]/.test(text));
      const given = new Map<string, string>();
      for (const { text, from } of words) {
        const short = renamed.get(from);
        if (short === undefined) continue;
        expect(given.get(text) ?? short, `${file}: ${text}`).toBe(short);
        given.set(text, short);
      }
      expect(new Set(given.values()).size, file).toBe(given.size);
      const kept = new Set(words.filter(({ from }) => !renamed.has(from)).map(({ text }) => text));
      for (const [name, short] of given) expect(kept.has(short), `${file}: ${name} as ${short}`).toBe(false);
      // Every declaration is renamed, or has too short a name to gain.
      for (const [i, { text, from }] of words.entries())
        if (/^(let|var|const)$/.test(words[i - 1]?.text ?? '') && text.length > 2)
          expect(renamed.has(from), `${file}: ${text}`).toBe(true);
    }
  });
});
