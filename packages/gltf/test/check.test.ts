import { describe, expect, test } from 'vitest';
import { GltfError, loadGltf } from '../src/index';
import { glb, spoiled, triangle, type TriangleJson } from './build';

const outcome = async (bytes: Uint8Array<ArrayBuffer>): Promise<GltfError> => {
  const caught: unknown = await loadGltf(bytes).then(
    () => undefined,
    (e: unknown) => e,
  );
  expect(caught).toBeInstanceOf(GltfError);
  return caught as GltfError;
};

const text = (s: string) => new TextEncoder().encode(s);
const sound = spoiled(() => undefined);

test.each<[string, Uint8Array<ArrayBuffer>, string]>([
  ['nothing', new Uint8Array(0), 'gltf/not-gltf'],
  ['a text', text('hello'), 'gltf/not-gltf'],
  ['JSON of another kind', text('{"a": 1}'), 'gltf/not-gltf'],
  ['a GLB cut off in its header', sound.slice(0, 10), 'gltf/truncated'],
  ['a GLB cut off in its JSON', sound.slice(0, 100), 'gltf/truncated'],
  ['a GLB cut off in its data', sound.slice(0, -4), 'gltf/truncated'],
  ['a GLB of version 1', glb({}, undefined, 1), 'gltf/version'],
  ['glTF 1.0', text('{"asset": {"version": "1.0"}}'), 'gltf/version'],
  ['a GLB whose JSON is none', glb('{nonsense'), 'gltf/not-gltf'],
  ['data shorter than it says', glb(triangle().json, new Uint8Array(20)), 'gltf/truncated'],
])('%s is recognized', async (_, bytes, code) => {
  const error = await outcome(bytes);
  expect(error.code).toBe(code);
  expect(error.message).not.toMatch(/\n/);
});

describe('what the structure depends on is refused, and the error says where', () => {
  test.each<[string, (json: TriangleJson) => void, string]>([
    ['a list that is none', (j) => (j['meshes'] = {}), '/meshes'],
    ['an entry that is none', (j) => (j['nodes'][0] = null), '/nodes/0'],
    ['a buffer view beyond its buffer', (j) => (j['bufferViews'][0].byteLength = 1000), '/bufferViews/0'],
    ['a negative offset', (j) => (j['bufferViews'][1].byteOffset = -4), '/bufferViews/1/byteOffset'],
    ['a count as a fraction', (j) => (j['accessors'][0].count = 2.5), '/accessors/0/count'],
    ['a count of 2^32', (j) => (j['accessors'][0].count = 2 ** 32), '/accessors/0'],
    [
      'terabytes of zeros',
      (j) => {
        delete j['accessors'][0].bufferView;
        j['accessors'][0].count = 2 ** 40;
      },
      '/accessors/0',
    ],
    [
      'terabytes of zeros, sparse',
      (j) => {
        delete j['accessors'][0].bufferView;
        j['accessors'][0].count = 2 ** 32;
        j['accessors'][0].sparse = {
          count: 1,
          indices: { bufferView: 1, componentType: 5123 },
          values: { bufferView: 0 },
        };
      },
      '/accessors/0',
    ],
    [
      'sparse indices that do not grow',
      (j) =>
        (j['accessors'][0].sparse = {
          count: 2,
          indices: { bufferView: 0, componentType: 5121 },
          values: { bufferView: 0 },
        }),
      '/accessors/0/sparse/indices',
    ],
    ['an unknown component', (j) => (j['accessors'][0].componentType = 5130), '/accessors/0'],
    [
      'floats at an odd byte',
      (j) => {
        j['accessors'][0].count = 2;
        j['accessors'][0].byteOffset = 2;
      },
      '/accessors/0',
    ],
    ['indices of floats', (j) => (j['meshes'][0].primitives[0].indices = 0), '/meshes/0/primitives/0/indices'],
    [
      'positions of one number',
      (j) => (j['meshes'][0].primitives[0].attributes.POSITION = 1),
      '/meshes/0/primitives/0/attributes/POSITION',
    ],
    [
      'an accessor that does not exist',
      (j) => (j['meshes'][0].primitives[0].attributes.NORMAL = 9),
      '/meshes/0/primitives/0/attributes/NORMAL',
    ],
    [
      'a material that does not exist',
      (j) => (j['meshes'][0].primitives[0].material = 0),
      '/meshes/0/primitives/0/material',
    ],
    ['a mesh that does not exist', (j) => (j['nodes'][0].mesh = 1), '/nodes/0/mesh'],
    ['a node below itself', (j) => (j['nodes'][0].children = [0]), '/nodes/0'],
    [
      'a circle of nodes',
      (j) => {
        j['nodes'].push({ children: [2] }, { children: [1] });
      },
      '/nodes/2',
    ],
    [
      'a node with two parents',
      (j) => {
        j['nodes'].push({ children: [3] }, { children: [3] }, {});
      },
      '/nodes/2/children/0',
    ],
    [
      'a scene of a node that is no root',
      (j) => {
        j['nodes'].push({ children: [0] });
      },
      '/scenes/0/nodes/0',
    ],
    ['a matrix of 15 numbers', (j) => (j['nodes'][0].matrix = new Array(15).fill(1)), '/nodes/0/matrix'],
    ['a skin without joints', (j) => (j['skins'] = [{ joints: [] }]), '/skins/0/joints'],
  ])('%s', async (_, spoil, path) => {
    const error = await outcome(spoiled(spoil));
    expect([error.code, error.location?.path]).toEqual(['gltf/malformed', path]);
    expect(error.message).toContain(path);
    expect(error.message).not.toMatch(/\n/);
  });
});

describe('extensions that the document requires', () => {
  const requiring = (name: string) =>
    spoiled((j) => {
      j['extensionsUsed'] = [name];
      j['extensionsRequired'] = [name];
    });

  test('an unknown one is refused', async () => {
    const error = await outcome(requiring('VENDOR_everything_else'));
    expect([error.code, error.message]).toEqual([
      'gltf/unsupported-extension',
      expect.stringContaining('VENDOR_everything_else'),
    ]);
  });

  test.each([
    ['KHR_draco_mesh_compression', 'draco3dgltf'],
    ['EXT_meshopt_compression', 'meshoptimizer'],
  ])('%s without its decoder names the package', async (name, module) => {
    const error = await outcome(requiring(name));
    expect([error.code, error.message]).toEqual(['gltf/missing-decoder', expect.stringContaining(`"${module}"`)]);
  });

  test('one that only adds to a material is left out with a warning', async () => {
    const { warnings, instances } = await loadGltf(requiring('KHR_materials_coat'));
    expect([instances.length, warnings.map(({ code }) => code)]).toEqual([1, ['gltf/ignored-extension']]);
  });
});

test('names from the file cannot break a message into lines or hide it', async () => {
  const error = await outcome(
    spoiled((j) => {
      j['buffers'][0].uri = `a\nb\u2028${'x'.repeat(5000)}`;
    }),
  );
  expect(error.message).toMatch(/"a b x/);
  expect(error.message.length).toBeLessThan(600);
  const { warnings } = await loadGltf(
    spoiled((j) => {
      j['meshes'][0] = {
        name: 'two\nlines',
        primitives: [j['meshes'][0].primitives[0], { ...j['meshes'][0].primitives[0], mode: 1 }],
      };
    }),
  );
  expect(warnings.map(({ message }) => message)).toEqual(['two lines 1: points and lines are left out.']);
});

test('animations are not looked into: a broken one costs nothing', async () => {
  const scene = await loadGltf(
    spoiled((j) => {
      j['animations'] = [{ channels: [{ sampler: 9, target: { path: '__proto__' } }], samplers: [] }];
    }),
  );
  expect(scene.instances.length).toBe(1);
});

test('keys such as __proto__ reach no object', async () => {
  const { json, binary } = triangle();
  const spoilt = JSON.stringify(json).replace(
    '"asset":{',
    '"__proto__":{"polluted":1},"asset":{"__proto__":{"polluted":1},',
  );
  await loadGltf(glb(spoilt, binary));
  expect(({} as { polluted?: unknown }).polluted).toBeUndefined();
});
