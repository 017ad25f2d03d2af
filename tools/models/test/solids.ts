import type { Mesh } from '@glanz/scene';

/** What {@link inspect} finds. Positions are compared bit by bit. */
export interface Inspection {
  readonly triangles: number;
  /** Edges that do not meet exactly one edge of opposite direction: 0 on a closed, consistently wound surface. */
  readonly openEdges: number;
  /** Triangles without area. */
  readonly flat: number;
  /** Signed volume, m³: positive when triangles face outwards. */
  readonly volume: number;
  /** Least cosine between a vertex normal and the triangles that use it. */
  readonly worstNormal: number;
}

/** Looks a mesh over. */
export function inspect(mesh: Mesh): Inspection {
  const ids = new Map<string, number>();
  const weld = Array.from({ length: mesh.positions.length / 3 }, (_, i) => {
    const key = `${mesh.positions[3 * i]},${mesh.positions[3 * i + 1]},${mesh.positions[3 * i + 2]}`;
    const id = ids.get(key) ?? ids.size;
    ids.set(key, id);
    return id;
  });
  const edges = new Map<number, number>();
  let [flat, volume, worstNormal] = [0, 0, 1];
  const p = (v: number): [number, number, number] => [
    mesh.positions[3 * v]!,
    mesh.positions[3 * v + 1]!,
    mesh.positions[3 * v + 2]!,
  ];
  for (let i = 0; i < mesh.indices.length; i += 3) {
    const corners = [mesh.indices[i]!, mesh.indices[i + 1]!, mesh.indices[i + 2]!] as const;
    for (let k = 0; k < 3; k++) {
      const [from, to] = [weld[corners[k as 0]]!, weld[corners[((k + 1) % 3) as 0]]!];
      const [key, sign] = from < to ? [from * ids.size + to, 1] : [to * ids.size + from, -1];
      edges.set(key, (edges.get(key) ?? 0) + sign);
    }
    const [a, b, c] = [p(corners[0]), p(corners[1]), p(corners[2])];
    const [u, v] = [b.map((x, k) => x - a[k]!), c.map((x, k) => x - a[k]!)];
    const n = [u[1]! * v[2]! - u[2]! * v[1]!, u[2]! * v[0]! - u[0]! * v[2]!, u[0]! * v[1]! - u[1]! * v[0]!];
    const length = Math.hypot(...n);
    volume += (a[0] * n[0]! + a[1] * n[1]! + a[2] * n[2]!) / 6;
    const longest = Math.max(Math.hypot(...u), Math.hypot(...v), Math.hypot(...u.map((x, k) => x - v[k]!)));
    // Float positions give needles no direction to speak of.
    if (length / longest < 2e-8) {
      flat++;
      continue;
    }
    if (mesh.normals)
      for (const w of corners)
        worstNormal = Math.min(
          worstNormal,
          (n[0]! * mesh.normals[3 * w]! + n[1]! * mesh.normals[3 * w + 1]! + n[2]! * mesh.normals[3 * w + 2]!) / length,
        );
  }
  let openEdges = 0;
  for (const sum of edges.values()) if (sum !== 0) openEdges++;
  return { triangles: mesh.indices.length / 3, openEdges, flat, volume, worstNormal };
}
