import type { CompressedFormat, Image, Scene } from '@glanz/scene';
import { imageOfBitmap, namedImage } from '../browser-images';
import type { GltfOptions, GltfProgress } from '../load';
import type { GltfInput } from '../source';

/** The options that are sent to the worker. */
export type SentOptions = Pick<
  GltfOptions,
  'allowEmpty' | 'scene' | 'animation' | 'time' | 'imageBudgetMiB' | 'limits'
> & {
  readonly baseUrl?: string;
  readonly compressedFormats?: readonly CompressedFormat[] | undefined;
  readonly credentials?: RequestCredentials | undefined;
};

/** Message to a worker: one load. */
export interface LoadRequest {
  readonly input: string | Exclude<GltfInput, string | URL>;
  readonly options: SentOptions;
}

/** A scene as sent: images with a bitmap are sent without pixels, since reading them back is slow. */
export type SentScene = Omit<Scene, 'images'> & {
  readonly images: readonly (Image | (Pick<Image, 'name' | 'width' | 'height'> & { readonly bitmap: ImageBitmap }))[];
};

/** A scene as a worker posts it, with {@link buffersOf} (exported as `transferablesOf`) as the transfer list. */
export const sendable = (scene: Scene): SentScene => ({
  ...scene,
  images: scene.images.map((image) =>
    image.bitmap ? { name: image.name, width: image.width, height: image.height, bitmap: image.bitmap } : image,
  ),
});

/** The scene of a message. */
export const received = (scene: SentScene): Scene => ({
  ...scene,
  images: scene.images.map((image) =>
    image.bitmap ? namedImage(image.name, imageOfBitmap(image.bitmap)) : (image as Image),
  ),
});

/**
 * Message from a worker: `ready` once after its start; for each load any number of `progress`, then one of the others.
 */
export type LoadReply =
  | { readonly kind: 'ready' }
  | { readonly kind: 'progress'; readonly progress: GltfProgress }
  | { readonly kind: 'scene'; readonly scene: SentScene }
  /** Structured cloning drops the class and the code of an error. */
  | { readonly kind: 'error'; readonly code?: string; readonly message: string; readonly path?: string };

/** The transfer list of a scene: the buffers of its geometry and images. */
export function buffersOf({ meshes, images, environment }: SentScene): Transferable[] {
  const buffers = new Set<Transferable>();
  const add = (array: ArrayBufferView | undefined) => {
    if (array?.buffer instanceof ArrayBuffer) buffers.add(array.buffer);
  };
  for (const { positions, indices, normals, tangents, colors, uvs = [] } of meshes)
    for (const array of [positions, indices, normals, tangents, colors, ...uvs]) add(array);
  for (const image of images) {
    if (image.bitmap) buffers.add(image.bitmap);
    else add((image as Image).data);
    for (const level of image.bitmap ? [] : ((image as Image).compressed?.levels ?? [])) add(level);
  }
  if (environment?.type === 'latlong') add(environment.data);
  return [...buffers];
}
