import type { GltfDecoders } from '@glanz/gltf';

/** Where a document says what it uses: the JSON of a .glb comes first. */
const HEAD_BYTES = 16 << 20;

/** The decoders that a document asks for. Each is fetched only where it is needed. */
export async function decodersFor(document: Blob | undefined): Promise<GltfDecoders> {
  const text = (await document?.slice(0, HEAD_BYTES).text()) ?? '';
  const decoders: { draco?: unknown; meshopt?: unknown } = {};
  if (text.includes('EXT_meshopt_compression')) decoders.meshopt = (await import('meshoptimizer/decoder')).MeshoptDecoder;
  if (text.includes('KHR_draco_mesh_compression')) {
    const [{ default: create }, { default: wasm }] = await Promise.all([import('draco3dgltf/draco_decoder_gltf_nodejs.js'), import('draco3dgltf/draco_decoder_gltf.wasm?url')]);
    decoders.draco = await create({ locateFile: () => wasm });
  }
  return decoders;
}
