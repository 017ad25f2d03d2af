// Malicious files: small, valid or nearly so, and made to take much time or memory. What would take the
// square of a file's size does not come back within the test's time.
import { describe, expect, test } from 'vitest';
import { validateScene } from '@glanz/scene';
import { GltfError, loadGltf, type LoadGltfOptions } from '../src/index';
import { decodeImage, packagedDecoders } from '../src/node';
import { glb, triangle, type TriangleJson } from './build';

const decoders = packagedDecoders();
const load = (bytes: Uint8Array<ArrayBuffer>, options: LoadGltfOptions = {}) =>
  loadGltf(bytes, { decodeImage, decoders, ...options });
const text = (json: string) => new TextEncoder().encode(json);
const deep = (levels: number) => '['.repeat(levels) + ']'.repeat(levels);
const many = <T>(count: number, make: (index: number) => T): T[] =>
  Array.from({ length: count }, (_, index) => make(index));

function spoiled(change: (json: TriangleJson) => void): Uint8Array<ArrayBuffer> {
  const { json, binary } = triangle();
  change(json);
  return glb(json, binary);
}

/** Everything in the scene, which nodes name at its top. */
const place = (json: TriangleJson, nodes: object[]) => {
  json['nodes'] = nodes;
  json['scenes'][0].nodes = nodes.map((_, index) => index);
};

describe('JSON that lies two hundred thousand levels deep', { timeout: 60_000 }, () => {
  test.each([
    ['where a name should be', `"materials":[{"alphaMode":${deep(200_000)}}]`, 'gltf/material'],
    [
      'in a light',
      `"extensionsUsed":["KHR_lights_punctual"],"extensions":{"KHR_lights_punctual":{"lights":[{"type":"point","color":${deep(200_000)}}]}}`,
      'gltf/light',
    ],
    ['in extras, which would go to the host', `"materials":[{"extras":${deep(200_000)}}]`, 'gltf/material'],
    [
      "in a light's place",
      `"extensionsUsed":["KHR_lights_punctual"],"extensions":{"KHR_lights_punctual":${deep(200_000)}}`,
      'gltf/light',
    ],
    [
      'in a variant',
      `"extensionsUsed":["KHR_materials_variants"],"extensions":{"KHR_materials_variants":{"variants":[${deep(200_000)}]}}`,
      'gltf/variant',
    ],
    [
      'in environments',
      `"extensionsUsed":["EXT_lights_image_based"],"extensions":{"EXT_lights_image_based":{"lights":[{"specularImages":${deep(200_000)}}]}}`,
      'gltf/environment',
    ],
  ])('%s', async (_, part, code) => {
    const scene = await load(text(`{"asset":{"version":"2.0"},${part}}`), { allowEmpty: true });
    expect(scene.warnings).toEqual([expect.objectContaining({ code })]);
    // A worker could not send it otherwise.
    expect(structuredClone(scene)).toEqual(scene);
  });

  test.each([
    ['where the version should be', `{"asset":{"version":${deep(200_000)}}}`, 'gltf/version'],
    ['in a matrix', `{"asset":{"version":"2.0"},"nodes":[{"matrix":${deep(200_000)}}]}`, 'gltf/malformed'],
    ['in a list of names', `{"asset":{"version":"2.0"},"extensionsUsed":${deep(200_000)}}`, 'gltf/malformed'],
    ['and nothing else', deep(200_000), 'gltf/not-gltf'],
  ])('%s', async (_, json, code) => {
    await expect(load(text(json), { allowEmpty: true })).rejects.toMatchObject({ code });
  });
});

describe('lists that multiply', { timeout: 60_000 }, () => {
  const N = 30_000;
  const cases: Record<string, (json: TriangleJson) => void> = {
    'textures of each material': (json) => {
      json['textures'] = many(N, () => ({}));
      json['materials'] = many(N, () => ({ normalTexture: { index: 0 } }));
    },
    'views of each image': (json) => {
      json['images'] = many(N, () => ({ bufferView: 0, mimeType: 'image/png' }));
      json['bufferViews'].push(...many(N, () => ({ buffer: 0, byteLength: 4 })));
    },
    'channels of each node': (json) => {
      place(json, [{ mesh: 0 }, ...many(N, () => ({}))]);
      json['accessors'].push({ bufferView: 0, componentType: 5126, type: 'SCALAR', count: 3 });
      json['animations'] = [
        {
          samplers: [{ input: 2, output: 0 }],
          channels: many(N, (node) => ({ sampler: 0, target: { node, path: 'translation' } })),
        },
      ];
    },
    'pointers at each material': (json) => {
      json['materials'] = many(N, () => ({}));
      json['accessors'].push({ bufferView: 0, componentType: 5126, type: 'SCALAR', count: 3 });
      json['animations'] = [
        {
          samplers: [{ input: 2, output: 2 }],
          channels: many(N, (i) => ({
            sampler: 0,
            target: {
              path: 'pointer',
              extensions: { KHR_animation_pointer: { pointer: `/materials/${i}/alphaCutoff` } },
            },
          })),
        },
      ];
    },
    'variants of a mesh in each place': (json) => {
      json['extensions'] = { KHR_materials_variants: { variants: many(N, () => ({ name: 'v' })) } };
      json['materials'] = [{}];
      json['meshes'][0].primitives[0].extensions = {
        KHR_materials_variants: { mappings: [{ material: 0, variants: many(N, (i) => i) }] },
      };
      place(
        json,
        many(N, () => ({ mesh: 0 })),
      );
    },
    'joints of a skin in each place': (json) => {
      place(
        json,
        many(N, () => ({ mesh: 0, skin: 0 })),
      );
      json['skins'] = [{ joints: many(N, (i) => i) }];
      json['accessors'].push(
        { bufferView: 0, componentType: 5121, type: 'VEC4', count: 3 },
        { bufferView: 0, componentType: 5121, type: 'VEC4', count: 3, normalized: true },
      );
      Object.assign(json['meshes'][0].primitives[0].attributes, { JOINTS_0: 2, WEIGHTS_0: 3 });
    },
    'morph targets of a mesh in each place': (json) => {
      json['meshes'][0].weights = many(N, () => 1e-9);
      json['meshes'][0].primitives[0].targets = many(N, () => ({ POSITION: 0 }));
      place(
        json,
        many(N, () => ({ mesh: 0 })),
      );
    },
    'scenes of the same nodes': (json) => void (json['scenes'] = many(N, () => ({ nodes: [0] }))),
    'a chain of nodes': (json) => {
      json['nodes'] = many(4 * N, (i) => (i < 4 * N - 1 ? { children: [i + 1] } : { mesh: 0 }));
      json['scenes'][0].nodes = [0];
    },
  };
  test.each(Object.keys(cases))('%s', async (name) => {
    const scene = await load(spoiled(cases[name]!), { time: 0 });
    validateScene(scene);
    expect(scene.instances.length).toBeGreaterThan(0);
  });

  test('primitives that say the same are one mesh', async () => {
    const scene = await load(
      spoiled(
        (json) => void (json['meshes'][0].primitives = many(N, () => ({ attributes: { POSITION: 0 }, indices: 1 }))),
      ),
    );
    expect([scene.meshes.length, scene.instances.length]).toEqual([1, N]);
  });

  test('warnings are listed up to a thousand, and how many there are more', async () => {
    const { warnings } = await load(spoiled((json) => void (json['materials'] = many(5000, () => ({ alphaMode: 1 })))));
    expect(warnings.length).toBe(1001);
    expect(warnings.at(-1)).toEqual({ code: 'gltf/more-warnings', message: expect.stringContaining('4000 more') });
    expect(Object.getPrototypeOf(warnings)).toBe(Array.prototype);
  });
});

describe('sizes that lie', () => {
  test(
    'many combinations of a few accessors are refused before they fill the memory',
    { timeout: 60_000 },
    async () => {
      // 300 × 300 pairs of positions and indices over the same 1.2 MB: 100 GB if each were made.
      const count = 100_000;
      const bytes = new Uint8Array(12 * count + 4 * count);
      const { json } = triangle();
      json['buffers'][0].byteLength = bytes.length;
      json['bufferViews'] = [
        { buffer: 0, byteLength: 12 * count },
        { buffer: 0, byteOffset: 12 * count, byteLength: 4 * count },
      ];
      json['accessors'] = [
        ...many(300, () => ({ bufferView: 0, componentType: 5126, type: 'VEC3', count })),
        ...many(300, () => ({ bufferView: 1, componentType: 5125, type: 'SCALAR', count: 99_999 })),
      ];
      json['meshes'][0].primitives = many(90_000, (i) => ({
        attributes: { POSITION: i % 300 },
        indices: 300 + Math.floor(i / 300),
      }));
      await expect(load(glb(json, bytes))).rejects.toMatchObject({ code: 'gltf/too-large' });
    },
  );

  test('instances out of nothing', async () => {
    const bytes = spoiled((json) => {
      json['accessors'].push({ componentType: 5126, type: 'VEC3', count: 4_000_000 });
      json['nodes'][0].extensions = { EXT_mesh_gpu_instancing: { attributes: { TRANSLATION: 2 } } };
    });
    await expect(load(bytes)).rejects.toMatchObject({ code: 'gltf/too-large' });
  });

  /** The triangle with an image. */
  const withImage = (image: Uint8Array, type: string) =>
    spoiled((json) => {
      json['images'] = [{ uri: `data:${type};base64,${Buffer.from(image).toString('base64')}` }];
      json['textures'] = [{ source: 0 }];
      json['materials'] = [{ pbrMetallicRoughness: { baseColorTexture: { index: 0 } } }];
      json['meshes'][0].primitives[0].material = 0;
    });
  const png = (width: number, height: number) => {
    const head = Buffer.alloc(60);
    head.set([0x89, 0x50, 0x4e, 0x47, 13, 10, 26, 10, 0, 0, 0, 13, 0x49, 0x48, 0x44, 0x52]);
    head.writeUInt32BE(width, 16);
    head.writeUInt32BE(height, 20);
    head.set([8, 6], 24);
    return head;
  };
  const jpeg = (width: number, height: number) =>
    Uint8Array.of(
      0xff,
      0xd8,
      0xff,
      0xc0,
      0,
      17,
      8,
      height >> 8,
      height & 255,
      width >> 8,
      width & 255,
      3,
      1,
      0x11,
      0,
      2,
      0x11,
      0,
      3,
      0x11,
      0,
      0xff,
      0xda,
      0,
      2,
      0,
      0,
      0,
      0,
      0,
      0,
      0,
      0,
      0,
      0,
      0,
      0,
    );
  const webp = (width: number, height: number) => {
    const head = Buffer.alloc(40);
    head.write('RIFF', 0, 'latin1');
    head.write('WEBPVP8X', 8, 'latin1');
    head.writeUIntLE(width - 1, 24, 3);
    head.writeUIntLE(height - 1, 27, 3);
    return head;
  };

  test('a PNG whose bytes cannot hold its pixels is left out, and no decoder hears of it', async () => {
    let asked = 0;
    const scene = await load(withImage(png(20_000, 20_000), 'image/png'), {
      decodeImage: (...given) => (asked++, decodeImage(...given)),
    });
    expect(scene.warnings).toEqual([
      expect.objectContaining({ code: 'gltf/image', message: expect.stringContaining('20000 × 20000') }),
    ]);
    expect(asked).toBe(0);
  });

  test.each([
    ['JPEG', jpeg(60_000, 60_000), 'image/jpeg'],
    ['WebP', webp(40_000, 40_000), 'image/webp'],
  ] as const)('a %s of gigabytes is refused before a decoder sees it', async (_, image, type) => {
    let asked = 0;
    await expect(
      load(withImage(image, type), { decodeImage: (...given) => (asked++, decodeImage(...given)) }),
    ).rejects.toMatchObject({ code: 'gltf/too-large', location: { path: '/images/0' } });
    expect(asked).toBe(0);
  });
});

describe('addresses', () => {
  const uris = [
    '..%2f..%2fetc%2fpasswd',
    '%2e%2e/secret',
    'C:\\secret.bin',
    '\\\\server\\share',
    '//server/share',
    'file:///etc/passwd',
    'blob:null/x',
    'javascript:alert(1)',
    'a%00b',
    'x/../../secret',
    './../secret',
    '%E0%A4%A',
    '\ud800',
    'x'.repeat(1_000_000),
    'data:',
    'DATA:;BASE64,====',
    'data:application/octet-stream;base64,%%%%',
  ];
  test.each(uris)('%.60s', async (uri) => {
    const asked: string[] = [];
    const fetch = (async (url: URL) => (
      asked.push(url.href),
      new Response(null, { status: 404 })
    )) as unknown as typeof globalThis.fetch;
    const error = await load(
      spoiled((json) => void (json['buffers'][0].uri = uri)),
      { baseUrl: 'https://example.org/models/', fetch },
    ).catch((thrown: unknown) => thrown);
    expect(error).toBeInstanceOf(GltfError);
    expect((error as Error).message.length).toBeLessThan(700);
    for (const href of asked) expect(href.startsWith('https://example.org/models/')).toBe(true);
  });

  test('data: uris may escape any byte, and need not be base64', async () => {
    const { binary } = triangle();
    const scene = await load(
      spoiled(
        (json) =>
          void (json['buffers'][0].uri =
            `data:application/octet-stream,${[...binary].map((byte) => `%${byte.toString(16).padStart(2, '0')}`).join('')}`),
      ),
    );
    expect([...scene.meshes[0]!.positions]).toEqual([0, 0, 0, 1, 0, 0, 0, 1, 0]);
  });
});

test('numbers beyond all bounds become finite ones', async () => {
  const scene = await load(
    text(
      '{"asset":{"version":"2.0"},"materials":[{"alphaMode":"MASK","alphaCutoff":1e999,"emissiveFactor":[1e999,0,-1e999]}],"nodes":[{"translation":[1e308,1e308,1e308],"scale":[1e308,1,1],"camera":0}],"cameras":[{"type":"perspective","perspective":{"yfov":1e999,"znear":1e-999}}]}',
    ),
    { allowEmpty: true },
  );
  expect(JSON.stringify(scene.materials)).not.toMatch(/null/);
  expect(scene.cameras).toEqual([]);
});
