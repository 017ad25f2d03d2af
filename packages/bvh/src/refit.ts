import type { Blas, TriangleMesh } from './blas';
import { BvhError } from './error';
import { encloseChildren, FAR, LEAF, LEFT, LEFT_MAX, LEFT_MIN, leafCount, leafFirst, NODE_WORDS, RIGHT, RIGHT_MAX, RIGHT_MIN, rootBounds } from './layout';

/**
 * Fits the boxes of a BLAS to moved vertices, in place; the tree keeps its shape, so it gets worse as the mesh departs
 * from what it was built for: watch {@link sahCost} and rebuild when it has grown by half or so. Triangles that were left
 * out of the build stay out.
 *
 * @param mesh The mesh with its new positions; same triangles, same order.
 * @throws {BvhError} `bvh/positions` if a triangle that is in the tree is gone or no longer finite; the boxes are then undefined.
 */
export function refitBlas(blas: Blas, mesh: TriangleMesh): void {
  const { nodes, triangleIndices, bounds } = blas;
  const { positions, indices } = mesh;
  if (triangleIndices.length === 0) return;
  const words = new Uint32Array(nodes.buffer, nodes.byteOffset, nodes.length);
  const side = (node: number, reference: number, min: number, max: number) => {
    const target = node * NODE_WORDS;
    if ((reference & LEAF) === 0) {
      encloseChildren(nodes, target + min, target + max, reference * NODE_WORDS);
      return;
    }
    const first = 3 * leafFirst(reference);
    for (let k = 0; k < 3; k++) {
      let low = Infinity, high = -Infinity;
      for (let corner = first; corner < first + 3 * leafCount(reference); corner++) {
        const index = 3 * (triangleIndices[Math.floor(corner / 3)] as number) + (corner % 3);
        const x = positions[3 * (indices ? (indices[index] ?? Infinity) : index) + k];
        if (!Number.isFinite(x)) throw new BvhError('bvh/positions', `Triangle ${Math.floor(index / 3)} is no more, or has moved to a place that is not finite: build the hierarchy anew.`);
        low = Math.min(low, x as number);
        high = Math.max(high, x as number);
      }
      nodes[target + min + k] = low;
      nodes[target + max + k] = high;
    }
  };
  // Children have higher indices than their parents.
  for (let node = blas.nodeCount - 1; node >= 0; node--) {
    side(node, words[node * NODE_WORDS + LEFT] as number, LEFT_MIN, LEFT_MAX);
    if (nodes[node * NODE_WORDS + RIGHT_MIN] !== FAR) side(node, words[node * NODE_WORDS + RIGHT] as number, RIGHT_MIN, RIGHT_MAX);
  }
  const { min, max } = rootBounds(nodes);
  bounds.min.set(min);
  bounds.max.set(max);
}
