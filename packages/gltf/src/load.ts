import { createScene, loadPart, type Scene, type SceneWarning } from '@glanz/scene';
import type { Accessors } from './accessors';
import { describeAnimations, morphingNodes, posesAt, type NodePose } from './animation';
import { pointedValues, withValues } from './animation-pointer';
import { decodeImageInBrowser, browserReads } from './browser-images';
import { isShallow, type Raw } from './json-value';
import { checkDocument } from './check/index';
import { openContainer } from './container';
import { readDocument, type GltfDecoders } from './document';
import { GltfError, oneLine } from './error';
import { environmentOf, facesOf } from './image-light';
import { HeldImages, imageFitting } from './held-images';
import { TextureTable } from './images';
import type { CompressedFormats, DecodedImage, ImageDecoder } from './decoded-image';
import type { GltfAnimation, GltfJson, GltfMaterial } from './json';
import { readMaterial, type UvSets } from './materials';
import { Budget, DEFAULT_LIMITS, type GltfLimits } from './limits';
import { indexOf, readNodes, sceneToShow } from './nodes';
import type { PrimitiveReader } from './primitive';
import { openSource, type GltfInput, type Source } from './source';
import { checkUnreadImages } from './unread-images';
import { WarningList } from './warnings';

/** Progress of a load. */
export interface GltfProgress {
  readonly stage: 'read' | 'decode' | 'images';
  /** 0..1 within the stage. */
  readonly done: number;
}

/** Options common to all loaders. */
export interface GltfOptions {
  /** Aborts the load; it then rejects with the signal's reason. */
  readonly signal?: AbortSignal | undefined;
  /** Called with the progress of the load. */
  readonly onProgress?: ((progress: GltfProgress) => void) | undefined;
  /** Decoders of compressed meshes and textures. In Node, those of installed packages are used by default. */
  readonly decoders?: GltfDecoders | undefined;
  /** Decodes images. Default: the browser; in Node, the package `sharp`. */
  readonly decodeImage?: ImageDecoder | undefined;
  /**
   * Compressed texture formats in which KTX2 images may stay, best first: the result of `compressedFormats(device)` of
   * `@glanz/renderer`. They take a quarter of the GPU memory. Default: none; images are decompressed.
   */
  readonly compressedFormats?: CompressedFormats | undefined;
  /**
   * Accepts a document without triangles (lights, cameras) instead of throwing `gltf/no-triangles`. Default false.
   */
  readonly allowEmpty?: boolean | undefined;
  /** The scene to load, by its index or name. Default: the document's default scene. */
  readonly scene?: number | string | undefined;
  /**
   * The animation that poses the nodes, by its index or name. Default: the first one if `time` is given, else none (the
   * rest pose).
   */
  readonly animation?: number | string | undefined;
  /** Seconds from the start of the animation, clamped to its first and last key. Default 0. */
  readonly time?: number | undefined;
  /**
   * Whether `animatedParts` of the scene, the node and the primitive of each instance, is there without animations too.
   * Default false.
   */
  readonly partNodes?: boolean | undefined;
  /**
   * MiB of decoded images that are held at a time, without the smaller levels that a renderer adds; above 0, else
   * `gltf/option` is thrown. Default 4096; `Infinity` is no budget. Where the document has more, the largest images lose
   * their largest levels as they are decoded: width and height are halved by the mean of 2 × 2 texels, of colours in
   * linear light; compressed images lose stored levels and stay compressed. The warning `gltf/image-budget` has the
   * numbers. Images are decoded 512 MiB at a time, a larger one alone.
   */
  readonly imageBudgetMiB?: number | undefined;
  /** Limits on memory, instances and file size. */
  readonly limits?: GltfLimits | undefined;
}

/** Options for {@link loadGltf}. */
export interface LoadGltfOptions extends GltfOptions {
  /**
   * Base of a relative URL, and of the files named by a document that is given as bytes. Default: the page's URL.
   */
  readonly baseUrl?: string | URL | undefined;
  /** Default: the global `fetch`. */
  readonly fetch?: typeof fetch | undefined;
  /** Whether requests send cookies and other credentials to other origins too. Default: `same-origin`. */
  readonly credentials?: RequestCredentials | undefined;
}

/**
 * Loads a glTF 2.0 document (.gltf or .glb) as a scene: meshes, instances, metallic-roughness materials as OpenPBR,
 * textures, cameras, punctual lights, in the rest pose or in that of an animation at a time. Strips, fans, sparse,
 * quantised and normalised data are resolved. Broken parts that are not essential are left out and reported in
 * `scene.warnings`.
 *
 * @throws {GltfError} See its codes.
 * @example
 * const scene = await loadGltf('models/button.glb', { signal });
 */
export async function loadGltf(input: GltfInput, options: LoadGltfOptions = {}): Promise<Scene> {
  const source = await openSource(input, {
    fetch: options.fetch ?? globalThis.fetch,
    baseUrl: options.baseUrl,
    credentials: options.credentials,
    signal: options.signal,
    maxBytes: options.limits?.fileBytes ?? DEFAULT_LIMITS.fileBytes,
    onBytes: (done) => options.onProgress?.({ stage: 'read', done: 0.99 * done }),
  });
  return buildScene(source, { ...options, decodeImage: options.decodeImage ?? decodeImageInBrowser });
}

/** Builds the scene from an opened source; shared by all loaders. */
export async function buildScene(
  source: Source,
  options: GltfOptions & { readonly decodeImage: ImageDecoder },
): Promise<Scene> {
  const { signal, onProgress, imageBudgetMiB = 4096 } = options;
  signal?.throwIfAborted();
  if (!(imageBudgetMiB > 0)) throw (await imageFitting()).invalidBudget(imageBudgetMiB);
  const scene = createScene(source.name);
  const warnings = (scene.warnings = new WarningList());
  const container = openContainer(source.bytes, source.name, scene.warnings);
  const checked = checkDocument(container.json, source.name, scene.warnings);
  onProgress?.({ stage: 'read', done: 1 });
  const reader = await readDocument(checked, container.binary, source, options, scene.warnings);
  signal?.throwIfAborted();
  const animation = animationOf(reader, checked.json, options);
  const json = atMoment(checked.json, container.json, animation, options.time ?? 0, reader, scene.warnings);
  const table = new TextureTable(json, source, scene.warnings, options.decoders?.ktx2, options.compressedFormats);
  const uvSets: UvSets[] = [];
  const addMaterial = (material: GltfMaterial) => {
    const read = readMaterial(material, scene.materials.length, table, scene.warnings);
    uvSets.push(read.uvSets);
    return scene.materials.push(read.made) - 1;
  };
  json.materials?.forEach(addMaterial);
  let done = 0;
  // Decoders run on their own threads while geometry is read here.
  const imageBytes = new Budget(source.name, 'imageBytes', options.limits, reader.bytes);
  const held = new HeldImages(source.name, imageBudgetMiB * 2 ** 20, signal);
  const images = table.readImages(options.decodeImage, reader.viewBytes, imageBytes, held, signal, () =>
    onProgress?.({ stage: 'images', done: ++done / table.imageCount }),
  );
  images.catch(() => undefined);
  await browserReads();
  signal?.throwIfAborted();
  const shown = sceneToShow(json, options.scene, source.name);
  const dracoWorkers = reader.draco ? options.decoders?.dracoWorkers : undefined;
  if (dracoWorkers) {
    await (await loadPart('draco-ahead', import('./draco-ahead'))).unpackAhead(json, shown, reader, dracoWorkers);
    signal?.throwIfAborted();
  }
  // Faces of an environment are read at their full size.
  const faces = new HeldImages(source.name, Infinity, signal);
  const environmentRead = readEnvironment(
    json,
    shown,
    async (index) =>
      (await table.readImage(index, options.decodeImage, reader.viewBytes, imageBytes, faces, signal))?.image,
    signal,
  );
  environmentRead.catch(() => undefined);
  let fallback: number | undefined;
  if (options.partNodes || json.animations?.length) scene.animatedParts = [];
  readNodes({
    json,
    reader,
    scene,
    shown,
    poses: animation
      ? posesAt(animation, options.time ?? 0, reader.accessors, (sampler, what) => {
          const path = `/animations/${checked.json.animations?.indexOf(animation)}/samplers/${sampler}`;
          scene.warnings.push({ code: 'gltf/animation', message: `${source.name}: ${path} ${what}.`, path });
        })
      : new Map<number, NodePose>(),
    morphing: morphingNodes(json),
    instances: new Budget(source.name, 'instances', options.limits),
    defaultMaterial: () => (fallback ??= addMaterial({ name: 'default' })),
    uvSetsOf: (material) => uvSets[material] as UvSets,
  });
  checkUnreadImages(
    json,
    table.shownImages,
    reader,
    (path, what) => void scene.warnings.push({ code: 'gltf/image', message: `${source.name}: ${path} ${what}.`, path }),
  );
  const metadata = metadataOf(json);
  if (metadata) scene.metadata = metadata;
  if (json.animations?.length) scene.animations = describeAnimations(json);
  const variants = json.extensions?.KHR_materials_variants?.variants;
  if (variants) scene.variants = variants.map(({ name = '' }) => name);
  if (scene.instances.length === 0 && !options.allowEmpty)
    throw new GltfError(
      'gltf/no-triangles',
      `${source.name} has no triangles in its scene: pass allowEmpty to load it anyway.`,
      { location: { file: source.name } },
    );
  onProgress?.({ stage: 'decode', done: 1 });
  scene.images = await images;
  const environment = await environmentRead;
  if (environment) scene.environment = environment;
  scene.warnings.push(...table.imageWarnings);
  if (held.warning) scene.warnings.push(held.warning);
  scene.textures = table.textures;
  for (const { textures } of scene.materials) {
    for (const [parameter, binding] of Object.entries(textures ?? {})) {
      if (binding && table.failed.has(scene.textures[binding.texture]?.image ?? -1))
        delete textures?.[parameter as keyof typeof textures];
    }
  }
  scene.warnings = warnings.finished(source.name, oneLine);
  return scene;
}

/** The environment of the shown scene (EXT_lights_image_based); undefined if one of its images is broken. */
async function readEnvironment(
  { scenes, extensions }: GltfJson,
  shown: number | undefined,
  read: (image: number) => Promise<DecodedImage | undefined>,
  signal: AbortSignal | undefined,
): Promise<Scene['environment']> {
  const reference = shown === undefined ? undefined : scenes?.[shown]?.extensions?.EXT_lights_image_based;
  const light = reference && extensions?.EXT_lights_image_based?.lights[reference.light];
  if (!light) return undefined;
  const faces = await Promise.all(facesOf(light).map(read));
  return faces.every((face) => face !== undefined) ? environmentOf(light, faces, signal) : undefined;
}

/** The document's metadata: its asset and the asset's packet (KHR_xmp_json_ld). */
function metadataOf({ asset, extensions }: GltfJson): Scene['metadata'] {
  const {
    version: _,
    minVersion: __,
    extensions: own,
    ...properties
  } = asset as GltfJson['asset'] & {
    readonly extensions?: { readonly KHR_xmp_json_ld?: { readonly packet?: unknown } };
  };
  const xmp = extensions?.KHR_xmp_json_ld?.packets[(own?.KHR_xmp_json_ld?.packet as number | undefined) ?? 0];
  if (!isShallow([properties, xmp])) return undefined;
  const metadata = { ...properties, ...(xmp === undefined ? {} : { xmp }) };
  return Object.keys(metadata).length > 0 ? metadata : undefined;
}

/** The animation that poses the scene; undefined for the rest pose. */
function animationOf(
  { file }: PrimitiveReader,
  json: GltfJson,
  { animation, time }: GltfOptions,
): GltfAnimation | undefined {
  if (animation === undefined && (time === undefined || !json.animations?.length)) return undefined;
  if (time !== undefined && !Number.isFinite(time))
    throw new GltfError(
      'gltf/no-such-part',
      `The option time for ${file} is ${time}; it must be a finite number of seconds.`,
    );
  return (json.animations ?? [])[indexOf(json.animations ?? [], animation ?? 0, 'animation', file)];
}

/** The document with the values that KHR_animation_pointer animates, checked again. */
export function atMoment(
  json: GltfJson,
  raw: Raw,
  animation: GltfAnimation | undefined,
  time: number,
  { file, accessors }: { readonly file: string; readonly accessors: Pick<Accessors, 'floats' | 'at'> },
  warnings: SceneWarning[],
): GltfJson {
  if (!animation?.pointers?.length) return json;
  const moved = withValues(
    raw,
    pointedValues(animation, time, accessors),
    (path, what) => void warnings.push({ code: 'gltf/animation', message: `${file}: ${path} ${what}.`, path }),
  );
  const again: SceneWarning[] = [];
  const checked = checkDocument(moved, file, again);
  const known = new Set(warnings.map(({ message }) => message));
  warnings.push(...again.filter(({ message }) => !known.has(message)));
  return checked.json;
}
