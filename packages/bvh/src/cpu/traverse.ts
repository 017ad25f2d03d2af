import { LEAF, LEFT, LEFT_MAX, LEFT_MIN, NODE_WORDS, RIGHT, RIGHT_MAX, RIGHT_MIN } from '../layout';
import type { BvhNodes } from '../statistics';
import type { PreparedRay } from './triangle';

/** Moves the far side of a box out by more than rounding can move it in. */
const OUTWARD = 1 + 2 ** -50;

function enter(nodes: Float32Array, min: number, max: number, ray: PreparedRay, tMin: number, tMax: number): number {
  const x0 = ((nodes[min] as number) - ray.ox) * ray.ix, x1 = ((nodes[max] as number) - ray.ox) * ray.ix;
  const y0 = ((nodes[min + 1] as number) - ray.oy) * ray.iy, y1 = ((nodes[max + 1] as number) - ray.oy) * ray.iy;
  const z0 = ((nodes[min + 2] as number) - ray.oz) * ray.iz, z1 = ((nodes[max + 2] as number) - ray.oz) * ray.iz;
  const near = Math.max(Math.min(x0, x1), Math.min(y0, y1), Math.min(z0, z1), tMin);
  const far = Math.min(Math.max(x0, x1), Math.max(y0, y1), Math.max(z0, z1), tMax) * OUTWARD;
  return near <= far ? near : Infinity;
}

/**
 * Walks a hierarchy along a ray, nearer children first.
 *
 * @param leaf Told the reference of each leaf whose box the ray meets below the current end, and gives the new end of the
 * ray; anything under `tMin` stops the walk.
 */
export function traverse(bvh: BvhNodes, ray: PreparedRay, tMin: number, tMax: number, leaf: (reference: number, tMax: number) => number): void {
  const { nodes } = bvh;
  const words = new Uint32Array(nodes.buffer, nodes.byteOffset, nodes.length);
  const stack: number[] = [0];
  let end = tMax;
  while (stack.length > 0) {
    const reference = stack.pop() as number;
    if ((reference & LEAF) !== 0) {
      end = leaf(reference, end);
      if (end < tMin) return;
      continue;
    }
    const base = reference * NODE_WORDS;
    const left = enter(nodes, base + LEFT_MIN, base + LEFT_MAX, ray, tMin, end);
    const right = enter(nodes, base + RIGHT_MIN, base + RIGHT_MAX, ray, tMin, end);
    if (left <= right) {
      if (right < Infinity) stack.push(words[base + RIGHT] as number);
      if (left < Infinity) stack.push(words[base + LEFT] as number);
    } else {
      if (left < Infinity) stack.push(words[base + LEFT] as number);
      stack.push(words[base + RIGHT] as number);
    }
  }
}
