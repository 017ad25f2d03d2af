import { rm } from 'node:fs/promises';
import { hostname } from 'node:os';
import type { FarmJob, FarmRequest, FarmStore, JobResult } from '@glanz/farm';
import type { Backend } from '../../backend';
import { EXIT, EXIT_OF_INTERRUPT } from '../../errors';
import { gpuRenderer, type GpuRenderer } from '../../farm/gpu-renderer';
import { imageName } from '../../farm/openjd';
import type { FarmPlan } from '../../farm/plan';
import { chooseGpus } from '../../gpus/choose-gpus';
import type { CliIo, Interrupt } from '../../io';
import { usage } from '../../options';
import type { ProgressReporter } from '../../progress';
import { jsonLine, visible } from '../../visible';
import { openStore } from './open-store';
import type { FarmCommand } from './parse';

/**
 * `glanz farm task`: renders some images of a batch without a queue, for schedulers that start a process for each
 * (Open Job Description, Slurm arrays, indexed jobs of Kubernetes). What the store has is not rendered again. Gives the
 * exit code.
 */
export async function taskCommand(
  command: FarmCommand,
  plan: FarmPlan,
  io: CliIo,
  backend: Backend,
  progress: ProgressReporter,
): Promise<number> {
  const { images, part, json, quiet, gpus } = command;
  const total = await plan.check();
  const beyond = images?.find((image) => typeof image === 'number' && image >= total);
  if (beyond !== undefined) throw usage(`--image ${beyond}: the batch has ${total} images, from 0 to ${total - 1}.`);
  const store = await openStore(command, io);
  const stop = new AbortController();
  let interrupted: Interrupt | undefined;
  const stopListening = io.onInterrupt((signal) => {
    interrupted = signal;
    stop.abort();
  });
  const requested = images && new Set(images);
  const renderers: GpuRenderer[] = [];
  let rendered = 0;
  let done = 0;
  /** Images that are not in the store, one by one; finished ones are copied on the way. */
  async function* open(): AsyncGenerator<TaskImage> {
    for await (const image of plan.images(store)) {
      const { index, id, requests, paths } = image;
      if (requested && !requested.delete(index) && !requested.delete(imageName(image))) continue;
      const result = await store.result(id);
      if (result) await store.deliver(result, { root: plan.outputRoot, paths });
      const jobs = result ? [] : partsOf(requests, part);
      if (jobs.length === 0) done++;
      const merge = part === undefined ? requests[0]?.job.merge : undefined;
      const task = { id, paths, merge, left: jobs.length };
      for (const job of jobs) yield { job, image: task };
      if (requested?.size === 0) return;
    }
  }
  const tasks = open();
  const make = async (job: FarmJob, renderer: GpuRenderer) => {
    const there = await store.result(job.id);
    if (there || stop.signal.aborted) return there;
    const result = await renderInto(store, job, renderer, stop.signal);
    if (result) rendered++;
    return result;
  };
  /** Each GPU takes the next job; the one that has finished an image's last part adds the parts up. */
  const work = async (renderer: GpuRenderer) => {
    for (;;) {
      const { value, done: over } = await tasks.next();
      if (over || stop.signal.aborted) return;
      const { job, image } = value;
      let result = await make(job, renderer);
      if (!result) return;
      if (--image.left > 0) continue;
      if (image.merge) result = await make(image.merge, renderer);
      if (!result) return;
      if (result.id === image.id) await store.deliver(result, { root: plan.outputRoot, paths: image.paths });
      done++;
    }
  };
  try {
    for (const gpu of await chooseGpus(gpus, backend)) renderers.push(await gpuRenderer(gpu, io, backend));
    const failures: unknown[] = [];
    await Promise.all(
      renderers.map((renderer) =>
        work(renderer).catch((error: unknown) => {
          // Some stages answer an abort by throwing: what ended the others, or the interrupt, is reported then.
          if (stop.signal.aborted && (error as Error | undefined)?.name === 'AbortError') return;
          failures.push(error);
          // The others keep their samples.
          stop.abort();
        }),
      ),
    );
    if (failures.length > 0) throw failures[0];
  } finally {
    for (const renderer of renderers) renderer.close();
    stopListening();
    progress.clear();
  }
  if (interrupted) return EXIT_OF_INTERRUPT[interrupted];
  const [unknown] = requested ?? [];
  if (unknown !== undefined) throw usage(`--image: the batch has no image "${unknown}".`);
  if (json) io.stdout(jsonLine({ ok: true, images: done, rendered }));
  else if (!quiet) io.stderr(`${visible(`${done} images, ${rendered} jobs rendered`)}\n`);
  return EXIT.ok;
}

/** A job of an image that is rendered. */
interface TaskImage {
  readonly job: FarmJob;
  readonly image: {
    readonly id: string;
    readonly paths: readonly string[];
    readonly merge: FarmJob | undefined;
    /** Jobs that are not finished, without the merge. */
    left: number;
  };
}

/** The jobs of an image without their merge, or one of its parts; an image that is not in parts counts as its part 0. */
function partsOf(requests: readonly FarmRequest[], part: number | undefined): FarmJob[] {
  const jobs = requests.map(({ job }) => job);
  return part === undefined ? jobs : jobs.slice(part, part + 1);
}

async function renderInto(
  store: FarmStore,
  job: FarmJob,
  renderer: GpuRenderer,
  signal: AbortSignal,
): Promise<JobResult | undefined> {
  const start = performance.now();
  const folder = await store.begin(job.id);
  const checkpoint = await store.checkpoint(job.id);
  try {
    const made = await renderer.render(
      { type: 'job', job, store: store.address, folder, checkpoint },
      signal,
      () => undefined,
    );
    if (!made) {
      await store.keepCheckpoint(job.id);
      return undefined;
    }
    await store.commit(
      folder,
      {
        id: job.id,
        label: job.label,
        seconds: (performance.now() - start) / 1000,
        worker: `${hostname()}-${process.pid}`,
        finished: new Date().toISOString(),
        info: made.info,
      },
      made.files,
      made.hashes,
    );
    await store.dropCheckpoint(job.id);
    return await store.result(job.id);
  } finally {
    await rm(folder, { recursive: true, force: true });
  }
}
