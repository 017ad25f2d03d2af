import { expect, test } from 'vitest';
import { validateScene } from '@glanz/scene';
import { loadGltf } from '../src/index';
import { glb, spoiled, triangle, type TriangleJson } from './build';

/** Parts that can do without: each a warning at its place, and a scene. Found by the fuzzer or by a validator's list of issues. */
const REPAIRED: readonly (readonly [what: string, path: string, change: (json: TriangleJson) => void])[] = [
  ['weights of a node that are no array', '/nodes/0/weights', (json) => (json['nodes'][0].weights = 5)],
  ['names that are no texts', '/nodes/0/name', (json) => (json['nodes'][0].name = 7)],
  ['a generator that is no text', '/asset/generator', (json) => (json['asset'].generator = [])],
  ['minima of a wrong length', '/accessors/0/min', (json) => (json['accessors'][0].min = [0, 0])],
  ['a kind of view that is none', '/bufferViews/0/target', (json) => (json['bufferViews'][0].target = 3)],
  ['a stride in a view of indices', '/bufferViews/1/byteStride', (json) => { json['bufferViews'].push({ buffer: 0, byteLength: 36 }); json['bufferViews'][1] = { buffer: 0, byteOffset: 36, byteLength: 6, byteStride: 4, target: 34963 }; json['meshes'][0].primitives[0] = { attributes: { POSITION: 0 } }; json['accessors'].pop(); }],
  ['a texture whose picture does not exist', '/textures/0/source', (json) => (json['textures'] = [{ source: 4 }])],
  ['a WebP picture that does not exist', '/textures/0/extensions/EXT_texture_webp/source', (json) => (json['textures'] = [{ extensions: { EXT_texture_webp: { source: 4 } } }])],
  ['a texture whose sampler does not exist', '/textures/0/sampler', (json) => { json['textures'] = [{ sampler: 1 }]; }],
  ['a picture from nowhere', '/images/0', (json) => (json['images'] = [{}])],
  ['a picture of another kind', '/images/0', (json) => (json['images'] = [{ uri: 'data:image/gif;base64,AAAA' }])],
  ['a picture whose data are none', '/images/0', (json) => (json['images'] = [{ uri: 'data:image/png;base64,§' }])],
  ['a picture from elsewhere', '/images/0', (json) => (json['images'] = [{ uri: 'https://example.org/a.png' }])],
  ['a skeleton that does not exist', '/skins/0/skeleton', (json) => (json['skins'] = [{ joints: [0], skeleton: 9 }])],
  ['morph targets in one primitive only', '/meshes/0/primitives', (json) => json['meshes'][0].primitives.push({ attributes: { POSITION: 0 }, targets: [{ POSITION: 0 }] })],
  ['weights for morph targets that are not there', '/meshes/0/weights', (json) => (json['meshes'][0].weights = [1, 2])],
  ['indices of a mesh that nothing shows', '/meshes/1/primitives/0', (json) => { json['meshes'].push({ primitives: [{ attributes: { POSITION: 0 }, indices: 2 }] }); json['accessors'].push({ bufferView: 0, componentType: 5121, type: 'SCALAR', count: 36 }); }],
  ['a later minor version', '/asset/version', (json) => (json['asset'] = { version: '2.1', minVersion: '2.1' })],
];

test.each(REPAIRED)('%s', async (_, path, change) => {
  const scene = await loadGltf(spoiled(change));
  expect(scene.warnings.map((warning) => warning.path)).toContain(path);
  expect(scene.instances.length).toBeGreaterThan(0);
  validateScene(scene);
});

test('an index that restarts primitives in graphics interfaces is told', async () => {
  const { json, binary } = triangle();
  new Uint16Array(binary.buffer, 36, 3).set([0, 1, 65535]);
  const scene = await loadGltf(glb(json, binary), { allowEmpty: true });
  expect(scene.warnings[0]!.message).toMatch(/restarts a primitive/);
});

const REFUSED: readonly (readonly [what: string, change: (json: TriangleJson) => void, code: string])[] = [
  ['a data: uri without its comma', (json) => void (json['buffers'][0].uri = 'data:'), 'gltf/malformed'],
  ['a data: uri with a hole in its type', (json) => void (json['buffers'][0].uri = 'data:application/octet-stream;;base64,AAAA'), 'gltf/malformed'],
  ['a least version above the version', (json) => void (json['asset'] = { version: '2.0', minVersion: '2.1' }), 'gltf/version'],
  ['compressed data that claim to be more than they can', (json) => {
    json['extensionsUsed'] = ['EXT_meshopt_compression'];
    json['buffers'].push({ byteLength: 2 ** 40 });
    json['bufferViews'][0] = { buffer: 1, byteLength: 2 ** 36, extensions: { EXT_meshopt_compression: { buffer: 0, byteLength: 36, byteStride: 16, count: 2 ** 32, mode: 'ATTRIBUTES' } } };
  }, 'gltf/malformed'],
];

test.each(REFUSED)('%s is refused', async (_, change, code) => {
  await expect(loadGltf(spoiled(change), { decoders: { meshopt: {} } })).rejects.toMatchObject({ code });
});

test('morph targets that lead out of single precision do not count', async () => {
  const { json, binary } = triangle();
  const huge = new Uint8Array(44 + 36);
  huge.set(binary);
  new Float32Array(huge.buffer, 0, 9).fill(3e38, 3, 4);
  new Float32Array(huge.buffer, 44, 9).fill(3e38);
  json['buffers'][0].byteLength = huge.length;
  json['bufferViews'].push({ buffer: 0, byteOffset: 44, byteLength: 36 });
  json['accessors'].push({ bufferView: 2, componentType: 5126, type: 'VEC3', count: 3 });
  json['meshes'][0].primitives[0].targets = [{ POSITION: 2 }];
  json['meshes'][0].weights = [1];
  expect((await loadGltf(glb(json, huge))).meshes[0]!.positions.every(Number.isFinite)).toBe(true);
});
