import type { Environment, PerspectiveCamera } from '@glanz/scene';
import type { DecodeOptions } from './load';

/** What every contestant is given: one file, one camera, one size, one depth, one environment. */
export interface Task {
  /** Contents of a .glb file. */
  readonly glb: Uint8Array<ArrayBuffer>;
  readonly camera: PerspectiveCamera;
  readonly environment?: Environment;
  readonly width: number;
  readonly height: number;
  /** Most edges of a path, as of `PathTracerOptions.maxDepth`. */
  readonly maxDepth: number;
  /** Whether the reference keeps the energy that rough metals lose to single scattering. */
  readonly multipleScattering: boolean;
  /** How textures are decoded; default: as `decodePixels` does. */
  readonly textures?: DecodeOptions;
}

/** A renderer that takes part, with a task loaded and its pipelines compiled. */
export interface Contestant {
  /** What {@link advance} counts: whole samples of the image, or rounds that carry every path one bounce further. */
  readonly unit: 'samples' | 'rounds';
  /** Begins an image again with random numbers of its own. */
  restart(seed: number): Promise<void>;
  /** Renders on, and waits until the GPU is done. */
  advance(units: number): Promise<void>;
  /** Samples per pixel so far, on average. */
  samples(): Promise<number>;
  /** The image so far: RGB, stride 3, linear, top row first. */
  read(): Promise<Float32Array>;
  destroy(): void;
}

/** Prepares a contestant for a task. */
export type ContestantMaker = (device: GPUDevice, task: Task) => Promise<Contestant>;
