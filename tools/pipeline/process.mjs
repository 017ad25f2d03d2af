// Child processes: streamed to the terminal, or captured for a report.
import { spawn } from 'node:child_process';
import { existsSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';

/** The repository's root folder. */
export const root = fileURLToPath(new URL('../../', import.meta.url)).replace(/[\\/]$/, '');

/** A failure that is reported in one line, without a stack. */
export class TaskError extends Error {
  constructor(message, exitCode = 1) {
    super(message);
    this.name = 'TaskError';
    this.exitCode = exitCode;
  }
}

/** Ctrl-C goes to the whole process group: the children stop first, and we pass on how they ended. */
function passSignals(child) {
  const ignoreInterrupt = () => {};
  const terminate = () => child.kill('SIGTERM');
  process.on('SIGINT', ignoreInterrupt);
  process.on('SIGTERM', terminate);
  return () => {
    process.off('SIGINT', ignoreInterrupt);
    process.off('SIGTERM', terminate);
  };
}

const SIGNAL_CODES = { SIGINT: 130, SIGTERM: 143, SIGKILL: 137 };

/**
 * Runs a program with its output streaming through.
 *
 * @param options.stdout `'stderr'` sends its standard output to ours of errors, for steps that prepare a task whose own
 * standard output matters.
 * @returns the exit code; 128 + signal where a signal ended it.
 */
export function stream(command, args, { cwd = root, env = {}, stdout = 'inherit', shell = false } = {}) {
  return new Promise((resolve, reject) => {
    const child = spawn(command, args, {
      cwd,
      env: { ...process.env, ...env },
      stdio: ['inherit', stdout === 'stderr' ? 2 : 'inherit', 'inherit'],
      shell,
    });
    const release = passSignals(child);
    child.on('error', (error) => {
      release();
      reject(new TaskError(`${command}: cannot be started: ${error.message}`));
    });
    child.on('close', (code, signal) => {
      release();
      resolve(code ?? SIGNAL_CODES[signal] ?? 1);
    });
  });
}

/** Runs a program and returns what it printed: `{ code, output }`, both streams in the order they came. */
export function capture(command, args, { cwd = root, env = {}, timeoutMs = 600_000, shell = false } = {}) {
  return new Promise((resolve) => {
    const child = spawn(command, args, {
      cwd,
      env: { ...process.env, ...env },
      stdio: ['ignore', 'pipe', 'pipe'],
      shell,
    });
    const chunks = [];
    const timer = setTimeout(() => {
      chunks.push(Buffer.from(`\nended after ${timeoutMs / 1000} s without finishing\n`));
      child.kill('SIGKILL');
    }, timeoutMs);
    child.stdout.on('data', (chunk) => chunks.push(chunk));
    child.stderr.on('data', (chunk) => chunks.push(chunk));
    child.on('error', (error) => chunks.push(Buffer.from(`${command}: ${error.message}`)));
    child.on('close', (code) => {
      clearTimeout(timer);
      resolve({ code: code ?? 1, output: Buffer.concat(chunks).toString('utf8') });
    });
  });
}

/** Path of a script inside an installed package, to be run by this Node: no shell wrappers, no PATH. */
export function bin(packageName, script, from = root) {
  const path = join(from, 'node_modules', packageName, script);
  if (!existsSync(path))
    throw new TaskError(`${packageName} is not installed: run npm install, or npx -y pnpm@${PNPM_VERSION} install.`);
  return path;
}

/** The package manager of this workspace; run through npx, so that nobody needs to have it. */
export const PNPM_VERSION = '12.21.0';

/** Arguments for {@link stream} or {@link capture} that run pnpm. */
export function pnpm(args) {
  const windows = process.platform === 'win32';
  return { command: windows ? 'npx.cmd' : 'npx', args: ['-y', `pnpm@${PNPM_VERSION}`, ...args], shell: windows };
}

/** Runs `task`, turns what it throws into one line on stderr, and sets the exit code. */
export async function main(task) {
  try {
    const code = await task();
    if (typeof code === 'number') process.exitCode = code;
  } catch (error) {
    process.stderr.write(
      error instanceof TaskError ? `glanz: ${error.message}\n` : `glanz: ${error?.stack ?? error}\n`,
    );
    process.exitCode = error instanceof TaskError ? error.exitCode : 1;
  }
}
