import { describe, expect, it } from 'vitest';
import { differences, unusedFlags, type HashEntry } from '../../src/hashes/compare';
import { channelMeans, digest, programDigest, wgslDeclarations, wgslTokens } from '../../src/hashes/digest';
import { HASH_CASES } from '../../src/hashes/scenes';

const entry = (scene: string, hash: string, means?: readonly number[]): HashEntry => ({
  scene,
  part: 'beauty',
  hash,
  ...(means ? { means } : {}),
});

describe('differences', () => {
  it('names what changed, what is new and what is gone', () => {
    const before = [entry('same', 'a'), entry('changed', 'b', [1, 2]), entry('gone', 'c')];
    const after = [entry('same', 'a'), entry('changed', 'd', [1, 2.5]), entry('new', 'e')];
    expect(differences(before, after)).toEqual([
      { scene: 'changed', part: 'beauty', before: 'b', after: 'd', change: 0.25 },
      { scene: 'new', part: 'beauty', before: 'none', after: 'e' },
      { scene: 'gone', part: 'beauty', before: 'c', after: 'none' },
    ]);
  });

  it('does not count scenes that a partial run left out', () => {
    expect(differences([entry('a', '1'), entry('b', '2')], [entry('a', '1')], true)).toEqual([]);
  });

  it('distinguishes a rounding from a fault: the change of the mean, NaN where a mean is none', () => {
    expect(differences([entry('a', '1', [0.5])], [entry('a', '2', [0.5])])).toMatchObject([{ change: 0 }]);
    expect(differences([entry('a', '1', [0.5])], [entry('a', '2', [NaN])])).toMatchObject([{ change: NaN }]);
  });
});

it('names flags that are never on and never off', () => {
  expect(
    unusedFlags([
      { A: true, B: false, C: true },
      { A: false, B: false, C: true },
    ]),
  ).toEqual({ neverOn: ['B'], neverOff: ['C'] });
});

describe('digests', () => {
  it('of programs see tokens alone', () => {
    expect(programDigest('fn f() { // why\n  x = a - -b; /* y */ }')).toBe(programDigest('fn f(){x=a- -b;}'));
    expect(programDigest('x = a - -b;')).not.toBe(programDigest('x = a -- b;'));
    expect(programDigest('x = 1e-3;')).not.toBe(programDigest('x = 1e - 3;'));
  });

  it('of programs do not see the order of declarations, but that of statements', () => {
    const [a, b] = ['fn a() { x(); y(); }', 'struct B { m: f32 } const c = 1;'];
    expect(wgslDeclarations(`${a} ${b}`)).toEqual([
      'fn a ( ) { x ( ) ; y ( ) ; }',
      'struct B { m : f32 }',
      'const c = 1 ;',
    ]);
    expect(programDigest(`${a} ${b}`)).toBe(programDigest(`${b} ${a}`));
    expect(programDigest(a)).not.toBe(programDigest('fn a() { y(); x(); }'));
  });

  it('split WGSL into its tokens', () => {
    expect(wgslTokens('let x:vec2<f32>=1.5e-3f<<2u; // end')).toEqual([
      'let',
      'x',
      ':',
      'vec2',
      '<',
      'f32',
      '>=',
      '1.5e-3f',
      '<<',
      '2u',
      ';',
    ]);
  });

  it('of films see every bit: 0 and -0 differ', () => {
    expect(digest(Float32Array.of(0))).not.toBe(digest(Float32Array.of(-0)));
    // The SHA-256 of the empty string begins with these digits (FIPS 180-4).
    expect(digest('')).toBe('e3b0c44298fc1c14');
  });

  it('have means by channel', () => {
    expect(channelMeans([1, 10, 3, 30], 2)).toEqual([2, 20]);
  });
});

it('has one name for each scene', () => {
  expect(new Set(HASH_CASES.map(({ name }) => name)).size).toBe(HASH_CASES.length);
});
