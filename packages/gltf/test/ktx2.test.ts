import { existsSync, readFileSync } from 'node:fs';
import { GlanzError } from '@glanz/scene';
import { describe, expect, test } from 'vitest';
import { GltfError, ktx2Decoder, loadGltf } from '../src/index';
import { loadGltfFile } from '../src/node';
import { triangle } from './build';
import { presence, sharedIndex, sharedPath } from './shared';

/** The triangle with a KTX2 image, and a plain one beside it if asked for. */
function withKtx2(image: Uint8Array, { required = false, plain = false } = {}): Map<string, Uint8Array<ArrayBuffer>> {
  const { json, binary } = triangle();
  json['buffers'][0].uri = 'a.bin';
  json['extensionsUsed'] = ['KHR_texture_basisu'];
  if (required) json['extensionsRequired'] = ['KHR_texture_basisu'];
  json['images'] = [{ uri: 'a.ktx2' }, ...(plain ? [{ uri: 'a.png' }] : [])];
  json['textures'] = [{ ...(plain ? { source: 1 } : {}), extensions: { KHR_texture_basisu: { source: 0 } } }];
  json['materials'] = [{ pbrMetallicRoughness: { baseColorTexture: { index: 0 } } }];
  json['meshes'][0].primitives[0].material = 0;
  return new Map([
    ['a.gltf', new TextEncoder().encode(JSON.stringify(json))],
    ['a.bin', binary],
    ['a.ktx2', new Uint8Array(image)],
    ['a.png', Uint8Array.of(0x89, 0x50, 0x4e, 0x47)],
  ]);
}

const HEADER = Uint8Array.of(0xab, 0x4b, 0x54, 0x58, 0x20, 0x32, 0x30, 0xbb, 0x0d, 0x0a, 0x1a, 0x0a);
const decodeImage = async () => ({ width: 1, height: 1, data: new Uint8Array([1, 2, 3, 255]) });

describe('without a decoder', () => {
  test('the plain image is taken where there is one', async () => {
    const scene = await loadGltf({ files: withKtx2(HEADER, { plain: true }) }, { decodeImage });
    expect(scene.images.map(({ data }) => [...data])).toEqual([[1, 2, 3, 255]]);
    expect(scene.warnings).toEqual([]);
  });

  test('a file that has only KTX2 says what to install', async () => {
    await expect(loadGltf({ files: withKtx2(HEADER, { required: true }) }, { decodeImage })).rejects.toMatchObject({
      code: 'gltf/missing-decoder',
      message: expect.stringMatching(/decoders\.ktx2.*"three"/),
    });
  });
});

test('a decoder that does not start is an error, since the file is sound', async () => {
  const ktx2 = async () => {
    throw new GlanzError('element/decoder', 'It does not start.');
  };
  await expect(
    loadGltf({ files: withKtx2(HEADER, { required: true }) }, { decodeImage, decoders: { ktx2 } }),
  ).rejects.toMatchObject({ code: 'element/decoder' });
});

test('an image with a false size in its header is not passed to the transcoder', async () => {
  const decode = ktx2Decoder(() => {
    throw new Error('asked');
  });
  const image = (width: number, height: number) => {
    const bytes = new Uint8Array(200);
    bytes.set(HEADER);
    new DataView(bytes.buffer).setUint32(20, width, true);
    new DataView(bytes.buffer).setUint32(24, height, true);
    return bytes;
  };
  for (const bytes of [HEADER, image(0, 4), image(4, 0), image(65536, 65536), image(16384, 16384)])
    await expect(decode(bytes)).rejects.toMatchObject({ code: 'gltf/ktx2' });
});

const { present, note } = presence('assets/index.json');

test.skipIf(!present)(`a model with four KTX2 images${note}`, async () => {
  const { images, textures, warnings, materials } = await loadGltfFile(
    sharedPath('assets/AnisotropyBarnLamp-KTX2-Basisu/AnisotropyBarnLamp.gltf'),
  );
  expect(warnings).toEqual([]);
  const normal = materials
    .map((material) => material.textures?.geometry_normal)
    .find((binding) => binding !== undefined)!;
  const { width, height, data } = images[textures[normal.texture]!.image]!;
  expect([width, height]).toEqual([2048, 2048]);
  // A map of normals holds vectors of length 1 that point outwards, with every decoder.
  let length = 0,
    up = 0;
  const step = 4 * 97;
  for (let i = 0; i < data.length; i += step) {
    const n = [0, 1, 2].map((k) => data[i + k]! / 127.5 - 1) as [number, number, number];
    length += Math.hypot(...n) / Math.ceil(data.length / step);
    up += (n[2] > 0 ? 1 : 0) / Math.ceil(data.length / step);
    expect(data[i + 3]).toBe(255);
  }
  expect(Math.abs(length - 1)).toBeLessThan(0.05);
  expect(up).toBeGreaterThan(0.99);
});

interface Case {
  readonly file: string;
  readonly cat: string;
  readonly expect: string;
  readonly alsoOk?: readonly string[];
}
const bad = presence('bad/index.json');
const cases = sharedIndex<Case>('bad/index.json').filter(
  ({ file, cat }) => cat === 'ktx2' && file.endsWith('.ktx2') && existsSync(sharedPath(`bad/${file}`)),
);

test.skipIf(!bad.present)(
  `broken KTX2 files are typed errors of the decoder, and a load continues without them${bad.note}`,
  { timeout: 120_000 },
  async () => {
    const { packagedDecoders } = await import('../src/node');
    const { ktx2 } = packagedDecoders();
    const missed: string[] = [];
    for (const { file, expect: expected, alsoOk = [] } of cases) {
      const bytes = new Uint8Array(readFileSync(sharedPath(`bad/${file}`)));
      const outcome = await ktx2!(bytes).then(
        ({ width, height, data }) => {
          expect(data.length).toBe(4 * width * height);
          return 'accept';
        },
        (error: unknown) => {
          if (!(error instanceof GltfError)) throw error;
          return 'reject';
        },
      );
      if (outcome !== expected && !alsoOk.includes(outcome)) missed.push(`${file}: ${outcome} instead of ${expected}`);
    }
    expect(missed).toEqual([]);
    expect(cases.length).toBeGreaterThan(100);
    const scene = await loadGltf({ files: withKtx2(HEADER) }, { decodeImage, decoders: { ktx2 } });
    expect(scene.warnings.map(({ code }) => code)).toEqual(['gltf/image']);
  },
);
