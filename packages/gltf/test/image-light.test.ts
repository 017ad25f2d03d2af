import sharp from 'sharp';
import { describe, expect, test } from 'vitest';
import type { LatLongEnvironment } from '@glanz/scene';
import { loadGltf } from '../src/index';
import { decodeImage } from '../src/node';
import { glb, triangle, type TriangleJson } from './build';

const linear = (code: number) => (code / 255 <= 0.04045 ? code / 255 / 12.92 : ((code / 255 + 0.055) / 1.055) ** 2.4);
const uri = async (width: number, pixels: readonly number[], channels: 3 | 4) =>
  `data:image/png;base64,${(
    await sharp(Uint8Array.from(pixels), { raw: { width, height: width, channels } })
      .png()
      .toBuffer()
  ).toString('base64')}`;

/** The triangle with an environment of six images, a light's other properties as given. */
async function loadWithLight(
  images: readonly string[],
  light: object = {},
  more: (json: TriangleJson) => void = () => undefined,
) {
  const { json, binary } = triangle();
  json['images'] = images.map((image) => ({ uri: image }));
  json['extensions'] = {
    EXT_lights_image_based: {
      lights: [{ specularImages: [[0, 1, 2, 3, 4, 5]], specularImageSize: 2, irradianceCoefficients: [], ...light }],
    },
  };
  json['scenes'][0].extensions = { EXT_lights_image_based: { light: 0 } };
  json['extensionsUsed'] = ['EXT_lights_image_based'];
  more(json);
  return loadGltf(glb(json, binary), { decodeImage });
}

/** Radiance of the environment in a direction, by the definition of lat-long images. */
function seen(environment: LatLongEnvironment, [x, y, z]: readonly [number, number, number]): number[] {
  const { width, height, data, intensity = 1 } = environment;
  const length = Math.hypot(x, y, z);
  const u = Math.atan2(z, x) / (2 * Math.PI) + 0.5,
    v = Math.acos(y / length) / Math.PI;
  const at = 3 * (Math.min(Math.floor(v * height), height - 1) * width + Math.min(Math.floor(u * width), width - 1));
  return [0, 1, 2].map((k) => intensity * data[at + k]!);
}

const plain = (level: number) =>
  Array.from({ length: 6 }, (_, face) => uri(2, Array.from({ length: 4 }, () => [level * (face + 1), 0, 0]).flat(), 3));
const AXES = [
  [1, 0, 0],
  [-1, 0, 0],
  [0, 1, 0],
  [0, -1, 0],
  [0, 0, 1],
  [0, 0, -1],
] as const;

describe('EXT_lights_image_based', () => {
  test('each face lies where it belongs, its intensity multiplies it', async () => {
    const scene = await loadWithLight(await Promise.all(plain(40)), { intensity: 3 });
    expect(scene.warnings).toEqual([]);
    expect(scene.images).toEqual([]);
    AXES.forEach((axis, face) =>
      expect(seen(scene.environment as LatLongEnvironment, axis)[0]).toBeCloseTo(3 * linear(40 * (face + 1)), 5),
    );
  });

  test('faces are upright as seen from within', async () => {
    // Left red, right green in the lower half; the upper half blue.
    const face = await uri(
      16,
      Array.from({ length: 256 }, (_, i) => (i < 128 ? [0, 0, 255] : i % 16 < 8 ? [255, 0, 0] : [0, 255, 0])).flat(),
      3,
    );
    const environment = (await loadWithLight(Array<string>(6).fill(face))).environment as LatLongEnvironment;
    // Looking along each horizontal axis with +Y up, the right points to forward × up.
    for (const [x, , z] of [AXES[0], AXES[1], AXES[4], AXES[5]]) {
      const right = [-z, 0, x] as const;
      const look = (side: number, up: number) =>
        seen(environment, [x + 0.6 * side * right[0], 0.6 * up, z + 0.6 * side * right[2]]);
      expect(look(-1, -1)[0]).toBeGreaterThan(0.9);
      expect(look(1, -1)[1]).toBeGreaterThan(0.9);
      expect(look(1, 1)[2]).toBeGreaterThan(0.9);
    }
  });

  test('alpha divides (RGBD)', async () => {
    const face = await uri(1, [255, 128, 0, 51], 4);
    const [r, g, b] = seen(
      (await loadWithLight(Array<string>(6).fill(face))).environment as LatLongEnvironment,
      [1, 0.2, 0.1],
    );
    expect(r).toBeCloseTo(5, 5);
    expect(g).toBeCloseTo(5 * linear(128), 5);
    expect(b).toBe(0);
  });

  test('the light is turned by its rotation', async () => {
    // A quarter about +Z takes +X to +Y: what was seen along +X is now seen along +Y.
    const scene = await loadWithLight(await Promise.all(plain(40)), { rotation: [0, 0, Math.SQRT1_2, Math.SQRT1_2] });
    expect(seen(scene.environment as LatLongEnvironment, [1e-4, 1, 0])[0]).toBeCloseTo(linear(40), 5);
    expect(seen(scene.environment as LatLongEnvironment, [-1, 0, 0])[0]).toBeCloseTo(linear(40 * 3), 5);
  });

  test.each([
    ['five faces', { specularImages: [[0, 1, 2, 3, 4]] }],
    ['a face that does not exist', { specularImages: [[0, 1, 2, 3, 4, 9]] }],
    ['no images', { specularImages: [] }],
    ['a rotation without length', { rotation: [0, 0, 0, 0] }],
    ['an intensity that is none', { intensity: -1 }],
  ])('%s: no environment, with a warning', async (_, light) => {
    const scene = await loadWithLight(await Promise.all(plain(40)), light);
    expect(scene.environment).toBeUndefined();
    expect(scene.warnings).toEqual([
      expect.objectContaining({ code: 'gltf/environment', path: '/extensions/EXT_lights_image_based/lights/0' }),
    ]);
  });

  test('a broken image, and a light that does not exist', async () => {
    const broken = await loadWithLight([
      ...(await Promise.all(plain(40))).slice(0, 5),
      'data:image/png;base64,iVBORw0KGgo=',
    ]);
    expect(broken.environment).toBeUndefined();
    expect(broken.warnings).toEqual([expect.objectContaining({ code: 'gltf/image', path: '/images/5' })]);
    const none = await loadWithLight(await Promise.all(plain(40)), {}, (json) => {
      json['scenes'][0].extensions.EXT_lights_image_based.light = 3;
    });
    expect(none.environment).toBeUndefined();
    expect(none.warnings).toEqual([
      expect.objectContaining({ code: 'gltf/environment', path: '/scenes/0/extensions/EXT_lights_image_based' }),
    ]);
  });
});
