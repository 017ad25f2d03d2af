import { farmMetrics, openFarmQueue, serveRenderer, type FarmQueue } from '@glanz/farm';
import type { Backend } from '../../backend';
import { EXIT } from '../../errors';
import { farmRenderer } from '../../farm/job-renderer';
import type { CliIo } from '../../io';
import { duration, ProgressReporter } from '../../progress';
import { version } from '../../version';
import { jsonLine, visible } from '../../visible';
import { renderCommand } from '../render';
import { writeManifest } from './manifest';
import { writeTemplate } from './template';
import { openPlan } from './open-plan';
import { openStore } from './open-store';
import { serveFarm } from './serve';
import type { FarmCommand } from './parse';
import { taskCommand } from './task';
import { workCommand } from './work';

/** `glanz farm`. Gives the exit code. */
export async function farmCommand(command: FarmCommand, io: CliIo, backend: Backend): Promise<number> {
  const progress = new ProgressReporter(io, command.quiet || command.json);
  for (const text of command.warnings) progress.warning(text);
  switch (command.action) {
    case 'submit':
      if (command.openjd !== undefined) return writeTemplate(command, io, backend, progress);
      return command.redis === undefined
        ? renderHere(command, io, backend)
        : submit(command, command.redis, io, backend, progress);
    case 'work':
      return workCommand(command, io, backend, progress);
    case 'task':
      return taskCommand(command, await openPlan(command, io, backend, progress), io, backend, progress);
    case 'manifest':
      return writeManifest(command, await openPlan(command, io, backend, progress), io, progress);
    case 'clean': {
      const { entries, bytes } = await (await openStore(command, io)).clean(command.olderThan as number);
      report(command, io, { entries, bytes }, `${entries} entries deleted, ${(bytes / 1e6).toFixed(1)} MB`);
      return EXIT.ok;
    }
    case 'renderer':
      return serveRenderer(farmRenderer(io, backend, command.gpus[0]));
    default:
      return withQueue(command, async (queue) => {
        if (command.action === 'status') return status(command, queue, io);
        if (command.action === 'serve') return serveFarm(command, queue, io);
        const ids = command.all ? undefined : command.args;
        if (command.action === 'retry') {
          const retried = await queue.retry(ids);
          report(command, io, { retried }, `${retried} jobs are queued again`);
        } else {
          const { removed, stopping } = await queue.cancel(ids);
          report(command, io, { removed, stopping }, `${removed} jobs removed, ${stopping} stop`);
        }
        return EXIT.ok;
      });
  }
}

function report({ json, quiet }: FarmCommand, io: CliIo, result: object, text: string): void {
  if (json) io.stdout(jsonLine({ ok: true, ...result }));
  else if (!quiet) io.stderr(`${visible(text)}\n`);
}

async function withQueue(
  { redis, queue: name }: FarmCommand,
  use: (queue: FarmQueue) => Promise<number>,
): Promise<number> {
  const queue = await openFarmQueue({ redis: redis as string, name });
  try {
    return await use(queue);
  } finally {
    await queue.close();
  }
}

/** Without a queue: `glanz render --batch FILE --resume`. */
async function renderHere(command: FarmCommand, io: CliIo, backend: Backend): Promise<number> {
  const { args, values, json, quiet, gpus, outputRoot } = command;
  const { result, exitCode } = await renderCommand(
    {
      kind: 'render',
      json,
      quiet,
      options: undefined,
      batch: args[0],
      outputRoot,
      values,
      resume: true,
      checkpoint: undefined,
      warnings: [],
      gpus,
    },
    io,
    backend,
    new ProgressReporter(io, quiet),
  );
  if (json) io.stdout(jsonLine(result ?? { ok: false }));
  return exitCode;
}

async function submit(
  command: FarmCommand,
  redis: string,
  io: CliIo,
  backend: Backend,
  progress: ProgressReporter,
): Promise<number> {
  const start = io.now();
  const plan = await openPlan(command, io, backend, progress);
  const total = await plan.check();
  const store = await openStore(command, io);
  return withQueue({ ...command, redis }, async (queue) => {
    for (const text of await queue.warnings()) progress.warning(text);
    let images = 0;
    let finished = 0;
    async function* requests() {
      for await (const image of plan.images(store)) {
        images++;
        // Its parts may be gone when the merge is done: they are not queued again.
        const done = image.requests.length > 1 ? await store.result(image.id) : undefined;
        if (done) {
          await store.deliver(done, { root: plan.outputRoot, paths: image.paths });
          finished++;
        } else yield* image.requests;
      }
    }
    const submission = await queue.submit(requests(), store, () => progress.stage('submit', images / total));
    progress.clear();
    const { failed } = await queue.status();
    if (failed > 0)
      progress.warning(
        `${failed} jobs of this queue have failed permanently, and submitting them again does not queue them: glanz farm status has their reasons, glanz farm retry queues them.`,
      );
    const { queued } = submission;
    finished += submission.finished;
    report(
      command,
      io,
      { version: version(), images, queued, finished, store: store.address.url, totalMs: io.now() - start },
      `${images} images: ${queued} jobs queued${finished > 0 ? `, ${finished} results exist already` : ''}, in ${duration(io.now() - start)}`,
    );
    return EXIT.ok;
  });
}

async function status({ json, metrics }: FarmCommand, queue: FarmQueue, io: CliIo): Promise<number> {
  const now = await queue.status();
  if (metrics) {
    io.stdout(farmMetrics(now));
    return EXIT.ok;
  }
  const deadLetters = await queue.deadLetters();
  if (json) io.stdout(jsonLine({ ok: true, ...now, deadLetters }));
  else {
    const { waiting, active, delayed, failed, done, secondsLeft, workers } = now;
    const left = secondsLeft === undefined || secondsLeft === 0 ? '' : ` · ${duration(1000 * secondsLeft)} left`;
    const lines = [
      `${done} done · ${active} active · ${waiting} waiting · ${delayed} delayed · ${failed} failed${left}`,
      ...workers.map(
        ({ host, pid, gpu, job, done: own }) =>
          `  ${host} ${pid}${gpu ? ` ${gpu}` : ''}: ${job ? `${job.label}, ${job.samples}/${job.of}` : 'idle'} (${own} done)`,
      ),
      ...deadLetters.flatMap(({ id, label, reason, log }) => [
        `failed ${id} ${label}: ${reason}`,
        ...log.slice(-6).map((line) => `    ${line}`),
      ]),
    ];
    io.stdout(`${lines.map(visible).join('\n')}\n`);
  }
  return EXIT.ok;
}
