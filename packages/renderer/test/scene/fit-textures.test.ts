import { SceneError, type Image, type Scene, type Texture } from '@glanz/scene';
import { expect, it } from 'vitest';
import { RenderError } from '../../src/errors';
import { fitTextures, type FittedTextures } from '../../src/scene/fit-textures';
import { addQuad, camera, createScene } from '../scenes';

const image = (name: string, size: number): Image => ({
  name,
  width: size,
  height: size,
  data: new Uint8Array(4 * size * size),
});

/** Fits two textures of one image, in both colour spaces, and another image. */
async function fitted(budget: number) {
  const scene = createScene();
  const texture = (of: number, color_space: Texture['color_space']): Texture => ({ image: of, color_space });
  scene.images = [image('shared', 64), image('other', 8)];
  scene.textures = [texture(0, 'srgb'), texture(0, 'linear'), texture(1, 'srgb')];
  addQuad(scene, 0.5, 0, { name: 'none', parameters: {} });
  const fit: FittedTextures = {
    source: {
      device: { limits: { maxTextureDimension2D: 8192 } } as GPUDevice,
      scene,
      camera,
      options: { height: 100, textureLodBias: 0 },
      layout: () => {
        throw new SceneError('test', 'not used');
      },
      signal: new AbortController().signal,
    },
    sizes: undefined,
    reduced: new Map(),
    fullBytes: undefined,
    warning: undefined,
  };
  const bytesOf = ({ images, textures }: Scene) => {
    const shown = new Set(textures.map(({ image: of, color_space }) => `${of} ${color_space}`));
    return [...shown].reduce((sum, key) => {
      const { width, height } = images[parseInt(key)]!;
      return sum + Math.ceil((width * height * 16) / 3);
    }, 0);
  };
  await fitTextures(fit, budget, [bytesOf, () => new Set([0, 1, 2]), () => [], RenderError]);
  return { scene, fit };
}

it('an image that is reduced in both colour spaces is not kept at its full size', async () => {
  const { scene, fit } = await fitted(16_000);
  expect(scene.images.map(({ name, width }) => [name, width])).toEqual([
    ['shared', 32],
    ['other', 8],
    ['shared', 32],
  ]);
  expect(scene.textures.map(({ image: of }) => of)).toEqual([0, 2, 1]);
  expect([...fit.reduced].map(([slot, { image: of, level }]) => [slot, of, level])).toEqual([
    [0, 0, 1],
    [2, 0, 1],
  ]);
});

it('an image that keeps its levels in one colour space keeps its place', async () => {
  const { scene, fit } = await fitted(30_000);
  expect(scene.images.map(({ name, width }) => [name, width])).toEqual([
    ['shared', 64],
    ['other', 8],
    ['shared', 32],
  ]);
  expect([...fit.reduced.keys()]).toEqual([2]);
});
