import type { SceneWarning } from '@glanz/scene';
import { Accessors } from './accessors';
import type { CheckedDocument } from './check/index';
import { fromBase64, fromPercents } from './data-bytes';
import { GltfError } from './error';
import type { Ktx2Decoder } from './decoded-image';
import { Budget, type GltfLimits } from './limits';
import { type GltfMeshopt, MATERIAL_EXTENSIONS } from './json';
import type { PrimitiveReader } from './primitive';
import { decoded, type Source } from './source';
import { dataUri } from './uri';
import type { DracoWorkers } from './draco-workers';

/**
 * Decoders, which the host passes because they are large: each as a module, or as a function that fetches it and is
 * called only for a file that needs it.
 */
export interface GltfDecoders {
  /** The module of `draco3dgltf`: `await createDecoderModule()`. */
  readonly draco?: unknown;
  /**
   * Decodes Draco-compressed meshes in parallel in workers. Requires `draco` too, which is used when a worker fails.
   */
  readonly dracoWorkers?: DracoWorkers | undefined;
  /** `MeshoptDecoder` of `meshoptimizer/decoder`. */
  readonly meshopt?: unknown;
  /**
   * Decodes KTX2 images; see {@link ktx2Decoder}. Without it, images in other formats are used if the document has
   * both.
   */
  readonly ktx2?: Ktx2Decoder | undefined;
}

/** Supported extensions. */
const KNOWN = new Set([
  'KHR_draco_mesh_compression',
  'EXT_meshopt_compression',
  'KHR_meshopt_compression',
  'KHR_mesh_quantization',
  'KHR_texture_transform',
  'KHR_lights_punctual',
  'EXT_mesh_gpu_instancing',
  'KHR_node_visibility',
  'KHR_materials_variants',
  'KHR_xmp_json_ld',
  'KHR_animation_pointer',
  'EXT_lights_image_based',
  // Without effect on rendering: older metadata; a hint about how polygons were triangulated.
  'KHR_xmp',
  'FB_ngon_encoding',
  'EXT_texture_webp',
  'EXT_texture_avif',
  'KHR_texture_basisu',
  ...MATERIAL_EXTENSIONS,
]);

/** Extensions that are ignored, with a warning, even if they are required. */
const OPTIONAL = /^(KHR_materials_|KHR_xmp|EXT_materials_|ADOBE_|MSFT_lod)/;

/** A document with its buffers, from which primitives are read. */
export type OpenDocument = PrimitiveReader;

/** Throws for required extensions that are not supported; warns of those that are only used. */
function checkExtensions({ json }: CheckedDocument, file: string, warnings: SceneWarning[]): void {
  for (const name of json.extensionsRequired ?? []) {
    if (!KNOWN.has(name) && !OPTIONAL.test(name))
      throw new GltfError(
        'gltf/unsupported-extension',
        `${file} requires the extension ${name}, which is not supported: export it without.`,
        { location: { file, path: '/extensionsRequired' } },
      );
  }
  for (const name of json.extensionsUsed ?? []) {
    if (!KNOWN.has(name))
      warnings.push({
        code: 'gltf/ignored-extension',
        message: `${file} uses ${name}, which is not read.`,
        path: '/extensionsUsed',
      });
  }
}

/** The parts of `MeshoptDecoder` that are used. */
interface MeshoptDecoder {
  readonly ready: Promise<void>;
  decodeGltfBuffer(
    target: Uint8Array,
    count: number,
    size: number,
    source: Uint8Array,
    mode: string,
    filter?: string,
  ): void;
}

/** A decoder, fetched if the host passed a function. */
const decoderOf = async (given: unknown): Promise<unknown> =>
  typeof given === 'function' ? ((await (given as () => unknown)()) as unknown) : given;

/** Reads everything that a document names except its images. */
export async function readDocument(
  checked: CheckedDocument,
  binary: Uint8Array<ArrayBuffer> | undefined,
  source: Source,
  options: {
    readonly decoders?: GltfDecoders | undefined;
    readonly signal?: AbortSignal | undefined;
    readonly limits?: GltfLimits | undefined;
  },
  warnings: SceneWarning[],
): Promise<OpenDocument> {
  const { json, neededBuffers, checkBytes } = checked;
  const { name: file } = source;
  checkExtensions(checked, file, warnings);
  const needed = async (names: readonly string[], given: unknown, module: string, option: string): Promise<unknown> => {
    const name = names.find((one) => json.extensionsUsed?.includes(one));
    if (name === undefined) return undefined;
    const decoder = await decoderOf(given);
    if (!decoder)
      throw new GltfError(
        'gltf/missing-decoder',
        `${file} is compressed by ${name}: install the package "${module}" and pass its decoder as ${option}.`,
        { location: { file, path: '/extensionsUsed' } },
      );
    return decoder;
  };
  const draco = await needed(['KHR_draco_mesh_compression'], options.decoders?.draco, 'draco3dgltf', 'decoders.draco');
  const meshopt = (await needed(
    ['EXT_meshopt_compression', 'KHR_meshopt_compression'],
    options.decoders?.meshopt,
    'meshoptimizer',
    'decoders.meshopt',
  )) as MeshoptDecoder | undefined;
  await meshopt?.ready;

  const fileBytes = new Budget(file, 'fileBytes', options.limits);
  const buffers = await Promise.all(
    (json.buffers ?? []).map(async (buffer, index): Promise<Uint8Array<ArrayBuffer> | undefined> => {
      const path = `/buffers/${index}`;
      const embedded = buffer.uri === undefined;
      const bytes = embedded ? (index === 0 ? binary : undefined) : await readUri(buffer.uri, source, options.signal);
      // Chunks are padded to multiples of 4 bytes (glTF 2.0, 4.4.3.3).
      if (embedded && bytes && bytes.length > buffer.byteLength + 3) {
        warnings.push({
          code: 'gltf/container',
          message: `${file}: the binary chunk has ${bytes.length} bytes, but ${path} only ${buffer.byteLength}; the rest is not read.`,
          path,
        });
      }
      if (!bytes) {
        if (neededBuffers.has(index))
          throw new GltfError('gltf/malformed', `${file}: ${path} has no uri, and the file no binary chunk for it.`, {
            location: { file, path },
          });
        return undefined;
      }
      fileBytes.take(bytes.length, path);
      if (bytes.length < buffer.byteLength) throw short(file, path, bytes.length, buffer.byteLength);
      return bytes;
    }),
  );
  const part = (
    view: { readonly buffer: number; readonly byteOffset?: number; readonly byteLength: number } | undefined,
    path: string,
  ) => {
    const bytes = buffers[view?.buffer ?? -1];
    const offset = view?.byteOffset ?? 0;
    if (!view || !bytes || !(offset >= 0 && view.byteLength > 0 && offset + view.byteLength <= bytes.length)) {
      throw new GltfError('gltf/malformed', `${file}: ${path} does not lie within its buffer.`, {
        location: { file, path },
      });
    }
    return bytes.subarray(offset, offset + view.byteLength);
  };
  const total =
    source.bytes.length +
    buffers.reduce((sum, bytes) => sum + (bytes && bytes.buffer !== source.bytes.buffer ? bytes.length : 0), 0);
  const budget = new Budget(file, 'geometryBytes', options.limits, total);
  const unpacked = new Map<number, Uint8Array<ArrayBuffer>>();
  const viewBytes = (index: number): Uint8Array<ArrayBuffer> => {
    const view = json.bufferViews?.[index];
    const path = `/bufferViews/${index}`;
    const extension = view?.extensions?.EXT_meshopt_compression ? 'EXT_meshopt_compression' : 'KHR_meshopt_compression';
    const packed: GltfMeshopt | undefined = view?.extensions?.[extension];
    if (!meshopt || !view || !packed) return part(view, path);
    let bytes = unpacked.get(index);
    if (bytes) return bytes;
    const at = `${path}/extensions/${extension}`;
    budget.take(view.byteLength, at);
    bytes = new Uint8Array(view.byteLength);
    try {
      meshopt.decodeGltfBuffer(
        bytes,
        packed.count,
        packed.byteStride,
        part(packed, at),
        packed.mode,
        packed.filter ?? 'NONE',
      );
    } catch (cause) {
      if (cause instanceof GltfError) throw cause;
      throw new GltfError(
        'gltf/malformed',
        `${file}: ${at} cannot be unpacked: ${cause instanceof Error ? cause.message : String(cause)}; export the file again.`,
        { cause, location: { file, path: at } },
      );
    }
    unpacked.set(index, bytes);
    return bytes;
  };
  const exists = (index: number) => {
    const view = json.bufferViews?.[index];
    const packed = view?.extensions?.EXT_meshopt_compression ?? view?.extensions?.KHR_meshopt_compression;
    return buffers[(packed ?? view)?.buffer ?? -1] !== undefined;
  };
  checkBytes((index) => (exists(index) ? viewBytes(index) : undefined));
  return {
    file,
    accessors: new Accessors(json, viewBytes, budget),
    viewBytes,
    exists,
    draco,
    ahead: new Map(),
    budget,
    bytes: total,
  };
}

const short = (name: string, path: string, length: number, expected: number) =>
  new GltfError(
    'gltf/truncated',
    `${name}: ${path} has ${length} bytes instead of ${expected}: the file is truncated. Download or export it again.`,
    { location: { file: name, path } },
  );

/** The bytes of a uri: a data: uri, or a file in the document's folder. */
export async function readUri(
  uri: string,
  source: Source,
  signal: AbortSignal | undefined,
): Promise<Uint8Array<ArrayBuffer>> {
  if (/^data:/i.test(uri)) {
    const unreadable = (cause?: unknown) =>
      new GltfError('gltf/malformed', `${source.name} holds a data: uri that cannot be decoded.`, {
        cause,
        location: { file: source.name },
      });
    const found = dataUri(uri);
    if (!found) throw unreadable();
    try {
      return found.base64 ? fromBase64(found.data) : fromPercents(found.data);
    } catch (cause) {
      throw unreadable(cause);
    }
  }
  signal?.throwIfAborted();
  const path = decoded(uri);
  if (/^[a-z][a-z0-9+.-]*:|^\/|^\\/i.test(path))
    throw new GltfError(
      'gltf/missing-resource',
      `${source.name} names "${uri}": only files in the document's folder are read.`,
      { location: { file: source.name } },
    );
  return source.read(path, signal);
}
