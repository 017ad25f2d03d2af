import { MeshoptDecoder } from 'meshoptimizer/decoder';
import { MeshoptEncoder } from 'meshoptimizer/encoder';
import { beforeAll, describe, expect, test } from 'vitest';
import { loadGltf } from '../src/index';
import { glb } from './build';

const POSITIONS = Float32Array.from({ length: 3 * 24 }, (_, i) => Math.round(Math.sin(i) * 1000) / 1000);
const COLORS = Float32Array.from({ length: 4 * 24 }, (_, i) => (i % 4 === 3 ? 1 : (i % 13) / 12));
const INDICES = Uint16Array.from({ length: 3 * 8 }, (_, i) => i);

const bytesOf = (array: Float32Array | Uint16Array) => new Uint8Array(array.buffer, array.byteOffset, array.byteLength);

interface View {
  readonly bytes: Uint8Array;
  readonly length: number;
  readonly extension: object;
}

/** A GLB of packed views, whose fallback buffer has neither a uri nor a chunk. */
function packed(name: string, views: readonly View[], accessors: readonly object[], attributes: object) {
  const binary = new Uint8Array(views.reduce((sum, { bytes }) => sum + Math.ceil(bytes.length / 4) * 4, 0));
  let at = 0,
    unpacked = 0;
  const bufferViews = views.map(({ bytes, length, extension }) => {
    binary.set(bytes, at);
    const view = {
      buffer: 1,
      byteOffset: unpacked,
      byteLength: length,
      extensions: { [name]: { buffer: 0, byteOffset: at, byteLength: bytes.length, ...extension } },
    };
    at += Math.ceil(bytes.length / 4) * 4;
    unpacked += length;
    return view;
  });
  return glb(
    {
      asset: { version: '2.0' },
      extensionsUsed: [name, 'KHR_mesh_quantization'],
      extensionsRequired: [name, 'KHR_mesh_quantization'],
      scene: 0,
      scenes: [{ nodes: [0] }],
      nodes: [{ mesh: 0 }],
      meshes: [{ primitives: [{ attributes, indices: 0 }] }],
      buffers: [{ byteLength: binary.length }, { byteLength: unpacked, extensions: { [name]: { fallback: true } } }],
      bufferViews,
      accessors,
    },
    binary,
  );
}

/** The mesh, its attributes by the given version of the codec, its colours through the given filter. */
function model(name: string, version: number, filter?: 'COLOR') {
  const positions = MeshoptEncoder.encodeGltfBuffer(bytesOf(POSITIONS), 24, 12, 'ATTRIBUTES', version);
  // The first byte of a stream is its kind and the version of its codec.
  expect(positions[0]).toBe(0xa0 + version);
  const colors = filter
    ? MeshoptEncoder.encodeFilterColor(COLORS, 24, 4, 8)
    : Uint8Array.from(COLORS, (c) => Math.round(255 * c));
  return packed(
    name,
    [
      {
        bytes: MeshoptEncoder.encodeGltfBuffer(bytesOf(INDICES), 24, 2, 'TRIANGLES'),
        length: 48,
        extension: { byteStride: 2, count: 24, mode: 'TRIANGLES' },
      },
      { bytes: positions, length: 288, extension: { byteStride: 12, count: 24, mode: 'ATTRIBUTES' } },
      {
        bytes: MeshoptEncoder.encodeGltfBuffer(colors, 24, 4, 'ATTRIBUTES', version),
        length: 96,
        extension: { byteStride: 4, count: 24, mode: 'ATTRIBUTES', ...(filter ? { filter } : {}) },
      },
    ],
    [
      { bufferView: 0, componentType: 5123, type: 'SCALAR', count: 24 },
      { bufferView: 1, componentType: 5126, type: 'VEC3', count: 24 },
      { bufferView: 2, componentType: 5121, normalized: true, type: 'VEC4', count: 24 },
    ],
    { POSITION: 1, COLOR_0: 2 },
  );
}

beforeAll(() => MeshoptEncoder.ready);

describe.each([
  ['EXT_meshopt_compression', 0, undefined],
  ['KHR_meshopt_compression', 0, undefined],
  ['KHR_meshopt_compression', 1, undefined],
  ['KHR_meshopt_compression', 1, 'COLOR'],
] as const)('%s, version %i of the codec, filter %s', (name, version, filter) => {
  test('geometry comes back as it was', async () => {
    const scene = await loadGltf(model(name, version, filter), { decoders: { meshopt: MeshoptDecoder } });
    expect(scene.warnings).toEqual([]);
    const [mesh] = scene.meshes;
    expect(mesh!.indices.length).toBe(24);
    // Corner by corner: the loader may renumber vertices.
    const corners = (array: ArrayLike<number>, size: number) =>
      Array.from(mesh!.indices, (v) => Array.from({ length: size }, (_, k) => array[size * v + k]!));
    expect(corners(mesh!.positions, 3)).toEqual(Array.from(INDICES, (v) => [...POSITIONS.subarray(3 * v, 3 * v + 3)]));
    const colors = corners(mesh!.colors!, 4).flat();
    // One code for rounding; the filter keeps two more as luma and chroma are rounded apart.
    Array.from(COLORS).forEach((c, i) => expect(Math.abs(colors[i]! - c)).toBeLessThan((filter ? 3 : 0.51) / 255));
  });

  test('without a decoder the error names the package', async () => {
    await expect(loadGltf(model(name, version, filter))).rejects.toMatchObject({
      code: 'gltf/missing-decoder',
      message: expect.stringMatching(new RegExp(`${name}.*"meshoptimizer"`)),
    });
  });
});
