import type { Mesh, SceneWarning } from '@glanz/scene';
import { makeUnit, unitNormals } from '@glanz/scene/pose';
import type { UvSets } from './materials';
import { windByNormals } from './normals';
import type { PrimitiveData } from './primitive';

/** Whether every number is finite. */
function allFinite(values: Float32Array): boolean {
  // Numbers that are not finite have all exponent bits set; adding one to the exponent carries into the sign bit.
  // Unlike a floating-point sum, this has no chain of dependent additions.
  const bits = new Int32Array(values.buffer, values.byteOffset, values.length);
  let carried = 0;
  for (let i = 0; i < bits.length; i++) carried |= ((bits[i] as number) & 0x7f800000) + 0x00800000;
  return carried >= 0;
}

/** The largest of some numbers; 0 if there are none. */
export function maximum(values: Uint32Array): number {
  let max = 0;
  for (let i = 0; i < values.length; i++) {
    const value = values[i] as number;
    max = value > max ? value : max;
  }
  return max;
}

/** Vertex indices of the triangles of a primitive, strips and fans expanded; `undefined` for points and lines. */
function trianglesOf(primitive: PrimitiveData, vertices: number): Uint32Array<ArrayBuffer> | undefined {
  const mode = primitive.json.mode ?? 4;
  if (mode < 4 || mode > 6) return undefined;
  const list = primitive.indices() ?? new Uint32Array(vertices).map((_, i) => i);
  if (mode === 4) return list.length % 3 === 0 ? list : list.slice(0, list.length - (list.length % 3));
  const count = Math.max(list.length - 2, 0);
  const triangles = new Uint32Array(count * 3);
  for (let i = 0; i < count; i++) {
    // Strips reverse every second triangle (glTF 2.0, section 3.7.2.1).
    const corners = mode === 6 ? [i + 1, i + 2, 0] : i % 2 === 0 ? [i, i + 1, i + 2] : [i, i + 2, i + 1];
    for (let c = 0; c < 3; c++) triangles[3 * i + c] = list[corners[c] as number] as number;
  }
  return triangles;
}

/**
 * Reads a primitive into a mesh. Leaves out, with a warning, attributes of a wrong length or with numbers that are not
 * finite, and triangles whose vertices do not exist.
 *
 * @param opaque Whether to ignore the alpha of vertex colours.
 * @param uvSets The indices of the UV sets to read.
 * @returns `undefined` (with a warning) if it has no triangles.
 */
export function readPrimitive(
  primitive: PrimitiveData,
  name: string,
  opaque: boolean,
  uvSets: UvSets,
  path: string,
  warnings: SceneWarning[],
): Mesh | undefined {
  const warn = (message: string) =>
    void warnings.push({ code: 'gltf/primitive', message: `${name}: ${message}`, path });
  const vertices = primitive.count('POSITION');
  if (vertices === undefined) {
    warn('it has no POSITION and is left out.');
    return undefined;
  }
  const corners = trianglesOf(primitive, vertices);
  if (!corners) {
    warn('points and lines are left out.');
    return undefined;
  }
  const positions = primitive.floats('POSITION', 3);
  const largest = maximum(corners);
  if (largest === primitive.restart)
    warn('its indices contain the primitive restart value, which glTF does not allow; it is read as a vertex index.');
  const indices = validTriangles(corners, largest, positions, warn);
  if (indices.length === 0) {
    warn('it has no triangles.');
    return undefined;
  }
  const attribute = (semantic: string, size: number): Float32Array<ArrayBuffer> | undefined => {
    const count = primitive.count(semantic);
    if (count === undefined) return undefined;
    if (count !== vertices) {
      warn(`${semantic} has ${count} entries for ${vertices} vertices and is left out.`);
      return undefined;
    }
    const values = primitive.floats(semantic, size);
    if (allFinite(values)) return values;
    warn(`${semantic} holds numbers that are not finite and is left out.`);
    return undefined;
  };
  const mesh: Mesh = { name, positions, indices };
  const normals = attribute('NORMAL', 3);
  if (normals) {
    mesh.normals = unitNormals(normals, positions, indices, warn);
    if (windByNormals(indices, positions, mesh.normals))
      warn('its normals point to the back of all of its triangles; the triangles are reversed.');
    const tangents = attribute('TANGENT', 4);
    if (tangents && makeUnit(tangents, 4)) mesh.tangents = withSigns(tangents, warn);
    else if (tangents) warn('TANGENT holds vectors of length 0 and is left out.');
  }
  if (!normals && primitive.count('TANGENT') !== undefined) warn('TANGENT is left out, since there are no normals.');
  const [uv0, uv1] = uvSets.map((set) => attribute(`TEXCOORD_${set}`, 2));
  if (uv0 || uv1) mesh.uvs = uv1 ? [uv0 ?? new Float32Array(2 * vertices), uv1] : [uv0 as Float32Array<ArrayBuffer>];
  const colors = attribute('COLOR_0', 4);
  if (colors) {
    let clamped = 0;
    for (let i = 0; i < colors.length; i++) {
      const value = colors[i] as number;
      const good = Math.min(Math.max(value, 0), 1);
      if (Math.abs(good - value) > 1e-3) clamped++;
      colors[i] = i % 4 === 3 && opaque ? 1 : good;
    }
    if (clamped > 0) warn(`COLOR_0 holds ${clamped} numbers below 0 or above 1; they are clamped.`);
    mesh.colors = colors;
  }
  return mesh;
}

/** Sets the handedness of tangents to −1 or 1, in place. */
function withSigns(tangents: Float32Array<ArrayBuffer>, warn: (message: string) => void): Float32Array<ArrayBuffer> {
  let wrong = 0;
  for (let i = 3; i < tangents.length; i += 4) {
    const sign = tangents[i] as number;
    if (Math.abs(sign) === 1) continue;
    if (!(Math.abs(Math.abs(sign) - 1) <= 1e-2)) wrong++;
    tangents[i] = sign < 0 ? -1 : 1;
  }
  if (wrong > 0) warn(`TANGENT has ${wrong} handednesses that are neither −1 nor 1; only their signs are used.`);
  return tangents;
}

/** The triangles whose vertices exist and are finite. Positions that are not finite become 0. */
function validTriangles(
  corners: Uint32Array<ArrayBuffer>,
  largest: number,
  positions: Float32Array,
  warn: (message: string) => void,
): Uint32Array<ArrayBuffer> {
  const vertices = positions.length / 3;
  const finite = allFinite(positions);
  if (finite && largest < vertices) return corners;
  const good = (v: number) =>
    v < vertices &&
    (finite ||
      (Number.isFinite(positions[3 * v]) &&
        Number.isFinite(positions[3 * v + 1]) &&
        Number.isFinite(positions[3 * v + 2])));
  let kept = 0;
  for (let i = 0; i < corners.length; i += 3) {
    if (!good(corners[i] as number) || !good(corners[i + 1] as number) || !good(corners[i + 2] as number)) continue;
    if (kept !== i) corners.copyWithin(kept, i, i + 3);
    kept += 3;
  }
  if (kept < corners.length)
    warn(`${(corners.length - kept) / 3} triangles have corners that do not exist or are not finite and are left out.`);
  if (!finite) for (let i = 0; i < positions.length; i++) if (!Number.isFinite(positions[i])) positions[i] = 0;
  return kept === corners.length ? corners : corners.slice(0, kept);
}

/**
 * Removes the vertices that no triangle uses if they are more than half: primitives may share one large set.
 */
export function withoutUnusedVertices(mesh: Mesh): Mesh {
  const vertices = mesh.positions.length / 3;
  if (2 * mesh.indices.length >= vertices) return mesh;
  const place = new Map<number, number>();
  const indices = mesh.indices.map((vertex) => {
    const known = place.get(vertex);
    if (known !== undefined) return known;
    place.set(vertex, place.size);
    return place.size - 1;
  });
  const gather = (values: Float32Array<ArrayBuffer>, stride: number) => {
    const kept = new Float32Array(place.size * stride);
    for (const [from, to] of place)
      for (let k = 0; k < stride; k++) kept[stride * to + k] = values[stride * from + k] as number;
    return kept;
  };
  const result: Mesh = { ...mesh, positions: gather(mesh.positions, 3), indices };
  if (mesh.normals) result.normals = gather(mesh.normals, 3);
  if (mesh.tangents) result.tangents = gather(mesh.tangents, 4);
  if (mesh.colors) result.colors = gather(mesh.colors, 4);
  if (mesh.uvs) result.uvs = mesh.uvs.map((uv) => gather(uv, 2));
  return result;
}
