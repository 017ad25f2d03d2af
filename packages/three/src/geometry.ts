import type { Mesh } from '@glanz/scene';
import { poseVertices } from './pose';
import type { Attribute, Geometry, ThreeMesh } from './types';

/** A part of a geometry that has one material. */
export interface Part {
  readonly start: number;
  readonly count: number;
  /** Index into the mesh's materials. */
  readonly material: number;
}

/** How a part is to be read. */
export interface PartOptions {
  /** Texture coordinates have their origin at the bottom, as images that three turns over want them. */
  readonly flipV: boolean;
  /** Vertex colours count. */
  readonly colors: boolean;
  /** Normals do not. */
  readonly flat: boolean;
}

/** An attribute's numbers, tightly packed, normalised integers as fractions; not to be written to. */
export function numbersOf(attribute: Attribute, size: number): Float32Array<ArrayBuffer> {
  const { count, array } = attribute;
  if (array instanceof Float32Array && !attribute.isInterleavedBufferAttribute && attribute.itemSize === size)
    return array.subarray(0, count * size) as Float32Array<ArrayBuffer>;
  const numbers = new Float32Array(count * size);
  for (let i = 0; i < count; i++)
    for (let k = 0; k < size; k++)
      numbers[i * size + k] = k < attribute.itemSize ? attribute.getComponent(i, k) : k === 3 ? 1 : 0;
  return numbers;
}

/** The parts of a geometry, within its draw range. */
export function partsOf({ index, attributes, groups, drawRange }: Geometry, several: boolean): Part[] {
  const total = index ? index.count : (attributes['position']?.count ?? 0);
  const end = Math.min(total, drawRange.start + drawRange.count);
  const all = several && groups.length > 0 ? groups : [{ start: 0, count: Infinity, materialIndex: 0 }];
  return all.flatMap(({ start, count, materialIndex = 0 }) => {
    const from = Math.max(start, drawRange.start);
    const triangles = Math.floor((Math.min(end, start + count) - from) / 3);
    return triangles > 0 ? [{ start: from, count: 3 * triangles, material: several ? materialIndex : 0 }] : [];
  });
}

/**
 * The mesh of a part, as it is posed now; `undefined` if it has no triangle. Vertices that no triangle of the part uses
 * are left out.
 */
export function meshOfPart(
  name: string,
  mesh: ThreeMesh,
  part: Part,
  { flipV, colors, flat }: PartOptions,
): Mesh | undefined {
  const { geometry } = mesh;
  const position = geometry.attributes['position'];
  if (!position || part.count < 3) return undefined;
  const corners = new Uint32Array(part.count);
  for (let i = 0; i < part.count; i++)
    corners[i] = geometry.index ? geometry.index.getComponent(part.start + i, 0) : part.start + i;
  if (corners.some((corner) => corner >= position.count)) return undefined;
  const posed = poseVertices(mesh);
  const normal = flat ? undefined : geometry.attributes['normal'];
  const streams: { readonly key: string; readonly size: number; readonly data: Float32Array }[] = [
    { key: 'positions', size: 3, data: posed?.positions ?? numbersOf(position, 3) },
  ];
  if (normal) streams.push({ key: 'normals', size: 3, data: posed?.normals ?? numbersOf(normal, 3) });
  const tangent = flat ? undefined : geometry.attributes['tangent'];
  // Those of a pose would have to turn with it; without them the shader makes its own from the coordinates.
  if (tangent && !posed) streams.push({ key: 'tangents', size: 4, data: numbersOf(tangent, 4) });
  for (const [set, key] of ['uv', 'uv1'].entries()) {
    const uv = geometry.attributes[key];
    if (!uv) break;
    streams.push({ key: `uv${set}`, size: 2, data: numbersOf(uv, 2) });
  }
  const color = colors ? geometry.attributes['color'] : undefined;
  if (color) streams.push({ key: 'colors', size: 4, data: numbersOf(color, 4) });

  // Only what the part uses: groups of one geometry do not carry each other's vertices.
  const place = new Int32Array(position.count).fill(-1);
  const used: number[] = [];
  const indices = new Uint32Array(part.count);
  for (let i = 0; i < corners.length; i++) {
    const corner = corners[i] as number;
    if ((place[corner] as number) < 0) place[corner] = used.push(corner) - 1;
    indices[i] = place[corner] as number;
  }
  const packed = new Map(
    streams.map(({ key, size, data }) => {
      const out = new Float32Array(used.length * size);
      used.forEach((from, to) => out.set(data.subarray(from * size, from * size + size), to * size));
      return [key, out] as const;
    }),
  );
  const made: Mesh = { name, positions: packed.get('positions') as Float32Array<ArrayBuffer>, indices };
  const normals = packed.get('normals');
  if (normals) made.normals = unit(normals, 3);
  const tangents = packed.get('tangents');
  if (tangents) made.tangents = unit(tangents, 4);
  const uvs = [packed.get('uv0'), packed.get('uv1')].filter((uv) => uv !== undefined);
  if (flipV) for (const uv of uvs) for (let i = 1; i < uv.length; i += 2) uv[i] = 1 - (uv[i] as number);
  if (uvs.length > 0) made.uvs = uvs;
  const made4 = packed.get('colors');
  if (made4) made.colors = made4.map((value) => Math.max(0, value));
  return made;
}

/** Makes the first three numbers of each entry a unit vector; one without a length points up. */
function unit(vectors: Float32Array<ArrayBuffer>, stride: number): Float32Array<ArrayBuffer> {
  for (let i = 0; i < vectors.length; i += stride) {
    const length = Math.hypot(vectors[i] as number, vectors[i + 1] as number, vectors[i + 2] as number);
    if (length > 1e-12) for (let k = 0; k < 3; k++) vectors[i + k] = (vectors[i + k] as number) / length;
    else vectors.set([0, 1, 0], i);
    if (stride === 4) vectors[i + 3] = (vectors[i + 3] as number) < 0 ? -1 : 1;
  }
  return vectors;
}
