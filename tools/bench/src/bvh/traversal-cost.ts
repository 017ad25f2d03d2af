import type { Blas } from '@glanz/bvh';
import type { MeshBVH } from 'three-mesh-bvh';
import type { BenchMesh } from './meshes';

/** A hierarchy of whatever library, to count what rays look at. */
export interface PlainTree {
  /** Six numbers a node: min xyz, max xyz. */
  readonly boxes: readonly number[];
  /** Two a node: its children, or −1 and −1 for a leaf. */
  readonly children: readonly number[];
  /** Two a node: first triangle of a leaf and how many. */
  readonly leaves: readonly number[];
  /** Three vertices a triangle, in leaf order. */
  readonly vertices: Uint32Array;
}

/** Ours: nodes of 16 words with the boxes of both children. */
export function plainBlas({ nodes, triangleIndices, bounds }: Blas, { indices }: BenchMesh): PlainTree {
  const words = new Uint32Array(nodes.buffer, nodes.byteOffset, nodes.length);
  const boxes: number[] = [],
    children: number[] = [],
    leaves: number[] = [];
  const add = (reference: number, box: readonly number[]): number => {
    const node = children.length / 2;
    boxes.push(...box);
    const leaf = reference >= 0x80000000;
    children.push(-1, -1);
    leaves.push(leaf ? reference & 0x7ffffff : 0, leaf ? ((reference >>> 27) & 15) + 1 : 0);
    return node;
  };
  const pending = [[0, add(0, [...bounds.min, ...bounds.max])]] as [number, number][];
  for (let task = pending.pop(); task; task = pending.pop()) {
    const [reference, node] = task;
    for (let side = 0; side < 2; side++) {
      const at = 16 * reference + 8 * side;
      const child = words[16 * reference + 3 + 4 * side]!;
      const made = add(child, [
        nodes[at]!,
        nodes[at + 1]!,
        nodes[at + 2]!,
        nodes[at + 4]!,
        nodes[at + 5]!,
        nodes[at + 6]!,
      ]);
      children[2 * node + side] = made;
      if (child < 0x80000000) pending.push([child, made]);
    }
  }
  const vertices = new Uint32Array(3 * triangleIndices.length);
  triangleIndices.forEach((triangle, i) => vertices.set(indices.subarray(3 * triangle, 3 * triangle + 3), 3 * i));
  return { boxes, children, leaves, vertices };
}

/** One of three-mesh-bvh, which sorts the index of its geometry into leaf order. */
export function plainThree(bvh: MeshBVH): PlainTree {
  const boxes: number[] = [],
    children: number[] = [],
    leaves: number[] = [];
  const open: number[] = [];
  bvh.traverse((depth, isLeaf, box, offset, count) => {
    const node = children.length / 2;
    boxes.push(...(box as unknown as Float32Array).subarray(0, 6));
    children.push(-1, -1);
    leaves.push(isLeaf ? offset : 0, isLeaf ? count! : 0);
    if (depth > 0) {
      const parent = open[depth - 1]!;
      children[2 * parent + (children[2 * parent]! < 0 ? 0 : 1)] = node;
    }
    open[depth] = node;
  });
  return {
    boxes,
    children,
    leaves,
    vertices: Uint32Array.from(
      (bvh as unknown as { geometry: { index: { array: ArrayLike<number> } } }).geometry.index.array,
    ),
  };
}

/** What rays look at, on average: nodes whose children's boxes are tested, and triangles. */
export interface TraversalCost {
  readonly nodes: number;
  readonly triangles: number;
  /** Two numbers a ray: t, and the triangle in leaf order or −1. */
  readonly hits: Float64Array;
}

/** Counts, nearer child first, with the boxes behind the nearest hit left out. `any`: up to the first hit. */
export function traversalCost(
  { boxes, children, leaves, vertices }: PlainTree,
  { positions: p }: BenchMesh,
  rays: Float32Array,
  any: boolean,
): TraversalCost {
  const box = Float64Array.from(boxes),
    child = Int32Array.from(children),
    leaf = Int32Array.from(leaves);
  const count = rays.length / 8;
  const hits = new Float64Array(2 * count);
  let nodes = 0,
    triangles = 0;
  const stack: number[] = [],
    entries: number[] = [];
  for (let ray = 0; ray < count; ray++) {
    const [ox, oy, oz, tMin, dx, dy, dz, tMax] = rays.subarray(8 * ray, 8 * ray + 8) as unknown as [
      number,
      number,
      number,
      number,
      number,
      number,
      number,
      number,
    ];
    let t = tMax,
      hit = -1;
    const enter = (node: number) => {
      const b = 6 * node;
      const x0 = (box[b]! - ox) / dx,
        x1 = (box[b + 3]! - ox) / dx,
        y0 = (box[b + 1]! - oy) / dy,
        y1 = (box[b + 4]! - oy) / dy,
        z0 = (box[b + 2]! - oz) / dz,
        z1 = (box[b + 5]! - oz) / dz;
      const near = Math.max(Math.min(x0, x1), Math.min(y0, y1), Math.min(z0, z1), tMin),
        far = Math.min(Math.max(x0, x1), Math.max(y0, y1), Math.max(z0, z1), t);
      return near <= far ? near : Infinity;
    };
    stack.push(0);
    entries.push(-Infinity);
    while (stack.length > 0) {
      const node = stack.pop()!;
      if (entries.pop()! > t) continue;
      const left = child[2 * node]!,
        right = child[2 * node + 1]!;
      if (left >= 0) {
        nodes++;
        const a = enter(left),
          b = enter(right);
        const [near, far, tNear, tFar] = a <= b ? [left, right, a, b] : [right, left, b, a];
        if (tFar < Infinity) {
          stack.push(far);
          entries.push(tFar);
        }
        if (tNear < Infinity) {
          stack.push(near);
          entries.push(tNear);
        }
        continue;
      }
      const first = leaf[2 * node]!;
      for (let i = first; i < first + leaf[2 * node + 1]!; i++) {
        triangles++;
        const a = 3 * vertices[3 * i]!,
          b = 3 * vertices[3 * i + 1]!,
          c = 3 * vertices[3 * i + 2]!;
        const ex = p[b]! - p[a]!,
          ey = p[b + 1]! - p[a + 1]!,
          ez = p[b + 2]! - p[a + 2]!,
          fx = p[c]! - p[a]!,
          fy = p[c + 1]! - p[a + 1]!,
          fz = p[c + 2]! - p[a + 2]!;
        const hx = dy * fz - dz * fy,
          hy = dz * fx - dx * fz,
          hz = dx * fy - dy * fx;
        const determinant = ex * hx + ey * hy + ez * hz;
        const sx = ox - p[a]!,
          sy = oy - p[a + 1]!,
          sz = oz - p[a + 2]!;
        const u = (sx * hx + sy * hy + sz * hz) / determinant;
        const qx = sy * ez - sz * ey,
          qy = sz * ex - sx * ez,
          qz = sx * ey - sy * ex;
        const v = (dx * qx + dy * qy + dz * qz) / determinant;
        const at = (fx * qx + fy * qy + fz * qz) / determinant;
        if (!(u >= 0 && v >= 0 && u + v <= 1 && at > tMin && at < t)) continue;
        t = at;
        hit = i;
      }
      if (any && hit >= 0) stack.length = entries.length = 0;
    }
    hits[2 * ray] = t;
    hits[2 * ray + 1] = hit;
  }
  return { nodes: nodes / count, triangles: triangles / count, hits };
}
