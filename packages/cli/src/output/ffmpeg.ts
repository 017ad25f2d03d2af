import { spawn } from 'node:child_process';
import { once } from 'node:events';
import { readFile, rename, rm, stat } from 'node:fs/promises';
import { resolve } from 'node:path';
import { CliError } from '../errors';

/** Codecs of videos, by the names that `--codec` knows. */
const CODECS = {
  h264: { encoder: 'libx264', crf: 18, max: 51, more: ['-preset', 'slow'] },
  h265: { encoder: 'libx265', crf: 22, max: 51, more: ['-preset', 'slow', '-tag:v', 'hvc1'] },
  vp9: { encoder: 'libvpx-vp9', crf: 24, max: 63, more: ['-b:v', '0', '-row-mt', '1'] },
  av1: { encoder: 'libsvtav1', crf: 28, max: 63, more: [] },
} as const;

/** A codec that `--codec` knows. */
export type VideoCodec = keyof typeof CODECS;
export const VIDEO_CODECS = Object.keys(CODECS) as VideoCodec[];
/** The largest `--crf` of a codec. */
export const maxCrf = (codec: VideoCodec): number => CODECS[codec].max;

/** Containers by the endings of their files: ffmpeg's names, and the codecs that they may hold, the default first. */
const CONTAINERS = {
  mp4: { muxer: 'mp4', codecs: ['h264', 'h265', 'av1', 'vp9'], more: ['-movflags', '+faststart'] },
  mov: { muxer: 'mov', codecs: ['h264', 'h265'], more: ['-movflags', '+faststart'] },
  webm: { muxer: 'webm', codecs: ['vp9', 'av1'], more: [] },
  mkv: { muxer: 'matroska', codecs: ['h264', 'h265', 'av1', 'vp9'], more: [] },
} as const satisfies Record<string, { muxer: string; codecs: readonly VideoCodec[]; more: readonly string[] }>;

/** A video to encode, and how. */
export interface VideoTarget {
  /** As the user gave it. */
  readonly path: string;
  readonly container: keyof typeof CONTAINERS;
  readonly codec: VideoCodec;
  /** Constant rate factor: the higher, the smaller the file and the worse the image. */
  readonly crf: number;
  readonly fps: number;
}

/** The container that a file's ending asks for; `undefined`: it is no video. */
export function containerOf(path: string): VideoTarget['container'] | undefined {
  const ending = /\.([a-z0-9]+)$/i.exec(path)?.[1]?.toLowerCase() ?? '';
  return Object.hasOwn(CONTAINERS, ending) ? (ending as VideoTarget['container']) : undefined;
}

/** The codecs that a container may hold, its default first. */
export const codecsOf = (container: VideoTarget['container']): readonly VideoCodec[] => CONTAINERS[container].codecs;
/** The constant rate factor of a codec that is hard to tell from the original. */
export const defaultCrf = (codec: VideoCodec): number => CODECS[codec].crf;

/** ffmpeg's arguments: PNG files on stdin, a file at `output`. */
export function ffmpegArguments({ container, codec, crf, fps }: VideoTarget, output: string): string[] {
  const { encoder, more } = CODECS[codec];
  // Players expect BT.709, in a limited range, with colour at half the resolution.
  const convert = ['-vf', 'scale=in_range=full:out_range=limited:out_color_matrix=bt709', '-pix_fmt', 'yuv420p'];
  const tags = [
    '-colorspace',
    'bt709',
    '-color_primaries',
    'bt709',
    '-color_trc',
    'iec61966-2-1',
    '-color_range',
    'tv',
  ];
  return [
    ['-hide_banner', '-loglevel', 'error', '-y'],
    ['-f', 'image2pipe', '-c:v', 'png', '-framerate', String(fps), '-i', 'pipe:0'],
    ['-c:v', encoder, '-crf', String(crf), ...more],
    convert,
    tags,
    CONTAINERS[container].more,
    ['-f', CONTAINERS[container].muxer, output],
  ].flat();
}

const missing = (program: string, cause: unknown) =>
  new CliError(
    'cli/ffmpeg',
    `Videos need ffmpeg, and "${program}" cannot be run (${(cause as NodeJS.ErrnoException).code ?? String(cause)}): install it (apt install ffmpeg, brew install ffmpeg, winget install ffmpeg), name it with --ffmpeg PATH, or write numbered images instead: -o 'frames/{frame}.png'.`,
    { cause },
  );

interface Ended {
  readonly code: number | null;
  readonly signal: NodeJS.Signals | null;
  readonly stdout: string;
  readonly stderr: string;
}

/** Runs a program to its end. @param feed Writes its stdin. @throws {CliError} `cli/ffmpeg` where it cannot be started */
async function runProgram(
  program: string,
  args: readonly string[],
  stop: AbortSignal | undefined,
  feed: (write: (bytes: Uint8Array) => Promise<boolean>) => Promise<void>,
): Promise<Ended> {
  const child = spawn(program, args, { stdio: 'pipe' });
  const end = () => void child.kill('SIGKILL');
  stop?.addEventListener('abort', end);
  try {
    let [stdout, stderr] = ['', ''];
    child.stdout.setEncoding('utf8').on('data', (text: string) => (stdout += text));
    child.stderr.setEncoding('utf8').on('data', (text: string) => (stderr += text));
    // A program that ends early closes its stdin: its exit status says why.
    let closed = false;
    child.stdin.on('error', () => (closed = true)).on('close', () => (closed = true));
    const ended = new Promise<Ended>((resolve, reject) => {
      child.on('error', (cause) => reject(missing(program, cause)));
      child.on('close', (code, signal) => resolve({ code, signal, stdout, stderr }));
    });
    ended.catch(() => undefined);
    const over = ended.then(
      () => undefined,
      () => undefined,
    );
    await feed(async (bytes) => {
      if (closed) return false;
      if (!child.stdin.write(bytes)) await Promise.race([once(child.stdin, 'drain').catch(() => undefined), over]);
      return !closed;
    });
    child.stdin.end();
    return await ended;
  } finally {
    stop?.removeEventListener('abort', end);
  }
}

/**
 * Makes sure, before hours of rendering, that ffmpeg is there and can encode.
 * @param program A path, or a name that is looked for in PATH.
 * @throws {CliError} `cli/ffmpeg`
 */
export async function checkFfmpeg(program: string, { codec }: Pick<VideoTarget, 'codec'>): Promise<void> {
  const { code, stdout } = await runProgram(program, ['-hide_banner', '-encoders'], undefined, async () => undefined);
  const { encoder } = CODECS[codec];
  if (code !== 0) throw missing(program, `exit status ${code}`);
  if (!new RegExp(`\\b${encoder}\\b`).test(stdout))
    throw new CliError(
      'cli/ffmpeg',
      `"${program}" has no encoder ${encoder}, which --codec ${codec} needs: choose another --codec, or a build of ffmpeg that has it.`,
    );
}

/**
 * Encodes PNG files as a video, which appears whole or not at all.
 *
 * @param frames Paths of the files, in their order.
 * @returns The video's size in bytes.
 * @throws {CliError} `cli/ffmpeg`; `cli/output` where the video cannot be put in its place
 * @throws the signal's reason
 */
export async function encodeVideo(
  program: string,
  frames: readonly string[],
  target: VideoTarget,
  cwd: string,
  { signal, onFrame }: { readonly signal: AbortSignal; readonly onFrame: (index: number) => void },
): Promise<number> {
  const file = resolve(cwd, target.path);
  const partial = `${file}.${process.pid}.partial`;
  try {
    const {
      code,
      signal: killed,
      stderr,
    } = await runProgram(program, ffmpegArguments(target, partial), signal, async (write) => {
      for (const [index, frame] of frames.entries()) {
        onFrame(index);
        if (signal.aborted || !(await write(await readFile(resolve(cwd, frame))))) return;
      }
    });
    signal.throwIfAborted();
    if (code !== 0)
      throw new CliError(
        'cli/ffmpeg',
        `ffmpeg could not encode "${target.path}" (${killed ?? `exit status ${code}`}): ${stderr.trim().split('\n').at(-1) || 'no message'}. The frames are kept: the same command with --resume encodes them again.`,
      );
    await rename(partial, file).catch((cause: unknown) => {
      throw new CliError('cli/output', `Cannot write "${target.path}": ${(cause as Error).message}.`, { cause });
    });
    return (await stat(file)).size;
  } finally {
    await rm(partial, { force: true });
  }
}
