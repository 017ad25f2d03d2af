import { execFile } from 'node:child_process';
import { promisify } from 'node:util';
import { CliError } from '../errors';

/** Binds /dev/null over its arguments up to `--`, and becomes the command after that. */
const HIDE = 'while [ "$1" != -- ]; do mount --bind /dev/null "$1" || exit 125; shift; done; shift; exec "$@"';

/**
 * What to write before a command so that its process, and those that it starts, find /dev/null in the place of files:
 * `unshare` of util-linux gives it a mount namespace of its own, which needs root, or user namespaces. The process keeps
 * its number, its streams and its signals.
 */
export function hiding(files: readonly string[]): string[] {
  if (files.length === 0) return [];
  const asRoot = process.getuid?.() === 0;
  return ['unshare', ...(asRoot ? [] : ['--map-root-user']), '--mount', 'sh', '-c', HIDE, 'sh', ...files, '--'];
}

/**
 * Tries {@link hiding}.
 *
 * @throws {CliError} `cli/gpu-isolation` where it is not allowed
 */
export async function checkHiding(files: readonly string[]): Promise<void> {
  const [program, ...args] = hiding(files);
  if (program === undefined) return;
  try {
    await promisify(execFile)(program, [...args, 'true'], { timeout: 10_000 });
  } catch (cause) {
    const { stderr = '', message } = cause as Error & { stderr?: string };
    const why = (stderr.trim() || message).split('\n').at(-1) as string;
    throw new CliError(
      'cli/gpu-isolation',
      `GPUs of one name are distinguished by hiding the others (${files.join(', ')}) from a process, which is not allowed here: ${why}. Run it as root, allow user namespaces, or start a container for each GPU (docker run --gpus device=0 …) and glanz in it without --gpu.`,
      { cause },
    );
  }
}
