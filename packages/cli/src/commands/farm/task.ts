import { rm } from 'node:fs/promises';
import { hostname } from 'node:os';
import type { FarmJob, FarmRequest, FarmStore, JobRenderer, JobResult } from '@glanz/farm';
import type { Backend } from '../../backend';
import { EXIT, EXIT_OF_INTERRUPT } from '../../errors';
import { farmRenderer } from '../../farm/job-renderer';
import { imageName } from '../../farm/openjd';
import type { FarmPlan } from '../../farm/plan';
import type { CliIo, Interrupt } from '../../io';
import { usage } from '../../options';
import type { ProgressReporter } from '../../progress';
import { jsonLine, visible } from '../../visible';
import { openStore } from './open-store';
import type { FarmCommand } from './parse';

/**
 * `glanz farm task`: renders some images of a batch in this process, for schedulers that start a process for each
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
  const renderer = farmRenderer(io, backend, gpus[0]);
  const requested = images && new Set(images);
  let rendered = 0;
  let done = 0;
  try {
    for await (const image of plan.images(store)) {
      const { index, id, requests, paths } = image;
      const name = imageName(image);
      if (requested && !requested.delete(index) && !requested.delete(name)) continue;
      let result = await store.result(id);
      const merge = requests[0]?.job.merge;
      for (const job of result ? [] : jobsOf(requests, merge, part)) {
        result = await store.result(job.id);
        if (result) continue;
        result = await renderInto(store, job, renderer, stop.signal);
        if (!result) return EXIT_OF_INTERRUPT[interrupted ?? 'SIGTERM'];
        rendered++;
      }
      if (result?.id === id) await store.deliver(result, { root: plan.outputRoot, paths });
      done++;
      if (requested?.size === 0) break;
    }
  } finally {
    stopListening();
    progress.clear();
  }
  const [unknown] = requested ?? [];
  if (unknown !== undefined) throw usage(`--image: the batch has no image "${unknown}".`);
  if (json) io.stdout(jsonLine({ ok: true, images: done, rendered }));
  else if (!quiet) io.stderr(`${visible(`${done} images, ${rendered} jobs rendered`)}\n`);
  return EXIT.ok;
}

/** The jobs of an image, or of one of its parts; an image that is not in parts counts as its part 0. */
function jobsOf(requests: readonly FarmRequest[], merge: FarmJob | undefined, part: number | undefined): FarmJob[] {
  const jobs = requests.map(({ job }) => job);
  if (part !== undefined) return jobs.slice(part, part + 1);
  return merge ? [...jobs, merge] : jobs;
}

async function renderInto(
  store: FarmStore,
  job: FarmJob,
  renderer: JobRenderer,
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
    );
    await store.dropCheckpoint(job.id);
    return await store.result(job.id);
  } finally {
    await rm(folder, { recursive: true, force: true });
  }
}
