import type { Scene } from '@glanz/scene';
import type { GltfOptions, GltfProgress } from '../load';
import type { GltfInput } from '../source';

/** What of the options crosses the boundary. */
export type SentOptions = Pick<GltfOptions, 'allowEmpty' | 'scene' | 'animation' | 'time' | 'limits'> & { readonly baseUrl?: string };

/** To a worker: one load. */
export interface LoadRequest {
  readonly input: string | Exclude<GltfInput, string | URL>;
  readonly options: SentOptions;
}

/** From a worker: `ready` first of all, then any number of `progress`, then one of the others. */
export type LoadReply =
  | { readonly kind: 'ready' }
  | { readonly kind: 'progress'; readonly progress: GltfProgress }
  | { readonly kind: 'scene'; readonly scene: Scene }
  /** Structured cloning would drop the class and the code of an error. */
  | { readonly kind: 'error'; readonly code?: string; readonly message: string; readonly path?: string };

/** The memory of a scene's geometry and pictures, to be handed over rather than copied. */
export function buffersOf({ meshes, images, environment }: Scene): ArrayBuffer[] {
  const buffers = new Set<ArrayBuffer>();
  const add = (array: ArrayBufferView | undefined) => {
    if (array?.buffer instanceof ArrayBuffer) buffers.add(array.buffer);
  };
  for (const { positions, indices, normals, tangents, colors, uvs = [] } of meshes) for (const array of [positions, indices, normals, tangents, colors, ...uvs]) add(array);
  for (const { data } of images) add(data);
  if (environment?.type === 'latlong') add(environment.data);
  return [...buffers];
}
