import { mkdir } from 'node:fs/promises';
import { dirname, resolve } from 'node:path';
import type { Backend } from '../backend';
import { checkBatchOutputs, readBatch } from '../batch-file';
import { CliError, EXIT, EXIT_OF_INTERRUPT } from '../errors';
import { isEnvironmentFile } from '../environment';
import { checkInput } from '../input';
import { chooseGpus } from '../gpus/choose-gpus';
import type { CliIo } from '../io';
import type { RenderCommand, RenderCommandOptions } from '../options';
import { checkWritable } from '../output/write';
import { duration, type ProgressReporter } from '../progress';
import { Batch, type Run } from '../render/batch';
import { Journal } from '../render/journal';
import { GpuWorker } from '../render/gpu-worker';
import { resultOf, type BatchResult, type RenderResult } from '../render/results';
import { SceneLoader } from '../render/scene';
import { checkDistinct, shotsOf, type Shot } from '../render/shots';
import { version } from '../version';

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
  return interruptible(io, backend, progress, async (run) => {
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
    const gpus = await gpusOf(command, backend);
    return run.many
      ? await renderMany(shots, { ...command, gpus }, loader, run)
      : await renderOne(shots[0] as Shot, { ...command, gpus }, loader, run);
  });
}

/** Runs what can be ended by Ctrl-C or a signal, and says what the process ends with. */
export async function interruptible<Result>(
  io: CliIo,
  backend: Backend,
  progress: ProgressReporter,
  work: (run: Run) => Promise<{ readonly result: Result | undefined; readonly exitCode: number }>,
): Promise<{ readonly result: Result | undefined; readonly exitCode: number }> {
  const abort = new AbortController();
  const run: Run = { io, backend, progress, signal: abort.signal, interrupted: null };
  const stopListening = io.onInterrupt((signal) => {
    run.interrupted = signal;
    progress.line(
      signal === 'SIGINT'
        ? `stopping${run.many ? '' : ': writing the samples so far'} (Ctrl-C again to exit at once)`
        : `stopping${run.many ? '' : ': writing the samples so far'}`,
    );
    abort.abort();
  });
  try {
    return await work(run);
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

export const exitOf = ({ interrupted }: Run) => (interrupted === null ? EXIT.ok : EXIT_OF_INTERRUPT[interrupted]);

/** The GPUs' names, all of them for `--gpu all`; in this process, GPUs of one name cannot be distinguished. */
export async function gpusOf({ gpus }: Pick<RenderCommand, 'gpus'>, backend: Backend): Promise<string[]> {
  if (gpus.length === 0) return [];
  const chosen = await chooseGpus(gpus, backend);
  const hidden = chosen.find((gpu) => gpu.hidden.length > 0);
  if (hidden)
    throw new CliError(
      'cli/gpu-isolation',
      `Several GPUs have the name of ${hidden.label}, and one process cannot distinguish them. Render the batch by glanz farm task BATCH --gpu ${gpus.includes('all') ? 'all' : `"${hidden.label}"`}, which starts a process for each.`,
    );
  return chosen.flatMap(({ name }) => (name === undefined ? [] : [name]));
}

/** The error of `--variant all` for a model without any. */
export const noVariants = ({ model }: RenderCommandOptions): CliError =>
  new CliError('cli/usage', `--variant all: "${model}" has no variants.`);

async function variantsOf(
  options: RenderCommandOptions,
  loader: SceneLoader,
  { progress, signal }: Run,
): Promise<readonly string[]> {
  progress.stage('load model');
  const { variants = [] } = (await loader.load(options, signal)).scene;
  if (variants.length === 0) throw noVariants(options);
  return variants;
}

async function renderOne(shot: Shot, { gpus }: RenderCommand, loader: SceneLoader, run: Run): Promise<RenderOutcome> {
  const worker = new GpuWorker({ ...run, loader, keepPartial: true }, gpus[0]);
  try {
    const made = await worker.render({ shot, lostGpus: 0 });
    if (made) return { result: resultOf(shot, made, run.interrupted), exitCode: exitOf(run) };
    run.progress.line('nothing has been accumulated yet; no file written.');
    return { result: undefined, exitCode: exitOf(run) || EXIT.failure };
  } finally {
    worker.close();
  }
}

/** Each GPU takes the next image when it is done with one. What fails is reported, and the others continue. */
export async function renderMany(
  shots: readonly Shot[],
  { gpus, resume }: Pick<RenderCommand, 'gpus' | 'resume'>,
  loader: SceneLoader,
  run: Run,
): Promise<{ readonly result: BatchResult; readonly exitCode: number }> {
  const { io, progress } = run;
  const start = io.now();
  const journal = new Journal(io.cwd);
  const waiting: Shot[] = [];
  for (const shot of shots) if (!resume || !(await journal.isDone(shot))) waiting.push(shot);
  const skipped = shots.length - waiting.length;
  if (skipped > 0) progress.line(`${skipped} of ${shots.length} images exist already.`);
  const batch = new Batch(waiting, skipped, journal, run);
  const names: readonly (string | undefined)[] = gpus.length === 0 ? [undefined] : gpus;
  progress.shared = names.length > 1;
  // Loaders keep the last model, which workers would take from one another.
  await batch.run(
    names.map(
      (name) =>
        new GpuWorker(
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
