import { BvhError } from '../error';
import { builtin } from './port';

/** A web worker, as far as it is used here. */
export interface WebWorkerLike {
  postMessage(message: unknown, transfer: Transferable[]): void;
  addEventListener(type: string, listener: (event: Event) => void): void;
  terminate(): void;
}

/** A `Worker` of Node's `worker_threads`, as far as it is used here. */
export interface NodeWorkerLike {
  // Node names its own transferables: any will do.
  postMessage(message: unknown, transfer: readonly never[]): void;
  on(type: string, listener: (value: unknown) => void): unknown;
  terminate(): unknown;
  ref(): void;
  unref(): void;
}

/** The near end of a worker: the same for both kinds. */
export interface WorkerLine {
  post(message: unknown, transfer: readonly ArrayBuffer[]): void;
  /** In Node: whether the worker keeps the process alive. */
  hold(on: boolean): void;
  terminate(): void;
}

/** Threads that this machine runs at a time. */
export function hardwareThreads(): number {
  const { navigator } = globalThis as { navigator?: { readonly hardwareConcurrency?: number } };
  return (
    navigator?.hardwareConcurrency ??
    builtin<{ availableParallelism(): number }>('node:os')?.availableParallelism() ??
    1
  );
}

let elsewhere: string | undefined;

/**
 * Starts the package's own worker file. From this page's origin no content security policy has to be widened for it.
 * From another one, a content delivery network say, browsers refuse; there a worker of a Blob imports the file, unless
 * the policy forbids that.
 */
export function startWorker(): WebWorkerLike | NodeWorkerLike {
  if (typeof Worker === 'function') {
    try {
      // In this form bundlers find the file.
      return new Worker(new URL('./worker.js', import.meta.url), { type: 'module', name: 'glanz-bvh' });
    } catch (error) {
      if ((error as Error).name !== 'SecurityError') throw error;
      const { url } = import.meta;
      elsewhere ??= URL.createObjectURL(
        new Blob([`import ${JSON.stringify(new URL('./worker.js', url).href)};`], { type: 'text/javascript' }),
      );
      return new Worker(elsewhere, { type: 'module', name: 'glanz-bvh' });
    }
  }
  const threads = builtin<{ readonly Worker: new (url: URL) => NodeWorkerLike }>('node:worker_threads');
  if (!threads)
    throw new BvhError(
      'bvh/worker',
      'There are no workers here: neither Worker nor process.getBuiltinModule (Node 20.16 or later).',
    );
  // Not in that form, or they would add the file a second time.
  const { url } = import.meta;
  return new threads.Worker(new URL('./worker.js', url));
}

/** @param failed Told once, if the worker cannot be loaded, throws or ends by itself. */
export function connect(
  worker: WebWorkerLike | NodeWorkerLike,
  heard: (message: unknown) => void,
  failed: (why: string) => void,
): WorkerLine {
  let over = false;
  const fail = (why: string) => {
    if (over) return;
    over = true;
    void worker.terminate();
    failed(why);
  };
  const terminate = () => {
    over = true;
    void worker.terminate();
  };
  const hear = (message: unknown) => {
    if (!over) heard(message);
  };
  if ('on' in worker) {
    worker.on('message', hear);
    worker.on('error', (error) => fail((error as Error).message));
    worker.on('exit', () => fail('it has ended'));
    return {
      post: (message, transfer) => worker.postMessage(message, transfer as readonly never[]),
      hold: (on) => (on ? worker.ref() : worker.unref()),
      terminate,
    };
  }
  worker.addEventListener('message', (event) => hear((event as MessageEvent).data));
  worker.addEventListener('messageerror', () => fail('its answer could not be read'));
  worker.addEventListener('error', (event) => {
    event.preventDefault();
    fail(
      (event as ErrorEvent).message ||
        'its script could not be loaded (a wrong address, or a content security policy without worker-src)',
    );
  });
  return { post: (message, transfer) => worker.postMessage(message, [...transfer]), hold: () => undefined, terminate };
}
