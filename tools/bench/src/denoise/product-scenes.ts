import { existsSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { gunzipSync } from 'node:zlib';
import { loadGltf } from '@glanz/gltf';
import { decodeHdr } from '@glanz/image';
import { createPushButton } from '@glanz/models';
import { frameCamera, type Camera, type Environment, type Scene } from '@glanz/scene';
import { studioEnvironment } from '@glanz/scene/studio';
import { assetFile, decodePixels, packedFolder } from '../equal-time/load';
import { BenchError } from '../error';

/** Name of the folder beside a packed bundle that holds models and environment. */
export const PRODUCT_DATA = 'product-data';
/** Longest edge of textures, texels. */
export const PRODUCT_TEXELS = 512;
/** The environment of the models that mirror or refract much. */
export const HALL = 'env/royal_esplanade_256.hdr';

/** A model that `products` wants besides. */
export const GLASS_TABLE = 'glass-table/glass-table.glb';

/** Models of the sample assets, and what lights them. */
export const PRODUCT_MODELS = {
  helmet: { file: 'DamagedHelmet/DamagedHelmet.glb', light: 'hall' },
  sofa: { file: 'GlamVelvetSofa/GlamVelvetSofa.glb', light: 'studio' },
  'candle holder': { file: 'GlassHurricaneCandleHolder/GlassHurricaneCandleHolder.glb', light: 'hall' },
  vase: { file: 'GlassVaseFlowers/GlassVaseFlowers.glb', light: 'studio' },
  'broken window': { file: 'GlassBrokenWindow/GlassBrokenWindow.glb', light: 'hall' },
  sunglasses: { file: 'SunglassesKhronos/SunglassesKhronos.glb', light: 'hall' },
  engine: { file: '2CylinderEngine/2CylinderEngine.glb', light: 'studio' },
  mixer: { file: 'Mixer/Mixer.glb', light: 'studio' },
} as const;

/** A scene with the camera that frames it. */
export interface ProductScene {
  readonly scene: Scene;
  readonly camera: Camera;
}

/**
 * A file of the products: from the packed data, or from the sample assets.
 *
 * @throws {BenchError} `bench/missing-data` where it is in neither.
 */
export function productFile(path: string): Uint8Array<ArrayBuffer> {
  const packed = packedFolder(PRODUCT_DATA);
  const file = packed ? join(packed, path) : assetFile(path);
  if (packed && existsSync(`${file}.gz`)) return new Uint8Array(gunzipSync(readFileSync(`${file}.gz`)));
  if (!file)
    throw new BenchError('bench/missing-data', `${path} is missing: set GLANZ_ASSETS to the folder that holds it.`);
  return new Uint8Array(readFileSync(file));
}

/** The photographed hall. */
export function hall(): Environment {
  const { width, height, data } = decodeHdr(productFile(HALL));
  return { type: 'latlong', width, height, data };
}

function pushButton(sun: boolean, aspect: number): ProductScene {
  const scene = createPushButton({ level: 'medium' });
  if (sun) {
    scene.environment = { type: 'constant', radiance: [0.6, 0.7, 0.9] };
    scene.lights.push({
      type: 'directional',
      name: 'sun',
      color: [1, 0.95, 0.85],
      intensity: 3,
      direction: [-0.48, -0.8, -0.36],
    });
  } else scene.environment = studioEnvironment();
  return { scene, camera: frameCamera(scene, { aspect }) };
}

async function model(name: keyof typeof PRODUCT_MODELS, aspect: number): Promise<ProductScene> {
  const { file, light } = PRODUCT_MODELS[name];
  const scene = await loadGltf(productFile(file), {
    decodeImage: (bytes) => decodePixels(bytes, { folder: packedFolder(PRODUCT_DATA), largest: PRODUCT_TEXELS }),
  });
  scene.environment = light === 'hall' ? hall() : studioEnvironment();
  return { scene, camera: frameCamera(scene, { aspect }) };
}

/** Ten products, by name: how each is loaded for an image of some width over height. */
export const PRODUCT_SCENES: Readonly<Record<string, (aspect: number) => Promise<ProductScene>>> = {
  'push-button, studio': (aspect) => Promise.resolve(pushButton(false, aspect)),
  'push-button, sun': (aspect) => Promise.resolve(pushButton(true, aspect)),
  ...Object.fromEntries(
    Object.keys(PRODUCT_MODELS).map((name) => [
      name,
      (aspect: number) => model(name as keyof typeof PRODUCT_MODELS, aspect),
    ]),
  ),
};
