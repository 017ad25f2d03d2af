import type { Accessor, Primitive } from '@gltf-transform/core';
import type { Mesh, SceneWarning } from '@glanz/scene';
import { makeUnit, unitNormals } from './normals';

/** Numbers of an accessor as floats, decoded if normalised; a copy. */
export function floatsOf(accessor: Accessor, size = accessor.getElementSize()): Float32Array<ArrayBuffer> {
  const count = accessor.getCount(), own = accessor.getElementSize();
  const array = accessor.getArray();
  const floats = new Float32Array(count * size);
  if (array instanceof Float32Array && own === size) {
    floats.set(array.subarray(0, floats.length));
    return floats;
  }
  const element: number[] = [];
  for (let i = 0; i < count; i++) {
    accessor.getElement(i, element);
    for (let k = 0; k < size; k++) floats[i * size + k] = k < own ? (element[k] as number) : 1;
  }
  return floats;
}

/** Whether every number is finite. */
const allFinite = (values: Float32Array) => values.every(Number.isFinite);

/** Corners of the triangles of a primitive, strips and fans opened; `undefined` for points and lines. */
function trianglesOf(primitive: Primitive, vertices: number): Uint32Array<ArrayBuffer> | undefined {
  const mode = primitive.getMode();
  if (mode < 4 || mode > 6) return undefined;
  const array = primitive.getIndices()?.getArray();
  const list = array ? Uint32Array.from(array) : Uint32Array.from({ length: vertices }, (_, i) => i);
  if (mode === 4) return list.slice(0, list.length - (list.length % 3));
  const count = Math.max(list.length - 2, 0);
  const triangles = new Uint32Array(count * 3);
  for (let i = 0; i < count; i++) {
    // Strips turn every second triangle round (glTF 2.0, section 3.7.2.1).
    const corners = mode === 6 ? [i + 1, i + 2, 0] : i % 2 === 0 ? [i, i + 1, i + 2] : [i, i + 2, i + 1];
    for (let c = 0; c < 3; c++) triangles[3 * i + c] = list[corners[c] as number] as number;
  }
  return triangles;
}

/**
 * Reads a primitive into a mesh. What is broken but can be left out is, with a warning: attributes of a wrong length or
 * with numbers that are not finite, triangles whose corners do not exist.
 *
 * @param opaque Whether the alpha of vertex colours counts for nothing.
 * @returns `undefined` (with a warning) if it has no triangles.
 */
export function readPrimitive(primitive: Primitive, name: string, opaque: boolean, path: string, warnings: SceneWarning[]): Mesh | undefined {
  const warn = (message: string) => void warnings.push({ code: 'gltf/primitive', message: `${name}: ${message}`, path });
  const position = primitive.getAttribute('POSITION');
  if (!position) {
    warn('it has no POSITION and is left out.');
    return undefined;
  }
  const positions = floatsOf(position, 3);
  const vertices = positions.length / 3;
  const corners = trianglesOf(primitive, vertices);
  if (!corners) {
    warn('points and lines are left out.');
    return undefined;
  }
  const indices = soundTriangles(corners, positions, warn);
  if (indices.length === 0) {
    warn('it has no triangles.');
    return undefined;
  }
  const attribute = (semantic: string, size: number): Float32Array<ArrayBuffer> | undefined => {
    const accessor = primitive.getAttribute(semantic);
    if (!accessor) return undefined;
    if (accessor.getCount() !== vertices) {
      warn(`${semantic} has ${accessor.getCount()} entries for ${vertices} vertices and is left out.`);
      return undefined;
    }
    const values = floatsOf(accessor, size);
    if (allFinite(values)) return values;
    warn(`${semantic} holds numbers that are not finite and is left out.`);
    return undefined;
  };
  const mesh: Mesh = { name, positions, indices };
  const normals = attribute('NORMAL', 3);
  if (normals) {
    mesh.normals = unitNormals(normals, positions, indices, warn);
    const tangents = attribute('TANGENT', 4);
    if (tangents && makeUnit(tangents, 4)) mesh.tangents = tangents;
    else if (tangents) warn('TANGENT holds vectors of length 0 and is left out.');
  }
  const uv0 = attribute('TEXCOORD_0', 2), uv1 = attribute('TEXCOORD_1', 2);
  if (uv0 || uv1) mesh.uvs = uv1 ? [uv0 ?? new Float32Array(2 * vertices), uv1] : [uv0 as Float32Array<ArrayBuffer>];
  const colors = attribute('COLOR_0', 4);
  if (colors) {
    for (let i = 0; i < colors.length; i++) colors[i] = i % 4 === 3 && opaque ? 1 : Math.min(Math.max(colors[i] as number, 0), 1);
    mesh.colors = colors;
  }
  return mesh;
}

/** The triangles whose corners exist and are finite. Positions that are not become 0, since nothing may be NaN. */
function soundTriangles(corners: Uint32Array<ArrayBuffer>, positions: Float32Array, warn: (message: string) => void): Uint32Array<ArrayBuffer> {
  const vertices = positions.length / 3;
  const finite = allFinite(positions);
  const good = (v: number) => v < vertices && (finite || (Number.isFinite(positions[3 * v]) && Number.isFinite(positions[3 * v + 1]) && Number.isFinite(positions[3 * v + 2])));
  let kept = 0;
  for (let i = 0; i < corners.length; i += 3) {
    if (!good(corners[i] as number) || !good(corners[i + 1] as number) || !good(corners[i + 2] as number)) continue;
    if (kept !== i) corners.copyWithin(kept, i, i + 3);
    kept += 3;
  }
  if (kept < corners.length) warn(`${(corners.length - kept) / 3} triangles have corners that do not exist or are not finite and are left out.`);
  if (!finite) for (let i = 0; i < positions.length; i++) if (!Number.isFinite(positions[i])) positions[i] = 0;
  return kept === corners.length ? corners : corners.slice(0, kept);
}
