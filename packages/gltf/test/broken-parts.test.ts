import { expect, test } from 'vitest';
import { validateScene } from '@glanz/scene';
import { loadGltf } from '../src/index';
import { glb, spoiled, triangle, type TriangleJson } from './build';

/**
 * Parts that can do without: each a warning at its place, and a scene. Found by the fuzzer or by a validator's list of
 * issues.
 */
const REPAIRED: readonly (readonly [what: string, path: string, change: (json: TriangleJson) => void])[] = [
  ['weights of a node that are no array', '/nodes/0/weights', (json) => (json['nodes'][0].weights = 5)],
  ['names that are no texts', '/nodes/0/name', (json) => (json['nodes'][0].name = 7)],
  ['a generator that is no text', '/asset/generator', (json) => (json['asset'].generator = [])],
  ['minima of a wrong length', '/accessors/0/min', (json) => (json['accessors'][0].min = [0, 0])],
  ['a kind of view that is none', '/bufferViews/0/target', (json) => (json['bufferViews'][0].target = 3)],
  [
    'a stride in a view of indices',
    '/bufferViews/1/byteStride',
    (json) => {
      json['bufferViews'].push({ buffer: 0, byteLength: 36 });
      json['bufferViews'][1] = { buffer: 0, byteOffset: 36, byteLength: 6, byteStride: 4, target: 34963 };
      json['meshes'][0].primitives[0] = { attributes: { POSITION: 0 } };
      json['accessors'].pop();
    },
  ],
  ['a texture whose image does not exist', '/textures/0/source', (json) => (json['textures'] = [{ source: 4 }])],
  [
    'a WebP image that does not exist',
    '/textures/0/extensions/EXT_texture_webp/source',
    (json) => (json['textures'] = [{ extensions: { EXT_texture_webp: { source: 4 } } }]),
  ],
  [
    'a texture whose sampler does not exist',
    '/textures/0/sampler',
    (json) => {
      json['textures'] = [{ sampler: 1 }];
    },
  ],
  ['an image without uri and bufferView', '/images/0', (json) => (json['images'] = [{}])],
  ['an image of another format', '/images/0', (json) => (json['images'] = [{ uri: 'data:image/gif;base64,AAAA' }])],
  ['an image with invalid data', '/images/0', (json) => (json['images'] = [{ uri: 'data:image/png;base64,§' }])],
  ['an image from another origin', '/images/0', (json) => (json['images'] = [{ uri: 'https://example.org/a.png' }])],
  ['a skeleton that does not exist', '/skins/0/skeleton', (json) => (json['skins'] = [{ joints: [0], skeleton: 9 }])],
  [
    'morph targets in one primitive only',
    '/meshes/0/primitives',
    (json) => json['meshes'][0].primitives.push({ attributes: { POSITION: 0 }, targets: [{ POSITION: 0 }] }),
  ],
  ['weights for missing morph targets', '/meshes/0/weights', (json) => (json['meshes'][0].weights = [1, 2])],
  [
    'indices of a mesh that nothing shows',
    '/meshes/1/primitives/0',
    (json) => {
      json['meshes'].push({ primitives: [{ attributes: { POSITION: 0 }, indices: 2 }] });
      json['accessors'].push({ bufferView: 0, componentType: 5121, type: 'SCALAR', count: 36 });
    },
  ],
  ['children without an entry', '/nodes/0/children', (json) => (json['nodes'][0].children = [])],
  ['a scene without an entry', '/scenes/1/nodes', (json) => json['scenes'].push({ nodes: [] })],
  ['a list without an entry', '/cameras', (json) => (json['cameras'] = [])],
  ['extensions without an entry', '/extensionsUsed', (json) => (json['extensionsUsed'] = [])],
  [
    'variants without an entry',
    '/extensions/KHR_materials_variants/variants',
    (json) => (json['extensions'] = { KHR_materials_variants: { variants: [] } }),
  ],
  [
    'an extension that is named twice',
    '/extensionsUsed',
    (json) => (json['extensionsUsed'] = ['KHR_materials_unlit', 'KHR_materials_unlit']),
  ],
  [
    'an extension that is required, but not used',
    '/extensionsUsed',
    (json) => (json['extensionsRequired'] = ['KHR_materials_unlit']),
  ],
  [
    'an extension of a material that is not declared',
    '/extensionsUsed',
    (json) => (json['materials'] = [{ extensions: { KHR_materials_unlit: {} } }]),
  ],
  [
    'an extension of a texture that is not declared',
    '/extensionsUsed',
    (json) =>
      (json['materials'] = [
        { pbrMetallicRoughness: { baseColorTexture: { index: 0, extensions: { KHR_texture_transform: {} } } } },
      ]),
  ],
  [
    'a buffer of a type that is none',
    '/buffers/1/uri',
    (json) => json['buffers'].push({ byteLength: 3, uri: 'data:text/plain;base64,AAAA' }),
  ],
  [
    'a buffer without a type',
    '/buffers/1/uri',
    (json) => json['buffers'].push({ byteLength: 3, uri: 'data:;base64,AAAA' }),
  ],
  [
    'a buffer as text',
    '/buffers/1/uri',
    (json) => json['buffers'].push({ byteLength: 4, uri: 'data:application/octet-stream,AAAA' }),
  ],
  ['normalised floats', '/accessors/0/normalized', (json) => (json['accessors'][0].normalized = true)],
  [
    'texture coordinates of bytes',
    '/meshes/0/primitives/0/attributes/TEXCOORD_0',
    (json) => {
      json['accessors'].push({ bufferView: 0, componentType: 5121, type: 'VEC2', count: 3 });
      json['meshes'][0].primitives[0].attributes.TEXCOORD_0 = 2;
    },
  ],
  [
    'a matrix beside a scale',
    '/nodes/0/matrix',
    (json) =>
      Object.assign(json['nodes'][0], { matrix: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1], scale: [1, 1, 1] }),
  ],
  [
    'a skin without a mesh',
    '/nodes/1/skin',
    (json) => {
      json['skins'] = [{ joints: [0] }];
      json['nodes'].push({ skin: 0 });
    },
  ],
  ['weights without a mesh', '/nodes/1/weights', (json) => json['nodes'].push({ weights: [1] })],
  ['weights of a node for missing morph targets', '/nodes/0/weights', (json) => (json['nodes'][0].weights = [1])],
  ['a camera of no type', '/cameras/0/type', (json) => (json['cameras'] = [{ perspective: { yfov: 1, znear: 1 } }])],
  [
    'a camera of both types',
    '/cameras/0',
    (json) =>
      (json['cameras'] = [
        {
          type: 'perspective',
          perspective: { yfov: 1, znear: 1 },
          orthographic: { xmag: 1, ymag: 1, znear: 0, zfar: 1 },
        },
      ]),
  ],
  [
    'an aspect ratio of 0',
    '/cameras/0/perspective/aspectRatio',
    (json) => (json['cameras'] = [{ type: 'perspective', perspective: { yfov: 1, znear: 1, aspectRatio: 0 } }]),
  ],
  [
    'a spot light whose inner cone is the wider one',
    '/extensions/KHR_lights_punctual/lights/0/spot',
    (json) =>
      (json['extensions'] = {
        KHR_lights_punctual: { lights: [{ type: 'spot', spot: { innerConeAngle: 1, outerConeAngle: 0.5 } }] },
      }),
  ],
  [
    'two channels that move the same',
    '/animations/0/channels/1',
    (json) => {
      json['accessors'].push({ bufferView: 0, componentType: 5126, type: 'SCALAR', count: 3 });
      json['animations'] = [
        {
          samplers: [{ input: 2, output: 0 }],
          channels: [
            { sampler: 0, target: { node: 0, path: 'scale' } },
            { sampler: 0, target: { node: 0, path: 'scale' } },
          ],
        },
      ];
    },
  ],
  [
    'a channel that moves a node with a matrix',
    '/animations/0/channels/0',
    (json) => {
      json['accessors'].push({ bufferView: 0, componentType: 5126, type: 'SCALAR', count: 3 });
      json['nodes'][0].matrix = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
      json['animations'] = [
        { samplers: [{ input: 2, output: 0 }], channels: [{ sampler: 0, target: { node: 0, path: 'scale' } }] },
      ];
    },
  ],
  [
    'instances placed by nothing',
    '/nodes/0/extensions/EXT_mesh_gpu_instancing/attributes',
    (json) => {
      json['extensionsUsed'] = ['EXT_mesh_gpu_instancing'];
      json['nodes'][0].extensions = { EXT_mesh_gpu_instancing: { attributes: {} } };
    },
  ],
  [
    'instances turned by three numbers',
    '/nodes/0/extensions/EXT_mesh_gpu_instancing/attributes/ROTATION',
    (json) => {
      json['extensionsUsed'] = ['EXT_mesh_gpu_instancing'];
      json['nodes'][0].extensions = { EXT_mesh_gpu_instancing: { attributes: { ROTATION: 0 } } };
    },
  ],
  [
    'morph targets of one number',
    '/meshes/0/primitives/0/targets/0/POSITION',
    (json) => {
      json['meshes'][0].primitives[0].targets = [{ POSITION: 1 }];
      json['meshes'][0].weights = [1];
    },
  ],
  [
    'morph targets that move colours',
    '/meshes/0/primitives/0/targets/0/COLOR_0',
    (json) => {
      Object.assign(json['meshes'][0].primitives[0], {
        attributes: { POSITION: 0, COLOR_0: 0 },
        targets: [{ COLOR_0: 0 }],
      });
      json['meshes'][0].weights = [1];
    },
  ],
  [
    'morph targets without an entry',
    '/meshes/0/primitives/0/targets',
    (json) => (json['meshes'][0].primitives[0].targets = []),
  ],
  [
    'bind matrices of bytes',
    '/skins/0/inverseBindMatrices',
    (json) => {
      json['accessors'].push({ bufferView: 0, componentType: 5121, type: 'MAT4', count: 1 });
      json['skins'] = [{ joints: [0], inverseBindMatrices: 2 }];
    },
  ],
  [
    'translations of bytes',
    '/animations/0/channels/0',
    (json) => {
      json['accessors'].push(
        { bufferView: 0, componentType: 5126, type: 'SCALAR', count: 3 },
        { bufferView: 0, componentType: 5121, type: 'VEC3', count: 3, normalized: true },
      );
      json['animations'] = [
        { samplers: [{ input: 2, output: 3 }], channels: [{ sampler: 0, target: { node: 0, path: 'translation' } }] },
      ];
    },
  ],
  [
    'rotations of plain shorts',
    '/animations/0/channels/0',
    (json) => {
      json['accessors'].push(
        { bufferView: 0, componentType: 5126, type: 'SCALAR', count: 3 },
        { bufferView: 0, componentType: 5122, type: 'VEC4', count: 3 },
      );
      json['animations'] = [
        { samplers: [{ input: 2, output: 3 }], channels: [{ sampler: 0, target: { node: 0, path: 'rotation' } }] },
      ];
    },
  ],
  [
    'indices with a stride',
    '/meshes/0/primitives/0/indices',
    (json) => {
      json['buffers'][0].byteLength = 44;
      json['bufferViews'][1] = { buffer: 0, byteOffset: 32, byteLength: 12, byteStride: 4 };
    },
  ],
  ['a later minor version', '/asset/version', (json) => (json['asset'] = { version: '2.1', minVersion: '2.1' })],
];

test.each(REPAIRED)('%s', async (_, path, change) => {
  const scene = await loadGltf(spoiled(change));
  expect(scene.warnings.map((warning) => warning.path)).toContain(path);
  expect(scene.instances.length).toBeGreaterThan(0);
  validateScene(scene);
});

/** What an attribute of the triangle, four numbers a vertex, is reported for. */
async function attributeWarnings(
  semantic: string,
  numbers: readonly number[],
  others: TriangleJson = {},
): Promise<string[]> {
  const { json, binary } = triangle();
  const all = new Uint8Array(44 + 48);
  all.set(binary);
  new Float32Array(all.buffer, 44, 12).set(numbers);
  json['buffers'][0].byteLength = all.length;
  json['bufferViews'].push({ buffer: 0, byteOffset: 44, byteLength: 48 });
  json['accessors'].push({ bufferView: 2, componentType: 5126, type: 'VEC4', count: 3 });
  Object.assign(json['meshes'][0].primitives[0].attributes, { [semantic]: 2, ...others });
  return (await loadGltf(glb(json, all))).warnings.map(({ message }) => message);
}

test('colours that are clamped', async () => {
  expect(await attributeWarnings('COLOR_0', [0, 0.5, 1, 1, 0, 2, 0, 1, -3, 0, 0, 1])).toEqual([
    'node: COLOR_0 holds 2 numbers below 0 or above 1; they are clamped.',
  ]);
  expect(await attributeWarnings('COLOR_0', [0, 0.5, 1, 1, 0, 1, 0, 1, 1, 0, 0, 1])).toEqual([]);
});

test('tangents without a handedness, or without normals', async () => {
  // Positions serve as normals, which make sense but at the first vertex.
  const warnings = await attributeWarnings('TANGENT', [1, 0, 0, 1, 1, 0, 0, 0, 1, 0, 0, -0.5], { NORMAL: 0 });
  expect(warnings).toContain('node: TANGENT has 2 handednesses that are neither −1 nor 1; only their signs are used.');
  expect(await attributeWarnings('TANGENT', [1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, -1])).toEqual([
    'node: TANGENT is left out, since there are no normals.',
  ]);
});

test('a byte order mark before the JSON is skipped, and reported', async () => {
  const { json, binary } = triangle();
  const text = `\ufeff${JSON.stringify(json)}`;
  const plain = JSON.stringify({
    ...json,
    buffers: [
      { byteLength: 44, uri: `data:application/octet-stream;base64,${Buffer.from(binary).toString('base64')}` },
    ],
  });
  for (const bytes of [glb(text, binary), new TextEncoder().encode(`\ufeff${plain}`)]) {
    const { warnings, instances } = await loadGltf(bytes);
    expect([instances.length, warnings.map(({ code, message }) => [code, message])]).toEqual([
      1,
      [['gltf/container', expect.stringMatching(/starts with a byte order mark/)]],
    ]);
  }
  expect((await loadGltf(new TextEncoder().encode(plain))).warnings).toEqual([]);
});

test('bytes after the end of a GLB, and more of them in its binary chunk than its buffer has', async () => {
  const { json, binary } = triangle();
  const good = glb(json, binary);
  expect((await loadGltf(new Uint8Array([...good, 1, 2, 3]))).warnings.map(({ message }) => message)).toEqual([
    expect.stringMatching(/has 3 bytes after its end/),
  ]);
  const long = new Uint8Array(48);
  long.set(binary);
  expect((await loadGltf(glb(json, long))).warnings.map(({ path, message }) => [path, message])).toEqual([
    ['/buffers/0', expect.stringMatching(/has 48 bytes, but \/buffers\/0 only 44/)],
  ]);
});

test('chunks of a GLB out of place', async () => {
  const { json, binary } = triangle();
  const good = glb(json, binary);
  const words = (...numbers: number[]) => [...new Uint8Array(Uint32Array.from(numbers).buffer)];
  const withBytes = (at: number, added: readonly number[]) => {
    const bytes = Uint8Array.from([...good.subarray(0, at), ...added, ...good.subarray(at)]);
    new DataView(bytes.buffer).setUint32(8, bytes.length, true);
    return bytes;
  };
  const second = 20 + new DataView(good.buffer).getUint32(12, true);
  const messages = async (bytes: Uint8Array<ArrayBuffer>) =>
    (await loadGltf(bytes)).warnings.map(({ message }) => message);
  expect(await messages(withBytes(good.length, words(0)))).toEqual([
    expect.stringMatching(/has 4 bytes after its last chunk/),
  ]);
  // A chunk of another kind, which may lie anywhere after the others.
  expect(await messages(withBytes(good.length, words(4, 0x12345678, 0)))).toEqual([]);
  expect(await messages(withBytes(second, words(4, 0x12345678, 0)))).toEqual([
    expect.stringMatching(/has its binary chunk in place 3/),
  ]);
});

test('compressed data that are not declared are unpacked all the same', async () => {
  let unpacked = 0;
  const meshopt = {
    ready: Promise.resolve(),
    decodeGltfBuffer: (target: Uint8Array, _count: number, _size: number, source: Uint8Array) => {
      unpacked++;
      target.set(source);
    },
  };
  const { warnings } = await loadGltf(
    spoiled((json) => {
      json['bufferViews'][0].extensions = {
        EXT_meshopt_compression: { buffer: 0, byteLength: 36, byteStride: 12, count: 3, mode: 'ATTRIBUTES' },
      };
    }),
    { decoders: { meshopt } },
  );
  expect([unpacked, warnings.map(({ code }) => code)]).toEqual([1, ['gltf/extension']]);
});

test('an index equal to the primitive restart value is reported', async () => {
  const { json, binary } = triangle();
  new Uint16Array(binary.buffer, 36, 3).set([0, 1, 65535]);
  const scene = await loadGltf(glb(json, binary), { allowEmpty: true });
  expect(scene.warnings[0]!.message).toMatch(/primitive restart value/);
});

const REFUSED: readonly (readonly [what: string, change: (json: TriangleJson) => void, code: string])[] = [
  ['a data: uri without its comma', (json) => void (json['buffers'][0].uri = 'data:'), 'gltf/malformed'],
  [
    'a data: uri with a hole in its type',
    (json) => void (json['buffers'][0].uri = 'data:application/octet-stream;;base64,AAAA'),
    'gltf/malformed',
  ],
  [
    'a least version above the version',
    (json) => void (json['asset'] = { version: '2.0', minVersion: '2.1' }),
    'gltf/version',
  ],
  [
    'compressed data that claim to be more than they can',
    (json) => {
      json['extensionsUsed'] = ['EXT_meshopt_compression'];
      json['buffers'].push({ byteLength: 2 ** 40 });
      json['bufferViews'][0] = {
        buffer: 1,
        byteLength: 2 ** 36,
        extensions: {
          EXT_meshopt_compression: { buffer: 0, byteLength: 36, byteStride: 16, count: 2 ** 32, mode: 'ATTRIBUTES' },
        },
      };
    },
    'gltf/malformed',
  ],
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
