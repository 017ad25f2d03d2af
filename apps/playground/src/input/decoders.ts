import { packagedDecoders } from '@glanz/element/decoders';
import type { GltfDecoders } from '@glanz/gltf';

/** The decoders that a document may ask for. Each is fetched only where it is needed. */
export const decoders: GltfDecoders = {
  ...packagedDecoders(),
  meshopt: async () => (await import('meshoptimizer/decoder')).MeshoptDecoder,
};
