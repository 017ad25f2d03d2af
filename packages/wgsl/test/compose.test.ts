import { describe, expect, it } from 'vitest';
import { compose, gated, GlanzError, wgslModule, WgslComposeError, type WgslModule } from '../src';
import { randomSource, type RandomSource } from './random';

const linesOf = (code: string) => code.split('\n').slice(0, -1);

function failure(run: () => unknown): WgslComposeError {
  try {
    run();
  } catch (error) {
    if (error instanceof WgslComposeError) return error;
    throw error;
  }
  throw new Error('nothing was thrown');
}

describe('order of modules', () => {
  it('puts dependencies first and each module once', () => {
    const a = wgslModule('a', 'const A = 1;');
    const b = wgslModule('b', 'const B = A;', [a]);
    const c = wgslModule('c', 'const C = A;', [a]);
    const d = wgslModule('d', 'const D = B + C;', [b, c]);
    const { code, modules } = compose([d, b, d]);
    expect(modules).toEqual(['a', 'b', 'c', 'd']);
    expect(code).toBe('const A = 1;\nconst B = A;\nconst C = A;\nconst D = B + C;\n');
  });

  it.each([1, 2, 3, 4, 5])('holds for random graphs (seed %i)', (seed) => {
    const random = randomSource(seed);
    const modules: WgslModule[] = [];
    for (let i = 0; i < 40; i++)
      modules.push(
        wgslModule(
          `m${i}`,
          `// ${i}`,
          modules.filter(() => random.next() < 0.15),
        ),
      );
    const roots = modules.filter(() => random.next() < 0.3);
    const order = compose(roots).modules;
    // What must be there: everything that can be reached, by a plain flood.
    const reachable = new Set<WgslModule>(roots);
    for (const module of reachable) for (const dep of module.deps) reachable.add(dep as WgslModule);
    expect([...order].sort()).toEqual([...reachable].map((module) => module.name).sort());
    for (const module of reachable)
      for (const dep of module.deps)
        expect(order.indexOf((dep as WgslModule).name)).toBeLessThan(order.indexOf(module.name));
    expect(compose(roots).code).toBe(compose(roots).code);
  });

  it('names the circle', () => {
    const deps: WgslModule[] = [];
    const a: WgslModule = { name: 'a', code: '', deps };
    const b = wgslModule('b', '', [a]);
    deps.push(b);
    const error = failure(() => compose([a]));
    expect(error.code).toBe('wgsl/cycle');
    expect(error.message).toContain('a → b → a');
    expect(error).toBeInstanceOf(GlanzError);
  });

  it('refuses two modules of one name, even when they are equal', () => {
    expect(failure(() => compose([wgslModule('x', '1'), wgslModule('x', '1')])).code).toBe('wgsl/duplicate-name');
  });
});

describe('gated dependencies', () => {
  const coat = wgslModule('coat', 'fn coat() {}');
  const bare = wgslModule('bare', 'fn bare() {}');
  const root = wgslModule('root', '', [gated('COAT', coat), gated('!COAT', bare)]);

  it('come in by their flag, or by its absence', () => {
    expect(compose([root], { flags: { COAT: true } }).modules).toEqual(['coat', 'root']);
    expect(compose([root], { flags: { COAT: false } }).modules).toEqual(['bare', 'root']);
  });

  it('need their flag to be given', () => {
    const error = failure(() => compose([root], { flags: { OTHER: true } }));
    expect(error.code).toBe('wgsl/unknown-flag');
    expect(error.message).toMatch(/"root".*"COAT".*OTHER/);
    expect(error.location).toEqual({ module: 'root' });
  });

  it('do not take names from the prototype of the flags', () => {
    expect(failure(() => compose([wgslModule('m', '//#if toString\n//#endif')])).code).toBe('wgsl/unknown-flag');
  });
});

describe('gates', () => {
  it('keep and drop lines', () => {
    const module = wgslModule('m', 'a\n//#if X\nb\n//#else\nc\n//#endif\nd');
    expect(linesOf(compose([module], { flags: { X: true } }).code)).toEqual(['a', 'b', 'd']);
    expect(linesOf(compose([module], { flags: { X: false } }).code)).toEqual(['a', 'c', 'd']);
  });

  it('may be indented, negated and end in a carriage return', () => {
    const module = wgslModule('m', '  //#if !X \r\nb\r\n\t//#endif\r\n');
    expect(compose([module], { flags: { X: false } }).code).toContain('b');
    expect(compose([module], { flags: { X: true } }).code).not.toContain('b');
  });

  it('stand inside of lines: what they let through of a line stays in it', () => {
    const module = wgslModule(
      'm',
      'a(//#if X b,//#else c,//#endif d);\n//#if X e;//#endif//#if !X f;//#endif\n  //#if X//#if Y g;//#else h;//#endif//#endif',
    );
    const kept = (flags: Record<string, boolean>) =>
      compose([module], { flags })
        .code.split('\n')
        .map((line) => line.replace(/\s/g, ''));
    expect(kept({ X: true, Y: false })).toEqual(['a(b,d);', 'e;', 'h;', '']);
    expect(kept({ X: false, Y: false })).toEqual(['a(c,d);', 'f;', '']);
    expect(compose([module], { flags: { X: true, Y: true } }).locate(3)).toEqual({ module: 'm', line: 3 });
  });

  it('take several flags, all of which must hold', () => {
    const module = wgslModule('m', '//#if X && !Y\na\n//#else\nb\n//#endif\n//#if X&&Y c;//#endif');
    expect(linesOf(compose([module], { flags: { X: true, Y: false } }).code)).toEqual(['a']);
    expect(linesOf(compose([module], { flags: { X: true, Y: true } }).code)).toEqual(['b', ' c;']);
    expect(failure(() => compose([module], { flags: { X: true } })).code).toBe('wgsl/unknown-flag');
  });

  it.each([
    ['//#if X', /line 1.*never closed/],
    ['a\n//#endif', /line 2.*without \/\/#if/],
    ['//#else', /line 1.*without \/\/#if/],
    ['//#if X\n//#else\n//#else\n//#endif', /line 3.*second/],
    ['//#if\n//#endif', /line 1.*without a flag/],
    ['//#if X &&\n//#elsif', /line 2.*not a gate/],
    ['a //#endif', /line 1.*without \/\/#if/],
    ['//#if X //#else b //#else', /line 1.*second/],
    ['//#elif X', /line 1.*not a gate/],
    ['//#ifdef X\n//#endif', /line 1.*not a gate/],
  ])('that are invalid are reported with their line: %j', (code, message) => {
    const error = failure(() => compose([wgslModule('m', code)], { flags: { X: true, Y: true } }));
    expect(error.code).toBe('wgsl/unbalanced-gate');
    expect(error.message).toMatch(message);
    expect(error.message).not.toContain('\n');
  });

  it('say where an unknown flag is asked for, also inside text that is left out', () => {
    const error = failure(() =>
      compose([wgslModule('m', 'a\n//#if X\n//#if NEW\n//#endif\n//#endif')], { flags: { X: false } }),
    );
    expect(error).toMatchObject({ code: 'wgsl/unknown-flag', location: { module: 'm', line: 3 } });
  });

  // The oracle is the tree that the text is printed from: it knows which lines live, without reading any gate.
  interface Tree {
    readonly flag: string;
    readonly negated: boolean;
    readonly kept: Block;
    readonly otherwise: Block | undefined;
  }
  type Block = readonly (string | Tree)[];
  const FLAGS = ['A', 'B', 'C', 'D'];

  function randomBlock(random: RandomSource, depth: number, name: string): Block {
    return Array.from({ length: 1 + random.below(4) }, (_, i) => {
      if (depth === 0 || random.next() < 0.5) return `${name}.${i}`;
      return {
        flag: random.pick(FLAGS),
        negated: random.next() < 0.3,
        kept: randomBlock(random, depth - 1, `${name}.${i}t`),
        otherwise: random.next() < 0.5 ? randomBlock(random, depth - 1, `${name}.${i}e`) : undefined,
      };
    });
  }
  const print = (block: Block): string[] =>
    block.flatMap((item) =>
      typeof item === 'string'
        ? [item]
        : [
            `//#if ${item.negated ? '!' : ''}${item.flag}`,
            ...print(item.kept),
            ...(item.otherwise ? ['//#else', ...print(item.otherwise)] : []),
            '//#endif',
          ],
    );
  const alive = (block: Block, flags: Record<string, boolean>): string[] =>
    block.flatMap((item) =>
      typeof item === 'string'
        ? [item]
        : flags[item.flag] !== item.negated
          ? alive(item.kept, flags)
          : alive(item.otherwise ?? [], flags),
    );

  it.each(Array.from({ length: 20 }, (_, i) => i + 1))(
    'nest as the tree they were printed from, and lines find home (seed %i)',
    (seed) => {
      const random = randomSource(seed);
      const blocks = [0, 1, 2].map((i) => randomBlock(random, 4, `m${i}`));
      const texts = blocks.map(print);
      const modules = texts.map((text, i) => wgslModule(`m${i}`, text.join('\n')));
      for (let bits = 0; bits < 16; bits++) {
        const flags = Object.fromEntries(FLAGS.map((flag, i) => [flag, (bits & (1 << i)) !== 0]));
        const composed = compose(modules, { flags });
        expect(linesOf(composed.code)).toEqual(blocks.flatMap((block) => alive(block, flags)));
        linesOf(composed.code).forEach((line, i) => {
          const place = composed.locate(i + 1);
          expect(texts[Number(place?.module.slice(1))]?.[(place?.line ?? 0) - 1]).toBe(line);
        });
      }
    },
  );
});

describe('the line map', () => {
  it('knows nothing outside of the text', () => {
    const { locate, code } = compose([wgslModule('m', 'a\nb')]);
    expect(code).toBe('a\nb\n');
    expect([locate(0), locate(3), locate(-1), locate(1.5)]).toEqual([undefined, undefined, undefined, undefined]);
    expect(locate(2)).toEqual({ module: 'm', line: 2 });
  });
});

describe('directives', () => {
  it('move to the top, each once, and keep their places', () => {
    const a = wgslModule('a', 'enable f16;\nconst A = 1;');
    const b = wgslModule('b', 'diagnostic(off, derivative_uniformity);\n  enable f16;\nconst B = A;', [a]);
    const { code, locate } = compose([b]);
    expect(linesOf(code)).toEqual([
      'enable f16;',
      'diagnostic(off, derivative_uniformity);',
      'const A = 1;',
      'const B = A;',
    ]);
    expect([1, 2, 3, 4].map(locate)).toEqual([
      { module: 'a', line: 1 },
      { module: 'b', line: 1 },
      { module: 'a', line: 2 },
      { module: 'b', line: 3 },
    ]);
  });

  it('obey gates, and attributes are none', () => {
    const module = wgslModule(
      'm',
      '//#if HALF\nenable f16;\n//#endif\n@diagnostic(off, derivative_uniformity) fn f() {}',
    );
    expect(linesOf(compose([module], { flags: { HALF: false } }).code)).toEqual([
      '@diagnostic(off, derivative_uniformity) fn f() {}',
    ]);
  });
});

describe('modules', () => {
  it('are frozen, with their dependencies', () => {
    const deps = [wgslModule('a', '')];
    const module = wgslModule('b', '', deps);
    deps.length = 0;
    expect(module.deps).toHaveLength(1);
    expect(Object.isFrozen(module) && Object.isFrozen(module.deps) && Object.isFrozen(gated('X', module))).toBe(true);
  });
});
