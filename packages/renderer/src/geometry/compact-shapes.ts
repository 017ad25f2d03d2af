// Imports no values of the renderer: those it has in common with what is there from the start would become a chunk of
// their own, which all pages load.
import type { Mesh } from '@glanz/scene';
import type { ShapeSlice } from '../storage/shape-arrays';
import type { Hierarchy, MeshRegion } from './hierarchy';

/** Bytes of a record or a vertex in the array of triangles, as in `compact-records.ts`. */
const RECORD_BYTES = 16;

/** Records and vertices that are written at once: a millisecond or two of work. */
const SLICE_RECORDS = 1 << 14;

/**
 * A direction as two numbers of `bits` bits on an octahedron, each a sign and a magnitude up to `largest`, in one word.
 * Of a vector of length 0, which has no direction, the first magnitude is larger than all others. Millions are packed
 * while a scene is loaded: nothing is allocated.
 */
function packDirection(x: number, y: number, z: number, bits: number, largest: number): number {
  const scale = largest / (Math.abs(x) + Math.abs(y) + Math.abs(z));
  const sign = 1 << (bits - 1);
  if (!(scale < Infinity)) return sign - 1;
  let u = Math.abs(x) * scale;
  let v = Math.abs(y) * scale;
  if (z < 0) {
    const before = u;
    u = largest - v;
    v = largest - before;
  }
  const first = (u + 0.5) | 0 | (x < 0 ? sign : 0);
  const second = (v + 0.5) | 0 | (y < 0 ? sign : 0);
  return (first | (second << bits)) >>> 0;
}

/** A normal, as the fourth word of a vertex. */
export const packNormal = (x: number, y: number, z: number): number => packDirection(x, y, z, 16, 0x7ffe);

/** Tangents of four numbers, as a word each. */
export function packTangents(tangents: Float32Array): Uint32Array<ArrayBuffer> {
  const words = new Uint32Array(tangents.length / 4);
  for (let i = 0; i < words.length; i++) {
    const at = 4 * i;
    const [x, y, z] = [tangents[at] as number, tangents[at + 1] as number, tangents[at + 2] as number];
    words[i] = packDirection(x, y, z, 15, 0x3ffe) | ((tangents[at + 3] as number) < 0 ? 0x80000000 : 0);
  }
  return words;
}

/** Tangents as a word each, written from `offset` bytes of the attributes on. */
function* tangentSlices(offset: number, tangents: Float32Array): Generator<ShapeSlice> {
  for (let first = 0; 4 * first < tangents.length; first += SLICE_RECORDS) {
    const data = packTangents(tangents.subarray(4 * first, 4 * (first + SLICE_RECORDS)));
    yield { buffer: 'attributes', offset: offset + 4 * first, data };
  }
}

/** Records of a mesh's triangles and vertices. Where its hierarchy is on the GPU, those of triangles are made there. */
function* slices(
  { positions, indices, normals }: Mesh,
  { triangleIndices, nodes }: Pick<Hierarchy, 'triangleIndices' | 'nodes'>,
  { firstTriangle, firstVertex }: MeshRegion,
): Generator<ShapeSlice> {
  for (let first = 0; nodes && first < triangleIndices.length; first += SLICE_RECORDS) {
    const count = Math.min(SLICE_RECORDS, triangleIndices.length - first);
    const data = new Uint32Array(4 * count);
    for (let i = 0; i < count; i++) {
      const triangle = triangleIndices[first + i] as number;
      data[4 * i] = firstVertex + (indices[3 * triangle] as number);
      data[4 * i + 1] = firstVertex + (indices[3 * triangle + 1] as number);
      data[4 * i + 2] = firstVertex + (indices[3 * triangle + 2] as number);
      data[4 * i + 3] = triangle;
    }
    yield { buffer: 'triangles', offset: RECORD_BYTES * (firstTriangle + first), data };
  }
  const vertices = positions.length / 3;
  for (let first = 0; first < vertices; first += SLICE_RECORDS) {
    const count = Math.min(SLICE_RECORDS, vertices - first);
    const data = new Float32Array(4 * count);
    const words = new Uint32Array(data.buffer);
    for (let i = 0, at = 3 * first; i < count; i++, at += 3) {
      data[4 * i] = positions[at] as number;
      data[4 * i + 1] = positions[at + 1] as number;
      data[4 * i + 2] = positions[at + 2] as number;
      if (normals)
        words[4 * i + 3] = packNormal(normals[at] as number, normals[at + 1] as number, normals[at + 2] as number);
    }
    yield { buffer: 'triangles', offset: RECORD_BYTES * (firstVertex + first), data };
  }
}

/**
 * Shapes of about half the size: triangles name the vertices of their mesh, which are stored once, with their normals;
 * normals and tangents take a word. Positions are the same numbers. A ray loads four records for a triangle, of which
 * one names the others, where the other layout has three that lie together.
 */
export const COMPACT_SHAPES = {
  /** Words of an attribute for each number of the mesh: indices, normals, tangents, colours, texture coordinates. */
  shares: [0, 0, 1 / 4, 1, 1, 1],
  slices,
  tangentSlices,
} as const;

export type CompactShapes = typeof COMPACT_SHAPES;
