import { createCornellBox } from '@glanz/models';
import { GALLERY_MODELS } from '@glanz/models/gallery';
import { sceneToGlb } from '@glanz/models/gltf';
import { PRODUCT_DATA, PRODUCT_MODELS, PRODUCT_SCENES, PRODUCT_TEXELS, productFile } from '../denoise/product-scenes';
import type { ProductScene } from '../denoise/product-scenes';
import { packedFolder } from '../equal-time/load';
import type { Task } from '../equal-time/contestant';
import { fitCamera } from '../products/scenes';
import type { PerspectiveCamera } from '@glanz/scene';

/** A scene that is rendered from frame to frame. */
export interface MotionScene {
  /** @throws {BenchError} `bench/missing-data` where its file is absent. */
  load(aspect: number): Promise<ProductScene>;
  /** The same as a file, for other renderers. */
  file(product: ProductScene): Promise<Pick<Task, 'glb' | 'textures'>>;
}

const written = async ({ scene }: ProductScene) => ({ glb: await sceneToGlb(scene) });

const model = (name: 'helmet' | 'vase'): MotionScene => ({
  load: PRODUCT_SCENES[name]!,
  file: () =>
    Promise.resolve({
      glb: productFile(PRODUCT_MODELS[name].file),
      textures: { folder: packedFolder(PRODUCT_DATA), largest: PRODUCT_TEXELS },
    }),
});

/** What moves, by name. */
export const MOTION_SCENES: Readonly<Record<string, MotionScene>> = {
  'push-button': { load: PRODUCT_SCENES['push-button, studio']!, file: written },
  helmet: model('helmet'),
  vase: model('vase'),
  room: {
    load: () => {
      const scene = createCornellBox();
      return Promise.resolve({ scene, camera: scene.cameras[0]! });
    },
    file: written,
  },
  // A room at night with 74 lights.
  night: {
    load: (aspect) => {
      const scene = GALLERY_MODELS['lamps']!();
      return Promise.resolve({ scene, camera: fitCamera(scene.cameras[0] as PerspectiveCamera, aspect) });
    },
    file: written,
  },
};
