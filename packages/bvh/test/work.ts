import { closestHit, type Blas, type TriangleMesh } from '../src/index';
import { LEAF, LEFT, LEFT_MIN, leafCount, NODE_WORDS, RIGHT, RIGHT_MIN } from '../src/layout';
import { direction, randomNumbers } from './shapes';

/**
 * Inner nodes and triangles that random rays through the box of a hierarchy meet up to their hit, on the average: what
 * the surface area cost predicts, counted.
 */
export function work(blas: Blas, mesh: TriangleMesh, seed: number, rays = 2000): number {
  const random = randomNumbers(seed);
  const { nodes, bounds } = blas;
  const words = new Uint32Array(nodes.buffer);
  const center = [0, 1, 2].map((k) => (bounds.min[k]! + bounds.max[k]!) / 2),
    radius = Math.hypot(...[0, 1, 2].map((k) => bounds.max[k]! - bounds.min[k]!)) / 2;
  let met = 0;
  for (let ray = 0; ray < rays; ray++) {
    const from = direction(random),
      to = direction(random);
    const origin = from.map((x, k) => center[k]! + radius * x),
      along = to.map((x, k) => center[k]! + radius * x - origin[k]!);
    const end = closestHit(blas, mesh, { origin, direction: along })?.t ?? Infinity;
    const enters = (low: number) => {
      let near = 0,
        far = end;
      for (let k = 0; k < 3; k++) {
        const a = (nodes[low + k]! - origin[k]!) / along[k]!,
          b = (nodes[low + 4 + k]! - origin[k]!) / along[k]!;
        near = Math.max(near, Math.min(a, b));
        far = Math.min(far, Math.max(a, b));
      }
      return near <= far;
    };
    const stack = [0];
    while (stack.length > 0) {
      const node = stack.pop()!;
      met++;
      for (const [at, low] of [
        [LEFT, LEFT_MIN],
        [RIGHT, RIGHT_MIN],
      ] as const) {
        if (!enters(node * NODE_WORDS + low)) continue;
        const reference = words[node * NODE_WORDS + at]!;
        if (reference < LEAF) stack.push(reference);
        else met += leafCount(reference);
      }
    }
  }
  return met / rays;
}
