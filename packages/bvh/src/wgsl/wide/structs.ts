import { struct } from '@glanz/wgsl/struct';

/**
 * A node of eight children with quantised boxes, 80 bytes (after Ylitie, Karras and Laine 2017, "Efficient Incoherent
 * Ray Traversal on GPUs Through Compressed Wide BVHs"), in whole words of four, as compilers load these at once.
 * `frame`: the origin, xyz as bits of f32; then exponents of the steps along x, y and z, biased by 127, in the lower
 * three bytes, and which children are nodes in the upper. `children`: x, from where on child nodes lie together; y, the
 * first primitive; zw, a byte for each child: 0xe0 a node, else the number of primitives (upper three bits; 0: no
 * child) and the first (lower five), counted from y. `boxes`: six times eight bytes, lower x, y, z, upper x, y, z, in
 * steps from the origin.
 */
export const bvhNodeStruct = struct('BvhNode', {
  frame: 'vec4u',
  children: 'vec4u',
  boxes: ['vec4u', 3],
});

/** The module of {@link bvhNodeStruct}, by the name that shaders import. */
export const BvhNode = bvhNodeStruct.module;
