import { mkdir } from 'node:fs/promises';
import { dirname, resolve } from 'node:path';
import type { Backend, RenderStatistics } from '../backend';
import { checkBatchOutputs, readBatch } from '../batch-file';
import { CliError, describeError, errorLine, EXIT, EXIT_OF_INTERRUPT, exitCodeOf } from '../errors';
import { isEnvironmentFile } from '../environment';
import { checkInput } from '../input';
import type { CliIo, Interrupt } from '../io';
import type { RenderCommand, RenderCommandOptions } from '../options';
import { checkWritable, type WrittenFile } from '../output/write';
import { duration, type ProgressReporter } from '../progress';
import { Journal } from '../render/journal';
import { GpuGoneError } from '../render/gpu';
import { Lane, type RenderedShot, type RenderTimings } from '../render/lane';
import { JobQueue, type Job } from '../render/queue';
import { SceneLoader } from '../render/scene';
import { checkDistinct, shotLabel, shotsOf, type Shot } from '../render/shots';
import { version } from '../version';

export type { RenderTimings } from '../render/lane';

/** What `--json` prints for one image. */
export interface RenderResult {
  readonly ok: true;
  readonly version: string;
  readonly model: string;
  readonly files: readonly WrittenFile[];
  readonly width: number;
  readonly height: number;
  /** Paths per pixel in the image. */
  readonly samples: number;
  readonly targetSamples: number;
  /** Those of them that a checkpoint brought along. */
  readonly resumedSamples: number;
  /** How often the GPU was lost while it was made; its pixels do not depend on that. */
  readonly gpuLosses: number;
  /** Relative error of the image when it was last looked at; only with `--noise`. */
  readonly noise?: number;
  readonly samplesPerSecond: number;
  /** The signal that ended it early, if one did. */
  readonly interrupted: Interrupt | null;
  readonly depth: number;
  readonly seed: number;
  readonly variant?: string;
  readonly view?: string;
  readonly camera: string;
  readonly environment: string;
  readonly adapter: { readonly name: string; readonly software: boolean };
  readonly timings: RenderTimings;
  readonly statistics: RenderStatistics;
  readonly warnings: readonly string[];
}

/** An image that could not be made. */
export interface FailedImage {
  readonly ok: false;
  readonly model: string;
  readonly files: readonly string[];
  readonly variant?: string;
  readonly view?: string;
  readonly error: { readonly code: string; readonly message: string };
}

/** A GPU that was lost and not recovered, or never found. */
export interface LostGpu {
  readonly gpu: string;
  readonly error: { readonly code: string; readonly message: string };
}

/** What `--json` prints for several images. */
export interface BatchResult {
  /** Whether every image is there. */
  readonly ok: boolean;
  readonly version: string;
  /** Those of this run, in the order they were finished. */
  readonly images: readonly (RenderResult | FailedImage)[];
  readonly total: number;
  /** Finished by an earlier run, with `--resume`. */
  readonly skipped: number;
  readonly failed: number;
  /** GPUs that were lost and not recovered; the others, if any, have taken over their images. */
  readonly gpusLost: readonly LostGpu[];
  readonly interrupted: Interrupt | null;
  readonly totalMs: number;
}

/** A result and what the process should end with. */
export interface RenderOutcome {
  /** `undefined` if it was interrupted before there was anything to write. */
  readonly result: RenderResult | BatchResult | undefined;
  readonly exitCode: number;
}

/** `glanz render`: loads, prepares, renders, writes; one image or many. */
export async function renderCommand(
  command: RenderCommand,
  io: CliIo,
  backend: Backend,
  progress: ProgressReporter,
): Promise<RenderOutcome> {
  const abort = new AbortController();
  const run: Run = { io, backend, progress, signal: abort.signal, interrupted: null };
  const stopListening = io.onInterrupt((signal) => {
    run.interrupted = signal;
    progress.line(
      signal === 'SIGINT'
        ? `stopping${run.many ? '' : ': writing what there is'} (Ctrl-C again to end at once)`
        : `stopping${run.many ? '' : ': writing what there is'}`,
    );
    abort.abort();
  });
  try {
    const loader = new SceneLoader(backend, io.cwd);
    const warned = new Set<string>();
    const warn = (text: string) => {
      if (!warned.has(text)) progress.warning(text);
      warned.add(text);
    };
    for (const text of command.warnings) warn(text);
    const requests =
      command.batch === undefined
        ? [{ options: command.options as RenderCommandOptions, ownOutput: false, where: '' }]
        : await readBatch(command.batch, io.cwd, command.values, warn);
    for (const {
      options: { model, env },
    } of requests) {
      await checkInput(model, io.cwd, 'the model');
      if (isEnvironmentFile(env)) await checkInput(env, io.cwd, 'the environment');
    }
    const shots: Shot[] = [];
    for (const request of requests) {
      const { options } = request;
      const asked = shotsOf(
        options,
        options.variants.includes('all') ? await variantsOf(options, loader, run) : [],
        command.checkpoint,
      );
      if (command.batch !== undefined && request.ownOutput)
        await checkBatchOutputs(
          asked.flatMap(({ outputs }) => outputs.map(({ path }) => path)),
          request,
          command.batch,
          io.cwd,
          command.outputRoot,
        );
      shots.push(...asked);
    }
    checkDistinct(shots);
    run.many = command.batch !== undefined || shots.length > 1;
    for (const { outputs, checkpoint } of shots) {
      for (const path of [...outputs.map((target) => target.path), ...(checkpoint === undefined ? [] : [checkpoint])]) {
        if (run.many) await mkdir(dirname(resolve(io.cwd, path)), { recursive: true }).catch(() => undefined);
        await checkWritable(path, io.cwd);
      }
    }
    return run.many
      ? await renderMany(shots, command, loader, run)
      : await renderOne(shots[0] as Shot, command, loader, run);
  } catch (error) {
    // An abort that a stage answered by throwing is the user's wish, not a fault.
    if (run.interrupted !== null && abort.signal.aborted && (error as Error | undefined)?.name === 'AbortError') {
      progress.line('no image written.');
      return { result: undefined, exitCode: exitOf(run) };
    }
    throw error;
  } finally {
    stopListening();
    progress.clear();
  }
}

interface Run {
  readonly io: CliIo;
  readonly backend: Backend;
  readonly progress: ProgressReporter;
  readonly signal: AbortSignal;
  interrupted: Interrupt | null;
  many?: boolean;
}

const exitOf = ({ interrupted }: Run) => (interrupted === null ? EXIT.ok : EXIT_OF_INTERRUPT[interrupted]);

async function variantsOf(
  options: RenderCommandOptions,
  loader: SceneLoader,
  { progress, signal }: Run,
): Promise<readonly string[]> {
  progress.stage('load model');
  const { variants = [] } = (await loader.load(options, signal)).scene;
  if (variants.length === 0) throw new CliError('cli/usage', `--variant all: "${options.model}" has no variants.`);
  return variants;
}

const named = ({ variant, view }: Shot) => ({
  ...(variant === undefined ? {} : { variant }),
  ...(view.kind === 'camera' && view.camera === undefined ? {} : { view: view.name }),
});

const resultOf = (shot: Shot, made: RenderedShot, interrupted: Interrupt | null): RenderResult => {
  const { options } = shot;
  const {
    files,
    samples,
    resumedSamples,
    gpuLosses,
    noise,
    samplesPerSecond,
    camera,
    environment,
    adapter,
    timings,
    statistics,
    warnings,
  } = made;
  return {
    ok: true,
    version: version(),
    model: options.model,
    files,
    width: options.width,
    height: options.height,
    samples,
    targetSamples: options.settings.samples,
    resumedSamples,
    gpuLosses,
    ...(noise === undefined ? {} : { noise }),
    samplesPerSecond,
    interrupted,
    depth: options.settings.maxDepth,
    seed: options.settings.seed,
    ...named(shot),
    camera,
    environment,
    adapter,
    timings,
    statistics,
    warnings,
  };
};

async function renderOne(shot: Shot, { gpus }: RenderCommand, loader: SceneLoader, run: Run): Promise<RenderOutcome> {
  const lane = new Lane({ ...run, loader, keepPartial: true }, gpus[0]);
  try {
    const made = await lane.render({ shot, lostGpus: 0 });
    if (made) return { result: resultOf(shot, made, run.interrupted), exitCode: exitOf(run) };
    run.progress.line('nothing has been accumulated yet; no file written.');
    return { result: undefined, exitCode: exitOf(run) || EXIT.failure };
  } finally {
    lane.close();
  }
}

/** Each GPU takes the next image when it is done with one. What fails is reported, and the others continue. */
async function renderMany(
  shots: readonly Shot[],
  { gpus, resume }: RenderCommand,
  loader: SceneLoader,
  run: Run,
): Promise<RenderOutcome> {
  const { io, progress } = run;
  const start = io.now();
  const journal = new Journal(io.cwd);
  const waiting: Shot[] = [];
  for (const shot of shots) if (!resume || !(await journal.isDone(shot))) waiting.push(shot);
  const skipped = shots.length - waiting.length;
  if (skipped > 0) progress.line(`${skipped} of ${shots.length} images are there already.`);
  const batch = new Batch(waiting, skipped, journal, run);
  const names: readonly (string | undefined)[] = gpus.length === 0 ? [undefined] : gpus;
  progress.shared = names.length > 1;
  // Loaders keep the last model, which lanes would take from one another.
  await batch.run(
    names.map(
      (name) =>
        new Lane(
          { ...run, loader: names.length > 1 ? new SceneLoader(run.backend, io.cwd) : loader, keepPartial: false },
          name,
        ),
    ),
  );
  progress.prefix = '';
  const { images, exitCode, gpusLost } = batch;
  const failed = images.filter(({ ok }) => !ok).length;
  const missing = waiting.length - images.length;
  progress.line(
    `${shots.length - failed - missing} of ${shots.length} images in ${duration(io.now() - start)}${failed > 0 ? `, ${failed} failed` : ''}${missing > 0 ? '; --resume continues' : ''}`,
  );
  return {
    result: {
      ok: failed === 0 && missing === 0,
      version: version(),
      images,
      total: shots.length,
      skipped,
      failed,
      gpusLost,
      interrupted: run.interrupted,
      totalMs: io.now() - start,
    },
    exitCode: exitOf(run) || exitCode,
  };
}

/** The images of a run, shared out among lanes. */
class Batch {
  readonly images: (RenderResult | FailedImage)[] = [];
  readonly gpusLost: LostGpu[] = [];
  /** That of the first failure. */
  exitCode = 0;
  readonly #queue: JobQueue;
  readonly #total: number;
  readonly #journal: Journal;
  readonly #run: Run;
  #begun: number;
  #lanes = 0;
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
   * Makes all images. Lanes whose GPU is gone leave their work to the others; without any lane the rest fails.
   * @throws the error of the first lane if none has ever had a GPU, and faults of our own.
   */
  async run(lanes: readonly Lane[]): Promise<void> {
    const { signal } = this.#run;
    const stop = () => this.#queue.close();
    signal.addEventListener('abort', stop);
    if (signal.aborted) stop();
    this.#lanes = lanes.length;
    try {
      await Promise.all(lanes.map((lane) => this.#work(lane)));
    } finally {
      signal.removeEventListener('abort', stop);
      for (const lane of lanes) lane.close();
    }
    if (this.#fatal) throw this.#fatal.error;
    if (this.#causes.length === 0 || signal.aborted) return;
    const rest = this.#queue.rest();
    // No image was begun: the requested GPUs do not exist.
    if (this.images.length === 0 && lanes.every(({ everOpened }) => !everOpened)) throw this.#causes[0];
    const reasons = this.gpusLost.map(({ error }) => error.message).join(' ');
    for (const { shot } of rest)
      this.#fail(shot, new CliError('cli/gpu-lost', `No GPU is left to render it. ${reasons}`), false);
  }

  async #work(lane: Lane): Promise<void> {
    const { progress, signal } = this.#run;
    let unlucky = false;
    for (let job = await this.#queue.take(); job; job = await this.#queue.take()) {
      const { shot } = job;
      progress.prefix = `[${Math.min(++this.#begun, this.#total)}/${this.#total}] `;
      try {
        const made = await lane.render(job);
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
          this.#leave(lane, job, error);
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
    return job.lostGpus > 1 || (this.#lanes === 1 && !unlucky);
  }

  /** A lane ends and returns its image to the queue, with the samples so far. */
  #leave(lane: Lane, job: Job, error: unknown): void {
    this.#lanes--;
    this.gpusLost.push({ gpu: lane.label, error: describeError(error) });
    this.#causes.push(error);
    this.#run.progress.warning(`${errorLine(error)}${this.#lanes > 0 ? ' The other GPUs take over its images.' : ''}`);
    if (this.#lanes > 0 || !lane.everOpened) this.#queue.giveBack(job);
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
      ...named(shot),
      error: describeError(error),
    });
  }
}
