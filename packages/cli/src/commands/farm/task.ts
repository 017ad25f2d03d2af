import { rm } from 'node:fs/promises';
import { hostname } from 'node:os';
import { resolve } from 'node:path';
import { FolderStore, type FarmJob, type JobRenderer, type JobResult } from '@glanz/farm';
import type { Backend } from '../../backend';
import { EXIT, EXIT_OF_INTERRUPT } from '../../errors';
import { farmRenderer } from '../../farm/job-renderer';
import type { FarmPlan } from '../../farm/plan';
import type { CliIo, Interrupt } from '../../io';
import { usage } from '../../options';
import type { ProgressReporter } from '../../progress';
import { jsonLine, visible } from '../../visible';
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
  const { images, json, quiet, gpus } = command;
  const total = await plan.check();
  const beyond = images?.find((index) => index >= total);
  if (beyond !== undefined) throw usage(`--image ${beyond}: the batch has ${total} images, from 0 to ${total - 1}.`);
  const store = new FolderStore(resolve(io.cwd, command.store));
  const stop = new AbortController();
  let interrupted: Interrupt | undefined;
  const stopListening = io.onInterrupt((signal) => {
    interrupted = signal;
    stop.abort();
  });
  const renderer = farmRenderer(io, backend, gpus[0]);
  const wanted = images && new Set(images);
  let rendered = 0;
  let done = 0;
  try {
    for await (const { index, id, requests, paths } of plan.images(store)) {
      if (wanted && !wanted.has(index)) continue;
      let result = await store.result(id);
      const merge = requests[0]?.job.merge;
      for (const job of result ? [] : [...requests.map((request) => request.job), ...(merge ? [merge] : [])]) {
        result = await store.result(job.id);
        if (result) continue;
        result = await renderInto(store, job, renderer, stop.signal);
        if (!result) return EXIT_OF_INTERRUPT[interrupted ?? 'SIGTERM'];
        rendered++;
      }
      if (result) await store.deliver(result, { root: plan.outputRoot, paths });
      done++;
      if (wanted && done === wanted.size) break;
    }
  } finally {
    stopListening();
    progress.clear();
  }
  if (json) io.stdout(jsonLine({ ok: true, images: done, rendered }));
  else if (!quiet) io.stderr(`${visible(`${done} images, ${rendered} jobs rendered`)}\n`);
  return EXIT.ok;
}

async function renderInto(
  store: FolderStore,
  job: FarmJob,
  renderer: JobRenderer,
  signal: AbortSignal,
): Promise<JobResult | undefined> {
  const start = performance.now();
  const folder = await store.begin(job.id);
  const checkpoint = await store.checkpoint(job.id);
  try {
    const made = await renderer.render(
      { type: 'job', job, store: store.folder, folder, checkpoint },
      signal,
      () => undefined,
    );
    if (!made) return undefined;
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
    await rm(checkpoint, { force: true });
    return await store.result(job.id);
  } finally {
    await rm(folder, { recursive: true, force: true });
  }
}
