import { describe, expect, it } from 'vitest';
import { compose, struct, StructError } from '../src';

function codeOf(run: () => unknown): string {
  try {
    run();
  } catch (error) {
    if (error instanceof StructError) return error.code;
    throw error;
  }
  throw new Error('nothing was thrown');
}

describe('layout', () => {
  // The worked example of the WGSL specification, section "Structure Member Layout", with its comments as the truth.
  const A = struct('A', { u: 'f32', v: 'f32', w: 'vec2f', x: 'f32' });
  const B = struct('B', { a: 'vec2f', b: 'vec3f', c: 'f32', d: 'f32', e: A, f: 'vec3f', g: [A, 3], h: 'i32' });

  it("agrees with the specification's example", () => {
    expect([A.align, A.size]).toEqual([8, 24]);
    expect(A.fields.map(({ offset, size }) => [offset, size])).toEqual([
      [0, 4],
      [4, 4],
      [8, 8],
      [16, 4],
    ]);
    expect([B.align, B.size]).toEqual([16, 160]);
    expect(B.fields.map(({ name, offset, size }) => [name, offset, size])).toEqual([
      ['a', 0, 8],
      ['b', 16, 12],
      ['c', 28, 4],
      ['d', 32, 4],
      ['e', 40, 24],
      ['f', 64, 12],
      ['g', 80, 72],
      ['h', 152, 4],
    ]);
    expect(B.offsetOf('h')).toBe(152);
  });

  it('prints WGSL and brings the structs inside along, those in arrays too', () => {
    const C = struct('C', { items: [A, 2], grid: [['u32', 2], 3] });
    expect(C.module.code).toBe('struct C {\n  items: array<A, 2>,\n  grid: array<array<u32, 2>, 3>,\n}');
    expect(compose([C.module]).modules).toEqual(['struct/A', 'struct/C']);
  });

  it('pads array strides', () => {
    const S = struct('S', { v: ['vec3f', 2], after: 'f32' });
    expect([S.offsetOf('after'), S.size]).toEqual([32, 48]);
  });

  it.each([
    ['no fields', {}, 'wgsl/empty-struct'],
    ['an unknown type', { a: 'f64' as 'f32' }, 'wgsl/field-type'],
    ['a type from the prototype', { a: 'toString' as 'f32' }, 'wgsl/field-type'],
    ['an empty array', { a: ['f32', 0] as const }, 'wgsl/field-type'],
    ['half an array', { a: ['f32', 1.5] as const }, 'wgsl/field-type'],
  ])('refuses %s', (_what, fields, code) => {
    expect(codeOf(() => struct('S', fields))).toBe(code);
  });
});

describe('writing', () => {
  const S = struct('S', { id: 'u32', offset: 'i32', color: 'vec3f', weight: 'f32', corners: ['vec3f', 2] });

  it('puts numbers where they belong, little-endian, and leaves the rest alone', () => {
    const buffer = S.allocate(2);
    expect(buffer.byteLength).toBe(2 * 64);
    new Uint8Array(buffer).fill(0xee);
    S.write(buffer, 1, { id: 0xffffffff, offset: -2, color: [1, 2, 3], corners: new Float32Array([4, 5, 6, 7, 8, 9]) });
    const view = new DataView(buffer, 64);
    expect(view.getUint32(0, true)).toBe(0xffffffff);
    expect(view.getInt32(4, true)).toBe(-2);
    expect([16, 20, 24].map((at) => view.getFloat32(at, true))).toEqual([1, 2, 3]);
    expect([32, 36, 40, 48, 52, 56].map((at) => view.getFloat32(at, true))).toEqual([4, 5, 6, 7, 8, 9]);
    for (const untouched of [8, 12, 28, 44, 60]) expect(view.getUint32(untouched, true)).toBe(0xeeeeeeee);
    expect(new Uint8Array(buffer, 0, 64).every((byte) => byte === 0xee)).toBe(true);
  });

  it('takes undefined for a field that is not to be written', () => {
    const buffer = S.allocate();
    S.write(buffer, 0, { weight: 2 });
    S.write(buffer, 0, { weight: undefined as unknown as number, id: 1 });
    expect(new DataView(buffer).getFloat32(S.offsetOf('weight'), true)).toBe(2);
  });

  it('takes nested structs as their bytes, and only so', () => {
    const Outer = struct('Outer', { pad: 'u32', inner: S, list: [S, 2] });
    const inner = S.allocate();
    S.write(inner, 0, { id: 7 });
    const buffer = Outer.allocate();
    Outer.write(buffer, 0, { inner });
    expect(new DataView(buffer).getUint32(Outer.offsetOf('inner'), true)).toBe(7);
    const two = S.allocate(2);
    S.write(two, 1, { id: 9 });
    Outer.write(buffer, 0, { list: two });
    expect(new DataView(buffer).getUint32(Outer.offsetOf('list') + 64, true)).toBe(9);
    expect(codeOf(() => Outer.write(buffer, 0, { inner: new Float32Array(16) }))).toBe('wgsl/field-type');
  });

  it('nests arrays', () => {
    const Grid = struct('Grid', { cells: [['vec2u', 2], 3] });
    const buffer = Grid.allocate();
    Grid.write(buffer, 0, { cells: Uint32Array.from({ length: 12 }, (_, i) => i) });
    expect([...new Uint32Array(buffer)]).toEqual([0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11]);
  });

  it.each([
    ['an unknown field', () => S.write(S.allocate(), 0, { nope: 1 } as never), 'wgsl/unknown-field'],
    ['an offset of such a field', () => S.offsetOf('nope' as never), 'wgsl/unknown-field'],
    ['too few numbers', () => S.write(S.allocate(), 0, { color: [1, 2] }), 'wgsl/field-length'],
    ['a number for a vector', () => S.write(S.allocate(), 0, { color: 1 }), 'wgsl/field-length'],
    ['too many bytes', () => S.write(S.allocate(), 0, { color: new ArrayBuffer(16) }), 'wgsl/field-length'],
    ['an index past the end', () => S.write(S.allocate(2), 2, { id: 1 }), 'wgsl/out-of-range'],
    ['an index before the start', () => S.write(S.allocate(2), -1, { id: 1 }), 'wgsl/out-of-range'],
    ['half an index', () => S.write(S.allocate(2), 0.5, { id: 1 }), 'wgsl/out-of-range'],
  ])('refuses %s', (_what, run, code) => {
    expect(codeOf(run)).toBe(code);
  });
});
