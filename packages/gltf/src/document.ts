import { Logger, WebIO, type Document, type GLTF } from '@gltf-transform/core';
import { EXTMeshGPUInstancing, EXTMeshoptCompression, KHRDracoMeshCompression, KHRLightsPunctual, KHRMeshQuantization } from '@gltf-transform/extensions';
import type { SceneWarning } from '@glanz/scene';
import type { CheckedDocument } from './check/index';
import { GltfError } from './error';
import type { GltfJson } from './json';
import { decoded, type Source } from './source';

/**
 * Decoders of compressed meshes, which the host hands in since they are heavy: the module of `draco3dgltf`
 * (`await createDecoderModule()`), and `MeshoptDecoder` of `meshoptimizer`.
 */
export interface GltfDecoders {
  readonly draco?: unknown;
  readonly meshopt?: unknown;
}

/** Extensions whose data glTF-Transform reads, or whose absence only simplifies a material. */
const KNOWN = new Set([
  'KHR_draco_mesh_compression',
  'EXT_meshopt_compression',
  'KHR_mesh_quantization',
  'KHR_texture_transform',
  'KHR_lights_punctual',
  'EXT_mesh_gpu_instancing',
  'EXT_texture_webp',
  'KHR_materials_clearcoat',
  'KHR_materials_emissive_strength',
  'KHR_materials_ior',
  'KHR_materials_specular',
]);

/** Extensions that may be required and do without: what they add is left out, with a warning. */
const OPTIONAL = /^(KHR_materials_|KHR_xmp|KHR_animation_pointer|KHR_node_visibility|EXT_materials_|ADOBE_|MSFT_lod)/;

const GLB_CHUNK = '@glb.bin';

/** A document with its buffers. */
export interface OpenDocument {
  readonly document: Document;
  /**
   * Bytes of a buffer view.
   * @throws {GltfError} `gltf/malformed` if there is none.
   */
  readonly viewBytes: (index: number) => Uint8Array<ArrayBuffer>;
}

/** Reads everything that a document names except its pictures, and has glTF-Transform understand meshes and nodes. */
export async function readDocument({ json, neededBuffers, checkBytes }: CheckedDocument, binary: Uint8Array<ArrayBuffer> | undefined, source: Source, decoders: GltfDecoders, signal: AbortSignal | undefined, warnings: SceneWarning[]): Promise<OpenDocument> {
  for (const name of json.extensionsRequired ?? []) {
    if (KNOWN.has(name)) continue;
    if (!OPTIONAL.test(name)) throw new GltfError('gltf/unsupported-extension', `${source.name} requires the extension ${name}, which is not supported: export it without.`, { location: { file: source.name, path: '/extensionsRequired' } });
  }
  for (const name of json.extensionsUsed ?? []) {
    if (!KNOWN.has(name)) warnings.push({ code: 'gltf/ignored-extension', message: `${source.name} uses ${name}, which is not read.`, path: '/extensionsUsed' });
  }
  const uses = (name: string) => json.extensionsUsed?.includes(name) ?? false;
  const need = (name: string, given: unknown, module: string, option: string) => {
    if (uses(name) && !given) throw new GltfError('gltf/missing-decoder', `${source.name} is compressed by ${name}: install the package "${module}" and pass its decoder as ${option}.`, { location: { file: source.name } });
  };
  need('KHR_draco_mesh_compression', decoders.draco, 'draco3dgltf', 'decoders.draco');
  need('EXT_meshopt_compression', decoders.meshopt, 'meshoptimizer', 'decoders.meshopt');

  const resources: Record<string, Uint8Array<ArrayBuffer>> = {};
  const absent = new Set<number>();
  const buffers = await Promise.all(
    (json.buffers ?? []).map(async (buffer, index) => {
      const path = `/buffers/${index}`;
      if (buffer.uri === undefined) {
        if (index === 0 && binary) {
          if (binary.length < buffer.byteLength) throw short(source.name, path, binary.length, buffer.byteLength);
          resources[GLB_CHUNK] = binary;
        } else if ('extensions' in buffer) return buffer;
        else if (neededBuffers.has(index)) throw new GltfError('gltf/malformed', `${source.name}: ${path} has no uri, and the file no binary chunk for it.`, { location: { file: source.name, path } });
        else {
          // Nothing reads it, but glTF-Transform wants every buffer and every view of it to be there.
          absent.add(index);
          resources[`buffer-${index}.bin`] = new Uint8Array(1);
          return { ...buffer, uri: `buffer-${index}.bin`, byteLength: 1 };
        }
        return buffer;
      }
      const bytes = await readUri(buffer.uri, source, signal);
      if (bytes.length < buffer.byteLength) throw short(source.name, path, bytes.length, buffer.byteLength);
      // Names of our own: addresses are resolved already.
      const uri = `buffer-${index}.bin`;
      resources[uri] = bytes;
      return { ...buffer, uri };
    }),
  );
  // Pictures and materials are read from the JSON.
  const { images: _i, textures: _t, samplers: _s, materials, animations: _a, ...rest } = json as GltfJson & { readonly animations?: unknown };
  const document = {
    ...rest,
    buffers,
    bufferViews: (json.bufferViews ?? []).map((view) => (absent.has(view.buffer) ? { buffer: view.buffer, byteLength: 1 } : view)),
    ...(materials ? { materials: materials.map(({ name }) => (name === undefined ? {} : { name })) } : {}),
  };
  const io = new WebIO()
    .setLogger(new Logger(Logger.Verbosity.SILENT))
    .registerExtensions([KHRDracoMeshCompression, EXTMeshoptCompression, KHRMeshQuantization, KHRLightsPunctual, EXTMeshGPUInstancing])
    .registerDependencies({ ...(decoders.draco ? { 'draco3d.decoder': decoders.draco } : {}), ...(decoders.meshopt ? { 'meshopt.decoder': decoders.meshopt } : {}) });
  const strip = (names: readonly string[] | undefined) => names?.filter((name) => KNOWN.has(name) && !/texture|materials/.test(name));
  const cleaned = { ...document, extensionsRequired: strip(json.extensionsRequired) ?? [], extensionsUsed: strip(json.extensionsUsed) ?? [] };
  const viewBytes = (index: number) => {
    const view = json.bufferViews?.[index];
    const bytes = resources[view?.buffer === 0 && resources[GLB_CHUNK] ? GLB_CHUNK : `buffer-${view?.buffer}.bin`];
    const offset = view?.byteOffset ?? 0;
    if (!view || !bytes || !(offset >= 0 && view.byteLength > 0 && offset + view.byteLength <= bytes.length)) {
      throw new GltfError('gltf/malformed', `${source.name}: buffer view ${index} does not lie within its buffer.`, { location: { file: source.name, path: `/bufferViews/${index}` } });
    }
    return bytes.subarray(offset, offset + view.byteLength);
  };
  checkBytes(viewBytes);
  try {
    return { document: await io.readJSON({ json: cleaned as unknown as GLTF.IGLTF, resources }), viewBytes };
  } catch (cause) {
    throw new GltfError('gltf/malformed', `${source.name} contradicts the glTF specification: ${cause instanceof Error ? cause.message.split('\n')[0] : String(cause)}.`, { cause, location: { file: source.name } });
  }
}

const short = (name: string, path: string, length: number, expected: number) =>
  new GltfError('gltf/truncated', `${name}: ${path} has ${length} bytes, but says it has ${expected}: the file is cut off.`, { location: { file: name, path } });

/** The bytes behind a uri: data in the uri itself, or a file beside the document. */
export async function readUri(uri: string, source: Source, signal: AbortSignal | undefined): Promise<Uint8Array<ArrayBuffer>> {
  const data = /^data:[^,]*?(;base64)?,(.*)$/s.exec(uri);
  if (data) {
    try {
      if (!data[1]) return new TextEncoder().encode(decodeURIComponent(data[2] as string));
      return Uint8Array.from(atob(data[2] as string), (c) => c.charCodeAt(0));
    } catch (cause) {
      throw new GltfError('gltf/malformed', `${source.name} holds a data: uri that cannot be decoded.`, { cause, location: { file: source.name } });
    }
  }
  signal?.throwIfAborted();
  const path = decoded(uri);
  if (/^[a-z][a-z0-9+.-]*:|^\/|^\\/i.test(path)) throw new GltfError('gltf/missing-resource', `${source.name} names "${uri}": only files beside the document are read.`, { location: { file: source.name } });
  return source.read(path, signal);
}
