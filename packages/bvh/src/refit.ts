import type { Blas } from './blas';
import { BvhError } from './error';
import {
  encloseChildren,
  FAR,
  LEAF,
  leafCount,
  leafFirst,
  LEFT,
  LEFT_MAX,
  LEFT_MIN,
  NODE_WORDS,
  RIGHT,
  RIGHT_MAX,
  RIGHT_MIN,
  rootBounds,
  type TriangleMesh,
} from './layout';

/**
 * Fits the boxes of a BLAS to moved vertices, in place; the tree keeps its topology, so its quality drops as the mesh
 * departs from the one that it was built for: `RefitQuality` of `@glanz/bvh/refit-quality` tells when to rebuild.
 * Triangles that were left out of the build stay out.
 *
 * @param mesh The mesh with its new positions; same triangles, same order.
 * @throws {BvhError} `bvh/positions` if a triangle that is in the tree is gone or no longer finite; the boxes are then
 * undefined.
 */
export function refitBlas(blas: Blas, mesh: TriangleMesh): void {
  const { nodes, triangleIndices, bounds } = blas;
  if (triangleIndices.length === 0) return;
  const words = new Uint32Array(nodes.buffer, nodes.byteOffset, nodes.length);
  // Children have higher indices than their parents.
  for (let at = (blas.nodeCount - 1) * NODE_WORDS; at >= 0; at -= NODE_WORDS) {
    for (let side = LEFT_MIN; side <= RIGHT_MIN; side += RIGHT_MIN - LEFT_MIN) {
      if (nodes[at + side] === FAR) continue;
      const reference = words[at + (side === LEFT_MIN ? LEFT : RIGHT)] as number;
      const max = at + side + (side === LEFT_MIN ? LEFT_MAX - LEFT_MIN : RIGHT_MAX - RIGHT_MIN);
      if (reference < LEAF) encloseChildren(nodes, at + side, max, reference * NODE_WORDS);
      else encloseTriangles(nodes, at + side, max, triangleIndices, reference, mesh);
    }
  }
  const { min, max } = rootBounds(nodes);
  bounds.min.set(min);
  bounds.max.set(max);
}

/** Sets the box at `min` and `max` to that around the triangles of a leaf. */
function encloseTriangles(
  nodes: Float32Array,
  min: number,
  max: number,
  triangleIndices: Uint32Array,
  leaf: number,
  { positions, indices }: TriangleMesh,
): void {
  const first = leafFirst(leaf),
    end = first + leafCount(leaf);
  let x0 = Infinity,
    y0 = Infinity,
    z0 = Infinity,
    x1 = -Infinity,
    y1 = -Infinity,
    z1 = -Infinity;
  for (let i = first; i < end; i++) {
    const triangle = triangleIndices[i] as number;
    let sum = 0;
    for (let corner = 3 * triangle; corner < 3 * triangle + 3; corner++) {
      const v = 3 * (indices ? (indices[corner] as number) : corner);
      const x = positions[v] as number,
        y = positions[v + 1] as number,
        z = positions[v + 2] as number;
      if (x < x0) x0 = x;
      if (y < y0) y0 = y;
      if (z < z0) z0 = z;
      if (x > x1) x1 = x;
      if (y > y1) y1 = y;
      if (z > z1) z1 = z;
      sum += x + y + z;
    }
    // Only if each of the nine numbers is there and finite; so many floats do not overflow a double.
    if (!Number.isFinite(sum))
      throw new BvhError(
        'bvh/positions',
        `Triangle ${triangle} is missing, or its position is not finite: build the hierarchy again.`,
      );
  }
  nodes[min] = x0;
  nodes[min + 1] = y0;
  nodes[min + 2] = z0;
  nodes[max] = x1;
  nodes[max + 1] = y1;
  nodes[max + 2] = z1;
}
