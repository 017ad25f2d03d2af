import { createPushButton } from '@glanz/models';
import { GALLERY_MODELS } from '@glanz/models/gallery';
import { sceneToGlb } from '@glanz/models/gltf';
import { frameCamera, withVariant, type Environment, type PerspectiveCamera } from '@glanz/scene';
import { studioEnvironment } from '@glanz/scene/studio';
import {
  GLASS_TABLE,
  HALL,
  hall,
  PRODUCT_DATA,
  PRODUCT_MODELS,
  PRODUCT_TEXELS,
  productFile,
} from '../denoise/product-scenes';
import type { Task } from '../equal-time/contestant';
import { loadGltfBytes, packedFolder, type DecodeOptions } from '../equal-time/load';
import { BenchError } from '../error';

/** A product in its light. */
export interface Product {
  readonly name: string;
  readonly title: string;
  /** Why three-gpu-pathtracer cannot show it, where it cannot. */
  readonly notByPeer?: string;
  /** Files of the sample assets that it is made of. */
  readonly files: readonly string[];
  /** @throws {BenchError} `bench/missing-data` where its file is absent. */
  task(width: number, height: number): Promise<Task>;
}

/** Most edges of a path; more where light goes through many interfaces, as in the gallery. */
const DEPTH = { plain: 12, glass: 24 } as const;

/** Width over height that the gallery's cameras are made for. */
const GALLERY_ASPECT = 1.6;

/** The camera in an image of another shape: what it was made to show stays in the image. */
export function fitCamera(camera: PerspectiveCamera, aspect: number, made = GALLERY_ASPECT): PerspectiveCamera {
  const yfov = 2 * Math.atan(Math.tan(camera.yfov / 2) * Math.max(1, made / aspect));
  return { ...camera, aspect, yfov };
}

/** Half the angle of {@link sunEnvironment}'s sun, radians: a little wider than the real one, some texels across. */
const SUN_RADIUS = 0.0175;
/** Towards the sun. */
const SUN = [0.48, 0.8, 0.36] as const;

/** A blue sky with a small sun that gives four times the light of the sky or so. Both renderers take it as a map. */
export function sunEnvironment(): Environment {
  const [width, height] = [1024, 512];
  const data = new Float32Array(3 * width * height);
  const length = Math.hypot(...SUN);
  const radiance = 9 / (Math.PI * SUN_RADIUS ** 2);
  for (let y = 0; y < height; y++) {
    const theta = ((y + 0.5) / height) * Math.PI;
    for (let x = 0; x < width; x++) {
      // u = atan2(z, x)/2π + ½: see LatLongEnvironment.
      const phi = ((x + 0.5) / width - 0.5) * 2 * Math.PI;
      const [u, v, w] = [Math.sin(theta) * Math.cos(phi), Math.cos(theta), Math.sin(theta) * Math.sin(phi)];
      const cosine = (u * SUN[0] + v * SUN[1] + w * SUN[2]) / length;
      const sun = cosine > Math.cos(SUN_RADIUS) ? radiance : 0;
      const sky = theta < Math.PI / 2 ? [0.6, 0.7, 0.9] : [0.2, 0.18, 0.15];
      data.set([sky[0]! + sun, sky[1]! + 0.95 * sun, sky[2]! + 0.85 * sun], 3 * (y * width + x));
    }
  }
  return { type: 'latlong', width, height, data };
}

/** A model of the gallery under its own softboxes or lamps. */
function gallery(
  name: string,
  title: string,
  options: {
    readonly model?: string;
    readonly variant?: string;
    readonly depth?: number;
    readonly notByPeer?: string;
  } = {},
): Product {
  const { model = name, variant, depth = DEPTH.plain, notByPeer } = options;
  return {
    name,
    title,
    files: [],
    ...(notByPeer === undefined ? {} : { notByPeer }),
    async task(width, height) {
      const scene = withVariant(GALLERY_MODELS[model]!(), variant);
      return {
        glb: await sceneToGlb(scene),
        camera: fitCamera(scene.cameras[0] as PerspectiveCamera, width / height),
        width,
        height,
        maxDepth: depth,
        multipleScattering: true,
      };
    },
  };
}

function pushButton(name: string, title: string, light: () => Environment): Product {
  return {
    name,
    title,
    files: [],
    async task(width, height) {
      const scene = createPushButton({ level: 'medium' });
      return {
        glb: await sceneToGlb(scene),
        camera: frameCamera(scene, { aspect: width / height }),
        environment: light(),
        width,
        height,
        maxDepth: DEPTH.plain,
        multipleScattering: true,
      };
    },
  };
}

/** A model of the sample assets, which a checkout need not have. */
function asset(name: string, title: string, file: string, light: () => Environment, depth: number): Product {
  return {
    name,
    title,
    files: light === hall ? [file, HALL] : [file],
    async task(width, height) {
      const glb = productFile(file);
      const textures: DecodeOptions = { folder: packedFolder(PRODUCT_DATA), largest: PRODUCT_TEXELS };
      return {
        glb,
        textures,
        camera: frameCamera(await loadGltfBytes(glb, textures), { aspect: width / height }),
        environment: light(),
        width,
        height,
        maxDepth: depth,
        multipleScattering: true,
      };
    },
  };
}

const SUBSURFACE = 'it has no subsurface scattering';

/** What `products` measures. */
export const PRODUCTS: readonly Product[] = [
  gallery('perfume', 'perfume bottle of thick glass with liquid', { depth: DEPTH.glass }),
  gallery('tumbler', 'tumbler with a drink and ice', { depth: DEPTH.glass }),
  gallery('ring', 'ring with a cut diamond', { depth: DEPTH.glass }),
  gallery('watch', 'steel wristwatch'),
  gallery('speedform', 'body in car paint'),
  gallery('armchair', 'armchair in velvet'),
  gallery('weave', 'cloth, every yarn woven'),
  gallery('mail', 'mail of metal rings'),
  gallery('amplifier', 'amplifier with a brushed front'),
  gallery('room', 'room at night with 74 lights', { model: 'lamps' }),
  gallery('wax', 'burning candles', { model: 'candles', notByPeer: SUBSURFACE }),
  gallery('jade', 'knot of jade', { model: 'knot', notByPeer: SUBSURFACE }),
  pushButton('button', 'push-button in a studio', studioEnvironment),
  pushButton('button-sun', 'push-button under sky and sun', sunEnvironment),
  asset('broken-window', 'GlassBrokenWindow in a hall', PRODUCT_MODELS['broken window'].file, hall, DEPTH.glass),
  asset('vase', 'GlassVaseFlowers in a studio', PRODUCT_MODELS.vase.file, studioEnvironment, DEPTH.glass),
  asset('glass-table', 'glass table in a hall', GLASS_TABLE, hall, DEPTH.glass),
  asset('sofa', 'GlamVelvetSofa in a studio', PRODUCT_MODELS.sofa.file, studioEnvironment, DEPTH.plain),
];

/** The product of a name. @throws {BenchError} `bench/option` where there is none. */
export function productOf(name: string): Product {
  const product = PRODUCTS.find((one) => one.name === name);
  if (!product) throw new BenchError('bench/option', `There is no product "${name}".`);
  return product;
}
