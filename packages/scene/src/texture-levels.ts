import { SceneError } from './error';

/** An image as {@link planTextureLevels} sees it. Textures that share an image are one entry. */
export interface TextureCost {
  readonly width: number;
  readonly height: number;
  /** Bytes of a texel: 4 for RGBA in 8 bits, 1 in blocks of 16 bytes. */
  readonly texelBytes: number;
  /** Whether smaller levels are held too, which add a third. Default true. */
  readonly mips?: boolean;
  /** Levels that have to be dropped in any case, e.g. because a device takes no larger images. Default 0. */
  readonly minLevel?: number;
  /** Levels that can be dropped. Default: down to one texel. */
  readonly maxLevel?: number;
  /**
   * The finest level that is seen, as log₂ of the texels for a pixel: 0 where they are equally large, below 0 where texels
   * are larger than pixels. Default `-Infinity`: all of it is needed.
   */
  readonly need?: number;
}

/** Levels to drop, see {@link planTextureLevels}. */
export interface TextureLevels {
  /** Of each entry, how many of its largest levels are dropped: each halves width and height. */
  readonly levels: readonly number[];
  /** Bytes of what is left. */
  readonly bytes: number;
  /** Bytes of all levels. */
  readonly fullBytes: number;
}

/** Width and height of a level of an image: halved, rounded down, at least 1. */
export const levelSize = (width: number, height: number, level: number): readonly [number, number] => [
  Math.max(1, Math.floor(width / 2 ** level)),
  Math.max(1, Math.floor(height / 2 ** level)),
];

/** Bytes of an image without its largest levels. */
export function textureBytes({ width, height, texelBytes, mips = true }: TextureCost, level = 0): number {
  const [w, h] = levelSize(width, height, level);
  return Math.ceil((w * h * texelBytes * (mips ? 4 : 3)) / 3);
}

const lastLevel = ({ width, height, maxLevel }: TextureCost) =>
  Math.min(maxLevel ?? Infinity, Math.floor(Math.log2(Math.max(width, height))));

/**
 * The levels that are missing of those that the image can show, where a texture starts at a level. Where all is needed,
 * each counts.
 */
export function visibleLoss({ need = -Infinity }: TextureCost, level: number): number {
  return Math.max(0, level - Math.max(0, need));
}

/**
 * Chooses the levels that textures start from so that they fit into a budget.
 *
 * Levels are dropped one at a time, first those whose loss is seen least: the number of levels that are missing of those
 * that the image can show, 0 while texels stay as small as pixels. Of equal ones, the level with the most bytes is dropped
 * first, then that of the first entry. What turns out to fit after all is restored, the most visible first. The largest
 * loss of all textures is thus the smallest that any choice within the budget has, and no level can be added to the
 * result.
 *
 * @param textures An entry for each image.
 * @param budget In bytes.
 * @throws {SceneError} `scene/texture-budget` where the budget is too small even with all levels dropped that can be.
 * @example
 * planTextureLevels([{ width: 8192, height: 8192, texelBytes: 4 }], 100 * 2 ** 20).levels; // [1]
 */
export function planTextureLevels(textures: readonly TextureCost[], budget: number): TextureLevels {
  const levels = textures.map((texture) => Math.min(texture.minLevel ?? 0, lastLevel(texture)));
  const first = [...levels];
  const bytesAt = (index: number, level: number) => textureBytes(textures[index] as TextureCost, level);
  const sum = (at: readonly number[]) => at.reduce((total, level, index) => total + bytesAt(index, level), 0);
  const fullBytes = sum(textures.map(() => 0));
  let bytes = sum(levels);

  const saved = (index: number) => {
    const level = levels[index] as number;
    return bytesAt(index, level) - bytesAt(index, level + 1);
  };
  // A heap would save time only for tens of thousands of textures.
  while (bytes > budget) {
    let best = -1;
    let [bestLoss, bestSaved] = [Infinity, 0];
    textures.forEach((texture, index) => {
      const level = levels[index] as number;
      if (level >= lastLevel(texture)) return;
      const loss = visibleLoss(texture, level + 1);
      if (best >= 0 && (loss > bestLoss || (loss === bestLoss && saved(index) <= bestSaved))) return;
      [best, bestLoss, bestSaved] = [index, loss, saved(index)];
    });
    if (best < 0) throw overBudget(textures.length, budget, bytes, fullBytes);
    levels[best] = (levels[best] as number) + 1;
    bytes -= bestSaved;
  }

  const order = textures
    .map((texture, index) => ({ index, loss: visibleLoss(texture, levels[index] as number) }))
    .sort((a, b) => b.loss - a.loss || a.index - b.index);
  for (const { index } of order)
    while ((levels[index] as number) > (first[index] as number)) {
      const more = bytesAt(index, (levels[index] as number) - 1) - bytesAt(index, levels[index] as number);
      if (bytes + more > budget) break;
      levels[index] = (levels[index] as number) - 1;
      bytes += more;
    }
  return { levels, bytes, fullBytes };
}

const MIB = 2 ** 20;

/** Bytes in MiB, with a digit where there are few. */
export const mebibytes = (bytes: number): string => `${(bytes / MIB).toFixed(bytes < 10 * MIB ? 1 : 0)} MiB`;

const overBudget = (count: number, budget: number, bytes: number, fullBytes: number) =>
  new SceneError(
    'scene/texture-budget',
    `${count} images take ${mebibytes(fullBytes)}, and ${mebibytes(bytes)} with all levels dropped that can be; the budget is ${mebibytes(budget)}: raise it, or store smaller levels in compressed images.`,
  );
