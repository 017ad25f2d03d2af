import { struct } from '@glanz/wgsl/struct';

/**
 * A node of eight children with quantised boxes, 80 bytes (after Ylitie, Karras and Laine 2017, "Efficient Incoherent Ray
 * Traversal on GPUs Through Compressed Wide BVHs"). `steps`: exponents of the steps along x, y and z, biased by 127, in the
 * lower three bytes; which children are nodes in the upper. `kinds`, a byte for each child: 0xe0 a node, else the number of
 * primitives (upper three bits; 0: no child) and the first (lower five), counted from `primitive`. Child nodes lie together
 * from `child` on. `boxes`: six times eight bytes, lower x, y, z, upper x, y, z, in steps from `origin`.
 */
export const bvhNodeStruct = struct('BvhNode', {
  origin: 'vec3f',
  steps: 'u32',
  child: 'u32',
  primitive: 'u32',
  kinds: 'vec2u',
  boxes: ['vec4u', 3],
});
