import { closestHit, type Blas, type TriangleMesh } from '@glanz/bvh';

// The nodes as `bvhNodeStruct` lays them out, in words: two boxes with a reference after each lower corner.
const NODE = 16;
const SIDES = [
  { low: 0, reference: 3 },
  { low: 8, reference: 7 },
] as const;
const LEAF = 0x80000000;

/** What a ray has met. */
export interface Traced {
  /** Nodes and triangles that it had to look at, up to its hit. */
  cost: number;
  /** Cosine between the ray and the surface; −1 where it hits nothing. */
  facing: number;
}

const references = new Uint32Array(64);

/** Goes along a ray, and counts. Directions must have unit length. */
export function trace(
  blas: Blas,
  words: Uint32Array,
  mesh: TriangleMesh,
  origin: readonly number[],
  direction: readonly number[],
  out: Traced,
): void {
  const hit = closestHit(blas, mesh, { origin, direction });
  const end = hit?.t ?? Infinity;
  const { nodes } = blas;
  const [ox, oy, oz] = origin as [number, number, number];
  const ix = 1 / direction[0]!,
    iy = 1 / direction[1]!,
    iz = 1 / direction[2]!;
  let cost = 0,
    top = 1;
  references[0] = 0;
  while (top > 0) {
    const at = NODE * references[--top]!;
    cost++;
    for (const { low, reference } of SIDES) {
      const b = at + low;
      const x0 = (nodes[b]! - ox) * ix,
        x1 = (nodes[b + 4]! - ox) * ix,
        y0 = (nodes[b + 1]! - oy) * iy,
        y1 = (nodes[b + 5]! - oy) * iy,
        z0 = (nodes[b + 2]! - oz) * iz,
        z1 = (nodes[b + 6]! - oz) * iz;
      const near = Math.max(0, Math.min(x0, x1), Math.min(y0, y1), Math.min(z0, z1)),
        far = Math.min(end, Math.max(x0, x1), Math.max(y0, y1), Math.max(z0, z1));
      if (!(near <= far)) continue;
      const child = words[at + reference]!;
      if (child < LEAF) references[top++] = child;
      else cost += ((child >>> 27) & 15) + 1;
    }
  }
  out.cost = cost;
  out.facing = hit ? facing(mesh, hit.triangle, direction) : -1;
}

function facing({ positions: p, indices }: TriangleMesh, triangle: number, d: readonly number[]): number {
  const [a, b, c] = [0, 1, 2].map((k) => 3 * (indices ? indices[3 * triangle + k]! : 3 * triangle + k)) as [
    number,
    number,
    number,
  ];
  const ex = p[b]! - p[a]!,
    ey = p[b + 1]! - p[a + 1]!,
    ez = p[b + 2]! - p[a + 2]!;
  const fx = p[c]! - p[a]!,
    fy = p[c + 1]! - p[a + 1]!,
    fz = p[c + 2]! - p[a + 2]!;
  const x = ey * fz - ez * fy,
    y = ez * fx - ex * fz,
    z = ex * fy - ey * fx;
  return Math.abs(x * d[0]! + y * d[1]! + z * d[2]!) / (Math.hypot(x, y, z) || 1);
}

/**
 * The boxes on one level of a tree, six numbers each: min xyz, max xyz. Leaves that come earlier stay in. Level 0 is
 * the box of all.
 */
export function boxesOnLevel(blas: Blas, level: number): Float32Array[] {
  const words = new Uint32Array(blas.nodes.buffer, blas.nodes.byteOffset, blas.nodes.length);
  if (blas.triangleIndices.length === 0) return [];
  let boxes: { box: Float32Array; reference: number }[] = [
    { box: Float32Array.of(...blas.bounds.min, ...blas.bounds.max), reference: 0 },
  ];
  for (let i = 0; i < level; i++) {
    boxes = boxes.flatMap((entry) => {
      if (entry.reference >= LEAF) return [entry];
      const at = NODE * entry.reference;
      return SIDES.map(({ low, reference }) => ({
        box: Float32Array.of(
          ...blas.nodes.subarray(at + low, at + low + 3),
          ...blas.nodes.subarray(at + low + 4, at + low + 7),
        ),
        reference: words[at + reference]!,
      }));
    });
  }
  return boxes.map(({ box }) => box);
}
