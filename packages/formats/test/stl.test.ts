import { sceneBounds, validateScene } from '@glanz/scene';
import { STLLoader } from 'three/examples/jsm/loaders/STLLoader.js';
import { expect, it } from 'vitest';
import { FormatError, readStl } from '../src/index';

type Triangle = readonly (readonly [number, number, number])[];

function binary(triangles: readonly Triangle[], head = 'made by nobody'): Uint8Array<ArrayBuffer> {
  const bytes = new Uint8Array(84 + 50 * triangles.length);
  bytes.set(new TextEncoder().encode(head));
  const view = new DataView(bytes.buffer);
  view.setUint32(80, triangles.length, true);
  triangles.forEach((corners, t) =>
    corners.flat().forEach((x, i) => view.setFloat32(84 + 50 * t + 12 + 4 * i, x, true)),
  );
  return bytes;
}

const text = (triangles: readonly Triangle[], name = 'part one') =>
  new TextEncoder().encode(
    `solid ${name}\n${triangles.map((corners) => `facet normal 0 0 1\n outer loop\n${corners.map((p) => `  vertex ${p.join(' ')}\n`).join('')} endloop\nendfacet\n`).join('')}endsolid ${name}\n`,
  );

/** A tetrahedron: four vertices, whatever the file says. */
const P = [
  [0, 0, 0],
  [1, 0, 0],
  [0, 2, 0],
  [0, 0, 3],
] as const;
const BODY: readonly Triangle[] = [
  [P[0], P[2], P[1]],
  [P[0], P[1], P[3]],
  [P[0], P[3], P[2]],
  [P[1], P[2], P[3]],
];

it.each([
  ['binary', binary(BODY)],
  ['binary that begins like a text', binary(BODY, 'solid thing')],
  ['text', text(BODY)],
] as const)('%s: corners at the same place are one vertex, and three.js sees the same triangles', (_, bytes) => {
  const scene = readStl(bytes, { up: 'y' });
  const [mesh] = scene.meshes;
  expect(mesh!.positions.length).toBe(12);
  expect(mesh!.normals).toBeUndefined();
  expect(validateScene(scene)).toEqual([]);
  const theirs = new STLLoader().parse(bytes.buffer).getAttribute('position').array;
  expect(Array.from(mesh!.indices).flatMap((v) => Array.from(mesh!.positions.subarray(3 * v, 3 * v + 3)))).toEqual(
    Array.from(theirs),
  );
});

it("+Z of the file points up by default, and units are metres of the host's choice", () => {
  const near = (bounds: ReturnType<typeof sceneBounds>) =>
    [...bounds.min, ...bounds.max].map((x) => Math.round(x * 1e6) / 1e6 + 0);
  expect(near(sceneBounds(readStl(binary(BODY))))).toEqual([0, 0, -2, 1, 3, 0]);
  expect(near(sceneBounds(readStl(binary(BODY), { up: 'y', unit: 0.001 })))).toEqual([0, 0, 0, 0.001, 0.002, 0.003]);
});

it('the name in the file, or the given one', () => {
  expect(readStl(text(BODY)).meshes[0]!.name).toBe('part one');
  expect(readStl(text(BODY), { name: 'other' }).meshes[0]!.name).toBe('other');
});

it('triangles that are not finite are left out and reported', () => {
  const scene = readStl(binary([...BODY, [P[0], P[1], [NaN, 0, 0]]]));
  expect(scene.meshes[0]!.indices.length).toBe(12);
  expect(scene.warnings.map(({ code }) => code)).toEqual(['formats/not-finite']);
});

it('files that are cut off, empty or lie about their length', () => {
  const code = (bytes: Uint8Array) => {
    try {
      readStl(bytes);
    } catch (error) {
      if (error instanceof FormatError) return error.code;
      throw error;
    }
    return 'none';
  };
  expect(code(new Uint8Array(0))).toBe('formats/truncated');
  expect(code(binary(BODY).subarray(0, 100))).toBe('formats/truncated');
  expect(code(binary([]))).toBe('formats/no-triangles');
  const lie = binary(BODY);
  new DataView(lie.buffer).setUint32(80, 4_000_000_000, true);
  expect(code(lie)).toBe('formats/truncated');
  expect(code(new TextEncoder().encode('solid x\nfacet\nvertex 0 0 0\nendfacet\n'))).toBe('formats/malformed');
});
