import type { Scene } from '@glanz/scene';
import { cross, unit, type Vec3 } from './optics';

/** A triangle in the world. */
export interface Triangle {
  readonly corner: Vec3;
  /** From the corner to the two others. */
  readonly edges: readonly [Vec3, Vec3];
  /** Unit normal of the front. */
  readonly normal: Vec3;
  readonly material: number;
}

/** Where a ray meets a triangle. */
export interface Hit {
  readonly distance: number;
  readonly triangle: number;
}

/** All triangles of a scene's visible instances. */
export function trianglesOf({ instances, meshes }: Scene): Triangle[] {
  return instances.flatMap(({ mesh, material, transform: m, visible }) => {
    if (visible === false) return [];
    const { positions, indices } = meshes[mesh]!;
    const corner = (i: number): Vec3 => {
      const [x, y, z] = [0, 1, 2].map((k) => positions[3 * indices[i]! + k]!) as [number, number, number];
      return [0, 1, 2].map((k) => m[k]! * x + m[4 + k]! * y + m[8 + k]! * z + m[12 + k]!) as unknown as Vec3;
    };
    return Array.from({ length: indices.length / 3 }, (_, t): Triangle => {
      const [a, b, c] = [corner(3 * t), corner(3 * t + 1), corner(3 * t + 2)];
      const edges = [b, c].map((p) => [p[0] - a[0], p[1] - a[1], p[2] - a[2]]) as unknown as readonly [Vec3, Vec3];
      return { corner: a, edges, normal: unit(cross(...edges)), material };
    });
  });
}

/** Boxes in boxes, in order of depth: a node's first half follows it. */
interface Tree {
  /** Least and greatest x, y, z of each node. */
  readonly bounds: number[];
  /** Of each node: the number of its second half, or 0. */
  readonly second: number[];
  /** Of each node without halves: its triangles. */
  readonly inside: (readonly number[])[];
}

const LEAF = 3;

/** Adds a node: halves at the median of the middles along the longest axis. */
function grow(tree: Tree, triangles: readonly Triangle[], inside: readonly number[]): void {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (const i of inside) {
    const { corner, edges } = triangles[i]!;
    for (let k = 0; k < 3; k++) {
      const ends = [corner[k]!, corner[k]! + edges[0][k]!, corner[k]! + edges[1][k]!];
      low[k] = Math.min(low[k]!, ...ends);
      high[k] = Math.max(high[k]!, ...ends);
    }
  }
  // A little wider, for rays that run along a side.
  tree.bounds.push(...low.map((x) => x - 1e-9), ...high.map((x) => x + 1e-9));
  const node = tree.second.push(0) - 1;
  tree.inside.push(inside.length > LEAF ? [] : inside);
  if (inside.length <= LEAF) return;
  const sizes = low.map((x, k) => high[k]! - x);
  const axis = sizes.indexOf(Math.max(...sizes));
  const middle = (i: number) =>
    triangles[i]!.corner[axis]! + (triangles[i]!.edges[0][axis]! + triangles[i]!.edges[1][axis]!) / 3;
  const sorted = [...inside].sort((a, b) => middle(a) - middle(b));
  const half = sorted.length >> 1;
  grow(tree, triangles, sorted.slice(0, half));
  tree.second[node] = tree.second.length;
  grow(tree, triangles, sorted.slice(half));
}

/** Numbers of a triangle in a flat array: its corner and its edges. */
const STRIDE = 9;

/** Distance at which a ray meets a triangle (Möller and Trumbore), or infinity. */
function meets(data: Float64Array, at: number, origin: Vec3, direction: Vec3): number {
  const [x, y, z] = direction;
  const ux = data[at + 3]!;
  const uy = data[at + 4]!;
  const uz = data[at + 5]!;
  const vx = data[at + 6]!;
  const vy = data[at + 7]!;
  const vz = data[at + 8]!;
  const px = y * vz - z * vy;
  const py = z * vx - x * vz;
  const pz = x * vy - y * vx;
  const determinant = ux * px + uy * py + uz * pz;
  if (determinant === 0) return Infinity;
  const sx = origin[0] - data[at]!;
  const sy = origin[1] - data[at + 1]!;
  const sz = origin[2] - data[at + 2]!;
  const a = (sx * px + sy * py + sz * pz) / determinant;
  if (a < 0 || a > 1) return Infinity;
  const qx = sy * uz - sz * uy;
  const qy = sz * ux - sx * uz;
  const qz = sx * uy - sy * ux;
  const b = (x * qx + y * qy + z * qz) / determinant;
  if (b < 0 || a + b > 1) return Infinity;
  return (vx * qx + vy * qy + vz * qz) / determinant;
}

/**
 * Finds the nearest triangle of a ray, in double precision and without offsets: a ray does not meet the triangle that it
 * starts on, `from`, nor its neighbours closer than 1e-10 m.
 */
export function nearestHit(
  triangles: readonly Triangle[],
): (origin: Vec3, direction: Vec3, from: number) => Hit | undefined {
  const tree: Tree = { bounds: [], second: [], inside: [] };
  grow(
    tree,
    triangles,
    triangles.map((_, i) => i),
  );
  const bounds = Float64Array.from(tree.bounds);
  const second = Int32Array.from(tree.second);
  const { inside } = tree;
  const data = Float64Array.from(triangles.flatMap(({ corner, edges }) => [...corner, ...edges[0], ...edges[1]]));
  const stack = new Int32Array(64);
  return (origin, direction, from) => {
    const [ox, oy, oz] = origin;
    const ix = 1 / direction[0];
    const iy = 1 / direction[1];
    const iz = 1 / direction[2];
    let distance = Infinity;
    let triangle = -1;
    let waiting = 1;
    stack[0] = 0;
    while (waiting > 0) {
      const node = stack[--waiting]!;
      const at = 6 * node;
      const x0 = (bounds[at]! - ox) * ix;
      const y0 = (bounds[at + 1]! - oy) * iy;
      const z0 = (bounds[at + 2]! - oz) * iz;
      const x1 = (bounds[at + 3]! - ox) * ix;
      const y1 = (bounds[at + 4]! - oy) * iy;
      const z1 = (bounds[at + 5]! - oz) * iz;
      const near = Math.max(Math.min(x0, x1), Math.min(y0, y1), Math.min(z0, z1), 0);
      const far = Math.min(Math.max(x0, x1), Math.max(y0, y1), Math.max(z0, z1), distance);
      if (near > far) continue;
      if (second[node]! > 0) {
        stack[waiting++] = second[node]!;
        stack[waiting++] = node + 1;
        continue;
      }
      for (const i of inside[node]!) {
        if (i === from) continue;
        const t = meets(data, STRIDE * i, origin, direction);
        if (t > 1e-10 && t < distance) {
          distance = t;
          triangle = i;
        }
      }
    }
    return triangle < 0 ? undefined : { distance, triangle };
  };
}
