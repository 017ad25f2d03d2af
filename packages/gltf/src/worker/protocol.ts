import type { CompressedFormat, Image, Scene } from '@glanz/scene';
import { imageOfBitmap, namedImage } from '../browser-images';
import type { GltfOptions, GltfProgress } from '../load';
import type { GltfInput } from '../source';

/** What of the options crosses the boundary. */
export type SentOptions = Pick<GltfOptions, 'allowEmpty' | 'scene' | 'animation' | 'time' | 'limits'> & {
  readonly baseUrl?: string;
  readonly compressedFormats?: readonly CompressedFormat[] | undefined;
};

/** To a worker: one load. */
export interface LoadRequest {
  readonly input: string | Exclude<GltfInput, string | URL>;
  readonly options: SentOptions;
}

/** A scene whose pictures are bitmaps alone where there are some: asking for their pixels would read them back. */
export type SentScene = Omit<Scene, 'images'> & {
  readonly images: readonly (Image | (Pick<Image, 'name' | 'width' | 'height'> & { readonly bitmap: ImageBitmap }))[];
};

/** A scene as a worker posts it, with {@link buffersOf} (exported as `transferablesOf`) handed over. */
export const sendable = (scene: Scene): SentScene => ({
  ...scene,
  images: scene.images.map((image) =>
    image.bitmap ? { name: image.name, width: image.width, height: image.height, bitmap: image.bitmap } : image,
  ),
});

/** The scene out of a message. */
export const received = (scene: SentScene): Scene => ({
  ...scene,
  images: scene.images.map((image) =>
    image.bitmap ? namedImage(image.name, imageOfBitmap(image.bitmap)) : (image as Image),
  ),
});

/** From a worker: `ready` first of all, then any number of `progress`, then one of the others. */
export type LoadReply =
  | { readonly kind: 'ready' }
  | { readonly kind: 'progress'; readonly progress: GltfProgress }
  | { readonly kind: 'scene'; readonly scene: SentScene }
  /** Structured cloning would drop the class and the code of an error. */
  | { readonly kind: 'error'; readonly code?: string; readonly message: string; readonly path?: string };

/** A scene's geometry and pictures, to be handed over rather than copied. */
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
