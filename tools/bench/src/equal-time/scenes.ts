import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { decodeHdr } from '@glanz/image';
import { createPushButton } from '@glanz/models';
import { sceneToGlb } from '@glanz/models/gltf';
import { GROUND_TRUTH_CASES, GroundTruth, referenceFolder } from '@glanz/reference';
import { frameCamera, type Environment, type PerspectiveCamera } from '@glanz/scene';
import { studioEnvironment } from '@glanz/scene/studio';
import { BenchError } from '../error';
import { assetFile, decodePixels, loadGltfBytes, usePackedReferences } from './load';
import type { Task } from './contestant';
import type { Reference } from './images';

/** A scene to compare on, with where its truth comes from. */
export interface EqualTimeScene {
  readonly name: string;
  readonly title: string;
  /** `references`: another renderer's, known to be right. `own`: a long render of Glanz, checked against itself. */
  readonly truth: 'references' | 'own';
  load(size: number): Promise<{ readonly task: Task; readonly reference?: Reference }>;
}

type FileBytes = Uint8Array<ArrayBuffer>;
const bytesOf = (file: string): FileBytes => new Uint8Array(readFileSync(file));

/** The images of the reference set are this wide and high. */
export const CATALOGUE_SIZE = 128;

function groundTruth(name: string, title: string): EqualTimeScene {
  return {
    name,
    title,
    truth: 'references',
    async load(size) {
      usePackedReferences();
      if (!referenceFolder())
        throw new BenchError(
          'bench/missing-data',
          `${name} needs the reference set: set GLANZ_GROUNDTRUTH to its folder "scenes".`,
        );
      const truth = new GroundTruth(name);
      const scene = await truth.scene({ decodeImage: (bytes) => decodePixels(bytes) });
      const { mean, standardError } = truth.image();
      const { width, height } = truth.description.film;
      return {
        task: {
          glb: bytesOf(join(truth.folder, 'scene.glb')),
          camera: scene.cameras[0] as PerspectiveCamera,
          ...(scene.environment ? { environment: scene.environment } : {}),
          width: size,
          height: size,
          maxDepth: truth.maxDepth(),
          // The reference set's metals are single scattering.
          multipleScattering: false,
        },
        reference: { width, height, mean, standardError },
      };
    },
  };
}

/** Bounces beyond this change nothing that can be seen in the product scenes. */
const PRODUCT_DEPTH = 12;

const pushButton: EqualTimeScene = {
  name: 'push_button',
  title: 'push-button, 107 k triangles, in a studio',
  truth: 'own',
  async load(size) {
    const scene = createPushButton({ level: 'medium' });
    return {
      task: {
        glb: await sceneToGlb(scene),
        camera: scene.cameras[0] as PerspectiveCamera,
        environment: studioEnvironment(),
        width: size,
        height: size,
        maxDepth: PRODUCT_DEPTH,
        multipleScattering: true,
      },
    };
  },
};

/** Model and environment of the second product scene, below the folder of sample assets. */
export const HELMET_FILES = {
  model: 'DamagedHelmet/DamagedHelmet.glb',
  environment: 'env/royal_esplanade_256.hdr',
} as const;

const helmet: EqualTimeScene = {
  name: 'damaged_helmet',
  title: 'DamagedHelmet with its textures, in a photographed hall',
  truth: 'own',
  async load(size) {
    const [model, light] = [assetFile(HELMET_FILES.model), assetFile(HELMET_FILES.environment)];
    if (!model || !light)
      throw new BenchError(
        'bench/missing-data',
        `damaged_helmet needs ${HELMET_FILES.model} and ${HELMET_FILES.environment}: set GLANZ_ASSETS to the folder that holds them.`,
      );
    const glb = bytesOf(model);
    const { width, height, data } = decodeHdr(bytesOf(light));
    const environment: Environment = { type: 'latlong', width, height, data };
    return {
      task: {
        glb,
        camera: frameCamera(await loadGltfBytes(glb), { aspect: 1 }),
        environment,
        width: size,
        height: size,
        maxDepth: PRODUCT_DEPTH,
        multipleScattering: true,
      },
    };
  },
};

/**
 * What both renderers can show. Of the ground truth are left out: `metals_f82` and media (glTF cannot say them),
 * furnaces (one light from everywhere: no noise to speak of), and what Glanz does not render yet.
 */
export const SCENES: readonly EqualTimeScene[] = [
  ...[
    groundTruth('cornell_diffuse', 'Cornell box, diffuse, one area light'),
    groundTruth('cornell_spheres', 'Cornell box with a golden and a glass ball'),
    groundTruth('veach_mis', 'glossy plates under lights of four sizes'),
    groundTruth('env_sun', 'sky with a small sun'),
    groundTruth('env_soft', 'soft sky, glass ball'),
    groundTruth('glass_caustic', 'caustic of a glass ball'),
    groundTruth('textured', 'textures, nodes, transparency under even light'),
    groundTruth('dof', 'thin lens, small bright emitters'),
    groundTruth('punctual', 'point and directional light into a box'),
  ].filter(({ name }) => GROUND_TRUTH_CASES.some(({ scene }) => scene === name)),
  pushButton,
  helmet,
];
