import type { GltfDecoders } from '@glanz/gltf';

/** The decoders that a document may ask for. Each is fetched only where it is needed. */
export const decoders: GltfDecoders = {
  meshopt: async () => (await import('meshoptimizer/decoder')).MeshoptDecoder,
  draco: async () => {
    const [{ default: create }, { default: wasm }] = await Promise.all([import('draco3dgltf/draco_decoder_gltf_nodejs.js'), import('draco3dgltf/draco_decoder_gltf.wasm?url')]);
    return create({ locateFile: () => wasm });
  },
};
