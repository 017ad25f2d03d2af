import type { Scene } from '@glanz/scene';
import { decodeImageFile } from '@glanz/scene/node';
import type { GltfDecoders } from './document';
import { GltfError } from './error';
import type { ImageDecoder } from './decoded-image';
import { ktx2Decoder } from './ktx2';
import { buildScene, type GltfOptions } from './load';
import { animationsOf, type OpenAnimationsOptions, type ScenePoser } from './poser';
import { missing, type Source } from './source';

export { GltfError } from './error';
export { loadGltf, type GltfOptions, type GltfProgress, type LoadGltfOptions } from './load';
export type { OpenAnimationsOptions, PoseChange, ScenePoser } from './poser';

/** Loads an optional package, or says which one is missing. */
async function optional<T>(load: () => Promise<T>, name: string, what: string): Promise<T> {
  try {
    return await load();
  } catch (cause) {
    throw new GltfError('gltf/missing-decoder', `${what} needs the package "${name}": npm install ${name}.`, { cause });
  }
}

/**
 * Decodes a PNG, JPEG or WebP file, or another format that the optional package `sharp` reads: RGBA, 8 bits a channel,
 * straight alpha. A colour profile and an orientation in the file are ignored, as glTF requires (3.8.1).
 *
 * @throws {GltfError} `gltf/missing-decoder` if `sharp` is not installed.
 */
export const decodeImage: ImageDecoder = (bytes) =>
  decodeImageFile(bytes, (message, options) => new GltfError('gltf/missing-decoder', message, options));

/** The transcoder that `three` brings along. It is a script, neither a module nor CommonJS where it lies. */
async function openBasis(): Promise<unknown> {
  const [{ createRequire }, { readFile }] = await Promise.all([import('node:module'), import('node:fs/promises')]);
  const path = (name: string) =>
    optional(
      async () => createRequire(import.meta.url).resolve(`three/examples/jsm/libs/basis/${name}`),
      'three',
      'A model with KTX2 images',
    );
  const [script, wasmBinary] = await Promise.all([
    path('basis_transcoder.js').then((file) => readFile(file, 'utf8')),
    path('basis_transcoder.wasm').then((file) => readFile(file)),
  ]);
  const { runInNewContext } = await import('node:vm');
  // In a context of its own it finds nothing of Node, and so no files.
  const context = {
    WebAssembly,
    TextDecoder,
    performance,
    console: { log: () => undefined, warn: () => undefined, error: () => undefined },
    Uint8Array,
    Int8Array,
    Uint16Array,
    Int16Array,
    Uint32Array,
    Int32Array,
    Float32Array,
    Float64Array,
    setTimeout,
    exports: {},
    module: { exports: undefined as unknown },
  };
  runInNewContext(script, context);
  const create = context.module.exports as (options: object) => Promise<unknown>;
  return create({ wasmBinary, print: () => undefined, printErr: () => undefined });
}

/** The decoders of the packages that are installed; each is loaded for a document that needs it. */
export const packagedDecoders = (): GltfDecoders => ({
  draco: async () =>
    (
      await optional(() => import('draco3dgltf'), 'draco3dgltf', 'A Draco-compressed model')
    ).default.createDecoderModule(),
  ktx2: ktx2Decoder(openBasis),
  meshopt: async () =>
    (await optional(() => import('meshoptimizer/decoder'), 'meshoptimizer', 'A meshopt-compressed model'))
      .MeshoptDecoder,
});

/** Opens a file with those that it names beside it. @throws {GltfError} `gltf/missing-resource` */
async function openFile(path: string | URL, signal: AbortSignal | undefined): Promise<Source> {
  const { readFile, realpath, stat } = await import('node:fs/promises');
  const { basename, dirname, join, sep } = await import('node:path');
  const { fileURLToPath } = await import('node:url');
  const file = typeof path === 'string' ? path : fileURLToPath(path);
  const name = basename(file);
  const read = async (at: string) => {
    // Pipes and devices may never end.
    if (!(await stat(at)).isFile()) throw new Error('it is not a file');
    return new Uint8Array(await readFile(at, signal ? { signal } : {}));
  };
  let bytes: Uint8Array<ArrayBuffer>;
  try {
    bytes = await read(file);
  } catch (cause) {
    signal?.throwIfAborted();
    throw new GltfError(
      'gltf/missing-resource',
      `${file} cannot be read: ${(cause as NodeJS.ErrnoException).code === 'ENOENT' ? 'there is no such file' : (cause as Error).message}.`,
      { cause, location: { file } },
    );
  }
  const folder = await realpath(dirname(file));
  return {
    name,
    bytes,
    read: async (uri) => {
      const at = join(folder, uri);
      try {
        if (!(await realpath(at)).startsWith(folder + sep))
          throw new Error('it lies outside the folder of the document');
        return await read(at);
      } catch (cause) {
        signal?.throwIfAborted();
        throw missing(uri, name, cause);
      }
    },
  };
}

/**
 * Loads a .gltf or .glb file in Node, with the files it names beside it. See `loadGltf` for what is read.
 *
 * @param path Of the file. Files outside its folder are not read.
 * @throws {GltfError} See its codes; `gltf/missing-resource` if the file does not exist.
 * @example
 * const scene = await loadGltfFile('models/button.glb');
 */
export async function loadGltfFile(path: string | URL, options: GltfOptions = {}): Promise<Scene> {
  return buildScene(await openFile(path, options.signal), {
    ...options,
    decodeImage: options.decodeImage ?? decodeImage,
    decoders: { ...packagedDecoders(), ...options.decoders },
  });
}

/**
 * Opens the animations of a .gltf or .glb file in Node, to pose at any time the scene that {@link loadGltfFile} has
 * loaded from it. See `openAnimations` of `@glanz/gltf/animation`.
 *
 * @throws {GltfError} As `openAnimations`; `gltf/missing-resource` if the file does not exist.
 * @example
 * const poser = await openAnimationsFile('robot.glb', await loadGltfFile('robot.glb'));
 * const { transforms } = poser.pose('walk', 0.5);
 */
export async function openAnimationsFile(
  path: string | URL,
  scene: Scene,
  options: Pick<OpenAnimationsOptions, 'signal' | 'decoders' | 'limits' | 'scene'> = {},
): Promise<ScenePoser> {
  return animationsOf(await openFile(path, options.signal), scene, {
    ...options,
    decoders: { ...packagedDecoders(), ...options.decoders },
  });
}
