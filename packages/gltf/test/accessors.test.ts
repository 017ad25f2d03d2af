// How much of a buffer view the last element of an accessor needs, by the figure in glTF 2.0, 3.6.2.4: columns of
// matrices start at multiples of 4 bytes, and no byte after the last column is part of the element.
import { expect, test } from 'vitest';
import { loadGltf, type GltfError } from '../src/index';
import { Accessors } from '../src/accessors';
import type { GltfJson } from '../src/json';
import { Budget } from '../src/limits';
import { spoiled } from './build';

const X = 0xee;
const MAT2_BYTES = [1, 2, X, X, 3, 4, X, X];
const MAT3_BYTES = [1, 2, 3, X, 4, 5, 6, X, 7, 8, 9, X];
const MAT3_SHORTS = [1, 0, 2, 0, 3, 0, X, X, 4, 0, 5, 0, 6, 0, X, X, 7, 0, 8, 0, 9, 0, X, X];
const LAYOUTS = [
  ['MAT2', 5121, MAT2_BYTES, 6, 4],
  ['MAT2', 5120, MAT2_BYTES, 6, 4],
  ['MAT3', 5121, MAT3_BYTES, 11, 9],
  ['MAT3', 5123, MAT3_SHORTS, 22, 9],
] as const;

/** The triangle with an accessor of matrices that a vertex attribute of the document's own reads. */
const withMatrices = (accessor: object, bytes: readonly number[], view: object = {}) =>
  spoiled((json) => {
    json['buffers'].push({
      byteLength: bytes.length,
      uri: `data:application/octet-stream;base64,${Buffer.from(bytes).toString('base64')}`,
    });
    json['bufferViews'].push({ buffer: 1, byteLength: bytes.length, ...view });
    json['accessors'].push({ bufferView: 2, count: 2, ...accessor });
    json['meshes'][0].primitives[0].attributes._MATRICES = 2;
  });

/** Numbers of an accessor over bytes, as the loader reads them. */
function read(accessor: object, bytes: readonly number[], view: object = {}): number[] {
  const json = {
    bufferViews: [{ buffer: 0, byteLength: bytes.length, ...view }],
    accessors: [{ bufferView: 0, ...accessor }],
  };
  const data = Uint8Array.from(bytes);
  return [
    ...new Accessors(json as unknown as GltfJson, () => data, new Budget('test', 'geometryBytes', undefined)).floats(0),
  ];
}

test.each(LAYOUTS)('the last %s of %d ends with its last column', async (type, componentType, element, used, size) => {
  const bytes = [...element, ...element.slice(0, used)];
  const scene = await loadGltf(withMatrices({ componentType, type }, bytes));
  expect([scene.instances.length, scene.warnings]).toEqual([1, []]);
  const numbers = Array.from({ length: size }, (_, i) => i + 1);
  expect(read({ componentType, type, count: 2 }, bytes)).toEqual([...numbers, ...numbers]);
});

test.each(LAYOUTS)('a byte less than that is refused: %s of %d', async (type, componentType, element, used) => {
  const bytes = [...element, ...element.slice(0, used - 1)];
  // Kept even, so that views of shorts are cut in a column as well.
  const error = await loadGltf(withMatrices({ componentType, type }, bytes)).catch(
    (thrown: unknown) => thrown as GltfError,
  );
  expect(error).toMatchObject({ code: 'gltf/malformed', location: { path: '/accessors/2' } });
});

test('a stride counts between elements, not after the last one', async () => {
  const gap = Array.from({ length: 4 }, () => X);
  const bytes = [...MAT2_BYTES, ...gap, ...MAT2_BYTES.slice(0, 6)];
  const scene = await loadGltf(withMatrices({ componentType: 5121, type: 'MAT2' }, bytes, { byteStride: 12 }));
  expect(scene.instances.length).toBe(1);
  expect(read({ componentType: 5121, type: 'MAT2', count: 2 }, bytes, { byteStride: 12 })).toEqual([
    1, 2, 3, 4, 1, 2, 3, 4,
  ]);
  const short = withMatrices({ componentType: 5121, type: 'MAT2' }, bytes, { byteStride: 16 });
  await expect(loadGltf(short)).rejects.toMatchObject({ code: 'gltf/malformed', location: { path: '/accessors/2' } });
});

test('sparse matrices need no padding after the last one either', async () => {
  const bytes = [1, 0, 0, 0, ...MAT3_BYTES.slice(0, 11)];
  const accessor = { componentType: 5121, type: 'MAT3', count: 2 };
  const sparse = (view: number) => ({
    count: 1,
    indices: { bufferView: view, componentType: 5121 },
    values: { bufferView: view, byteOffset: 4 },
  });
  const { warnings } = await loadGltf(withMatrices({ ...accessor, bufferView: undefined, sparse: sparse(2) }, bytes));
  expect(warnings).toEqual([]);
  expect(read({ ...accessor, bufferView: undefined, sparse: sparse(0) }, bytes)).toEqual([
    0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9,
  ]);
});

test('a stride has no meaning for sparse data, and is reported', async () => {
  const bytes = [1, 0, 0, 0, ...MAT2_BYTES];
  const sparse = {
    count: 1,
    indices: { bufferView: 2, componentType: 5121 },
    values: { bufferView: 2, byteOffset: 4 },
  };
  const { warnings } = await loadGltf(
    withMatrices({ componentType: 5121, type: 'MAT2', bufferView: undefined, sparse }, bytes, { byteStride: 12 }),
  );
  expect(warnings.map(({ path }) => path)).toEqual(['/accessors/2/sparse/indices', '/accessors/2/sparse/values']);
});
