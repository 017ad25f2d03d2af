// Tangents as MikkTSpace makes them (M. S. Mikkelsen, "Simulation of Wrinkled Surfaces Revisited", 2008; the glTF
// specification, 3.7.2.1, requires them if a file has none): one for each set of triangles that share a vertex, are
// connected by edges and have the same orientation in texture space; directions are weighted by the angles at the
// vertex. Vertices with the same position, normal and uv are merged, whatever their index. Mirrored halves and seams
// thus get separate vertices.
import type { Material, Mesh } from '@glanz/scene';

/** The UV set whose tangents a material needs; undefined if it needs none. */
export function tangentSet(material: Material | undefined): number | undefined {
  const { parameters, textures } = material ?? {};
  const binding = textures?.geometry_normal ?? textures?.geometry_coat_normal ?? textures?.geometry_tangent;
  if (binding) return binding.uv ?? 0;
  return parameters?.specular_roughness_anisotropy || parameters?.coat_roughness_anisotropy ? 0 : undefined;
}

const mix = (hash: number, value: number) => Math.imul(hash ^ value, 0x9e3779b1) ^ (hash >>> 15);
const powerOfTwoAbove = (n: number) => 2 ** Math.ceil(Math.log2(Math.max(n, 2)));

/** For each vertex the first one with the same position, normal and uv. */
function weld(positions: Float32Array, normals: Float32Array, uvs: Float32Array): Int32Array {
  const vertices = positions.length / 3;
  // Each vertex as eight words; adding 0 turns −0 into 0.
  const floats = new Float32Array(8 * vertices);
  for (let v = 0, k = 0; v < vertices; v++) {
    for (let i = 3 * v; i < 3 * v + 3; i++) floats[k++] = (positions[i] as number) + 0;
    for (let i = 3 * v; i < 3 * v + 3; i++) floats[k++] = (normals[i] as number) + 0;
    floats[k++] = (uvs[2 * v] as number) + 0;
    floats[k++] = (uvs[2 * v + 1] as number) + 0;
  }
  const words = new Int32Array(floats.buffer);
  const mask = powerOfTwoAbove(2 * vertices) - 1;
  const table = new Int32Array(mask + 1).fill(-1);
  const first = new Int32Array(vertices);
  for (let v = 0; v < vertices; v++) {
    const at = 8 * v;
    let hash = 0;
    for (let k = at; k < at + 8; k++) hash = mix(hash, words[k] as number);
    let slot = (hash ^ (hash >>> 13)) & mask;
    for (;;) {
      const other = table[slot] as number;
      if (other === -1) {
        table[slot] = v;
        first[v] = v;
        break;
      }
      let k = 0;
      while (k < 8 && words[at + k] === words[8 * other + k]) k++;
      if (k === 8) {
        first[v] = other;
        break;
      }
      slot = (slot + 1) & mask;
    }
  }
  return first;
}

/** Sets of corners that share a tangent. */
class Groups {
  readonly #parent: Int32Array;

  constructor(count: number) {
    this.#parent = new Int32Array(count).map((_, i) => i);
  }

  of(corner: number): number {
    const parent = this.#parent;
    let root = corner;
    while (parent[root] !== root) {
      parent[root] = parent[parent[root] as number] as number;
      root = parent[root] as number;
    }
    return root;
  }

  unite(a: number, b: number): void {
    const [p, q] = [this.of(a), this.of(b)];
    this.#parent[Math.max(p, q)] = Math.min(p, q);
  }
}

/**
 * Calls `found` for every pair of triangles that run along an edge in opposite directions, with the corners at which
 * the edge begins in each. Every edge of a triangle is in at most one pair.
 */
function pairEdges(
  corners: Int32Array,
  usable: (triangle: number) => boolean,
  found: (a: number, b: number) => void,
): void {
  const mask = powerOfTwoAbove(2 * corners.length) - 1;
  // Hash table of unpaired edges: the key is the two vertices, the value the head of a linked list of corners.
  const from = new Int32Array(mask + 1).fill(-1),
    to = new Int32Array(mask + 1),
    head = new Int32Array(mask + 1),
    next = new Int32Array(corners.length);
  const slotOf = (a: number, b: number) => {
    const hash = mix(mix(0, a), b);
    let slot = (hash ^ (hash >>> 13)) & mask;
    while (from[slot] !== -1 && !(from[slot] === a && to[slot] === b)) slot = (slot + 1) & mask;
    return slot;
  };
  for (let corner = 0; corner < corners.length; corner++) {
    const triangle = (corner / 3) | 0;
    if (!usable(triangle)) continue;
    const a = corners[corner] as number,
      b = corners[3 * triangle + ((corner + 1) % 3)] as number;
    const waiting = slotOf(b, a);
    if (from[waiting] !== -1 && (head[waiting] as number) !== -1) {
      const other = head[waiting] as number;
      head[waiting] = next[other] as number;
      found(corner, other);
      continue;
    }
    const slot = slotOf(a, b);
    next[corner] = from[slot] === -1 ? -1 : (head[slot] as number);
    from[slot] = a;
    to[slot] = b;
    head[slot] = corner;
  }
}

/** Whether two vertices have the same position. */
const samePosition = (P: Float32Array, p: number, q: number) =>
  P[3 * p] === P[3 * q] && P[3 * p + 1] === P[3 * q + 1] && P[3 * p + 2] === P[3 * q + 2];

const following = (corner: number) => (corner % 3 === 2 ? corner - 2 : corner + 1);

/**
 * Adds tangents to a mesh (xyz unit, w the handedness by glTF's convention: v points down). Vertices that need several
 * tangents are duplicated. Returns the mesh unchanged if it has tangents, or lacks normals or the UV set.
 *
 * @param set The UV set whose u the tangents follow.
 */
export function withTangents(mesh: Mesh, set = 0): Mesh {
  const { positions: P, normals: N, indices } = mesh;
  const UV = mesh.uvs?.[set];
  if (mesh.tangents || !N || !UV || indices.length === 0) return mesh;
  const first = weld(P, N, UV);
  const corners = Int32Array.from(indices, (vertex) => first[vertex] as number);
  const triangles = indices.length / 3;

  // For each triangle the unit direction of increasing u, and its orientation in texture space.
  const along = new Float64Array(3 * triangles);
  const NONE = 0,
    ANY = 3;
  const turn = new Uint8Array(triangles);
  for (let t = 0; t < triangles; t++) {
    const a = corners[3 * t] as number,
      b = corners[3 * t + 1] as number,
      c = corners[3 * t + 2] as number;
    if (samePosition(P, a, b) || samePosition(P, b, c) || samePosition(P, c, a)) continue;
    const u0 = UV[2 * a] as number,
      v0 = UV[2 * a + 1] as number;
    const u1 = (UV[2 * b] as number) - u0,
      v1 = (UV[2 * b + 1] as number) - v0,
      u2 = (UV[2 * c] as number) - u0,
      v2 = (UV[2 * c + 1] as number) - v0;
    const area = u1 * v2 - v1 * u2;
    const direction = (k: number) =>
      v2 * ((P[3 * b + k] as number) - (P[3 * a + k] as number)) -
      v1 * ((P[3 * c + k] as number) - (P[3 * a + k] as number));
    const x = direction(0),
      y = direction(1),
      z = direction(2);
    const length = Math.sqrt(x * x + y * y + z * z);
    turn[t] = Math.abs(area) > 1.2e-38 && length > 1.2e-38 ? (area > 0 ? 1 : 2) : ANY;
    if (turn[t] === ANY) continue;
    const scale = (area > 0 ? 1 : -1) / length;
    along[3 * t] = x * scale;
    along[3 * t + 1] = y * scale;
    along[3 * t + 2] = z * scale;
  }
  const pairs: number[] = [];
  pairEdges(
    corners,
    (t) => turn[t] !== NONE,
    (a, b) => pairs.push(a, b),
  );
  // A triangle without area in texture space takes the orientation of a neighbour.
  const seen = Uint8Array.from(turn);
  for (let i = 0; i < pairs.length; i += 2) {
    const [s, t] = [((pairs[i] as number) / 3) | 0, ((pairs[i + 1] as number) / 3) | 0];
    if (seen[s] === ANY) seen[s] = seen[t] as number;
    else if (seen[t] === ANY) seen[t] = seen[s] as number;
  }
  const groups = new Groups(corners.length);
  for (let i = 0; i < pairs.length; i += 2) {
    const [a, b] = [pairs[i], pairs[i + 1]] as [number, number];
    if (seen[(a / 3) | 0] !== seen[(b / 3) | 0]) continue;
    // Where one edge begins the other ends.
    groups.unite(a, following(b));
    groups.unite(following(a), b);
  }

  const sums = new Float64Array(3 * corners.length);
  const projected = (out: number[], x: number, y: number, z: number, n: number): void => {
    const nx = N[n] as number,
      ny = N[n + 1] as number,
      nz = N[n + 2] as number;
    const d = nx * x + ny * y + nz * z;
    const px = x - d * nx,
      py = y - d * ny,
      pz = z - d * nz;
    const length = Math.sqrt(px * px + py * py + pz * pz);
    const scale = length > 1.2e-38 ? 1 / length : 0;
    out[0] = px * scale;
    out[1] = py * scale;
    out[2] = pz * scale;
  };
  const s: number[] = [0, 0, 0],
    e: number[] = [0, 0, 0],
    f: number[] = [0, 0, 0];
  for (let corner = 0; corner < corners.length; corner++) {
    const t = (corner / 3) | 0;
    if (turn[t] === NONE || turn[t] === ANY) continue;
    const at = 3 * (corners[corner] as number),
      after = 3 * (corners[following(corner)] as number),
      before = 3 * (corners[following(following(corner))] as number);
    const edge = (q: number, k: number) => (P[q + k] as number) - (P[at + k] as number);
    projected(s, along[3 * t] as number, along[3 * t + 1] as number, along[3 * t + 2] as number, at);
    projected(e, edge(before, 0), edge(before, 1), edge(before, 2), at);
    projected(f, edge(after, 0), edge(after, 1), edge(after, 2), at);
    const cosine =
      (e[0] as number) * (f[0] as number) + (e[1] as number) * (f[1] as number) + (e[2] as number) * (f[2] as number);
    const angle = Math.acos(Math.min(Math.max(cosine, -1), 1));
    const group = 3 * groups.of(corner);
    for (let k = 0; k < 3; k++) sums[group + k] = (sums[group + k] as number) + angle * (s[k] as number);
  }
  return assign(
    mesh,
    corners,
    (corner) => (turn[(corner / 3) | 0] === NONE ? -1 : groups.of(corner)),
    (group) => [sums.subarray(3 * group, 3 * group + 3), seen[(group / 3) | 0] === 1 ? -1 : 1],
  );
}

/** Assigns each vertex the tangent of its group, and duplicates it for each further group. */
function assign(
  mesh: Mesh,
  corners: Int32Array,
  groupOf: (corner: number) => number,
  tangentOf: (group: number) => readonly [ArrayLike<number>, number],
): Mesh {
  const N = mesh.normals as Float32Array;
  const vertices = mesh.positions.length / 3;
  // The group of each vertex; the vertices that later copies are of; the copies by vertex and group.
  const group: number[] = new Array<number>(vertices).fill(-1);
  const source: number[] = [];
  const copies = new Map<number, number>();
  const indices = mesh.indices.slice();
  for (let corner = 0; corner < indices.length; corner++) {
    const own = groupOf(corner);
    if (own === -1) continue;
    let vertex = indices[corner] as number;
    if (group[vertex] === -1) group[vertex] = own;
    else if (group[vertex] !== own) {
      const key = vertex * corners.length + own;
      let copy = copies.get(key);
      if (copy === undefined) {
        copy = vertices + source.push(vertex) - 1;
        copies.set(key, copy);
        group.push(own);
      }
      vertex = copy;
    }
    indices[corner] = vertex;
  }
  const total = vertices + source.length;
  const widened = (values: Float32Array<ArrayBuffer>, stride: number): Float32Array<ArrayBuffer> => {
    if (source.length === 0) return values;
    const wide = new Float32Array(stride * total);
    wide.set(values);
    source.forEach((from, i) => wide.copyWithin(stride * (vertices + i), stride * from, stride * from + stride));
    return wide;
  };
  const tangents = new Float32Array(4 * total);
  // A corner of a triangle without area uses the tangent of another triangle at its vertex.
  const weldedOf = new Map<number, number>(),
    atWelded = new Map<number, number>();
  for (let corner = 0; corner < corners.length; corner++)
    if (group[indices[corner] as number] === -1) weldedOf.set(indices[corner] as number, corners[corner] as number);
  if (weldedOf.size > 0)
    for (let corner = 0; corner < corners.length; corner++)
      if (groupOf(corner) !== -1 && !atWelded.has(corners[corner] as number))
        atWelded.set(corners[corner] as number, groupOf(corner));
  for (let v = 0; v < total; v++) {
    const own = group[v] === -1 ? atWelded.get(weldedOf.get(v) ?? -1) : group[v];
    const [sum, sign] = own === undefined ? [[0, 0, 0], 1] : tangentOf(own);
    const n = 3 * (v < vertices ? v : (source[v - vertices] as number));
    const length = Math.hypot(sum[0] as number, sum[1] as number, sum[2] as number);
    if (length > 1e-12) for (let k = 0; k < 3; k++) tangents[4 * v + k] = (sum[k] as number) / length;
    else tangents.set(perpendicular(N[n] as number, N[n + 1] as number, N[n + 2] as number), 4 * v);
    tangents[4 * v + 3] = sign;
  }
  const made: Mesh = {
    ...mesh,
    indices,
    tangents,
    positions: widened(mesh.positions, 3),
    normals: widened(mesh.normals as Float32Array<ArrayBuffer>, 3),
    uvs: (mesh.uvs ?? []).map((uv) => widened(uv, 2)),
  };
  if (mesh.colors) made.colors = widened(mesh.colors, 4);
  return made;
}

/** A unit vector perpendicular to a unit vector. */
function perpendicular(x: number, y: number, z: number): [number, number, number] {
  const [a, b, c]: [number, number, number] = Math.abs(x) < 0.6 ? [0, z, -y] : [-z, 0, x];
  const length = Math.hypot(a, b, c) || 1;
  return [a / length, b / length, c / length];
}
