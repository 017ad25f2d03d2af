import { expect, test } from 'vitest';
import { loadGltf } from '../src/index';
import { triangle, type TriangleJson } from './build';

const PNG = Buffer.from([0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a]);
const JPEG = Buffer.from([0xff, 0xd8, 0xff, 0xe0, 0, 0, 0, 0]);
const uri = (type: string, bytes: Buffer) => `data:${type};base64,${bytes.toString('base64')}`;
const decodeImage = async () => ({ width: 1, height: 1, data: new Uint8Array([1, 2, 3, 255]) });

/** Warnings of a triangle with some images. Files beside it are never there: reading one would reject. */
async function warningsOf(change: (json: TriangleJson) => void): Promise<(readonly [string | undefined, string])[]> {
  const { json, binary } = triangle();
  json['buffers'][0].uri = uri('application/octet-stream', Buffer.from(binary));
  change(json);
  const { warnings } = await loadGltf(new TextEncoder().encode(JSON.stringify(json)), { decodeImage });
  return warnings.map(({ path, message }) => [path, message]);
}

/** The first image as the base colour. */
const shown = (json: TriangleJson) => {
  json['textures'] = [{ source: 0 }];
  json['materials'] = [{ pbrMetallicRoughness: { baseColorTexture: { index: 0 } } }];
  json['meshes'][0].primitives[0].material = 0;
};

test('a file that no texture uses is not read, and that is reported', async () => {
  expect(await warningsOf((json) => (json['images'] = [{ uri: 'not-there.png' }]))).toEqual([
    ['/images/0', expect.stringMatching(/names the file "not-there\.png", but no texture uses it; it is not read\.$/)],
  ]);
});

test('a file that a texture uses which no material shows is none of it', async () => {
  expect(
    await warningsOf((json) => {
      json['images'] = [{ uri: 'not-there.png' }];
      json['textures'] = [{ source: 0 }];
    }),
  ).toEqual([]);
});

test.each([
  [
    'that nothing shows',
    (): void => undefined,
    /is declared as image\/png, but its bytes are image\/jpeg; no material uses it\.$/,
  ],
  [
    'that a material shows',
    shown,
    /is declared as image\/png, but its bytes are image\/jpeg; it is read as image\/jpeg\.$/,
  ],
] as const)('a data: uri of the wrong type in an image %s', async (_, change, message) => {
  expect(
    await warningsOf((json) => {
      json['images'] = [{ uri: uri('image/png', JPEG) }];
      change(json);
    }),
  ).toEqual([['/images/0', expect.stringMatching(message)]]);
  expect(
    await warningsOf((json) => {
      json['images'] = [{ uri: uri('image/jpeg', JPEG) }];
      change(json);
    }),
  ).toEqual([]);
});

test('a mimeType that the bytes of a buffer view contradict', async () => {
  const inView = (mimeType: string) => (json: TriangleJson) => {
    json['buffers'].push({ byteLength: PNG.length, uri: uri('application/gltf-buffer', PNG) });
    json['bufferViews'].push({ buffer: 1, byteLength: PNG.length });
    json['images'] = [{ bufferView: 2, mimeType }];
    shown(json);
  };
  expect(await warningsOf(inView('image/jpeg'))).toEqual([
    ['/images/0', expect.stringMatching(/is declared as image\/jpeg, but its bytes are image\/png/)],
  ]);
  expect(await warningsOf(inView('image/png'))).toEqual([]);
});

test('bytes of no image that nothing shows', async () => {
  expect(await warningsOf((json) => (json['images'] = [{ uri: uri('image/png', Buffer.from('GIF89a')) }]))).toEqual([
    ['/images/0', expect.stringMatching(/cannot be decoded: it is not a PNG, JPEG/)],
  ]);
});
