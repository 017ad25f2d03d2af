import type { Camera, Scene } from '@glanz/scene';
import { taskScene } from '../equal-time/glanz';
import { BenchError } from '../error';
import { PRODUCTS } from '../products/scenes';
import { PRODUCT_SCENES } from './product-scenes';

/** Bounces beyond this change nothing that can be seen in {@link PRODUCT_SCENES}. */
const DEPTH = 12;

/** A scene as `denoise-time` renders it. */
export interface TimeScene {
  readonly scene: Scene;
  readonly camera: Camera;
  readonly maxDepth: number;
}

/** What `denoise-time` measures by default: ten products whose films take long to become clean. */
export const TIME_SCENES: readonly string[] = [
  'room',
  'tumbler',
  'ring',
  'perfume',
  'mail',
  'jade',
  'wax',
  'amplifier',
  'button-sun',
  'watch',
];

const KNOWN: readonly string[] = [...PRODUCTS.map(({ name }) => name), ...Object.keys(PRODUCT_SCENES)];

/**
 * Checks names of scenes before any of them is loaded.
 *
 * @throws {BenchError} `bench/option` where there is no scene of a name.
 */
export function checkTimeScenes(names: readonly string[]): void {
  const unknown = names.find((name) => !KNOWN.includes(name));
  if (unknown !== undefined)
    throw new BenchError('bench/option', `--scenes: there is no "${unknown}"; there are: ${KNOWN.join('; ')}.`);
}

/**
 * A scene by its name: one of `products`, or of the ten of {@link PRODUCT_SCENES}.
 *
 * @throws {BenchError} `bench/option` where there is none, `bench/missing-data` where its file is absent.
 */
export async function timeScene(name: string, width: number, height: number): Promise<TimeScene> {
  checkTimeScenes([name]);
  const make = Object.hasOwn(PRODUCT_SCENES, name) ? PRODUCT_SCENES[name] : undefined;
  if (make) return { ...(await make(width / height)), maxDepth: DEPTH };
  const product = PRODUCTS.find((one) => one.name === name)!;
  const task = await product.task(width, height);
  return { scene: await taskScene(task), camera: task.camera, maxDepth: task.maxDepth };
}
