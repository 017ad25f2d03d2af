import { readFileSync, readdirSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { describe, expect, test } from 'vitest';
import { codesIn, errorCodes } from '../../../tools/pipeline/error-codes.mjs';
import { packageFacts } from '../.vitepress/package-facts';
import { errorClasses } from '../src/error-classes';

const packages = fileURLToPath(new URL('../../../packages', import.meta.url));
const guide = readFileSync(new URL('../guide/errors.md', import.meta.url), 'utf8');

/** The page's entries: code, anchor, paragraph. */
const entries = [...guide.matchAll(/^### `([a-z-]+\/[a-z0-9-]+)` \{#([^}]+)\}\n([\s\S]*?)(?=\n#|$(?![\s\S]))/gm)].map(
  ([, code = '', anchor = '', text = '']) => ({ code, anchor, text: text.trim() }),
);
const inSources = new Map(readdirSync(packages).flatMap((name) => [...errorCodes(name, `${packages}/${name}/src`)]));

describe('the errors page', () => {
  test('has one entry for each code in the sources, and none besides', () => {
    expect(inSources.size).toBeGreaterThan(115);
    const documented = entries.map(({ code }) => code);
    const missing = [...inSources]
      .filter(([code]) => !documented.includes(code))
      .map(([code, places]) => `${code} (${places[0]})`);
    expect(missing, 'codes without a paragraph in guide/errors.md').toEqual([]);
    expect(
      documented.filter((code) => !inSources.has(code)),
      'paragraphs of codes that no source has',
    ).toEqual([]);
    expect(
      documented.filter((code, i) => documented.indexOf(code) !== i),
      'codes with two paragraphs',
    ).toEqual([]);
  });

  test('gives each its anchor, and a paragraph under its package', () => {
    for (const { code, anchor, text } of entries) {
      expect(anchor).toBe(code.replace('/', '-'));
      expect(text.split(/\s+/).length, `words about ${code}`).toBeGreaterThan(7);
      const section = guide
        .slice(0, guide.indexOf(`### \`${code}\``))
        .match(/^## (@glanz\/[\w-]+|create-glanz)$/gm)
        ?.at(-1);
      const name = code.split('/')[0]!;
      expect(section, code).toBe(`## ${packageFacts(name).name}`);
    }
  });

  test('comments of the error classes promise only codes that exist, and say of each when it is thrown', () => {
    let promised = 0;
    for (const name of readdirSync(packages)) {
      for (const file of readdirSync(`${packages}/${name}/src`, { recursive: true, encoding: 'utf8' }).filter((one) =>
        one.endsWith('.ts'),
      )) {
        for (const { codes } of errorClasses(name, readFileSync(`${packages}/${name}/src/${file}`, 'utf8'))) {
          expect(codes.length, `codes in the comment of an error class in ${file}`).toBeGreaterThan(0);
          promised += codes.length;
          for (const { code, note } of codes) {
            expect(inSources.has(code), `${file} promises ${code}`).toBe(true);
            expect(note.split(/\s+/).length, `words about ${code} in ${file}`).toBeGreaterThan(2);
          }
        }
      }
    }
    expect(promised).toBeGreaterThan(115);
  });
});

describe('codes are found in the syntax', () => {
  const find = (text: string) => [...codesIn('bvh', new Map([['a.ts', text]])).keys()];

  test('as literals, in conditions, in objects, and by functions that add the package', () => {
    expect(find("throw new BvhError('bvh/one', x);")).toEqual(['bvh/one']);
    expect(find("throw new BvhError(x ? 'bvh/one' : 'bvh/two', y); list.push({ code: 'bvh/three' });")).toEqual([
      'bvh/one',
      'bvh/three',
      'bvh/two',
    ]);
    expect(find("function fail(code: string) { throw new BvhError(`bvh/${code}`, x); }\nfail('length');")).toEqual([
      'bvh/length',
    ]);
  });

  test('not in imports, types, comments, names of shader modules, or of other packages', () => {
    expect(
      find(
        "import { x } from 'bvh/one'; /* 'bvh/two' */ type A = 'bvh/three'; wgslModule('bvh/four', text); f('scene/five'); await import('bvh/six');",
      ),
    ).toEqual([]);
  });
});
