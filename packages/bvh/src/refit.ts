import { boundsOf, triangleBoxes, triangleCount, type Blas, type TriangleMesh } from './blas';
import { BvhError } from './error';
import { FAR, LEAF, LEFT, LEFT_MAX, LEFT_MIN, leafCount, leafFirst, NODE_WORDS, RIGHT, RIGHT_MAX, RIGHT_MIN } from './layout';

/**
 * Fits the boxes of a BLAS to moved vertices, in place; the tree keeps its shape, so it gets worse as the mesh departs
 * from what it was built for: watch {@link sahCost} and rebuild when it has grown by half or so. Triangles that were left
 * out of the build stay out.
 *
 * @param mesh The mesh with its new positions; same triangles, same order.
 * @throws {BvhError} `bvh/indices` if the mesh has other triangles, `bvh/positions` if one that is in the tree is no longer finite.
 */
export function refitBlas(blas: Blas, mesh: TriangleMesh): void {
  const { nodes, triangleIndices } = blas;
  const count = triangleCount(mesh);
  const boxes = new Float32Array(count * 6);
  triangleBoxes(mesh, boxes);
  for (const triangle of triangleIndices) {
    if (triangle >= count) throw new BvhError('bvh/indices', `The hierarchy was built over more triangles than the ${count} given: build it anew.`);
    for (let k = 0; k < 6; k++) {
      if (!Number.isFinite(boxes[6 * triangle + k])) throw new BvhError('bvh/positions', `Triangle ${triangle} has moved to a place that is not finite: build the hierarchy anew.`);
    }
  }
  if (triangleIndices.length === 0) return;
  const words = new Uint32Array(nodes.buffer, nodes.byteOffset, nodes.length);
  const side = (node: number, reference: number, min: number, max: number) => {
    const target = node * NODE_WORDS;
    if ((reference & LEAF) !== 0) {
      const first = leafFirst(reference);
      for (let k = 0; k < 3; k++) {
        let low = Infinity, high = -Infinity;
        for (let i = first; i < first + leafCount(reference); i++) {
          const b = 6 * (triangleIndices[i] as number) + k;
          low = Math.min(low, boxes[b] as number);
          high = Math.max(high, boxes[b + 3] as number);
        }
        nodes[target + min + k] = low;
        nodes[target + max + k] = high;
      }
      return;
    }
    const child = reference * NODE_WORDS;
    for (let k = 0; k < 3; k++) {
      nodes[target + min + k] = Math.min(nodes[child + LEFT_MIN + k] as number, nodes[child + RIGHT_MIN + k] as number);
      nodes[target + max + k] = Math.max(nodes[child + LEFT_MAX + k] as number, nodes[child + RIGHT_MAX + k] as number);
    }
  };
  // Children have higher indices than their parents.
  for (let node = blas.nodeCount - 1; node >= 0; node--) {
    side(node, words[node * NODE_WORDS + LEFT] as number, LEFT_MIN, LEFT_MAX);
    if (nodes[node * NODE_WORDS + RIGHT_MIN] !== Math.fround(FAR)) side(node, words[node * NODE_WORDS + RIGHT] as number, RIGHT_MIN, RIGHT_MAX);
  }
  const { min, max } = boundsOf(boxes, triangleIndices);
  blas.bounds.min.set(min);
  blas.bounds.max.set(max);
}
