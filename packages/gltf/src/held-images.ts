import { loadPart } from '@glanz/scene';
import type { SceneWarning } from '@glanz/scene';
import type { DecodedImage } from './decoded-image';
import type { FittedImage, FittedImages } from './fit-images';

/** Bytes of images that are decoded without waiting for others. */
const UNCHECKED_BYTES = 2 ** 28;

/** Few documents need it. */
export const imageFitting = () => loadPart('fit-images', import('./fit-images'));

/**
 * The decoded images of a load, within a budget: as soon as they exceed it, the largest lose levels, so that those of a
 * scene are never in memory all at once at their full size.
 */
export class HeldImages implements FittedImages {
  readonly images: FittedImage[] = [];
  declare warning: SceneWarning | undefined;
  /** Bytes of the images that were begun, and of those that were decoded, at their full size. */
  #begun = 0;
  #decoded = 0;

  constructor(
    readonly file: string,
    readonly budget: number,
    readonly signal: AbortSignal | undefined,
  ) {}

  /** Runs what decodes and holds an image of so many bytes, once there is room for it. */
  async decode<T>(bytes: number, run: () => Promise<T>): Promise<T> {
    return (this.#begun += bytes) > UNCHECKED_BYTES ? (await imageFitting()).inTurn(this, bytes, run) : run();
  }

  /**
   * Takes an image over. What it returns has the image as it is now, with the levels that are left.
   * @throws {GltfError} `gltf/too-large` where the images do not fit with all levels dropped that can be.
   */
  async hold(image: DecodedImage, space: FittedImage['space']): Promise<FittedImage> {
    const { width, height } = image;
    const held = { image, space, width, height, level: 0 };
    this.images.push(held);
    if ((this.#decoded += 4 * width * height) > this.budget) await (await imageFitting()).fitImages(this);
    return held;
  }
}
