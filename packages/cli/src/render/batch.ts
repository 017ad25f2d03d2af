import type { Backend } from '../backend';
import { CliError, describeError, errorLine, EXIT, exitCodeOf } from '../errors';
import type { CliIo, Interrupt } from '../io';
import type { ProgressReporter } from '../progress';
import { GpuGoneError } from './gpu';
import type { GpuWorker } from './gpu-worker';
import type { Journal } from './journal';
import { JobQueue, type Job } from './queue';
import { namesOf, resultOf, type FailedImage, type LostGpu, type RenderResult } from './results';
import { shotLabel, type Shot } from './shots';

/** A run of `glanz render`. */
export interface Run {
  readonly io: CliIo;
  readonly backend: Backend;
  readonly progress: ProgressReporter;
  readonly signal: AbortSignal;
  interrupted: Interrupt | null;
  many?: boolean;
}

/** The images of a run, distributed over GPUs. */
export class Batch {
  readonly images: (RenderResult | FailedImage)[] = [];
  readonly gpusLost: LostGpu[] = [];
  /** That of the first failure. */
  exitCode = 0;
  readonly #queue: JobQueue;
  readonly #total: number;
  readonly #journal: Journal;
  readonly #run: Run;
  #begun: number;
  #workers = 0;
  readonly #causes: unknown[] = [];
  #fatal: { readonly error: unknown } | undefined;

  constructor(shots: readonly Shot[], skipped: number, journal: Journal, run: Run) {
    this.#queue = new JobQueue(shots);
    this.#total = shots.length + skipped;
    this.#begun = skipped;
    this.#journal = journal;
    this.#run = run;
  }

  /**
   * Makes all images. Workers whose GPU is gone leave their work to the others; without any worker the rest fails.
   * @throws the error of the first worker if none has ever had a GPU, and faults of our own.
   */
  async run(workers: readonly GpuWorker[]): Promise<void> {
    const { signal } = this.#run;
    const stop = () => this.#queue.close();
    signal.addEventListener('abort', stop);
    if (signal.aborted) stop();
    this.#workers = workers.length;
    try {
      await Promise.all(workers.map((worker) => this.#work(worker)));
    } finally {
      signal.removeEventListener('abort', stop);
      for (const worker of workers) worker.close();
    }
    if (this.#fatal) throw this.#fatal.error;
    if (this.#causes.length === 0 || signal.aborted) return;
    const rest = this.#queue.rest();
    // No image was begun: the requested GPUs do not exist.
    if (this.images.length === 0 && workers.every(({ everOpened }) => !everOpened)) throw this.#causes[0];
    const reasons = this.gpusLost.map(({ error }) => error.message).join(' ');
    for (const { shot } of rest)
      this.#fail(shot, new CliError('cli/gpu-lost', `No GPU is left to render it. ${reasons}`), false);
  }

  async #work(worker: GpuWorker): Promise<void> {
    const { progress, signal } = this.#run;
    let unlucky = false;
    for (let job = await this.#queue.take(); job; job = await this.#queue.take()) {
      const { shot } = job;
      progress.prefix = `[${Math.min(++this.#begun, this.#total)}/${this.#total}] `;
      try {
        const made = await worker.render(job);
        if (made) {
          await this.#journal.done(shot, made.files);
          this.images.push(resultOf(shot, made, null));
        }
        unlucky = false;
      } catch (error) {
        const gone = exitCodeOf(error) === EXIT.gpu;
        if (signal.aborted) this.#queue.close();
        else if (exitCodeOf(error) === EXIT.internal) {
          // A bug: the next image fares no better.
          this.#fatal ??= { error };
          this.#queue.close();
        } else if (gone && !this.#blames(error, job, unlucky)) {
          this.#begun--;
          this.#leave(worker, job, error);
          return;
        } else this.#fail(shot, error);
        unlucky = gone;
      }
      this.#queue.done();
    }
  }

  /** Whether an image is to blame for the loss of a GPU that still gives devices, rather than the GPU. */
  #blames(error: unknown, job: Job, unlucky: boolean): boolean {
    if (!(error instanceof GpuGoneError) || !error.givesDevices) return false;
    job.lostGpus++;
    // Lost on two GPUs; or on the only one there is, unless the image before fared like this.
    return job.lostGpus > 1 || (this.#workers === 1 && !unlucky);
  }

  /** A worker ends and returns its image to the queue, with the samples so far. */
  #leave(worker: GpuWorker, job: Job, error: unknown): void {
    this.#workers--;
    this.gpusLost.push({ gpu: worker.label, error: describeError(error) });
    this.#causes.push(error);
    this.#run.progress.warning(
      `${errorLine(error)}${this.#workers > 0 ? ' The other GPUs take over its images.' : ''}`,
    );
    if (this.#workers > 0 || !worker.everOpened) this.#queue.giveBack(job);
    else {
      this.#fail(job.shot, error, false);
      this.#queue.done();
    }
  }

  #fail(shot: Shot, error: unknown, report = true): void {
    this.exitCode ||= exitCodeOf(error);
    if (report) this.#run.progress.warning(`${shotLabel(shot)}: ${errorLine(error)}`);
    this.images.push({
      ok: false,
      model: shot.options.model,
      files: shot.outputs.map(({ path }) => path),
      ...namesOf(shot),
      error: describeError(error),
    });
  }
}
