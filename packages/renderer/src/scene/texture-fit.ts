import { loadPart } from '@glanz/wgsl';
import type { Scene } from '@glanz/scene';
import { RenderError } from '../errors';
import type { ReducedTexture } from '../memory';
import type { FittedTextures, TextureFitSource } from './fit-textures';
import { usedTextures } from '../materials/materials';
import { arrayBytes, compressedFormats } from '../materials/textures';

/**
 * Reduces textures that do not fit into the budget, the limits of the device, or its memory. What does this is loaded
 * where it is needed.
 */
export class TextureFit implements FittedTextures {
  declare fullBytes: number | undefined;
  declare sizes: ReadonlyMap<number, number> | undefined;
  declare warning: RenderError | undefined;
  reduced: ReadonlyMap<number, ReducedTexture> = new Map();
  readonly source: TextureFitSource;

  constructor(source: TextureFitSource) {
    this.source = source;
  }

  /**
   * Reduces the textures until they fit into the budget.
   * @param cause Why they do not, if not for the budget: where the GPU has no memory, they are halved.
   * @throws {SceneError} `scene/texture-budget`; `cause`, where smaller textures do not help.
   */
  async fit(cause?: unknown): Promise<void> {
    const { scene, layout, device, options } = this.source;
    const bytesOf = (of: Scene) => layout(of).arrays.reduce((sum, array) => sum + arrayBytes(array), 0);
    const budget = (options.memory?.budgetMiB ?? Infinity) * 2 ** 20;
    const limit = 2 * device.limits.maxTextureDimension2D;
    if (
      cause ||
      bytesOf(scene) > budget ||
      scene.images.some(({ width, height }) => Math.max(width, height) >= limit)
    ) {
      const tools = [bytesOf, usedTextures, compressedFormats, RenderError] as const;
      await (await loadPart('fit-textures', import('./fit-textures'))).fitTextures(this, budget, tools, cause);
    }
  }
}
