/** 32-bit words of a wide node. */
export const WIDE_WORDS = 20;
/** Maximum number of children of a wide node. */
export const WIDTH = 8;
/** Maximum number of primitives of one child. */
export const WIDE_LEAF_MAX = 4;
/**
 * Wide nodes on the longest path from the root of a BLAS to a leaf, and in a TLAS: one replaces three levels.
 */
export const WIDE_BLAS_DEPTH = 14;
export const WIDE_TLAS_DEPTH = 8;
/** Stack entries needed to traverse both levels. */
export const WIDE_STACK_SIZE = WIDE_BLAS_DEPTH + WIDE_TLAS_DEPTH;

// Words of a node:
//   0–2 lower corner; 3 exponents of the steps along x, y, z (a byte each, biased by 127), which children are nodes (a
//   byte)
//   4 first of its child nodes, 5 first of its primitives, 6–7 a byte for each child (see below)
//   8–19 six bytes for each child: lower x (words 8, 9), y, z, upper x, y, z, in steps from the lower corner
/**
 * A child's byte: a node. Else the upper three bits count its primitives (0: no child), the lower five give the first.
 */
export const WIDE_NODE = 0xe0;
