import type { PathTracer } from '@glanz/renderer';
import { renderShutter } from '@glanz/renderer/shutter';
import type { Camera } from '@glanz/scene';
import { checkedOption, checkedSetting } from '../checks';
import type { DenoiseSession } from '../denoise-session';
import { ViewerError } from '../errors';
import { codesOf } from '../save-image';
import { checkSeconds, type VideoMotion, type VideoPath } from './paths';
import type { VideoSource } from './source';

/** How far a video is. */
export interface VideoProgress {
  /** Number of finished frames. */
  readonly frames: number;
  readonly total: number;
  /** Share of the work that is done, 0..1. */
  readonly share: number;
  /** Estimated milliseconds to the end; `Infinity` before the first sample. */
  readonly remainingMs: number;
}

/** Options for {@link renderFrames}. */
export interface FrameOptions {
  /** What happens; several at once may each change something else. */
  readonly path: VideoPath | readonly VideoPath[];
  /** Pixels, whole numbers from 1. */
  readonly width: number;
  readonly height: number;
  /** Default: that of the longest path. */
  readonly seconds?: number | undefined;
  /** Frames a second. Default 30. */
  readonly fps?: number | undefined;
  /** Samples per pixel of each frame. Default: those of the viewer. */
  readonly samples?: number | undefined;
  /** Motion blur: share of the time between two frames in which the shutter is open, from 0 to 1. Default 0: none. */
  readonly shutter?: number | undefined;
  /** Times of an open shutter at which the scene is posed. Default: one for each sample. */
  readonly shutterTimes?: number | undefined;
  /** What is behind the model. Default: as the viewer shows it. */
  readonly background?: 'environment' | 'transparent' | undefined;
  readonly onProgress?: ((progress: VideoProgress) => void) | undefined;
  /** Ends the rendering. */
  readonly signal?: AbortSignal | undefined;
}

/** A frame of a video. */
export interface VideoImage {
  /** From 0. */
  readonly index: number;
  /** When it is shown, in seconds. */
  readonly seconds: number;
  readonly width: number;
  readonly height: number;
  /** The camera at the end of the frame's exposure. */
  readonly camera: Camera;
  /** sRGB, RGBA with straight alpha, top row first, with the viewer's tone map and exposure. */
  readonly data: Uint8ClampedArray<ArrayBuffer>;
}

/** Options with their defaults, checked. */
interface CheckedOptions {
  readonly samples: number;
  readonly fps: number;
  readonly shutter: number;
}

function checked(
  viewer: VideoSource,
  { width, height, samples, fps = 30, shutter = 0, seconds }: FrameOptions,
): CheckedOptions {
  checkedSetting('width', width);
  checkedSetting('height', height);
  if (seconds !== undefined) checkSeconds(seconds);
  for (const [name, value, low, high] of [
    ['fps', fps, 0.01, 1000],
    ['shutter', shutter, 0, 1],
  ] as const)
    if (!(value >= low && value <= high))
      throw new ViewerError('viewer/option', `${name} is ${value}; it must be a number from ${low} to ${high}.`);
  return { fps, shutter, samples: samples === undefined ? viewer.samples : checkedOption('samples', samples) };
}

/** The number of frames of a video. */
const framesIn = (motions: readonly VideoMotion[], seconds: number | undefined, fps: number) =>
  Math.max(1, Math.round((seconds ?? Math.max(0, ...motions.map((motion) => motion.seconds ?? 0))) * fps || fps));

/** The film of a frame: denoised where the viewer denoises. @throws {ViewerError} `viewer/denoise` */
async function pixelsOf(
  tracer: PathTracer,
  denoise: DenoiseSession | undefined,
  signal: AbortSignal,
  failure: () => unknown,
): Promise<Float32Array> {
  if (!denoise) return tracer.read('beauty');
  const denoised = await denoise.still(tracer, signal);
  // Frames with noise between others without would flicker.
  if (!denoised) throw failure() ?? new ViewerError('viewer/denoise', 'A frame cannot be denoised.');
  return denoised;
}

/**
 * Renders the frames of a video: of the scene and the view that the viewer shows, on a path tracer of its own. The viewer
 * can be used meanwhile, and what it shows does not change. The scene's buffers and textures take GPU memory a second
 * time until the video is finished, aborted, or the loop is left.
 *
 * All frames have the same samples: the same options give the same frames on the same device.
 *
 * @throws {ViewerError} `viewer/no-scene`, `viewer/option`, `viewer/animation`, `viewer/denoise`
 * @throws {DeviceError} `renderer/limit`, `renderer/out-of-memory`, `renderer/device-lost`
 * @throws the signal's reason, when aborted.
 * @example
 * const options = { path: turntable(), width: 640, height: 480, fps: 12 };
 * for await (const { data, width, height } of renderFrames(viewer, options))
 *   context.putImageData(new ImageData(data, width, height), 0, 0);
 */
export function renderFrames(viewer: VideoSource, options: FrameOptions): AsyncGenerator<VideoImage, void, undefined> {
  return filmFrames(
    viewer,
    options,
    (options.background ?? viewer.background) === 'transparent' ? 'straight' : 'opaque',
  );
}

/** See {@link renderFrames}. @param alpha Of the frames; opaque ones lie on black. */
export async function* filmFrames(
  viewer: VideoSource,
  options: FrameOptions,
  alpha: 'opaque' | 'straight',
): AsyncGenerator<VideoImage, void, undefined> {
  const { width, height, background, onProgress, shutterTimes } = options;
  const { samples, fps, shutter } = checked(viewer, options);
  const signal = options.signal ?? new AbortController().signal;
  signal.throwIfAborted();
  const copy = viewer.copyFor(width / height);
  const { camera, orbit, exposure, toneMap } = viewer;
  if (!copy || !camera || !orbit)
    throw new ViewerError('viewer/no-scene', 'There is no scene to render: await load() first.');
  let failure: unknown;
  const denoise = viewer.denoise?.(
    (error) => (failure = error),
    () => viewer.device,
  );
  let tracer: PathTracer | undefined;
  try {
    tracer = await copy.create({ width, height, signal, ...(background ? { background } : {}) });
    await copy.ready?.(tracer);
    const stage = { viewer, tracer, camera: tracer.camera, target: orbit.target };
    const motions: VideoMotion[] = [];
    for (const path of [options.path].flat() as readonly VideoPath[]) motions.push(await path(stage));
    const total = framesIn(motions, options.seconds, fps);
    const started = performance.now();
    const report = (frames: number, part: number) => {
      const share = (frames + part) / total;
      const elapsed = performance.now() - started;
      onProgress?.({ frames, total, share, remainingMs: share > 0 ? (elapsed * (1 - share)) / share : Infinity });
    };
    for (let index = 0; index < total; index++) {
      for (const { frame } of motions) await frame?.(index / fps);
      const pose = async (time: number) => {
        for (const { at } of motions) await at?.((index + shutter * time) / fps);
      };
      const times = shutter === 0 ? 1 : shutterTimes;
      for await (const progress of renderShutter(tracer, { samples, times, seed: index, pose, signal }))
        report(index, progress.samples / samples);
      signal.throwIfAborted();
      const pixels = await pixelsOf(tracer, denoise, signal, () => failure);
      const data = await codesOf(pixels, { exposure, toneMap }, alpha, signal);
      yield { index, seconds: index / fps, width, height, camera: tracer.camera, data };
      report(index + 1, 0);
    }
  } finally {
    tracer?.destroy();
    denoise?.destroy();
  }
}
