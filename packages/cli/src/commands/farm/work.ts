import { resolve } from 'node:path';
import { startFarmWorker, type FarmWorker, type WorkerEvent } from '@glanz/farm';
import type { Backend } from '../../backend';
import { EXIT } from '../../errors';
import { rendererOf } from '../../farm/gpu-renderer';
import { chooseGpus } from '../../gpus/choose-gpus';
import { checkHiding } from '../../gpus/hidden-files';
import type { CliIo } from '../../io';
import type { ProgressReporter } from '../../progress';
import { jsonLine } from '../../visible';
import { openStore } from './open-store';
import type { FarmCommand } from './parse';

/** Milliseconds between two looks at whether the queue is empty. */
const LOOK_MS = 500;

const EVENTS = {
  begun: ({ job }: WorkerEvent & { type: 'begun' }) => `begin ${job.label}`,
  done: ({ job, result, first }: WorkerEvent & { type: 'done' }) =>
    `${first ? 'done' : 'found'} ${job.label}, ${result.seconds.toFixed(1)} s`,
  failed: ({ job, failure, next }: WorkerEvent & { type: 'failed' }) =>
    `failed ${job.label}: ${failure.message} [${failure.code}], ${next}`,
  'given-back': ({ job }: WorkerEvent & { type: 'given-back' }) => `given back ${job.label}`,
  cancelled: ({ job }: WorkerEvent & { type: 'cancelled' }) => `cancelled ${job.label}`,
  redis: ({ message }: WorkerEvent & { type: 'redis' }) => `Redis: ${message}`,
} as Readonly<Record<WorkerEvent['type'], (event: never) => string>>;

/** `glanz farm work`: renders jobs until a signal, or until the queue is empty. Gives the exit code. */
export async function workCommand(
  command: FarmCommand,
  io: CliIo,
  backend: Backend,
  progress: ProgressReporter,
): Promise<number> {
  const { redis, queue, lock, outputRoot, untilEmpty, json } = command;
  const gpus = await chooseGpus(command.gpus, backend);
  for (const { hidden } of gpus) await checkHiding(hidden);
  const store = await openStore(command, io);
  const isBucket = store.address.cache !== undefined;
  const counts = { done: 0, failed: 0 };
  let lastRedis = '';
  const onEvent = (event: WorkerEvent) => {
    if (event.type === 'done') counts.done++;
    if (event.type === 'failed' && event.next.startsWith('given up')) counts.failed++;
    // While Redis is away the same error comes repeatedly.
    if (event.type === 'redis' && event.message === lastRedis) return;
    lastRedis = event.type === 'redis' ? event.message : '';
    progress.line(EVENTS[event.type](event as never));
  };
  const workers: FarmWorker[] = [];
  const stop = new AbortController();
  const stopListening = io.onInterrupt(() => {
    progress.line('stopping: what is unfinished goes back to the queue');
    stop.abort();
  });
  try {
    for (const gpu of gpus)
      workers.push(
        await startFarmWorker({
          redis: redis as string,
          name: queue,
          store,
          renderer: rendererOf(gpu),
          gpu: gpu.label,
          // Machines that share a bucket need not share a folder.
          outputRoot: outputRoot === undefined ? (isBucket ? false : undefined) : resolve(io.cwd, outputRoot),
          ...(lock === undefined ? {} : { lockMs: 1000 * lock, beatMs: Math.min(5000, 250 * lock) }),
          onEvent,
        }),
      );
    progress.line(`${workers.length === 1 ? 'a worker is' : `${workers.length} workers are`} ready`);
    // While Redis is away, nobody knows what is left.
    const aborted = new Promise<void>((done) => stop.signal.addEventListener('abort', () => done()));
    const left = async () => (untilEmpty ? Promise.race([(workers[0] as FarmWorker).left(), aborted]) : undefined);
    for (let empty = 0; !stop.signal.aborted && empty < 2;) {
      await io.wait(LOOK_MS, stop.signal);
      empty = !stop.signal.aborted && (await left()) === 0 ? empty + 1 : 0;
    }
  } finally {
    await Promise.all(workers.map((worker) => worker.drain()));
    stopListening();
  }
  if (json) io.stdout(jsonLine({ ok: counts.failed === 0, ...counts }));
  return counts.failed === 0 ? EXIT.ok : EXIT.failure;
}
