import type { Image, SceneWarning, Texture } from '@glanz/scene';
import {
  droppableBlocks,
  inSlices,
  mebibytes,
  planTextureLevels,
  reduceImageSteps,
  type TextureCost,
  type TextureLevels,
} from '@glanz/scene/texture-budget';
import type { DecodedImage } from './decoded-image';
import { GltfError } from './error';

/** A decoded image that may lose levels. */
export interface FittedImage {
  /** As it is now. */
  image: DecodedImage;
  /** How its colours are averaged. */
  readonly space: Texture['color_space'];
  /** Of the file. */
  readonly width: number;
  readonly height: number;
  /** Levels that were dropped. */
  level: number;
}

/** The images of a load. */
export interface FittedImages {
  readonly file: string;
  /** In bytes. */
  readonly budget: number;
  readonly signal: AbortSignal | undefined;
  readonly images: readonly FittedImage[];
  /** About those that have lost levels. */
  warning: SceneWarning | undefined;
}

/** Bytes of images that are decoded in turn at the same time. A larger image is decoded alone. */
const MAX_DECODING_BYTES = 2 ** 28;

/** What is decoded in turn, and what waits for it. */
const turns = new WeakMap<FittedImages, { bytes: number; readonly waiting: (() => void)[] }>();
/** The images are fitted by one call after another. */
const fitting = new WeakMap<FittedImages, Promise<void>>();

/** Runs what decodes an image of so many bytes, once there is room for it. */
export async function inTurn<T>(of: FittedImages, bytes: number, run: () => Promise<T>): Promise<T> {
  const turn = turns.get(of) ?? { bytes: 0, waiting: [] };
  turns.set(of, turn);
  while (turn.bytes > 0 && turn.bytes + bytes > MAX_DECODING_BYTES)
    await new Promise<void>((resolve) => turn.waiting.push(resolve));
  turn.bytes += bytes;
  try {
    return await run();
  } finally {
    turn.bytes -= bytes;
    for (const resume of turn.waiting.splice(0)) resume();
  }
}

/** The error for a value of `imageBudgetMiB` that is no budget. */
export const invalidBudget = (value: unknown): GltfError =>
  new GltfError('gltf/option', `The option imageBudgetMiB is ${String(value)}; it must be a number above 0.`);

function costOf({ image, width, height, level }: FittedImage): TextureCost {
  const { compressed } = image;
  return {
    width,
    height,
    texelBytes: compressed ? 1 : 4,
    mips: (compressed?.levels.length ?? 0) > 1,
    minLevel: level,
    ...(compressed ? { maxLevel: level + droppableBlocks(image) } : {}),
    // The largest loses levels first: where images are seen is not known yet.
    need: Infinity,
  };
}

/** The image as scenes have them, with the accessor of the pixels, if there is one: they are not read here. */
const named = (image: DecodedImage): Image =>
  Object.defineProperties({ name: '' }, Object.getOwnPropertyDescriptors(image)) as unknown as Image;

/**
 * Reduces images, the largest first, until they fit into their budget. Sets the warning about all that are reduced, if
 * there are any.
 * @throws {GltfError} `gltf/too-large`
 */
export function fitImages(of: FittedImages): Promise<void> {
  const next = (fitting.get(of) ?? Promise.resolve()).then(() => fit(of));
  fitting.set(of, next);
  return next;
}

async function fit(of: FittedImages): Promise<void> {
  const { budget, file, signal } = of;
  // Others come while these are reduced.
  const images = [...of.images];
  let plan: TextureLevels;
  try {
    plan = planTextureLevels(images.map(costOf), budget);
  } catch (cause) {
    throw new GltfError('gltf/too-large', `${file}: ${(cause as Error).message}`, { cause, location: { file } });
  }
  // One after another, so that no more than one is there twice.
  for (const [index, held] of images.entries()) {
    const more = (plan.levels[index] as number) - held.level;
    if (more <= 0) continue;
    const { image, space } = held;
    const steps = reduceImageSteps(named(image), more, space, image.compressed !== undefined);
    const reduced = await inSlices(steps, { signal });
    // The name is not the image's, but the scene's.
    delete (reduced as Partial<Image>).name;
    held.image = reduced as DecodedImage;
    held.level += more;
    image.bitmap?.close();
  }
  of.warning = warningOf(file, images, budget);
}

function warningOf(file: string, images: readonly FittedImage[], budget: number): SceneWarning | undefined {
  const reduced = images.filter(({ level }) => level > 0);
  if (reduced.length === 0) return undefined;
  const largest = reduced.reduce((a, b) => (a.width * a.height >= b.width * b.height ? a : b));
  return {
    code: 'gltf/image-budget',
    message: `${file}: ${reduced.length} ${reduced.length === 1 ? 'image is' : 'images are'} loaded without the largest levels, up to ${Math.max(...reduced.map(({ level }) => level))} (the largest has ${largest.width} × ${largest.height} pixels, now ${largest.image.width} × ${largest.image.height}), since the images exceed imageBudgetMiB, ${mebibytes(budget)}.`,
  };
}
