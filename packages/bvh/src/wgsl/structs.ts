import { struct } from '@glanz/wgsl/struct';

/**
 * A node of two children with the boxes of both, 64 bytes. `left` and `right` are references: the index of a node,
 * counted from the first of its hierarchy, or (bit 31 set) a leaf: bits 27–30 the number of primitives less one, bits
 * 0–26 the first, in leaf order. A missing child is a point box at the largest float, which no ray reaches. `parent` is
 * the index of the node above, 0 for the root.
 */
export const bvhNodeStruct = struct('BvhNode', {
  left_min: 'vec3f',
  left: 'u32',
  left_max: 'vec3f',
  right: 'u32',
  right_min: 'vec3f',
  parent: 'u32',
  right_max: 'vec3f',
  reserved: 'u32',
});

/**
 * One instance as the traversal reads it, 64 bytes: the rows of the 3×4 matrix from world to object space, the first node
 * of its BLAS in the host's node buffer, the first triangle of its mesh in the host's triangle buffer, and two words
 * for the host.
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
