/** Triangles to build over or to trace. */
export interface TriangleMesh {
  /** xyz per vertex, stride 3. */
  readonly positions: Float32Array;
  /** Three per triangle, into the vertices. Absent: the vertices are taken in threes. */
  readonly indices?: Uint32Array | Uint16Array | undefined;
}
/** 32-bit words of a node. */
export const NODE_WORDS = 16;

/** 32-bit words of a packed triangle. */
export const TRIANGLE_WORDS = 12;

/** Maximum number of inner nodes on a path from the root of a BLAS to a leaf. */
export const BLAS_MAX_DEPTH = 40;

/** Maximum number of inner nodes on a path from the root of a TLAS to a leaf. */
export const TLAS_MAX_DEPTH = 22;

/** Stack entries needed to traverse both levels, the two end marks included. */
export const BVH_STACK_SIZE = BLAS_MAX_DEPTH + TLAS_MAX_DEPTH + 2;

/** Set in a reference to a leaf. */
export const LEAF = 0x80000000;

/** Bits of a leaf's first primitive. */
export const LEAF_FIRST_BITS = 27;

/** Maximum number of primitives in a leaf. */
export const LEAF_MAX = 16;

/** Maximum number of primitives in one hierarchy. */
export const MAX_PRIMITIVES = 2 ** LEAF_FIRST_BITS - LEAF_MAX;

/** Coordinate of the empty box: a point that no ray reaches. */
export const FAR = 3.4028234663852886e38;

/** The reference to a leaf of `count` primitives from `first` on. */
export const leafReference = (first: number, count: number): number =>
  (LEAF | ((count - 1) << LEAF_FIRST_BITS) | first) >>> 0;

/** First primitive of the leaf behind a reference. */
export const leafFirst = (reference: number): number => reference & ((1 << LEAF_FIRST_BITS) - 1);

/** How many primitives the leaf behind a reference has, 1 to 16. */
export const leafCount = (reference: number): number => ((reference >>> LEAF_FIRST_BITS) & (LEAF_MAX - 1)) + 1;

/** Word offsets within a node. */
export const LEFT_MIN = 0;
export const LEFT = 3;
export const LEFT_MAX = 4;
export const RIGHT = 7;
export const RIGHT_MIN = 8;
export const PARENT = 11;
export const RIGHT_MAX = 12;
export const RESERVED = 15;

/** An axis-aligned box: xyz of the lower and of the upper corner. Empty: min > max. */
export interface Aabb {
  readonly min: Float32Array;
  readonly max: Float32Array;
}

/** The box around both children of the root; min > max for an empty tree. */
export function rootBounds(nodes: Float32Array): Aabb {
  const min = new Float32Array(3).fill(Infinity),
    max = new Float32Array(3).fill(-Infinity);
  for (const low of [LEFT_MIN, RIGHT_MIN]) {
    if (nodes[low] === FAR) continue;
    for (let k = 0; k < 3; k++) {
      min[k] = Math.min(min[k] as number, nodes[low + k] as number);
      max[k] = Math.max(max[k] as number, nodes[low + LEFT_MAX + k] as number);
    }
  }
  return { min, max };
}

/** Sets the box at `min` and `max` to that around both children of the node that starts at word `child`. */
export function encloseChildren(nodes: Float32Array, min: number, max: number, child: number): void {
  for (let k = 0; k < 3; k++) {
    nodes[min + k] = Math.min(nodes[child + LEFT_MIN + k] as number, nodes[child + RIGHT_MIN + k] as number);
    nodes[max + k] = Math.max(nodes[child + LEFT_MAX + k] as number, nodes[child + RIGHT_MAX + k] as number);
  }
}

/** Writes six numbers. */
export function putBox(
  boxes: Float32Array | Float64Array,
  at: number,
  x0: number,
  y0: number,
  z0: number,
  x1: number,
  y1: number,
  z1: number,
): void {
  boxes[at] = x0;
  boxes[at + 1] = y0;
  boxes[at + 2] = z0;
  boxes[at + 3] = x1;
  boxes[at + 4] = y1;
  boxes[at + 5] = z1;
}

/** Copies six numbers: three to `at`, three to `at + stride`. */
export function copyBox(to: Float32Array, at: number, stride: number, from: Float32Array, b: number): void {
  to[at] = from[b] as number;
  to[at + 1] = from[b + 1] as number;
  to[at + 2] = from[b + 2] as number;
  at += stride;
  to[at] = from[b + 3] as number;
  to[at + 1] = from[b + 4] as number;
  to[at + 2] = from[b + 5] as number;
}

/** Inner nodes in an order in which parents come before their children, whatever their places in memory. */
export function parentsFirst(words: Uint32Array, nodeCount: number): Uint32Array<ArrayBuffer> {
  const order = new Uint32Array(nodeCount);
  for (let next = 0, found = 1; next < found; next++) {
    const base = (order[next] as number) * NODE_WORDS;
    for (const side of [LEFT, RIGHT]) {
      const reference = words[base + side] as number;
      if (reference < LEAF) order[found++] = reference;
    }
  }
  return order;
}
