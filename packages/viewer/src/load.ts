import type { GltfDecoders, GltfProgress } from '@glanz/gltf';
import { GlanzError, inSlices, type CompressedFormat, type Environment, type Scene } from '@glanz/scene';
import { isAbort } from './aborts';
import { ViewerError, loadPart } from './errors';
import type { ReadFile } from './load-other';

/**
 * A model: an address, a file, several files or a folder of them (glTF, GLB, OBJ with MTL, STL, USD), or a
 * scene.
 * A map's keys are paths, folders separated by `/`.
 */
export type ModelSource = string | URL | Blob | readonly File[] | FileList | ReadonlyMap<string, Blob> | Scene;

/**
 * Environment. `scene`: the model's own, or else the studio; `studio`: the built-in one; `none`: black; an address or
 * a file of a Radiance HDR or OpenEXR image, of an Ultra HDR JPEG, or of a JPEG, PNG or WebP image, whose radiance is at
 * most 1; or data.
 */
export type EnvironmentSource = 'scene' | 'studio' | 'none' | URL | Blob | Environment | (string & {});

/** Options for {@link loadModel}. */
export interface LoadModelOptions {
  readonly signal?: AbortSignal | undefined;
  readonly onProgress?: ((progress: GltfProgress) => void) | undefined;
  /**
   * Decoders of compressed meshes and images. That of meshopt is included. A file that needs one of these is read on
   * the calling thread; `createWorker` keeps it off.
   */
  readonly decoders?: GltfDecoders | undefined;
  /**
   * Starts the worker that reads glTF: your own file that calls `serveGltf` of `@glanz/gltf/worker` with decoders.
   */
  readonly createWorker?: (() => Worker) | undefined;
  /** Whether requests send credentials to other origins too. Default: `same-origin`. */
  readonly credentials?: RequestCredentials | undefined;
  /** What the GPU reads of compressed formats: images in KTX2 stay packed. Default: they are unpacked. */
  readonly compressedFormats?: (() => Promise<readonly CompressedFormat[]>) | undefined;
}

const MODEL = /\.(glb|gltf|obj|stl|usd[acz]?)$/i;
/** Models that are no glTF. */
export const OTHER = /\.(obj|stl|usd[acz]?)$/i;
const ENVIRONMENT = /\.(hdr|exr|pic)$/i;

const isScene = (source: ModelSource): source is Scene =>
  typeof source === 'object' && 'meshes' in source && 'instances' in source;
/** Whether a source is a list of files. */
export const isFiles = (source: unknown): source is readonly File[] | FileList =>
  typeof source === 'object' &&
  source !== null &&
  Symbol.iterator in source &&
  [...(source as Iterable<unknown>)].every((file) => file instanceof Blob);

/** An address as the page understands it. @throws {ViewerError} with the code, for what is none. */
function addressOf(source: string | URL, code: 'viewer/no-model' | 'viewer/environment'): URL {
  try {
    return new URL(source, location.href);
  } catch (cause) {
    throw new ViewerError(code, `"${String(source).slice(0, 200)}" is not an address that can be fetched.`, { cause });
  }
}
/** An address without its query. */
export const pathOf = (address: string | URL) => String(address).replace(/[?#].*$/, '');

/** Files by their paths, of whatever a drop, an input or a program gives. */
export function filesOf(source: Blob | readonly File[] | FileList | ReadonlyMap<string, Blob>): Map<string, Blob> {
  if (source instanceof Blob) return new Map([[source instanceof File ? source.name : 'model.glb', source]]);
  if (source instanceof Map) return new Map(source as ReadonlyMap<string, Blob>);
  return new Map([...(source as Iterable<File>)].map((file) => [file.webkitRelativePath || file.name, file]));
}

/**
 * The model and the environment among files: of several documents the one nearest to the top, as asset folders keep
 * variants below.
 */
export function sortFiles(files: ReadonlyMap<string, Blob>): {
  readonly model?: string;
  readonly environment?: string;
} {
  const depth = (path: string) => path.split('/').length;
  const paths = [...files.keys()].sort((a, b) => depth(a) - depth(b) || a.localeCompare(b));
  const model = paths.find((path) => MODEL.test(path));
  const environment = paths.find((path) => ENVIRONMENT.test(path));
  return { ...(model === undefined ? {} : { model }), ...(environment === undefined ? {} : { environment }) };
}

/**
 * Reads a model, glTF in a worker where one can be had.
 *
 * @throws {ViewerError} `viewer/no-model` if there is none among the files, or the source is none.
 * @throws {GltfError} {FormatError} for files that cannot be read.
 * @example
 * const scene = await loadModel('chair.glb', { signal });
 */
export async function loadModel(source: ModelSource, options: LoadModelOptions = {}): Promise<Scene> {
  const { signal } = options;
  signal?.throwIfAborted();
  if (typeof source === 'string' || source instanceof URL) {
    if (!OTHER.test(pathOf(source))) return readGltf(source, options);
    const base = addressOf(source, 'viewer/no-model');
    return readOther(
      decodeURIComponent(base.pathname.slice(base.pathname.lastIndexOf('/') + 1)),
      (path) => fetchBytes(new URL(path, base), signal, options.credentials),
      signal,
    );
  }
  if (!(source instanceof Blob || source instanceof Map || isFiles(source))) {
    if (typeof source === 'object' && source !== null && isScene(source)) return source;
    throw new ViewerError(
      'viewer/no-model',
      `A model is an address, a file, files or a scene, not ${source === null ? 'null' : `of the type "${typeof source}"`}.`,
    );
  }
  const files = filesOf(source);
  const { model } = sortFiles(files);
  // A Blob without a name may be anything; glTF is what it is taken for.
  if (model === undefined) {
    const names = [...files.keys()].slice(0, 3).map((path) => `"${path}"`);
    throw new ViewerError(
      'viewer/no-model',
      `There is no .glb, .gltf, .obj, .stl or .usdz among the files${names.length > 0 ? ` (${names.join(', ')}${files.size > 3 ? ', …' : ''})` : ''}.`,
    );
  }
  if (!OTHER.test(model)) return readGltf({ files, entry: model }, options);
  const folder = model.slice(0, model.lastIndexOf('/') + 1);
  return readOther(
    model.slice(folder.length),
    async (path) => {
      const file = files.get(folder + path);
      return file && bytesOf(file);
    },
    signal,
  );
}

/**
 * Reads an environment; `scene` and `none` give `undefined`.
 *
 * @throws {ViewerError} `viewer/environment` for an address that cannot be fetched; {ImageError} for an image that
 * cannot be read.
 */
export async function loadEnvironment(
  source: EnvironmentSource,
  signal?: AbortSignal,
  credentials?: RequestCredentials,
): Promise<Environment | undefined> {
  if (source === 'scene' || source === 'none') return undefined;
  if (source === 'studio')
    return inSlices((await loadPart('studio', import('@glanz/scene/studio'))).studioSteps(), { signal });
  let bytes;
  if (typeof source === 'string' || source instanceof URL) {
    bytes = await fetchBytes(addressOf(source, 'viewer/environment'), signal, credentials);
    if (!bytes)
      throw new ViewerError(
        'viewer/environment',
        `The environment "${String(source).slice(0, 200)}" could not be fetched: check the address, and that its server lets this page read it.`,
      );
  } else if (source instanceof Blob) bytes = await bytesOf(source);
  else {
    const type: unknown = (source as Environment | null)?.type;
    if (type === 'latlong' || type === 'constant') return source;
    throw new ViewerError(
      'viewer/environment',
      `An environment is a name, an address, a file, or latlong or constant data, not ${JSON.stringify(type ?? source)?.slice(0, 40)}.`,
    );
  }
  // JPEG, PNG and WebP; an environment of high dynamic range begins with "#?" or 76 2f.
  if (/^(ffd8|8950|5249)/.test([...bytes.subarray(0, 2)].map((byte) => byte.toString(16)).join('')))
    return (await loadPart('ldr-environment', import('./ldr-environment'))).ldrEnvironment(bytes);
  const { decodeEnvironment } = await loadPart('environment', import('@glanz/image/environment'));
  signal?.throwIfAborted();
  const { width, height, data } = decodeEnvironment(bytes);
  return { type: 'latlong', width, height, data };
}

const bytesOf = async (body: Blob | Response) => new Uint8Array(await body.arrayBuffer());

/** The bytes at an address, or `undefined` where there are none. */
async function fetchBytes(
  url: URL,
  signal: AbortSignal | undefined,
  credentials: RequestCredentials = 'same-origin',
): Promise<Uint8Array<ArrayBuffer> | undefined> {
  try {
    const response = await fetch(url, { credentials, ...(signal ? { signal } : {}) });
    return response.ok ? await bytesOf(response) : undefined;
  } catch {
    signal?.throwIfAborted();
    return undefined;
  }
}

/** meshopt's decoder, which models may need. */
export const meshoptDecoder = async (): Promise<unknown> => (await import('meshoptimizer/decoder')).MeshoptDecoder;

/** What the loader of glTF takes. */
export type GltfSource = string | URL | { readonly files: ReadonlyMap<string, Blob>; readonly entry: string };

/** The loader on the page's own thread. */
const readInPage = () => loadPart('gltf', import('./gltf'));

async function readGltf(source: GltfSource, options: LoadModelOptions): Promise<Scene> {
  const { signal, onProgress, decoders, createWorker, compressedFormats, credentials } = options;
  const common = { signal, onProgress, credentials };
  try {
    const { loadGltfInWorker } = await import('@glanz/gltf/workers');
    return await loadGltfInWorker(source, {
      ...common,
      createWorker,
      ...(createWorker && compressedFormats ? { compressedFormats: await compressedFormats() } : {}),
    });
  } catch (error) {
    // Without a worker, or where it lacks a decoder or a part of the loader, the file is read here, in slices. What
    // browsers throw for a worker of another origin or a policy differs, and none of it is a GlanzError.
    const refused =
      error instanceof GlanzError && !['gltf/worker', 'gltf/missing-decoder', 'wgsl/chunk'].includes(error.code);
    if (isAbort(error) || refused) throw error;
  }
  signal?.throwIfAborted();
  const { loadGltf } = await readInPage();
  return loadGltf(source, { ...common, compressedFormats, decoders: { meshopt: meshoptDecoder, ...decoders } });
}

/** Reads a model that is no glTF; pages that load glTF alone do not fetch what reads it. */
async function readOther(name: string, read: ReadFile, signal: AbortSignal | undefined): Promise<Scene> {
  const { loadOther } = await loadPart('load-other', import('./load-other'));
  return loadOther(name, read, {
    decoder: async () => (await readInPage()).decodeImageInBrowser,
    signal,
  });
}
