import { expect, it } from 'vitest';
import { packNormal, packTangents } from '../../src/geometry/compact-shapes';

/** What compact_vertices.wesl makes of a word. */
function unpacked(code: number, bits: number, largest: number): [number, number, number] {
  const sign = 2 ** (bits - 1);
  const [u, v] = [code, Math.floor(code / 2 ** bits)].map((word) => word % sign) as [number, number];
  if (u > largest) return [0, 0, 0];
  const z = largest - u - v;
  const [x, y] = z < 0 ? [largest - v, largest - u] : [u, v];
  const signs = [code, Math.floor(code / 2 ** bits)].map((word) => (Math.floor(word / sign) % 2 ? -1 : 1));
  const length = Math.hypot(x, y, z);
  return [(signs[0]! * x) / length, (signs[1]! * y) / length, z / length];
}

const normalOf = (code: number) => unpacked(code, 16, 0x7ffe);

/** Directions all around, and those next to axes, diagonals and the equator, where octahedra fold. */
function* directions(): Generator<[number, number, number]> {
  for (let i = 0; i < 200_000; i++) {
    const z = 1 - (2 * i + 1) / 200_000;
    const angle = 2.399963229728653 * i;
    const radius = Math.sqrt(1 - z * z);
    yield [radius * Math.cos(angle), radius * Math.sin(angle), z];
  }
  for (const x of [-1, -1e-5, 0, 1e-5, 1])
    for (const y of [-1, -1e-5, 0, 1e-5, 1])
      for (const z of [-1, -1e-5, 0, 1e-5, 1]) {
        const length = Math.hypot(x, y, z);
        if (length > 0) yield [x / length, y / length, z / length];
      }
}

const angle = (a: readonly number[], b: readonly number[]) =>
  Math.hypot(a[1]! * b[2]! - a[2]! * b[1]!, a[2]! * b[0]! - a[0]! * b[2]!, a[0]! * b[1]! - a[1]! * b[0]!);

it('rounds normals by less than 0.004°', () => {
  let furthest = 0;
  for (const normal of directions()) {
    const back = normalOf(packNormal(...normal));
    expectSameSide(back, normal);
    furthest = Math.max(furthest, angle(back, normal));
  }
  expect((furthest * 180) / Math.PI).toBeLessThan(0.004);
  expect((furthest * 180) / Math.PI).toBeGreaterThan(0.001);
});

function expectSameSide(a: readonly number[], b: readonly number[]): void {
  if (a[0]! * b[0]! + a[1]! * b[1]! + a[2]! * b[2]! < 0.5) throw new Error(`${a.join(' ')} in place of ${b.join(' ')}`);
}

it('keeps axes as they are, the length apart', () => {
  for (const axis of [0, 1, 2])
    for (const sign of [-1, 1]) {
      const normal: [number, number, number] = [0, 0, 0];
      normal[axis] = sign;
      const scaled = normal.map((value) => 3 * value) as typeof normal;
      for (const given of [normal, scaled])
        expect(normalOf(packNormal(...given)).map((value) => value + 0)).toEqual(normal);
    }
});

it('keeps normals of length 0', () => {
  expect(normalOf(packNormal(0, 0, 0))).toEqual([0, 0, 0]);
});

it('rounds tangents by less than 0.008° and keeps their handedness', () => {
  let furthest = 0;
  for (const [x, y, z] of directions()) {
    const [right, left] = packTangents(new Float32Array([x, y, z, 1, x, y, z, -1]));
    if (left !== right! + 2 ** 31) throw new Error(`${x} ${y} ${z}: ${left} and ${right}`);
    const back = unpacked(right!, 15, 0x3ffe);
    expectSameSide(back, [x, y, z]);
    furthest = Math.max(furthest, angle(back, [x, y, z]));
  }
  expect((furthest * 180) / Math.PI).toBeLessThan(0.008);
  const [none] = packTangents(new Float32Array(4));
  expect(unpacked(none!, 15, 0x3ffe)).toEqual([0, 0, 0]);
});
