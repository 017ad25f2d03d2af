import type { Blas } from './blas';
import { BvhError } from './error';
import {
  BLAS_MAX_DEPTH,
  FAR,
  LEAF,
  leafCount,
  leafFirst,
  LEFT,
  LEFT_MIN,
  NODE_WORDS,
  PARENT,
  RIGHT,
  RIGHT_MIN,
  type TriangleMesh,
} from './layout';

/** Version of the format that {@link serializeBlas} writes and {@link deserializeBlas} reads. */
export const SERIALIZED_VERSION = 1;

// A file is 32-bit words, in the order of the machine that wrote it; read in the other order, the magic shows it.
//   0 magic, 1 version, 2 number of trees, 3 checksum of all words from 4 on
//   then for each tree 8 words: nodes, triangle indices, box (min xyz, max xyz as floats)
//   then the nodes of all trees, 16 words each, then the triangle indices of all trees
const MAGIC = 0x48564247; // "GBVH" in little-endian bytes
const HEADER_WORDS = 4;
const TREE_WORDS = 8;

/**
 * Serializes hierarchies into one buffer, to be stored or sent: about 35 bytes a triangle. {@link deserializeBlases}
 * restores the same trees. The meshes are not included.
 */
export function serializeBlases(trees: readonly Blas[]): ArrayBuffer {
  const length = trees.reduce(
    (sum, { nodes, triangleIndices }) => sum + TREE_WORDS + nodes.length + triangleIndices.length,
    HEADER_WORDS,
  );
  const words = new Uint32Array(length),
    floats = new Float32Array(words.buffer);
  words[0] = MAGIC;
  words[1] = SERIALIZED_VERSION;
  words[2] = trees.length;
  let at = HEADER_WORDS;
  for (const { nodeCount, triangleIndices, bounds } of trees) {
    words[at] = nodeCount;
    words[at + 1] = triangleIndices.length;
    floats.set(bounds.min, at + 2);
    floats.set(bounds.max, at + 5);
    at += TREE_WORDS;
  }
  const put = (array: Float32Array | Uint32Array) => {
    // As integers: floats that are no numbers would not keep their bits.
    words.set(new Uint32Array(array.buffer, array.byteOffset, array.length), at);
    at += array.length;
  };
  for (const { nodes } of trees) put(nodes);
  for (const { triangleIndices } of trees) put(triangleIndices);
  words[3] = checksum(words);
  return words.buffer;
}

/** Serializes one hierarchy. See {@link serializeBlases}. */
export const serializeBlas = (blas: Blas): ArrayBuffer => serializeBlases([blas]);

/**
 * Restores hierarchies from a buffer of {@link serializeBlases}. Everything is validated, so that no query or traversal
 * of the result reads outside its arrays, whatever the buffer holds: lengths, the checksum, every reference and
 * the depth; and with `meshes` also that every triangle index exists.
 *
 * @param data May come from a machine of another byte order. Its words need not be aligned.
 * @param meshes What each tree was built for. Without them, keep the trees together with their meshes by other means,
 * such as the key of `@glanz/bvh/cache`.
 * @throws {BvhError} `bvh/not-serialized` if it is something else, `bvh/version` if written by another version of the
 * format, `bvh/truncated` for a wrong length, `bvh/checksum` if bytes have changed, `bvh/corrupt` for trees with
 * invalid references or too many levels, `bvh/other-mesh` if the trees are not those of the meshes.
 */
export function deserializeBlases(data: ArrayBuffer | ArrayBufferView, meshes?: readonly TriangleMesh[]): Blas[] {
  const words = wordsOf(data);
  if (words[1] !== SERIALIZED_VERSION)
    throw new BvhError(
      'bvh/version',
      `The hierarchy has version ${words[1]} of the format; this package reads ${SERIALIZED_VERSION}: build it again.`,
    );
  const count = words[2] as number;
  const truncated = () =>
    new BvhError('bvh/truncated', `The hierarchy of ${words.length} words is truncated: build it again.`);
  if (words.length < HEADER_WORDS + TREE_WORDS * count) throw truncated();
  let length = HEADER_WORDS + TREE_WORDS * count,
    nodeWords = 0;
  for (let tree = 0; tree < count; tree++) {
    const at = HEADER_WORDS + TREE_WORDS * tree;
    nodeWords += NODE_WORDS * (words[at] as number);
    length += NODE_WORDS * (words[at] as number) + (words[at + 1] as number);
  }
  if (words.length !== length) throw truncated();
  if (words[3] !== checksum(words))
    throw new BvhError('bvh/checksum', 'The bytes of the hierarchy have changed since it was written: build it again.');
  if (meshes && meshes.length !== count)
    throw new BvhError(
      'bvh/other-mesh',
      `There are ${count} hierarchies for ${meshes.length} meshes: build them again.`,
    );
  let node = HEADER_WORDS + TREE_WORDS * count,
    index = node + nodeWords;
  const trees: Blas[] = [];
  for (let tree = 0; tree < count; tree++) {
    const at = HEADER_WORDS + TREE_WORDS * tree;
    const nodeCount = words[at] as number,
      indexCount = words[at + 1] as number;
    const box = new Float32Array(words.slice(at + 2, at + TREE_WORDS).buffer);
    const nodes = new Float32Array(words.slice(node, (node += NODE_WORDS * nodeCount)).buffer);
    const triangleIndices = words.slice(index, (index += indexCount));
    checkNodes(nodes, nodeCount, indexCount, tree);
    const mesh = meshes?.[tree];
    if (mesh) checkTriangles(triangleIndices, mesh, tree);
    trees.push({ nodes, nodeCount, triangleIndices, bounds: { min: box.slice(0, 3), max: box.slice(3) } });
  }
  return trees;
}

/** Restores one hierarchy from a buffer of {@link serializeBlas}. See {@link deserializeBlases}. */
export function deserializeBlas(data: ArrayBuffer | ArrayBufferView, mesh?: TriangleMesh): Blas {
  const [blas, other] = deserializeBlases(data, mesh && [mesh]);
  if (!blas || other)
    throw new BvhError(
      'bvh/other-mesh',
      'The buffer does not hold exactly one hierarchy: read it by deserializeBlases().',
    );
  return blas;
}

/** The words of a buffer in this machine's order; without a copy if it is aligned. */
function wordsOf(data: ArrayBuffer | ArrayBufferView): Uint32Array<ArrayBuffer> {
  const bytes = ArrayBuffer.isView(data)
    ? new Uint8Array(data.buffer, data.byteOffset, data.byteLength)
    : new Uint8Array(data);
  const other = () =>
    new BvhError('bvh/not-serialized', 'The buffer does not begin like a serialized hierarchy: build it again.');
  if (bytes.length < 4) throw other();
  const whole = bytes.length - (bytes.length % 4);
  const plain = bytes.buffer instanceof ArrayBuffer && bytes.byteOffset % 4 === 0;
  let words = plain
    ? new Uint32Array(bytes.buffer as ArrayBuffer, bytes.byteOffset, whole / 4)
    : new Uint32Array(bytes.slice(0, whole).buffer);
  if (words[0] === swapped(MAGIC)) words = words.map(swapped);
  if (words[0] !== MAGIC) throw other();
  if (whole !== bytes.length || words.length < HEADER_WORDS)
    throw new BvhError('bvh/truncated', `The hierarchy of ${bytes.length} bytes is truncated: build it again.`);
  return words;
}

const swapped = (word: number): number =>
  ((word << 24) | ((word & 0xff00) << 8) | ((word >>> 8) & 0xff00) | (word >>> 24)) >>> 0;

/**
 * Mixes words as MurmurHash3 (Appleby 2008) does. Each step is a bijection, so a change within one word is always
 * detected.
 */
function checksum(words: Uint32Array): number {
  let hash = 0;
  for (let i = HEADER_WORDS; i < words.length; i++) {
    let k = Math.imul(words[i] as number, 0xcc9e2d51);
    k = Math.imul((k << 15) | (k >>> 17), 0x1b873593);
    hash ^= k;
    hash = (Math.imul((hash << 13) | (hash >>> 19), 5) + 0xe6546b64) | 0;
  }
  return hash >>> 0;
}

/**
 * Checks that every reference points to a later node or to existing triangles, that every node is reached once, and
 * that none is too deep.
 */
function checkNodes(nodes: Float32Array, nodeCount: number, indexCount: number, tree: number): void {
  const corrupt = (what: string) =>
    new BvhError('bvh/corrupt', `Tree ${tree} of the serialized hierarchies ${what}: build it again.`);
  if (nodeCount === 0) throw corrupt('has no root');
  const words = new Uint32Array(nodes.buffer);
  const depths = new Uint8Array(nodeCount);
  depths[0] = 1;
  for (let node = 0; node < nodeCount; node++) {
    const at = node * NODE_WORDS;
    // Parents come first, so a node that no earlier node refers to is unreachable.
    const depth = depths[node] as number;
    if (depth === 0) throw corrupt(`never leads to its node ${node}`);
    if (depth > BLAS_MAX_DEPTH) throw corrupt('is too deep');
    for (const [side, low] of [
      [LEFT, LEFT_MIN],
      [RIGHT, RIGHT_MIN],
    ] as const) {
      const reference = words[at + side] as number;
      if (reference < LEAF) {
        if (
          reference <= node ||
          reference >= nodeCount ||
          depths[reference] !== 0 ||
          words[reference * NODE_WORDS + PARENT] !== node
        )
          throw corrupt(`leads from node ${node} to ${reference}`);
        depths[reference] = depth + 1;
      } else {
        // An empty tree refers to a leaf that does not exist, behind boxes that no ray enters.
        const missing =
          nodes[at + low] === FAR && node === 0 && nodeCount === 1 && (side === RIGHT || indexCount === 0);
        if (!missing && leafFirst(reference) + leafCount(reference) > indexCount)
          throw corrupt(`has a leaf at node ${node} without triangles`);
      }
    }
  }
}

function checkTriangles(triangleIndices: Uint32Array, { positions, indices }: TriangleMesh, tree: number): void {
  const count = Math.floor((indices ? indices.length : positions.length / 3) / 3);
  for (let i = 0; i < triangleIndices.length; i++) {
    if ((triangleIndices[i] as number) >= count)
      throw new BvhError(
        'bvh/other-mesh',
        `Tree ${tree} has a triangle ${triangleIndices[i]}; its mesh has ${count}: build it again.`,
      );
  }
}
