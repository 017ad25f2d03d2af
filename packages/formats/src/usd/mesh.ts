import type { Mesh } from '@glanz/scene';
import { FloatList } from '../mesh-builder';
import { smoothNormals } from '../smooth';
import { triangulate } from '../triangulate';
import { numbersOf, textOf, type UsdPrim } from './layer';

/** Values on a mesh, and which of them belongs to a corner. */
interface Primvar {
  readonly values: ArrayLike<number>;
  readonly index: (face: number, corner: number, point: number) => number;
  readonly varies: boolean;
}

/** What all parts of a mesh read. */
export interface MeshData {
  readonly prim: UsdPrim;
  readonly points: ArrayLike<number>;
  readonly counts: ArrayLike<number>;
  /** First corner of each face, and the number of all. */
  readonly starts: Uint32Array;
  readonly corners: ArrayLike<number>;
}

/** The topology of a mesh; undefined without faces. */
export function meshData(prim: UsdPrim): MeshData | undefined {
  const [points, counts, corners] = ['points', 'faceVertexCounts', 'faceVertexIndices'].map((name) =>
    numbersOf(prim, name),
  );
  if (!points || !counts || !corners || counts.length === 0) return undefined;
  const starts = new Uint32Array(counts.length + 1);
  for (let face = 0; face < counts.length; face++)
    starts[face + 1] = Math.min((starts[face] as number) + Math.max(counts[face] as number, 0), corners.length);
  return { prim, points, counts, starts, corners };
}

/** A primvar by its interpolation, or by how many values there are where it names none. */
function primvarOf(data: MeshData, name: string, size: number): Primvar | undefined {
  const { prim, points, counts, corners } = data;
  const values = numbersOf(prim, name);
  if (!values || values.length < size) return undefined;
  const indices = numbersOf(prim, `${name}:indices`);
  const length = indices ? indices.length : values.length / size;
  const given = prim.attributes.get(name)?.interpolation;
  const kind =
    given ??
    (length === 1
      ? 'constant'
      : length === corners.length
        ? 'faceVarying'
        : length === points.length / 3
          ? 'vertex'
          : length === counts.length
            ? 'uniform'
            : 'constant');
  return {
    values,
    varies: kind !== 'constant',
    index: (face, corner, point) => {
      const at = kind === 'faceVarying' ? corner : kind === 'uniform' ? face : kind === 'constant' ? 0 : point;
      return indices ? (indices[at] ?? -1) : at;
    },
  };
}

/** The names of a mesh's texture coordinates, without `primvars:`. */
export const uvNames = ({ prim }: MeshData): string[] =>
  [...prim.attributes]
    .filter(([name, { type }]) => /^primvars:[^:]+$/.test(name) && /^(texCoord2|float2)/.test(type))
    .map(([name]) => name.slice('primvars:'.length));

/** The colour of a mesh without a material: one for all, one per corner, or none. */
export function displayColor(data: MeshData): readonly [number, number, number] | 'varying' | undefined {
  const primvar = primvarOf(data, 'primvars:displayColor', 3);
  if (!primvar) return undefined;
  if (primvar.varies) return 'varying';
  return [0, 1, 2].map((k) => Math.min(Math.max(Number(primvar.values[k]), 0), 1)) as [number, number, number];
}

/**
 * Faces of a mesh as triangles.
 *
 * @param uvs Names of the texture coordinates to read, in the order of the result's UV sets.
 * @param colored Whether `displayColor` becomes the vertices' colours.
 * @returns The mesh, undefined without triangles; and how many faces named points that are missing or not finite.
 */
export function meshPart(
  data: MeshData,
  faces: Iterable<number>,
  name: string,
  uvs: readonly string[],
  colored: boolean,
): { readonly mesh: Mesh | undefined; readonly dropped: number } {
  const { prim, points, starts, corners } = data;
  const sets = uvs.map((uv) => primvarOf(data, `primvars:${uv}`, 2));
  const normals = primvarOf(data, 'primvars:normals', 3) ?? primvarOf(data, 'normals', 3);
  const colors = colored ? primvarOf(data, 'primvars:displayColor', 3) : undefined;
  const reversed = textOf(prim, 'orientation') === 'leftHanded';
  const vertices = new Map<string, number>();
  const positions = new FloatList(),
    directions = new FloatList(),
    rgba = new FloatList();
  const coordinates = sets.map(() => new FloatList());
  const indices: number[] = [];
  let dropped = 0,
    areNormals = normals !== undefined;
  const vertex = (face: number, corner: number): number => {
    const point = corners[corner] as number;
    const [normal, color, ...texels] = [normals, colors, ...sets].map((set) => set?.index(face, corner, point) ?? -1);
    const key = `${point} ${normal} ${color} ${texels.join(' ')}`;
    const known = vertices.get(key);
    if (known !== undefined) return known;
    const number = (values: ArrayLike<number> | undefined, at: number) => {
      const value = Math.fround(values?.[at] ?? 0);
      return Number.isFinite(value) ? value : 0;
    };
    positions.push(...[0, 1, 2].map((k) => number(points, 3 * point + k)));
    const direction = [0, 1, 2].map((k) => number(normals?.values, 3 * (normal as number) + k));
    const length = Math.hypot(...direction);
    if (!(length > 1e-12)) areNormals = false;
    directions.push(...direction.map((x) => x / (length || 1)));
    rgba.push(...[0, 1, 2].map((k) => Math.min(Math.max(number(colors?.values, 3 * (color as number) + k), 0), 1)), 1);
    coordinates.forEach((list, i) => {
      const at = 2 * (texels[i] as number);
      list.push(number(sets[i]?.values, at), 1 - number(sets[i]?.values, at + 1));
    });
    const made = vertices.size;
    vertices.set(key, made);
    return made;
  };
  for (const face of faces) {
    const from = starts[face],
      to = starts[face + 1];
    if (from === undefined || to === undefined) {
      dropped++;
      continue;
    }
    const own = Array.from({ length: to - from }, (_, i) => (reversed ? to - 1 - i : from + i));
    const places = own.flatMap((corner) => [0, 1, 2].map((k) => Number(points[3 * (corners[corner] as number) + k])));
    if (own.length < 3 || !places.every((x) => Number.isFinite(Math.fround(x)))) {
      dropped++;
      continue;
    }
    for (const corner of triangulate(places)) indices.push(vertex(face, own[corner] as number));
  }
  if (indices.length === 0) return { mesh: undefined, dropped };
  const mesh: Mesh = { name, positions: positions.toArray(), indices: Uint32Array.from(indices) };
  if (coordinates.length > 0) mesh.uvs = coordinates.map((list) => list.toArray());
  if (colors) mesh.colors = rgba.toArray();
  if (areNormals) mesh.normals = directions.toArray();
  // Without normals a polygon mesh is flat, and the control mesh of a subdivision surface smooth.
  else if (textOf(prim, 'subdivisionScheme') !== 'none')
    return {
      mesh: smoothNormals(
        mesh,
        Array.from({ length: indices.length / 3 }, () => 1),
      ),
      dropped,
    };
  return { mesh, dropped };
}
