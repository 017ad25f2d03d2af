import { spawn, type ChildProcess } from 'node:child_process';
import { FarmError } from '../error';
import type { FarmJob } from '../job';
import type { StoreAddress } from '../store/store';

/** What a worker sends to its renderer's process. */
export type ToRenderer =
  | {
      readonly type: 'job';
      readonly job: FarmJob;
      /** Of the store, for `openFarmStore`. */
      readonly store: StoreAddress;
      /** An empty folder for the files of the result. */
      readonly folder: string;
      /** Path of the samples when the job is returned to the queue; the file exists when the job starts again. */
      readonly checkpoint: string;
    }
  /** Stop, and keep the samples. */
  | { readonly type: 'stop' };

/** What a finished job has left in its folder. */
export interface RenderedFiles {
  /** Names of its files. */
  readonly files: readonly string[];
  /** SHA-256, hexadecimal, of files that were hashed while they were written; the store hashes the others. */
  readonly hashes?: Readonly<Record<string, string>>;
  /** What the renderer says of the job. */
  readonly info?: unknown;
}

/** What a renderer's process sends. */
export type FromRenderer =
  | { readonly type: 'progress'; readonly samples: number; readonly of: number }
  | ({ readonly type: 'done' } & RenderedFiles)
  | { readonly type: 'stopped' }
  | { readonly type: 'failed'; readonly kind: RendererFailure; readonly code: string; readonly message: string };

/**
 * What a failure means for the job: `gpu`, the GPU was lost, and another one may do it; `input`, it fails everywhere;
 * `output`, a file could not be written, which may change; `files`, the same of a file that only this job has, such as
 * its destination, or one of its files is missing; `other`.
 */
export type RendererFailure = 'gpu' | 'input' | 'output' | 'files' | 'other';

/** Why a job was not finished. */
export class RenderFailure extends Error {
  readonly kind: RendererFailure | 'crash';
  readonly code: string;

  /** @param kind `crash`: the process ended, or did not answer. */
  constructor(kind: RendererFailure | 'crash', code: string, message: string) {
    super(message);
    this.kind = kind;
    this.code = code;
  }
}

/** How a job ended, if it did not fail. */
export type RenderEnd = ({ readonly type: 'done' } & RenderedFiles) | { readonly type: 'stopped' };

/** Options of {@link RendererProcess}. */
export interface RendererProcessOptions {
  /** The script that renders, and its arguments. */
  readonly script: string;
  readonly args: readonly string[];
  /**
   * Written before the command, such as `['nice']`. The program must execute the command with its streams. Default:
   * none.
   */
  readonly prefix?: readonly string[] | undefined;
  readonly env?: Readonly<Record<string, string | undefined>> | undefined;
  /** Milliseconds without a message after which it counts as hung and is killed. Default: ten minutes. */
  readonly hangMs?: number | undefined;
}

const HANG_MS = 600_000;
/** Characters of what it prints that are kept. */
const KEPT = 16_384;

/** A process that renders one job after another. It is started when the first one comes, and again after it ended. */
export class RendererProcess {
  readonly #options: RendererProcessOptions;
  #child: ChildProcess | undefined;
  #printed = '';

  constructor(options: RendererProcessOptions) {
    this.#options = options;
  }

  /** The number of the process, while there is one. */
  get pid(): number | undefined {
    return this.#child?.pid;
  }

  /** What it has printed since the job began, the end of it. */
  get printed(): string {
    return this.#printed;
  }

  /**
   * Renders a job.
   *
   * @throws {RenderFailure}
   */
  run(
    request: Extract<ToRenderer, { readonly type: 'job' }>,
    onProgress: (samples: number, of: number) => void,
  ): Promise<RenderEnd> {
    const child = this.#started();
    this.#printed = '';
    return new Promise((done, fail) => {
      let timeout: NodeJS.Timeout;
      let hung = false;
      const restartTimeout = () => {
        clearTimeout(timeout);
        timeout = setTimeout(() => {
          hung = true;
          child.kill('SIGKILL');
        }, this.#options.hangMs ?? HANG_MS);
      };
      const end = () => {
        clearTimeout(timeout);
        child.off('message', onMessage);
        child.off('close', ended);
        child.off('error', broken);
      };
      const onMessage = (message: FromRenderer) => {
        restartTimeout();
        if (message.type === 'progress') return onProgress(message.samples, message.of);
        end();
        if (message.type === 'failed') fail(new RenderFailure(message.kind, message.code, message.message));
        else done(message);
      };
      const ended = (code: number | null, signal: string | null) => {
        end();
        this.#child = undefined;
        const how = hung ? 'did not respond and was killed' : `ended by ${signal ?? `exit status ${code}`}`;
        fail(new RenderFailure('crash', 'farm/renderer', `The renderer's process ${how}.`));
      };
      const broken = (cause: Error) => {
        end();
        this.#child = undefined;
        fail(new FarmError('farm/renderer', `The renderer cannot be started: ${cause.message}.`, { cause }));
      };
      child.on('message', onMessage);
      child.once('close', ended);
      child.once('error', broken);
      restartTimeout();
      // A process that has just ended emits 'close'.
      child.send(request, () => undefined);
    });
  }

  /** Requests that the process stops rendering and stores its samples. */
  stop(): void {
    this.#child?.send({ type: 'stop' } satisfies ToRenderer, () => undefined);
  }

  /** Ends the process at once. */
  kill(): void {
    this.#child?.kill('SIGKILL');
    this.#child = undefined;
  }

  #started(): ChildProcess {
    if (this.#child?.connected) return this.#child;
    const { script, args, prefix = [], env } = this.#options;
    // Without execArgv: flags of a debugger or a test runner are not for it.
    const [program, ...rest] = [...prefix, process.execPath, script, ...args];
    const child = spawn(program as string, rest, {
      stdio: ['ignore', 'pipe', 'pipe', 'ipc'],
      env: { ...process.env, ...env },
    });
    const append = (chunk: Buffer) => void (this.#printed = (this.#printed + chunk.toString()).slice(-KEPT));
    child.stdout?.on('data', append);
    child.stderr?.on('data', append);
    child.once('close', () => {
      if (this.#child === child) this.#child = undefined;
    });
    this.#child = child;
    return child;
  }
}
