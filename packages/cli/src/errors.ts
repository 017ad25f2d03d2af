import { GlanzError } from '@glanz/scene';
import { visible } from './visible';

/**
 * Thrown for errors that the user can correct. Codes: `cli/usage` (unknown option, impossible value), `cli/input` (a
 * file that cannot be read), `cli/output` (a file that cannot be written), `cli/camera` (no such camera), `cli/batch`
 * (an invalid batch file), `cli/checkpoint` (a file that cannot be resumed), `cli/film` (a file that cannot be
 * merged), `cli/gpu-isolation` (GPUs of one name that cannot be distinguished), `cli/gpu-lost` (a GPU that cannot be
 * recovered), `cli/farm` (a job of another version), `cli/missing-package` (an optional package is needed),
 * `cli/ffmpeg` (a video that ffmpeg cannot encode, or ffmpeg is missing), `cli/port` (a port that cannot be used).
 */
export class CliError extends GlanzError {}

/** Exit statuses of the process, as in the manual page. */
export const EXIT = {
  ok: 0,
  failure: 1,
  usage: 2,
  input: 3,
  output: 4,
  gpu: 5,
  internal: 70,
  hangup: 129,
  interrupted: 130,
  terminated: 143,
} as const;

/** Exit statuses after a signal. */
export const EXIT_OF_INTERRUPT = { SIGINT: EXIT.interrupted, SIGTERM: EXIT.terminated, SIGHUP: EXIT.hangup } as const;

const GPU_CODES = new Set([
  'renderer/no-webgpu',
  'renderer/no-adapter',
  'renderer/no-device',
  'renderer/no-gpu',
  'renderer/gpu-not-found',
  'renderer/device-lost',
  'cli/gpu-lost',
  'cli/gpu-isolation',
]);

/** The exit code that belongs to an error. */
export function exitCodeOf(error: unknown): number {
  if (!(error instanceof GlanzError)) return EXIT.internal;
  const { code } = error;
  if (
    code === 'cli/usage' ||
    code === 'cli/camera' ||
    code === 'cli/batch' ||
    code === 'cli/port' ||
    code === 'farm/option' ||
    code === 'renderer/size' ||
    code === 'renderer/camera'
  )
    return EXIT.usage;
  if (code === 'cli/output') return EXIT.output;
  if (GPU_CODES.has(code)) return EXIT.gpu;
  if (
    /^(cli\/input|cli\/checkpoint|cli\/film|gltf\/|scene\/|image\/|formats\/|cad\/|renderer\/no-triangles)/.test(code)
  )
    return EXIT.input;
  return EXIT.failure;
}

const oneLine = (text: string) => visible(text.replace(/\s*\n\s*/g, ' '));

/** The error as one line of text. Control characters, such as in names of files, are made visible. */
export function errorLine(error: unknown): string {
  if (error instanceof GlanzError) return `${oneLine(error.message)} [${error.code}]`;
  const message = error instanceof Error ? error.message : String(error);
  return `internal error: ${oneLine(message)} — please report this; GLANZ_DEBUG=1 shows where it happened.`;
}

/** The error as `--json` prints it. */
export function describeError(error: unknown): {
  readonly code: string;
  readonly message: string;
  readonly location?: unknown;
} {
  if (error instanceof GlanzError)
    return { code: error.code, message: error.message, ...(error.location ? { location: error.location } : {}) };
  return { code: 'cli/internal', message: error instanceof Error ? error.message : String(error) };
}
