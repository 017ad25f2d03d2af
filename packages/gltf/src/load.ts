import { createScene, type Scene } from '@glanz/scene';
import { describeAnimations, posesAt, type NodePose } from './animation';
import { decodeImageInBrowser } from './browser-images';
import { checkDocument } from './check/index';
import { openContainer } from './container';
import { readDocument, type GltfDecoders } from './document';
import { GltfError, oneLine } from './error';
import { TextureTable, type ImageDecoder } from './images';
import type { GltfAnimation, GltfJson } from './json';
import { readMaterial } from './materials';
import { Budget, DEFAULT_LIMITS, type GltfLimits } from './limits';
import { indexOf, readNodes, sceneToShow } from './nodes';
import type { PrimitiveReader } from './primitive';
import { openSource, type GltfInput, type Source } from './source';

/** How far a load has come. */
export interface GltfProgress {
  readonly stage: 'read' | 'decode' | 'images';
  /** 0..1 within the stage. */
  readonly done: number;
}

/** What every loader may be told. */
export interface GltfOptions {
  /** Aborts the load; it then rejects with the signal's reason. */
  readonly signal?: AbortSignal | undefined;
  /** Told as the load goes on. */
  readonly onProgress?: ((progress: GltfProgress) => void) | undefined;
  /** Decoders of compressed meshes. In Node they are found by themselves where their packages are installed. */
  readonly decoders?: GltfDecoders | undefined;
  /** Decodes pictures. Default: the browser does; in Node, the package `sharp`. */
  readonly decodeImage?: ImageDecoder | undefined;
  /** Whether a document without triangles is a scene too (lights, cameras) rather than `gltf/no-triangles`. Default false. */
  readonly allowEmpty?: boolean | undefined;
  /** Which of the document's scenes, by its index or name. Default: the one that it shows by itself. */
  readonly scene?: number | string | undefined;
  /** Poses the nodes by an animation, by its index or name. Default: the pose at rest, or the first one where `time` is given. */
  readonly animation?: number | string | undefined;
  /** Seconds from the animation's beginning; before its first and after its last key it stands still. Default 0. */
  readonly time?: number | undefined;
  /** How much the document may ask for. */
  readonly limits?: GltfLimits | undefined;
}

/** What {@link loadGltf} may be told. */
export interface LoadGltfOptions extends GltfOptions {
  /** Where the files lie that a document given as bytes names, and what a relative address is relative to. Default: the page. */
  readonly baseUrl?: string | URL | undefined;
  /** Default: the global `fetch`. */
  readonly fetch?: typeof fetch | undefined;
}

/**
 * Loads a glTF 2.0 document (.gltf or .glb) as a scene: meshes, instances, metallic-roughness materials as OpenPBR,
 * textures, cameras, punctual lights, at rest or in the pose that an animation has at a time. Strips, fans, sparse, quantised and normalised data
 * are resolved. What is broken but can be left out is left out; `scene.warnings` tells.
 *
 * @throws {GltfError} See its codes.
 * @example
 * const scene = await loadGltf('models/button.glb', { signal });
 */
export async function loadGltf(input: GltfInput, options: LoadGltfOptions = {}): Promise<Scene> {
  const source = await openSource(input, { fetch: options.fetch ?? globalThis.fetch, baseUrl: options.baseUrl, signal: options.signal, maxBytes: options.limits?.fileBytes ?? DEFAULT_LIMITS.fileBytes, onBytes: (done) => options.onProgress?.({ stage: 'read', done: 0.99 * done }) });
  return buildScene(source, { ...options, decodeImage: options.decodeImage ?? decodeImageInBrowser });
}

/** The common part of all loaders. */
export async function buildScene(source: Source, options: GltfOptions & { readonly decodeImage: ImageDecoder }): Promise<Scene> {
  const { signal, onProgress } = options;
  signal?.throwIfAborted();
  const scene = createScene(source.name);
  const container = openContainer(source.bytes, source.name, scene.warnings);
  const checked = checkDocument(container.json, source.name, scene.warnings);
  const { json } = checked;
  onProgress?.({ stage: 'read', done: 1 });
  const reader = await readDocument(checked, container.binary, source, options, scene.warnings);
  signal?.throwIfAborted();
  const table = new TextureTable(json, source, scene.warnings, options.decoders?.ktx2);
  scene.materials = (json.materials ?? []).map((material, index) => readMaterial(material, index, table, scene.warnings));
  let done = 0;
  // Decoders have threads of their own: they are at work while geometry is read here.
  const images = table.readImages(options.decodeImage, reader.viewBytes, new Budget(source.name, 'imageBytes', options.limits), signal, () => onProgress?.({ stage: 'images', done: ++done / table.imageCount }));
  images.catch(() => undefined);
  let fallback: number | undefined;
  readNodes({
    json,
    reader,
    scene,
    shown: sceneToShow(json, options.scene, source.name),
    poses: posesOf(reader, json, options),
    instances: new Budget(source.name, 'instances', options.limits),
    defaultMaterial: () => (fallback ??= scene.materials.push(readMaterial({ name: 'default' }, scene.materials.length, table, scene.warnings)) - 1),
  });
  const metadata = metadataOf(json);
  if (metadata) scene.metadata = metadata;
  if (json.animations?.length) scene.animations = describeAnimations(json);
  const variants = json.extensions?.KHR_materials_variants?.variants;
  if (variants) scene.variants = variants.map(({ name = '' }) => name);
  if (scene.instances.length === 0 && !options.allowEmpty) throw new GltfError('gltf/no-triangles', `${source.name} has no triangles in its scene: there is nothing to show.`, { location: { file: source.name } });
  onProgress?.({ stage: 'decode', done: 1 });
  scene.images = await images;
  scene.textures = table.textures;
  for (const { textures } of scene.materials) {
    for (const [parameter, binding] of Object.entries(textures ?? {})) {
      if (binding && table.failed.has(scene.textures[binding.texture]?.image ?? -1)) delete textures?.[parameter as keyof typeof textures];
    }
  }
  scene.warnings = scene.warnings.map((warning) => ({ ...warning, message: oneLine(warning.message) }));
  return scene;
}

/** What a document says of itself: its asset and, by KHR_xmp_json_ld, the packet of its asset. */
function metadataOf({ asset, extensions }: GltfJson): Scene['metadata'] {
  const { version: _, minVersion: __, extensions: own, ...said } = asset as GltfJson['asset'] & { readonly extensions?: { readonly KHR_xmp_json_ld?: { readonly packet?: unknown } } };
  const xmp = extensions?.KHR_xmp_json_ld?.packets[(own?.KHR_xmp_json_ld?.packet as number | undefined) ?? 0];
  const metadata = { ...said, ...(xmp === undefined ? {} : { xmp }) };
  return Object.keys(metadata).length > 0 ? metadata : undefined;
}

function posesOf({ file, accessors }: PrimitiveReader, json: GltfJson, { animation, time }: GltfOptions): ReadonlyMap<number, NodePose> {
  if (animation === undefined && (time === undefined || !json.animations?.length)) return new Map();
  if (time !== undefined && !Number.isFinite(time)) throw new GltfError('gltf/no-such-part', `The time to pose ${file} at is ${time}; it must be a number of seconds.`);
  const index = indexOf(json.animations ?? [], animation ?? 0, 'animation', file);
  return posesAt((json.animations ?? [])[index] as GltfAnimation, time ?? 0, accessors);
}
