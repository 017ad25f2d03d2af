import { inSlices, SceneError, type Camera, type Image, type Scene, type Texture } from '@glanz/scene';
import {
  droppableBlocks,
  levelSize,
  mebibytes,
  planTextureLevels,
  reduceImageSteps,
  type TextureCost,
  type TextureLevels,
} from '@glanz/scene/texture-budget';
import type { DeviceError, RenderError } from '../errors';
import type { ReducedTexture } from '../memory';
import type { PathTracerOptions } from '../options';
import type { usedTextures } from '../materials/materials';
import { textureSizesOnScreen } from './texture-need';
import type { compressedFormats, TexturePlan } from '../materials/textures';

/** What textures must fit into, and what is known of how they are seen. */
export interface TextureFitSource {
  readonly device: GPUDevice;
  /** The tracer's own; its images and textures are replaced by reduced ones. */
  readonly scene: Scene;
  readonly camera: Camera;
  readonly options: Pick<PathTracerOptions, 'height' | 'memory'> & { readonly textureLodBias: number };
  /** How the textures of a scene would lie on the GPU. */
  readonly layout: (scene: Scene) => TexturePlan;
  readonly signal: AbortSignal;
}

/** What the renderer has anyway, see `GuideTools`. */
export type FitTools = readonly [
  bytesOf: (scene: Scene) => number,
  usedTextures: typeof usedTextures,
  compressedFormats: typeof compressedFormats,
  error: typeof RenderError,
];

/** Textures that have been fitted. */
export interface FittedTextures {
  readonly source: TextureFitSource;
  /** Images that have lost levels, by their index in the tracer's scene. */
  reduced: ReadonlyMap<number, ReducedTexture>;
  /** What `textureSizesOnScreen` has found, once it was needed. */
  sizes: ReadonlyMap<number, number> | undefined;
  /** Bytes of all levels, where some were dropped. */
  fullBytes: number | undefined;
  /** Says that they were. */
  warning: RenderError | undefined;
}

/** Smaller textures are not why the GPU has no memory. */
const MIN_BYTES = 1 << 20;

/** An image as textures of one colour space use it. */
interface Use {
  readonly image: number;
  readonly space: Texture['color_space'];
  readonly textures: number[];
  /** Whether it stays in blocks on the device. */
  readonly blocks: boolean;
}

/**
 * Reduces the images of a tracer's scene so that their textures fit.
 * @param budget In bytes.
 * @param cause As of `TextureFit.fit`.
 * @throws {SceneError} `scene/texture-budget`
 */
export async function fitTextures(
  fit: FittedTextures,
  budget: number,
  tools: FitTools,
  cause?: unknown,
): Promise<void> {
  if (!cause) return reduce(fit, budget, tools);
  const [bytesOf] = tools;
  const { scene, signal } = fit.source;
  const bytes = bytesOf(scene);
  if ((cause as Partial<DeviceError>).code !== 'renderer/out-of-memory' || bytes < MIN_BYTES) throw cause;
  await reduce(fit, bytes / 2, tools).catch((error: unknown) => {
    throw signal.aborted ? error : cause;
  });
}

async function reduce(
  fit: FittedTextures,
  budget: number,
  [bytesOf, usedTextures, compressedFormats, RenderError]: FitTools,
): Promise<void> {
  const { device, scene, camera, options, signal } = fit.source;
  const fullBytes = fit.fullBytes ?? bytesOf(scene);
  const uses = usesOf(scene, usedTextures(scene.materials), compressedFormats(device));
  // Another attempt has the same textures.
  const sizes = (fit.sizes ??= await inSlices(textureSizesOnScreen(scene, camera, options.height), { signal }));
  const maxSize = device.limits.maxTextureDimension2D;
  const costs = uses.map((use) => costOf(scene, use, sizes, maxSize, options.textureLodBias));
  const levels = fittingLevels(costs, budget, (chosen) => bytesOf(sceneOfSizes(scene, uses, chosen)));
  const result = await replaceImages(scene, uses, levels, async (use, level) => {
    const image = scene.images[use.image] as Image;
    return level === 0 ? image : inSlices(reduceImageSteps(image, level, use.space, use.blocks), { signal });
  });
  const reduced = new Map(fit.reduced);
  uses.forEach(({ image }, index) => {
    const before = fit.reduced.get(image);
    const level = (levels[index] as number) + (before?.level ?? 0);
    const { name, width, height } = scene.images[image] as Image;
    if (level > 0) reduced.set(result.slots[index] as number, { image, name, width, height, ...before, level });
  });
  scene.images = result.images;
  scene.textures = result.textures;
  // Only images that nothing uses were too large.
  if (reduced.size === 0) return;
  fit.reduced = reduced;
  fit.fullBytes = fullBytes;
  const text = reducedText([...reduced.values()], bytesOf(scene), fullBytes);
  fit.warning = new RenderError('renderer/textures-reduced', text);
}

function usesOf({ images, textures }: Scene, used: Iterable<number>, formats: readonly string[]): Use[] {
  const uses = new Map<string, Use>();
  for (const index of used) {
    const { image, color_space: space } = textures[index] as Texture;
    const { width, height, compressed } = images[image] as Image;
    const blocks = compressed !== undefined && formats.includes(compressed.format) && !(width % 4 || height % 4);
    const key = `${image} ${space}`;
    const use = uses.get(key) ?? { image, space, textures: [], blocks };
    use.textures.push(index);
    uses.set(key, use);
  }
  return [...uses.values()];
}

function costOf(
  { images }: Scene,
  { image: index, textures, blocks }: Use,
  sizes: ReadonlyMap<number, number>,
  maxSize: number,
  lodBias: number,
): TextureCost {
  const image = images[index] as Image;
  const { width, height, compressed } = image;
  const size = Math.max(0, ...textures.map((texture) => sizes.get(texture) ?? 0));
  const over = Math.log2(Math.max(width, height) / maxSize);
  return {
    width,
    height,
    texelBytes: blocks ? 1 : !image.bitmap && !compressed && image.data instanceof Float32Array ? 8 : 4,
    mips: !blocks || (compressed?.levels.length ?? 0) > 1,
    // What is still too large is resampled: blocks cannot be.
    minLevel: Math.max(0, blocks ? Math.ceil(over) : Math.floor(over)),
    ...(blocks ? { maxLevel: droppableBlocks(image) } : {}),
    need: Math.log2(Math.sqrt(width * height) / size) + lodBias,
  };
}

/** Levels whose layout fits, which may take more than the images alone: sizes that share an array are resampled. */
function fittingLevels(
  costs: readonly TextureCost[],
  budget: number,
  bytesOf: (levels: readonly number[]) => number,
): readonly number[] {
  let last: TextureLevels | undefined;
  for (let target = budget; ;) {
    let plan: TextureLevels;
    try {
      plan = planTextureLevels(costs, Math.max(0, target));
    } catch (error) {
      if (!last) throw error;
      throw new SceneError(
        'scene/texture-budget',
        `${costs.length} images take ${mebibytes(last.fullBytes)}, and ${mebibytes(bytesOf(last.levels))} in the texture arrays that this device binds, with the levels dropped that can be; the budget is ${mebibytes(budget)}: raise it, or use fewer sizes of images.`,
      );
    }
    const bytes = bytesOf(plan.levels);
    if (bytes <= budget) return plan.levels;
    last = plan;
    target = Math.min(target - (bytes - budget), plan.bytes - 1);
  }
}

/** A scene with images of the sizes that levels give, without their pixels. */
function sceneOfSizes(scene: Scene, uses: readonly Use[], levels: readonly number[]): Scene {
  const images = [...scene.images];
  const textures = [...scene.textures];
  uses.forEach(({ image: index, textures: users, blocks }, at) => {
    const image = scene.images[index] as Image;
    const { name, bitmap, compressed } = image;
    const level = levels[at] as number;
    const [width, height] = levelSize(image.width, image.height, level);
    const isFloat = !bitmap && !compressed && image.data instanceof Float32Array;
    const kept = blocks && compressed && { ...compressed, levels: compressed.levels.slice(level) };
    const data = new (isFloat ? Float32Array : Uint8Array)(0);
    const slot = images.push({ name, width, height, data, ...(kept ? { compressed: kept } : {}) }) - 1;
    for (const texture of users) textures[texture] = { ...(textures[texture] as Texture), image: slot };
  });
  return { ...scene, images, textures };
}

/**
 * Puts an image in the place of each, one after another. Where textures of both colour spaces use it, the place belongs
 * to the one that keeps all levels, else to the first; the other comes at the end.
 */
async function replaceImages(
  scene: Scene,
  uses: readonly Use[],
  levels: readonly number[],
  make: (use: Use, level: number) => Promise<Image>,
): Promise<{ readonly images: Image[]; readonly textures: Texture[]; readonly slots: readonly number[] }> {
  const images = [...scene.images];
  const textures = [...scene.textures];
  const slots: number[] = [];
  for (const [index, use] of uses.entries()) {
    const level = levels[index] as number;
    const made = await make(use, level);
    const isTaken = uses.some((other, at) => other.image === use.image && (at < index || levels[at] === 0));
    const slot = level === 0 || !isTaken ? use.image : images.length;
    images[slot] = made;
    for (const texture of use.textures) textures[texture] = { ...(textures[texture] as Texture), image: slot };
    slots.push(slot);
  }
  return { images, textures, slots };
}

/** What is said of textures that were reduced. */
function reducedText(reduced: readonly ReducedTexture[], bytes: number, fullBytes: number): string {
  const levels = Math.max(...reduced.map(({ level }) => level));
  return `${reduced.length} ${reduced.length === 1 ? 'texture lacks its' : 'textures lack their'} largest levels (up to ${levels}) and take ${mebibytes(bytes)} instead of ${mebibytes(fullBytes)}: the image is approximated. Raise memory.budgetMiB, or free GPU memory.`;
}
