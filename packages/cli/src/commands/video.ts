import { mkdir, rm, rmdir } from 'node:fs/promises';
import { dirname, join, resolve } from 'node:path';
import type { Backend } from '../backend';
import { CliError } from '../errors';
import { isEnvironmentFile } from '../environment';
import { checkInput } from '../input';
import type { CliIo } from '../io';
import { number, OPTIONS, parseOptionsOf, renderOptions, usage } from '../options';
import type { RenderCommandOptions, ReportOptions } from '../options';
import { formatOf } from '../output/formats';
import { checkWritable } from '../output/write';
import { duration, type ProgressReporter } from '../progress';
import { JOURNAL } from '../render/journal';
import type { BatchResult } from '../render/results';
import { SceneLoader } from '../render/scene';
import type { FrameMotion, Shot } from '../render/shots';
import {
  checkFfmpeg,
  codecsOf,
  containerOf,
  defaultCrf,
  encodeVideo,
  maxCrf,
  VIDEO_CODECS,
  type VideoCodec,
  type VideoTarget,
} from '../output/ffmpeg';
import type { View } from '../views';
import { exitOf, gpusOf, interruptible, renderMany } from './render';

/** What `glanz video` takes beside the options of `glanz render`. */
const VIDEO_OPTIONS = {
  ...OPTIONS,
  seconds: { type: 'string' },
  fps: { type: 'string' },
  degrees: { type: 'string' },
  shutter: { type: 'string' },
  'shutter-times': { type: 'string' },
  codec: { type: 'string' },
  crf: { type: 'string' },
  frames: { type: 'string' },
  ffmpeg: { type: 'string' },
} as const;

/** Options of `glanz render` that say nothing about a video, with what does. */
const REFUSED: Partial<Record<keyof typeof OPTIONS, string>> = {
  turntable: 'a video turns by --degrees, with --elevation',
  view: 'a video has one camera: give --camera, or --degrees',
  time: 'a video begins at the start of its --animation',
  batch: 'a video is one command',
  checkpoint: 'frames that are finished are kept: give --resume',
  'output-root': 'it belongs to --batch',
  'samples-from': 'frames are not merged',
  noise: 'the frames of a video have the same samples, so that its noise does not pulsate',
};

/** `glanz video`. */
export interface VideoCommand extends ReportOptions {
  readonly kind: 'video';
  readonly options: RenderCommandOptions;
  /** `undefined`: the frames alone. */
  readonly target: VideoTarget | undefined;
  /** Path of a frame, with {frame} for its number. */
  readonly frames: string;
  /** Whether frames are kept when the video is finished. */
  readonly keepFrames: boolean;
  /** `undefined`: as long as the animation. */
  readonly seconds: number | undefined;
  readonly motion: Omit<FrameMotion, 'frame'>;
  /** Degrees that the camera goes around the model; `undefined`: it does not move. */
  readonly degrees: number | undefined;
  readonly elevation: number;
  readonly ffmpeg: string;
  readonly resume: boolean;
  readonly gpus: readonly string[];
}

const PLACE = '{frame}';
/** Seconds of a video without an animation. */
const SECONDS = 4;
const MAX_FRAMES = 100_000;

function targetOf(output: string, values: { codec?: string; crf?: string }, fps: number): VideoTarget | undefined {
  const container = containerOf(output);
  if (container === undefined) {
    if (values.codec !== undefined || values.crf !== undefined)
      throw usage(
        '--codec and --crf belong to videos: name a file that ends in .mp4, .mov, .webm or .mkv by --output.',
      );
    return undefined;
  }
  const codecs = codecsOf(container);
  const codec = (values.codec ?? codecs[0]) as VideoCodec;
  if (!VIDEO_CODECS.includes(codec)) throw usage(`--codec must be ${VIDEO_CODECS.join(', ')}, not "${codec}".`);
  if (!codecs.includes(codec)) throw usage(`A .${container} file supports ${codecs.join(', ')}, not --codec ${codec}.`);
  const crf = number('crf', values.crf, defaultCrf(codec), { whole: true, min: 0, max: maxCrf(codec) });
  return { path: output, container, codec, crf, fps };
}

/**
 * Reads the arguments behind `video`.
 *
 * @throws {CliError} `cli/usage`, with what to do about it.
 */
export function parseVideo(argv: readonly string[]): VideoCommand {
  const { values, positionals } = parseOptionsOf(argv, VIDEO_OPTIONS);
  const [model, ...rest] = positionals;
  if (model === undefined) throw usage('No model given. Use glanz video MODEL -o VIDEO.mp4.');
  if (rest.length > 0) throw usage(`One model at a time: unexpected argument "${rest[0]}".`);
  for (const [name, instead] of Object.entries(REFUSED))
    if (values[name as keyof typeof OPTIONS] !== undefined) throw usage(`--${name} is not for videos: ${instead}.`);
  if ((values.output?.length ?? 0) > 1) throw usage('A video is one file: give --output once.');
  if ((values.variant?.length ?? 0) > 1 || values.variant?.[0] === 'all')
    throw usage('A video shows one variant: give --variant once, with a name or a number.');
  const base = (model.split(/[\\/]/).pop() as string).replace(/\.(glb|gltf|obj|stl|usd[acz]?)$/i, '') || 'video';
  const output = values.output?.[0] ?? `${base}.mp4`;
  const fps = number('fps', values.fps, 30, { min: 0.01, max: 1000 });
  const target = targetOf(output, values, fps);
  if (!target && !output.includes(PLACE))
    throw usage(
      `--output "${output}": a video ends in .mp4, .mov, .webm or .mkv; images need a placeholder for their number: 'frames/{frame}.png'.`,
    );
  if (!target && values.frames !== undefined)
    throw usage('--frames is where the images of a video are kept; here --output says where they go.');
  const folder = values.frames ?? output.replace(/\.[^.]*$/, '.frames');
  const frames = target ? join(folder, `${PLACE}.png`) : output;
  const { elevation, ...shared } = values;
  const options = renderOptions({ ...shared, output: [frames.replaceAll(PLACE, '0')] }, model);
  if (target && (options.width % 2 !== 0 || options.height % 2 !== 0))
    throw usage(
      `--size ${options.width}x${options.height}: width and height of a video must be even, since its colours have half the resolution.`,
    );
  const { animation, time: _, ...pose } = options.pose;
  const degrees =
    values.degrees === undefined
      ? animation === undefined && values.camera === undefined
        ? 360
        : undefined
      : number('degrees', values.degrees, 0, { min: -36000, max: 36000 });
  if (degrees !== undefined && values.camera !== undefined)
    throw usage('--camera is fixed, and --degrees goes around the model: give one of the two.');
  if (degrees === undefined && elevation !== undefined) throw usage('--elevation belongs to --degrees.');
  const times =
    values['shutter-times'] === undefined
      ? undefined
      : number('shutter-times', values['shutter-times'], 0, { whole: true, min: 1, max: 65536 });
  return {
    kind: 'video',
    json: values.json ?? false,
    quiet: values.quiet ?? false,
    options: { ...options, pose },
    target,
    frames,
    keepFrames: values.frames !== undefined || !target,
    seconds:
      values.seconds === undefined
        ? animation === undefined
          ? SECONDS
          : undefined
        : number('seconds', values.seconds, 0, { min: 0.001, max: 86400 }),
    motion: { fps, shutter: number('shutter', values.shutter, 0, { min: 0, max: 1 }), times, animation },
    degrees,
    elevation: number('elevation', elevation, 20, { min: -89, max: 89 }),
    ffmpeg: values.ffmpeg ?? 'ffmpeg',
    resume: values.resume ?? false,
    gpus: values.gpu ?? [],
  };
}

/** What `--json` prints. */
export type VideoResult = Omit<BatchResult, 'images'> & {
  readonly model: string;
  /** Absent: numbered images were asked for, or the video could not be encoded yet. */
  readonly file?: string;
  readonly bytes?: number;
  readonly codec?: VideoCodec;
  readonly width: number;
  readonly height: number;
  readonly fps: number;
  readonly seconds: number;
  /** The images, where they are kept. */
  readonly frames?: readonly string[];
};

/** The frames of a video, as images of their own. */
export function framesOf(command: VideoCommand, count: number): Shot[] {
  const { options, frames, motion, degrees, elevation } = command;
  const digits = Math.max(4, String(count - 1).length);
  return Array.from({ length: count }, (_, frame): Shot => {
    const number = String(frame).padStart(digits, '0');
    const view: View =
      degrees === undefined
        ? (options.views[0] as View)
        : { kind: 'turntable', name: `frame-${number}`, step: frame, count, elevation, degrees };
    const [target] = options.outputs;
    return {
      options,
      variant: options.variants[0],
      view,
      outputs: [{ ...formatOf(frames.replaceAll(PLACE, number)), bits: (target as Shot['outputs'][number]).bits }],
      checkpoint: undefined,
      motion: { ...motion, frame },
    };
  });
}

/** The animation's duration. @throws {CliError} `cli/usage` where the model does not have it */
async function secondsOf(command: VideoCommand, loader: SceneLoader, signal: AbortSignal): Promise<number> {
  const { animation } = command.motion;
  if (animation === undefined) return command.seconds as number;
  const { animations = [] } = (await loader.load(command.options, signal)).scene;
  const found = animations.find(({ name }, index) => name === animation || index === animation);
  if (!found)
    throw new CliError(
      'cli/usage',
      `--animation: the model has no animation "${animation}"; it has ${animations.map(({ name }) => `"${name}"`).join(', ') || 'none'}.`,
    );
  return command.seconds ?? (found.duration || 1);
}

/** `glanz video`: renders the frames of a video, and has ffmpeg encode them. */
export async function videoCommand(
  command: VideoCommand,
  io: CliIo,
  backend: Backend,
  progress: ProgressReporter,
): Promise<{ readonly result: VideoResult | undefined; readonly exitCode: number }> {
  return interruptible<VideoResult>(io, backend, progress, async (run) => {
    run.many = true;
    const { options, target, ffmpeg, motion, resume } = command;
    const { width, height, model, env } = options;
    const start = io.now();
    await checkInput(model, io.cwd, 'the model');
    if (isEnvironmentFile(env)) await checkInput(env, io.cwd, 'the environment');
    if (target) {
      await checkWritable(target.path, io.cwd);
      await checkFfmpeg(ffmpeg, target);
    }
    const loader = new SceneLoader(backend, io.cwd);
    if (motion.animation !== undefined) progress.stage('load model');
    const seconds = await secondsOf(command, loader, run.signal);
    const count = Math.max(1, Math.round(seconds * motion.fps));
    if (count > MAX_FRAMES) throw usage(`A video has at most ${MAX_FRAMES} frames, not ${count}.`);
    const shots = framesOf(command, count);
    const paths = shots.map(({ outputs }) => (outputs[0] as Shot['outputs'][number]).path);
    const folder = dirname(resolve(io.cwd, paths[0] as string));
    await mkdir(folder, { recursive: true }).catch(() => undefined);
    await checkWritable(paths[0] as string, io.cwd);
    const gpus = await gpusOf(command, backend);
    const { result: rendered, exitCode } = await renderMany(shots, { gpus, resume }, loader, run);
    const { images: _, ...totals } = rendered;
    const result = { ...totals, model, width, height, fps: motion.fps, seconds: count / motion.fps };
    const kept = { ...result, frames: paths };
    if (!target || !rendered.ok) return { result: { ...kept, totalMs: io.now() - start }, exitCode };
    const bytes = await encodeVideo(ffmpeg, paths, target, io.cwd, {
      signal: run.signal,
      onFrame: (index) => progress.stage('encode', index / count),
    });
    progress.line(
      `${target.path}: ${width}×${height}, ${count} frames at ${motion.fps}/s, ${target.codec}, ${(bytes / 1e6).toFixed(1)} MB, ${duration(io.now() - start)} in all`,
    );
    if (!command.keepFrames) await removeFrames(folder, paths, io.cwd);
    const video = { file: target.path, bytes, codec: target.codec, totalMs: io.now() - start };
    return { result: { ...(command.keepFrames ? kept : result), ...video }, exitCode: exitOf(run) };
  });
}

/** Deletes the images of a video, and their folder unless other files are in it. */
async function removeFrames(folder: string, paths: readonly string[], cwd: string): Promise<void> {
  for (const path of paths) await rm(resolve(cwd, path), { force: true });
  await rm(join(folder, JOURNAL), { force: true });
  await rmdir(folder).catch(() => undefined);
}
