import type { FilmLayer, FilmState, PathTracerOptions, PathTracer, RenderStatistics } from '@glanz/renderer';
import type { FilmSource, MergeOptions } from '@glanz/renderer/film';
import type { DenoiseQuality } from '@glanz/denoise/film';
import type { ScenePoser } from '@glanz/gltf/animation';
import type { CompressedFormat, Scene } from '@glanz/scene';
import type { PoseOptions } from './options';
import type { ImageDenoiser } from './denoise';

/** The part of a `PathTracer` that the command needs. */
export type Tracer = Pick<
  PathTracer,
  | 'render'
  | 'read'
  | 'reset'
  | 'setCamera'
  | 'setVariant'
  | 'setInstanceTransforms'
  | 'setVisibility'
  | 'setLight'
  | 'replaceMesh'
  | 'accumulates'
  | 'readLightGroup'
  | 'lightGroups'
  | 'saveFilm'
  | 'restoreFilm'
  | 'samples'
  | 'statistics'
  | 'destroy'
>;

/** Films on the CPU: as bytes for files, merged, as layers of an image. */
export interface FilmCodec {
  /** The bytes, one piece after another. @param withBeauty Whether the layer `beauty` is among them. Default: true. */
  readonly encode: (state: FilmState, withBeauty?: boolean) => readonly Uint8Array<ArrayBuffer>[];
  /** @throws {RenderError} `renderer/film-state` */
  readonly decode: (bytes: Uint8Array) => FilmState;
  /** @throws {RenderError} `renderer/film-state` */
  readonly merge: (films: readonly FilmSource[], options?: MergeOptions) => Promise<FilmState>;
  readonly layer: (film: FilmState, layer: 'beauty' | 'variance') => Float32Array;
}

/** A device and what it is called. */
export interface OpenedGpu {
  readonly device: GPUDevice;
  readonly adapterName: string;
  /** Whether the adapter renders on the CPU. */
  readonly software: boolean;
}

/** One line of `--list-gpus`. */
export interface ListedGpu {
  readonly name: string;
  /** Graphics interface below WebGPU, e.g. `vulkan`. */
  readonly backend: string;
  /** Name and version of the driver, as far as it is reported. */
  readonly driver: string;
  readonly software: boolean;
}

/**
 * The machinery behind the command. The real one is loaded when it is needed, so that `--help` does not wait for it.
 */
export interface Backend {
  /**
   * @param pose Which scene of the file, and at which moment; formats without such have one.
   * @param formats Compressed formats that the device reads, asked where an image could stay in one. Default: none.
   */
  loadModel(
    file: string,
    signal: AbortSignal,
    pose?: PoseOptions,
    formats?: () => Promise<readonly CompressedFormat[]>,
  ): Promise<Scene>;
  /**
   * Opens the animations of a glTF file whose scene was loaded.
   *
   * @param pose Which scene of the file.
   */
  openAnimations(
    file: string,
    scene: Scene,
    signal: AbortSignal,
    pose?: Pick<PoseOptions, 'scene'>,
  ): Promise<ScenePoser>;
  compressedFormats(device: GPUDevice): Promise<readonly CompressedFormat[]>;
  /**
   * A new device of a new adapter.
   *
   * @param onError Called with each error that the device reports outside of a call of the renderer.
   */
  openGpu(name: string | undefined, onError?: (error: Error) => void): Promise<OpenedGpu>;
  listGpus(): Promise<readonly ListedGpu[]>;
  createTracer(device: GPUDevice, scene: Scene, options: PathTracerOptions): Promise<Tracer>;
  filmCodec(): Promise<FilmCodec>;
  /** @throws {CliError} `cli/missing-package` */
  createDenoiser(device: GPUDevice, quality: DenoiseQuality, signal: AbortSignal): Promise<ImageDenoiser>;
}

export type { DenoiseQuality, FilmLayer, FilmSource, FilmState, ImageDenoiser, PathTracerOptions, RenderStatistics };

/** The renderer on Dawn, the loaders with sharp. */
export function nodeBackend(): Backend {
  return {
    async loadModel(file, signal, pose = {}, compressedFormats = undefined) {
      if (/\.(obj|stl|usd[acz]?)$/i.test(file)) {
        const { loadModelFile } = await import('@glanz/formats/node');
        return loadModelFile(file, { signal });
      }
      const { loadGltfFile } = await import('@glanz/gltf/node');
      return loadGltfFile(file, { signal, compressedFormats, ...pose });
    },
    async openAnimations(file, scene, signal, pose = {}) {
      const { openAnimationsFile } = await import('@glanz/gltf/node');
      return openAnimationsFile(file, scene, { signal, ...pose });
    },
    async compressedFormats(device) {
      return (await import('@glanz/renderer')).compressedFormats(device);
    },
    async openGpu(name, onError = () => undefined) {
      const [{ requestDevice }, { createGpu }] = await Promise.all([
        import('@glanz/renderer'),
        import('@glanz/renderer/node'),
      ]);
      const software = name?.toLowerCase() === 'software';
      const {
        gpu,
        adapterName,
        software: isSoftware,
      } = await createGpu(software ? { software: 'only' } : name === undefined ? {} : { gpu: name });
      const device = await requestDevice({ gpu, onError });
      return { device, adapterName, software: isSoftware };
    },
    async listGpus() {
      const { listGpus } = await import('@glanz/renderer/node');
      return listGpus();
    },
    async createTracer(device, scene, options) {
      const { PathTracer } = await import('@glanz/renderer');
      return PathTracer.create(device, scene, options);
    },
    async createDenoiser(device, quality, signal) {
      const { createImageDenoiser } = await import('./denoise');
      return createImageDenoiser(device, quality, signal);
    },
    async filmCodec() {
      const film = await import('@glanz/renderer/film');
      return {
        encode: film.encodeFilmPieces,
        decode: film.decodeFilmState,
        merge: film.mergeFilmSources,
        layer: film.readFilmState,
      };
    },
  };
}
