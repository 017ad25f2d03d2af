import { buildBlas, type Blas, type TriangleMesh } from '../src/index';
import { FAR, LEFT_MIN, NODE_WORDS, RIGHT_MIN } from '../src/layout';

/**
 * A hierarchy in which each triangle is in two leaves, as builders with spatial splits make them: every triangle is cut
 * in the middle of its longest side, and each leaf has the box of one half.
 */
export function cutInTwo({ positions: p, indices }: TriangleMesh): Blas {
  const count = (indices ? indices.length : p.length / 3) / 3;
  const halves = new Float32Array(18 * count);
  for (let t = 0; t < count; t++) {
    const corners = [0, 1, 2]
      .map((c) => 3 * (indices ? indices[3 * t + c]! : 3 * t + c))
      .map((v) => [p[v]!, p[v + 1]!, p[v + 2]!]);
    const length = (c: number) => Math.hypot(...corners[c]!.map((x, k) => x - corners[(c + 1) % 3]![k]!));
    const side = [0, 1, 2].reduce((a, b) => (length(b) > length(a) ? b : a));
    const [a, b, c] = [0, 1, 2].map((k) => corners[(side + k) % 3]!) as [number[], number[], number[]];
    const middle = a.map((x, k) => (x + b[k]!) / 2);
    halves.set([...a, ...middle, ...c, ...middle, ...b, ...c], 18 * t);
  }
  const blas = buildBlas({ positions: halves }, { maxLeafTriangles: 1 });
  // Halves are rounded to single precision: a little larger boxes hold what was lost.
  const { nodes } = blas;
  for (let at = 0; at < nodes.length; at += NODE_WORDS)
    for (const low of [LEFT_MIN, RIGHT_MIN])
      for (let k = 0; k < 3; k++) {
        if (nodes[at + low] === FAR) continue;
        nodes[at + low + k]! -= 1e-6;
        nodes[at + low + 4 + k]! += 1e-6;
      }
  return { ...blas, triangleIndices: blas.triangleIndices.map((half) => half >> 1) };
}
