import { struct } from '@glanz/wgsl/struct';

/**
 * A node of two children with the boxes of both, 64 bytes. Each member has the three coordinates of a corner, as bits
 * of f32, and in its fourth word: `left_min` the reference of the left child, `left_max` that of the right one,
 * `right_min` the index of the node above (0 for the root), `right_max` nothing. As such compilers load a node with
 * four instructions; of vec3f and u32 they make eight, and rays are a tenth slower.
 *
 * A reference is the index of a node, counted from the first of its hierarchy, or (bit 31 set) a leaf: bits 27–30 the
 * number of primitives less one, bits 0–26 the first, in leaf order. A missing child is a point box at the largest
 * float, which no ray reaches.
 */
export const bvhNodeStruct = struct('BvhNode', {
  left_min: 'vec4u',
  left_max: 'vec4u',
  right_min: 'vec4u',
  right_max: 'vec4u',
});

/**
 * One instance as the traversal reads it, 64 bytes: the rows of the 3×4 matrix from world to object space, the first
 * node of its BLAS in the host's node buffer, the first triangle of its mesh in the host's triangle buffer, and two
 * words for the host.
 */
export const bvhInstanceStruct = struct('BvhInstance', {
  to_object_0: 'vec4f',
  to_object_1: 'vec4f',
  to_object_2: 'vec4f',
  blas_node: 'u32',
  triangle_offset: 'u32',
  id: 'u32',
  flags: 'u32',
});

/** The module of {@link bvhNodeStruct}, by the name that shaders import. */
export const BvhNode = bvhNodeStruct.module;

/** The module of {@link bvhInstanceStruct}, by the name that shaders import. */
export const BvhInstance = bvhInstanceStruct.module;
