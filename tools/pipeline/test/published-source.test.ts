import { readdirSync, readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { build } from 'esbuild';
import { describe, expect, it } from 'vitest';

import { preparePublished, publishedModules } from '../published-source.mjs';

const root = fileURLToPath(new URL('../../..', import.meta.url));

/** What a bundler keeps of a module that is imported for nothing, not trusting `sideEffects`. */
async function leftover(code: string): Promise<string> {
  const { outputFiles } = await build({
    stdin: { contents: `import 'm';`, loader: 'ts' },
    bundle: true,
    write: false,
    minify: true,
    format: 'esm',
    plugins: [
      {
        name: 'module',
        setup(context) {
          context.onResolve({ filter: /^m$/ }, () => ({ path: 'm', namespace: 'test', sideEffects: true }));
          context.onResolve({ filter: /^x$/ }, () => ({ path: 'x', external: true, sideEffects: false }));
          context.onLoad({ filter: /^m$/, namespace: 'test' }, () => ({ contents: code, loader: 'ts' }));
        },
      },
    ],
  });
  return outputFiles[0]!.text.replace(/import ?(?:\{[^}]*\} ?from ?)?"x";/g, '').trim();
}

describe('constants', () => {
  const used = [
    `import { call } from 'x'; export const a = call(1, [2]);`,
    `import { other, call } from 'x'; const a = call('n', other.module); export const b = call(a);`,
    `import { a } from 'x'; export const b = a.c * 2, d = 1 / b;`,
    `import { a } from 'x'; export const limit = a ** 26;`,
    `import { a } from 'x'; export const c = [...a, { [a]: 1 }];`,
    'import { a } from "x"; export const t = `fn ${a()} {}`;',
  ];

  it.each(used)('are dropped when nobody uses them: %s', async (code) => {
    expect(await leftover(preparePublished(code))).toBe('');
  });

  it('would otherwise stay: the test above can fail', async () => {
    expect((await Promise.all(used.map(leftover))).filter((text) => text !== '').length).toBe(used.length);
  });

  it('keep their values', async () => {
    const code = `const two = 1 + 1, text = \`\${two}\${[two].length}\`;\nexport default [two, text, ((n: number) => -n)(3), { two }.two];`;
    const load = async (source: string) => {
      const { outputFiles } = await build({ stdin: { contents: source, loader: 'ts' }, write: false, format: 'esm' });
      return (
        (await import(`data:text/javascript,${encodeURIComponent(outputFiles[0]!.text)}`)) as { default: unknown }
      ).default;
    };
    expect(await load(preparePublished(code))).toEqual([2, '21', -3, 2]);
    expect(await load(code)).toEqual([2, '21', -3, 2]);
  });

  it('that are plain values, functions or not constant are left as they are', () => {
    const code = `export const a = 1, b = 'x', c = [a, -1, { d: b }], e = () => a.toString(), f = \`x\`;\nexport let g = e();\nfunction h() { const i = e(); }`;
    expect(preparePublished(code)).toBe(code);
  });
});

describe('WGSL templates', () => {
  it('lose comments and indentation, and keep gates and line breaks', () => {
    const code =
      'export const m = f(/* wgsl */ `\n  // why\n  fn a() { // what\n    //#if COAT\n    b(); //!\n    //#endif\n\n  }`);';
    expect(preparePublished(code)).toContain('`\n\nfn a(){\n//#if COAT\nb();\n//#endif\n\n}`');
  });

  it('lose the spaces that separate nothing', () => {
    const code =
      'export const m = f(/* wgsl */ `  let a : array<vec2f, 4> = b(c, -d) - -e * &f[g] / h; if (i < -j && k > = l) { return m; }`);';
    expect(preparePublished(code)).toContain(
      '`let a:array<vec2f,4> =b(c,-d)- -e* &f[g]/h;if(i< -j&&k> =l){return m;}`',
    );
  });

  it('lose zeros of numbers that mean nothing, and none that a substitution continues', () => {
    const code = 'const f = () => g(/* wgsl */ `a = 1.0 + 0.5 * 10.05 - 1.0e-3 + b.x0 + 20.0; c = 1.0${d}; e = 0.0;`);';
    expect(preparePublished(code)).toContain('`a=1.+.5*10.05-1.0e-3+b.x0+20.;c=1.0${d}; e = 0.0;`');
  });

  it('of all packages keep their tokens', () => {
    // The longest operators first, as section 3.3 of the WGSL specification reads them.
    const token = /\/\/#.*|<<=|>>=|&&|->|--|==|>=|>>|<<|<=|!=|\+\+|\|\||[-+*/%&|^]=|[\w.]+|[^\s\w]/g;
    // 1. is 1.0 and .5 is 0.5; with a point it is another type than without.
    const byValue = (part: string) =>
      /^\.?\d[\d.]*$/.test(part) ? `${Number(part)}${part.includes('.') ? ' float' : ''}` : part;
    const templates = (text: string) =>
      [...text.matchAll(/\/\* wgsl \*\/ `((?:[^`\\]|\\.)*)`/g)].map(([, wgsl]) =>
        wgsl!
          .replace(/(?<!\/)\/\/(?!#).*$/gm, '')
          .match(token)
          ?.map(byValue),
      );
    const files = ['wgsl', 'bvh', 'openpbr', 'tonemap', 'renderer', 'viewer'].flatMap((name) =>
      readdirSync(`${root}/packages/${name}/src`, { recursive: true, encoding: 'utf8' }).map(
        (path) => `packages/${name}/src/${path}`,
      ),
    );
    const shaders = files.filter(
      (path) => path.endsWith('.ts') && readFileSync(`${root}/${path}`, 'utf8').includes('/* wgsl */ `'),
    );
    expect(shaders.length).toBeGreaterThan(3);
    for (const path of shaders) {
      const text = readFileSync(`${root}/${path}`, 'utf8');
      expect(templates(preparePublished(text)), path).toEqual(templates(text));
    }
  });

  it('keep a comment that runs on into a substitution, and what follows a substitution', () => {
    const code =
      'export const m = f(/* wgsl */ `\n  // about ${name} in units\n  const x = ${value};  // said\n  let y = 1;`);';
    expect(preparePublished(code)).toContain('`\n// about ${name} in units\nconst x= ${value};  // said\nlet y=1;`');
  });

  it('are found inside functions and inside substitutions', () => {
    const code = 'const f = () => /* wgsl */ `  a\n  ${/* wgsl */ `  b // c\n  d`}`;';
    expect(preparePublished(code)).toBe('const f = () => /* wgsl */ `a\n${/* wgsl */ `b\nd`}`;');
  });

  it('alone are touched: other templates keep their spaces', () => {
    const code = 'export const help = () => `\n  // this stays\n`;';
    expect(preparePublished(code)).toBe(code);
  });
});

describe('pages built from the sources', () => {
  const { transform } = publishedModules();
  const code = "export const m = wgslModule('m', /* wgsl */ `  // why\n  let a = 1;`);";

  it('ship packages as they are published, and leave the rest alone', () => {
    expect(transform(code, '/x/packages/bvh/src/a/b.ts')!.code).toBe(preparePublished(code));
    for (const id of [
      '/x/apps/playground/src/a.ts',
      '/x/node_modules/packages/b/src/a.js',
      '/x/packages/bvh/src/a.ts?worker',
    ])
      expect(transform(code, id)).toBeUndefined();
  });
});
