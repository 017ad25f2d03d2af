import { mkdir } from 'node:fs/promises';
import { dirname, resolve } from 'node:path';
import type { Backend, RenderStatistics } from '../backend';
import { checkBatchOutputs, readBatch } from '../batch-file';
import { CliError, describeError, errorLine, EXIT, exitCodeOf } from '../errors';
import { isEnvironmentFile } from '../environment';
import { checkInput } from '../input';
import type { CliIo, Interrupt } from '../io';
import type { RenderCommand, RenderCommandOptions } from '../options';
import { checkWritable, type WrittenFile } from '../output/write';
import { duration, type ProgressReporter } from '../progress';
import { Journal } from '../render/journal';
import { Lane, type RenderedShot, type RenderTimings } from '../render/lane';
import { SceneLoader } from '../render/scene';
import { checkDistinct, shotLabel, shotsOf, type Shot } from '../render/shots';
import { version } from '../version';

export type { RenderTimings } from '../render/lane';

/** What `--json` prints for one picture. */
export interface RenderResult {
  readonly ok: true;
  readonly version: string;
  readonly model: string;
  readonly files: readonly WrittenFile[];
  readonly width: number;
  readonly height: number;
  /** Paths per pixel in the picture. */
  readonly samples: number;
  readonly targetSamples: number;
  /** Relative error of the picture when it was last looked at; only with `--noise`. */
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

/** A picture that could not be made. */
export interface FailedPicture {
  readonly ok: false;
  readonly model: string;
  readonly files: readonly string[];
  readonly variant?: string;
  readonly view?: string;
  readonly error: { readonly code: string; readonly message: string };
}

/** What `--json` prints for several pictures. */
export interface BatchResult {
  /** Whether every picture is there. */
  readonly ok: boolean;
  readonly version: string;
  /** Those of this run, in the order they were finished. */
  readonly pictures: readonly (RenderResult | FailedPicture)[];
  readonly total: number;
  /** Finished by an earlier run, with `--resume`. */
  readonly skipped: number;
  readonly failed: number;
  readonly interrupted: Interrupt | null;
  readonly totalMs: number;
}

/** A result and what the process should end with. */
export interface RenderOutcome {
  /** `undefined` if it was interrupted before there was anything to write. */
  readonly result: RenderResult | BatchResult | undefined;
  readonly exitCode: number;
}

/** `glanz render`: loads, prepares, renders, writes; one picture or many. */
export async function renderCommand(command: RenderCommand, io: CliIo, backend: Backend, progress: ProgressReporter): Promise<RenderOutcome> {
  const abort = new AbortController();
  const run: Run = { io, backend, progress, signal: abort.signal, interrupted: null };
  const stopListening = io.onInterrupt((signal) => {
    run.interrupted = signal;
    progress.line(signal === 'SIGINT' ? `stopping${run.many ? '' : ': writing what there is'} (Ctrl-C again to end at once)` : `stopping${run.many ? '' : ': writing what there is'}`);
    abort.abort();
  });
  try {
    const loader = new SceneLoader(backend, io.cwd);
    const requests = command.batch === undefined ? [{ options: command.options as RenderCommandOptions, ownOutput: false, where: '' }] : await readBatch(command.batch, io.cwd, command.values);
    for (const { options: { model, env } } of requests) {
      await checkInput(model, io.cwd, 'the model');
      if (isEnvironmentFile(env)) await checkInput(env, io.cwd, 'the environment');
    }
    const shots: Shot[] = [];
    for (const request of requests) {
      const { options } = request;
      const asked = shotsOf(options, options.variants.includes('all') ? await variantsOf(options, loader, run) : []);
      if (command.batch !== undefined && request.ownOutput) await checkBatchOutputs(asked.flatMap(({ outputs }) => outputs.map(({ path }) => path)), request, command.batch, io.cwd, command.outputRoot);
      shots.push(...asked);
    }
    checkDistinct(shots);
    run.many = command.batch !== undefined || shots.length > 1;
    for (const { outputs } of shots) {
      for (const { path } of outputs) {
        if (run.many) await mkdir(dirname(resolve(io.cwd, path)), { recursive: true }).catch(() => undefined);
        await checkWritable(path, io.cwd);
      }
    }
    return run.many ? await renderMany(shots, command, loader, run) : await renderOne(shots[0] as Shot, command, loader, run);
  } catch (error) {
    // An abort that a stage answered by throwing is the user's wish, not a fault.
    if (run.interrupted !== null && abort.signal.aborted && (error as Error | undefined)?.name === 'AbortError') {
      progress.line('nothing has been accumulated yet; no file written.');
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

const EXIT_OF_INTERRUPT = { SIGINT: EXIT.interrupted, SIGTERM: EXIT.terminated, SIGHUP: EXIT.hangup } as const;
const exitOf = ({ interrupted }: Run) => (interrupted === null ? EXIT.ok : EXIT_OF_INTERRUPT[interrupted]);

async function variantsOf(options: RenderCommandOptions, loader: SceneLoader, { progress, signal }: Run): Promise<readonly string[]> {
  progress.stage('load model');
  const { variants = [] } = (await loader.load(options, signal)).scene;
  if (variants.length === 0) throw new CliError('cli/usage', `--variant all: "${options.model}" has no variants.`);
  return variants;
}

const named = ({ variant, view }: Shot) => ({ ...(variant === undefined ? {} : { variant }), ...(view.kind === 'camera' && view.camera === undefined ? {} : { view: view.name }) });

const resultOf = (shot: Shot, made: RenderedShot, interrupted: Interrupt | null): RenderResult => {
  const { options } = shot;
  const { files, samples, noise, samplesPerSecond, camera, environment, adapter, timings, statistics, warnings } = made;
  return {
    ok: true, version: version(), model: options.model, files, width: options.width, height: options.height, samples, targetSamples: options.samples, ...(noise === undefined ? {} : { noise }), samplesPerSecond, interrupted,
    depth: options.depth, seed: options.seed, ...named(shot), camera, environment, adapter, timings, statistics, warnings,
  };
};

async function renderOne(shot: Shot, { gpus }: RenderCommand, loader: SceneLoader, run: Run): Promise<RenderOutcome> {
  const lane = new Lane({ ...run, loader, keepPartial: true }, gpus[0]);
  try {
    const made = await lane.render(shot);
    if (made) return { result: resultOf(shot, made, run.interrupted), exitCode: exitOf(run) };
    run.progress.line('nothing has been accumulated yet; no file written.');
    return { result: undefined, exitCode: exitOf(run) || EXIT.failure };
  } finally {
    lane.close();
  }
}

/** Each GPU takes the next picture when it is done with one. What fails is told, and the others go on. */
async function renderMany(shots: readonly Shot[], { gpus, resume }: RenderCommand, loader: SceneLoader, run: Run): Promise<RenderOutcome> {
  const { io, progress, signal } = run;
  const start = io.now();
  const journal = new Journal(io.cwd);
  const waiting: Shot[] = [];
  for (const shot of shots) if (!resume || !(await journal.isDone(shot))) waiting.push(shot);
  const skipped = shots.length - waiting.length;
  if (skipped > 0) progress.line(`${skipped} of ${shots.length} pictures are there already.`);
  const pictures: (RenderResult | FailedPicture)[] = [];
  let exitCode = 0, next = 0, begun = skipped;
  const names: readonly (string | undefined)[] = gpus.length === 0 ? [undefined] : gpus;
  progress.shared = names.length > 1;
  const work = async (name: string | undefined): Promise<void> => {
    // Loaders keep the last model, which lanes would take from one another.
    const lane = new Lane({ ...run, loader: names.length > 1 ? new SceneLoader(run.backend, io.cwd) : loader, keepPartial: false }, name);
    try {
      while (next < waiting.length && !signal.aborted) {
        const shot = waiting[next++] as Shot;
        progress.prefix = `[${++begun}/${shots.length}] `;
        try {
          const made = await lane.render(shot);
          if (!made) continue;
          await journal.done(shot, made.files);
          pictures.push(resultOf(shot, made, null));
        } catch (error) {
          if (signal.aborted) return;
          // Without a GPU, or with a bug, the next picture fares no better.
          if (exitCodeOf(error) === EXIT.gpu || exitCodeOf(error) === EXIT.internal) throw error;
          exitCode ||= exitCodeOf(error);
          progress.warning(`${shotLabel(shot)}: ${errorLine(error)}`);
          pictures.push({ ok: false, model: shot.options.model, files: shot.outputs.map(({ path }) => path), ...named(shot), error: describeError(error) });
        }
      }
    } finally {
      lane.close();
    }
  };
  await Promise.all(names.map(work));
  progress.prefix = '';
  const failed = pictures.filter(({ ok }) => !ok).length;
  const missing = shots.length - skipped - pictures.length;
  progress.line(`${shots.length - failed - missing} of ${shots.length} pictures in ${duration(io.now() - start)}${failed > 0 ? `, ${failed} failed` : ''}${missing > 0 ? '; --resume goes on' : ''}`);
  return {
    result: { ok: failed === 0 && missing === 0, version: version(), pictures, total: shots.length, skipped, failed, interrupted: run.interrupted, totalMs: io.now() - start },
    exitCode: exitOf(run) || exitCode,
  };
}
