import type * as MediabunnyModule from 'mediabunny';
import { ViewerError } from '../errors';
import { filmFrames, type FrameOptions, type VideoImage } from './frames';
import type { VideoSource } from './source';

type Mediabunny = typeof MediabunnyModule;

/** Codecs as WebCodecs groups them: H.264, H.265, VP8, VP9, AV1. */
export type VideoCodecName = 'avc' | 'hevc' | 'vp8' | 'vp9' | 'av1';

/** Options for {@link recordVideo}. */
export interface VideoOptions extends Omit<FrameOptions, 'background'> {
  /** Default: `video/mp4` where the browser encodes H.264, otherwise `video/webm`. */
  readonly type?: 'video/mp4' | 'video/webm' | undefined;
  /** Default: the first that the browser encodes in this size: `avc` in MP4; `vp9`, `av1` or `vp8` in WebM. */
  readonly codec?: VideoCodecName | undefined;
  /** Bits per second. Default: by the codec, the size and the frame rate, for a high quality. */
  readonly bitrate?: number | undefined;
  /**
   * The module `mediabunny`, which writes the file, or a function that gives it. Default: `import('mediabunny')`, which
   * a bundler or an import map resolves.
   */
  readonly mediabunny?: unknown;
  /**
   * Puts something behind the model: is called with each frame, on a transparent background and with straight alpha,
   * and changes its `data` in place. What is left transparent is black in the video. Default: the frames have the
   * background of the viewer; a transparent one is black.
   */
  readonly compose?: ((frame: VideoImage) => void | Promise<void>) | undefined;
  /** Called with each frame before it is encoded. */
  readonly onFrame?: ((frame: VideoImage) => void) | undefined;
}

/** What is tried, in this order. */
const CHOICES: readonly (readonly [type: 'video/mp4' | 'video/webm', codec: VideoCodecName])[] = [
  ['video/mp4', 'avc'],
  ['video/webm', 'vp9'],
  ['video/webm', 'av1'],
  ['video/webm', 'vp8'],
  ['video/mp4', 'hevc'],
  ['video/mp4', 'av1'],
  ['video/mp4', 'vp9'],
];

/** @throws {ViewerError} `viewer/missing-package` */
async function muxer(given: unknown): Promise<Mediabunny> {
  try {
    return (await (typeof given === 'function' ? given() : (given ?? import('mediabunny')))) as Mediabunny;
  } catch (cause) {
    throw new ViewerError(
      'viewer/missing-package',
      'Recording a video needs the package "mediabunny": npm install mediabunny. Pages without a bundler pass its module as the option mediabunny.',
      { cause },
    );
  }
}

/** What the browser can encode. @throws {ViewerError} `viewer/video` */
async function choose(
  { canEncodeVideo }: Mediabunny,
  { type, codec, width, height, fps = 30 }: VideoOptions,
  quality: object,
): Promise<(typeof CHOICES)[number]> {
  for (const choice of CHOICES) {
    if ((type !== undefined && type !== choice[0]) || (codec !== undefined && codec !== choice[1])) continue;
    if (await canEncodeVideo(choice[1], { width, height, frameRate: fps, ...quality })) return choice;
  }
  throw new ViewerError(
    'viewer/video',
    `This browser does not encode ${codec ?? 'video'} of ${width} × ${height} pixels${type === undefined ? '' : ` for ${type}`}: leave out codec and type, or choose another size.`,
  );
}

/** Puts codes with straight alpha on black, where they are not opaque. */
function ontoBlack(data: Uint8ClampedArray): void {
  for (let i = 0; i < data.length; i += 4) {
    const alpha = data[i + 3] as number;
    if (alpha === 255) continue;
    for (let k = 0; k < 3; k++) data[i + k] = ((data[i + k] as number) * alpha) / 255;
    data[i + 3] = 255;
  }
}

/**
 * Records a video of what a viewer shows: a turntable, an animation, a walk through the states of a configurator. Frames
 * are path-traced one after another on a tracer of their own, as `renderFrames` does, and encoded by WebCodecs.
 *
 * @returns The video as a file of the type that its `type` says.
 * @throws {ViewerError} `viewer/video` where the browser has no WebCodecs, or none of the codecs for this size;
 * `viewer/missing-package` without `mediabunny`; `viewer/no-scene`, `viewer/option`, `viewer/animation`,
 * `viewer/denoise`.
 * @throws {DeviceError} as `renderFrames`, and the signal's reason.
 * @example
 * const file = await recordVideo(viewer, {
 *   path: turntable({ seconds: 6 }),
 *   width: 1280,
 *   height: 720,
 *   samples: 64,
 *   shutter: 0.5,
 * });
 * video.src = URL.createObjectURL(file);
 */
export async function recordVideo(viewer: VideoSource, options: VideoOptions): Promise<Blob> {
  const { width, height, fps = 30, bitrate, compose, onFrame, mediabunny } = options;
  if (width % 2 !== 0 || height % 2 !== 0)
    throw new ViewerError('viewer/option', `A video has even sides, not ${width} × ${height}.`);
  if (typeof VideoEncoder === 'undefined' || typeof VideoFrame === 'undefined')
    throw new ViewerError(
      'viewer/video',
      'This browser cannot encode video: it has no WebCodecs, which pages need https or localhost for.',
    );
  const library = await muxer(mediabunny);
  const { BufferTarget, Mp4OutputFormat, Output, VideoSample, VideoSampleSource, WebMOutputFormat } = library;
  const quality = { quality: bitrate === undefined ? library.QUALITY_HIGH : new library.Quality(bitrate) };
  const [type, codec] = await choose(library, options, quality);
  const target = new BufferTarget();
  const format = type === 'video/mp4' ? new Mp4OutputFormat({ fastStart: 'in-memory' }) : new WebMOutputFormat();
  const output = new Output({ format, target });
  const source = new VideoSampleSource({ codec, ...quality });
  output.addVideoTrack(source, { frameRate: fps });
  await output.start();
  try {
    const frames = compose
      ? filmFrames(viewer, { ...options, background: 'transparent' }, 'straight')
      : filmFrames(viewer, options, 'opaque');
    for await (const frame of frames) {
      if (compose) {
        await compose(frame);
        options.signal?.throwIfAborted();
        ontoBlack(frame.data);
      }
      onFrame?.(frame);
      const sample = new VideoSample(frame.data, {
        format: 'RGBX',
        codedWidth: width,
        codedHeight: height,
        timestamp: frame.seconds,
        duration: 1 / fps,
      });
      try {
        await source.add(sample);
      } finally {
        sample.close();
      }
    }
    await output.finalize();
  } catch (error) {
    if (output.state !== 'finalized') await output.cancel();
    throw error;
  }
  return new Blob([target.buffer as ArrayBuffer], { type });
}
