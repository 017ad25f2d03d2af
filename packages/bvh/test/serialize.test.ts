import { describe, expect, test } from 'vitest';
import { buildBlas, BvhError, closestHit, type Blas } from '../src/index';
import { LEFT, leafReference, NODE_WORDS, RIGHT } from '../src/layout';
import { deserializeBlas, deserializeBlases, serializeBlas, serializeBlases } from '../src/serialize';
import { randomNumbers, sphere, strewn } from './shapes';
import { checkBlas } from './structure';

const code = (f: () => unknown): string | undefined => {
  try {
    f();
  } catch (error) {
    expect(error).toBeInstanceOf(BvhError);
    return (error as BvhError).code;
  }
  return undefined;
};

const none = { positions: new Float32Array(0) };
const meshes = [sphere(16), strewn(1, 0.3, randomNumbers(61)), none, strewn(500, 0.2, randomNumbers(62))];

test('what comes back is what was put in, alone and together', () => {
  const trees = meshes.map((mesh) => buildBlas(mesh));
  trees.forEach((blas, i) => expect(deserializeBlas(serializeBlas(blas), meshes[i])).toEqual(blas));
  expect(deserializeBlases(serializeBlases(trees), meshes)).toEqual(trees);
  expect(deserializeBlases(serializeBlases([]))).toEqual([]);
  const back = deserializeBlas(serializeBlas(trees[0]!));
  checkBlas(back, meshes[0]!);
  expect(closestHit(back, meshes[0]!, { origin: [3, 0.1, 0.2], direction: [-1, 0, 0] })).toEqual(
    closestHit(trees[0]!, meshes[0]!, { origin: [3, 0.1, 0.2], direction: [-1, 0, 0] }),
  );
  // Arrays of its own: each can be transferred to a worker.
  expect(back.nodes.buffer.byteLength).toBe(back.nodes.byteLength);
});

test('bytes of another order and bytes that lie badly are read', () => {
  const blas = buildBlas(meshes[3]!);
  const bytes = new Uint8Array(serializeBlas(blas));
  const swapped = bytes.map((_, i) => bytes[i ^ 3]!);
  expect(deserializeBlas(swapped)).toEqual(blas);
  const shifted = new Uint8Array(bytes.length + 1);
  shifted.set(bytes, 1);
  expect(deserializeBlas(shifted.subarray(1))).toEqual(blas);
  expect(deserializeBlas(new DataView(bytes.buffer))).toEqual(blas);
});

test('something else, another version, missing and surplus bytes are refused', () => {
  const bytes = new Uint8Array(serializeBlas(buildBlas(meshes[3]!)));
  expect(code(() => deserializeBlas(new ArrayBuffer(0)))).toBe('bvh/not-serialized');
  expect(code(() => deserializeBlas(new TextEncoder().encode('glTF and more')))).toBe('bvh/not-serialized');
  for (let length = 0; length < bytes.length; length = Math.max(length + 1, Math.floor(length * 1.1))) {
    expect(code(() => deserializeBlas(bytes.slice(0, length)))).toBe(
      length < 4 ? 'bvh/not-serialized' : 'bvh/truncated',
    );
  }
  expect(code(() => deserializeBlas(Uint8Array.of(...bytes, 0, 0, 0, 0)))).toBe('bvh/truncated');
  const later = bytes.slice();
  later[4] = 2;
  expect(code(() => deserializeBlas(later))).toBe('bvh/version');
});

test('no flipped bit goes unseen (seed 63)', () => {
  const bytes = new Uint8Array(serializeBlases([buildBlas(meshes[1]!), buildBlas(strewn(40, 0.3, randomNumbers(64)))]));
  for (let bit = 0; bit < 8 * bytes.length; bit++) {
    const flipped = bytes.slice();
    flipped[bit >> 3]! ^= 1 << (bit & 7);
    expect(code(() => deserializeBlases(flipped))).toMatch(/^bvh\/(not-serialized|version|truncated|checksum)$/);
  }
  const random = randomNumbers(63);
  for (let i = 0; i < 500; i++) {
    const scrambled = bytes.slice();
    for (let k = 0; k < 2 + 20 * random(); k++) scrambled[Math.floor(random() * bytes.length)] = 256 * random();
    if (scrambled.some((x, k) => x !== bytes[k])) expect(code(() => deserializeBlases(scrambled))).toMatch(/^bvh\//);
  }
});

describe('trees that lead astray are refused, though their checksum is right', () => {
  const mesh = strewn(60, 0.3, randomNumbers(65));
  /** A tree with words changed before it was written. */
  const spoilt = (change: (words: Uint32Array, blas: Blas) => void) => {
    const blas = buildBlas(mesh);
    change(new Uint32Array(blas.nodes.buffer), blas);
    return code(() => deserializeBlas(serializeBlas(blas), mesh));
  };
  const inner = (words: Uint32Array) => {
    for (let at = 0; ; at += NODE_WORDS)
      for (const side of [LEFT, RIGHT]) if (at > 0 && words[at + side]! < 2 ** 31) return at + side;
  };
  const leaf = (words: Uint32Array) => {
    for (let at = 0; ; at += NODE_WORDS)
      for (const side of [LEFT, RIGHT]) if (words[at + side]! >= 2 ** 31) return at + side;
  };
  test.each<[string, (words: Uint32Array, blas: Blas) => void, string | undefined]>([
    ['as it is', () => undefined, undefined],
    ['a node behind the last', (words, { nodeCount }) => (words[inner(words)] = nodeCount), 'bvh/corrupt'],
    ['the root as a child', (words) => (words[inner(words)] = 0), 'bvh/corrupt'],
    [
      'a node as its own child',
      (words) => (words[inner(words)] = Math.floor(inner(words) / NODE_WORDS)),
      'bvh/corrupt',
    ],
    ['another parent', (words) => (words[NODE_WORDS + 11] = 7), 'bvh/corrupt'],
    ['a leaf beyond the triangles', (words) => (words[leaf(words)] = leafReference(60, 1)), 'bvh/corrupt'],
    ['a leaf across the end', (words) => (words[leaf(words)] = leafReference(59, 2)), 'bvh/corrupt'],
    ['a node that is never reached', (words) => (words[inner(words)] = leafReference(0, 1)), 'bvh/corrupt'],
    ['a triangle that the mesh has not', (_, blas) => (blas.triangleIndices[5] = 60), 'bvh/other-mesh'],
  ])('%s', (_, change, expected) => {
    expect(spoilt(change)).toBe(expected);
  });

  test('too deep', () => {
    // A vine: each node has a leaf and the next node.
    const nodeCount = 41;
    const nodes = new Float32Array(nodeCount * NODE_WORDS);
    const words = new Uint32Array(nodes.buffer);
    for (let i = 0; i < nodeCount; i++) {
      words[i * NODE_WORDS + LEFT] = leafReference(0, 1);
      words[i * NODE_WORDS + RIGHT] = i + 1 < nodeCount ? i + 1 : leafReference(0, 1);
      words[i * NODE_WORDS + 11] = Math.max(0, i - 1);
    }
    const vine = {
      nodes,
      nodeCount,
      triangleIndices: new Uint32Array(1),
      bounds: { min: new Float32Array(3), max: new Float32Array(3) },
    };
    expect(code(() => deserializeBlas(serializeBlas(vine)))).toBe('bvh/corrupt');
    words[(nodeCount - 2) * NODE_WORDS + RIGHT] = leafReference(0, 1);
    expect(
      code(() =>
        deserializeBlas(serializeBlas({ ...vine, nodes: nodes.slice(0, -NODE_WORDS), nodeCount: nodeCount - 1 })),
      ),
    ).toBeUndefined();
  });

  test('no root, another number of trees', () => {
    expect(
      code(() => deserializeBlas(serializeBlas({ ...buildBlas(mesh), nodes: new Float32Array(0), nodeCount: 0 }))),
    ).toBe('bvh/corrupt');
    const two = serializeBlases([buildBlas(mesh), buildBlas(mesh)]);
    expect(code(() => deserializeBlas(two))).toBe('bvh/other-mesh');
    expect(code(() => deserializeBlases(two, [mesh]))).toBe('bvh/other-mesh');
    expect(code(() => deserializeBlases(two, [mesh, none]))).toBe('bvh/other-mesh');
  });
});
